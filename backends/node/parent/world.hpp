// A world in a child process. The child has shapes, bodies, joints and a step; what can be made of these alike for
// every engine is made here: impulses, forces at points, kinematic targets, events, joint coordinates, joints that
// break.
#pragma once

#include <map>
#include <mutex>
#include <set>
#include <vector>

#include "child.hpp"
#include "manifest.hpp"
#include "plumb/backend.hpp"
#include "plumb/backend/touch_tracker.hpp"

namespace plumb::wire {

class World : public IPhysicsWorld, public IJoints, public IQueries, public ISettings, public IExceptions {
 public:
  World(const WorldInit& init, const Manifest& manifest, const std::vector<std::string>& command);

  IJoints* joints() override { return this; }
  IQueries* queries() override { return this; }
  ISettings* settings() override { return this; }
  IExceptions* exceptions() override { return this; }

  PlumbResult get_setting(const char* name, PlumbSettingValue& value) override;
  PlumbResult set_setting(const char* name, const PlumbSettingValue& value) override;

  PlumbResult create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) override;
  PlumbResult destroy_shapes(std::span<const PlumbShape> ids) override;
  PlumbResult create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) override;
  PlumbResult destroy_bodies(std::span<const PlumbBody> ids) override;
  PlumbResult read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) override;
  PlumbResult write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) override;
  PlumbResult set_gravity(const PlumbVec3& gravity) override;

  PlumbResult step(double dt) override;
  PlumbResult wait(PlumbStepReport& report) override;
  std::span<const PlumbContact> contacts() override;
  std::span<const PlumbEvent> events() override { return events_; }

  PlumbResult create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) override;
  PlumbResult destroy_joints(std::span<const PlumbJoint> ids) override;
  PlumbResult read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) override;
  PlumbResult write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) override;

  Hits cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) override;
  Hits cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) override;
  Hits overlap_shapes(std::span<const PlumbOverlap> overlaps) override;

  PlumbResult set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) override;

 private:
  struct Body {
    PlumbBody handle = 0;
    PlumbBodyDesc desc{};
    bool awake = true;
  };
  struct Joint {
    PlumbJoint handle = 0;
    PlumbJointDesc desc{};
  };
  struct Push {  ///< of a body in the next step, at its centre of mass
    PlumbVec3 force{}, torque{};
  };
  struct Motion {
    PlumbPose pose;
    PlumbVec3 linear, angular;
  };

  Frame call(Call what, std::span<const double> numbers, const std::string& text = {});
  [[nodiscard]] bool needs(PlumbNeeds bits) const { return (needs_ & bits) != 0; }
  [[nodiscard]] Body& body(PlumbBody id) { return bodies_[slot_of(id)]; }
  [[nodiscard]] const Body& body(PlumbBody id) const { return bodies_[slot_of(id)]; }
  [[nodiscard]] PlumbBody handle_of(double slot) const;

  std::vector<double> read_rows(PlumbField field, std::span<const PlumbBody> ids);
  void write_rows(PlumbField field, std::span<const PlumbBody> ids, std::span<const double> rows);
  std::vector<Motion> motions(std::span<const PlumbBody> ids);
  void tell_rolling_friction(std::span<const PlumbBodyDesc> descs, std::span<const PlumbBody> ids);
  void write_mirror(PlumbField field, PlumbBody id, const double* row);
  void take_away_locked(std::span<const PlumbBody> ids, std::span<double> velocities) const;
  void add_pushes(PlumbField field, std::span<const PlumbBody> ids, std::span<const double> rows);
  void add_impulses(PlumbField field, std::span<const PlumbBody> ids, std::span<const double> rows);

  void aim_kinematics(double dt);
  void settle_kinematics();
  void take_touches(std::span<const double> pairs);
  void take_sleep();
  void break_joints(double dt);
  void remove_joints(std::span<const PlumbJoint> ids);
  Hits hits_of(const Frame& reply, PlumbHitMode mode, std::size_t queries) const;

  std::mutex one_call_;  ///< queries may come from several threads
  std::vector<PlumbSettingInfo> setting_infos_;
  std::vector<PlumbSettingValue> setting_values_;
  double deadline_ = 60;  ///< s
  const Manifest& manifest_;
  Child child_;
  PlumbNeeds needs_;
  std::vector<Body> bodies_;
  std::vector<Joint> joints_;
  std::set<PlumbJoint> breakable_;
  std::map<PlumbBody, Push> pushes_;
  std::map<PlumbBody, PlumbPose> targets_;
  std::vector<PlumbBody> aimed_;  ///< kinematic bodies that the last step took to their targets
  backend::TouchTracker touches_;
  std::vector<PlumbContact> contacts_;
  std::vector<PlumbEvent> events_, ended_;
  PlumbStepReport report_{};
};

/// Rows of a body's descriptor on the wire, and of a joint's.
void append_body(std::vector<double>& row, std::uint32_t slot, const PlumbBodyDesc& desc);
void append_joint(std::vector<double>& row, std::uint32_t slot, const PlumbJointDesc& desc);
void append_shape(std::vector<double>& row, std::uint32_t slot, const PlumbShapeDesc& desc);

}  // namespace plumb::wire
