// One world: PhysX's scene, and what the interface asks for beside it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "body.hpp"
#include "contacts/listener.hpp"
#include "contacts/surface_velocity.hpp"
#include "filter.hpp"
#include "joints/joint.hpp"
#include "make_body.hpp"
#include "plumb/backend/hit_collector.hpp"
#include "plumb/backend/touch_tracker.hpp"

namespace plumb::px {

/// Objects of PhysX are given back by a call.
struct Release {
  template <class Object>
  void operator()(Object* object) const {
    object->release();
  }
};

class World final : public IPhysicsWorld,
                    public IJoints,
                    public IQueries,
                    public IClosest,
                    public ICollide,
                    public IDebug,
                    public ISettings,
                    public IExceptions,
                    public IModify {
 public:
  explicit World(const WorldInit& init);
  ~World() override;

  static const PlumbBackendInfo& info();
  static std::string unmet_requirement();
  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note);
  static std::span<const PlumbSettingInfo> setting_infos() { return settings_table().infos(); }

  // bodies.cpp
  PlumbResult create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) override;
  PlumbResult destroy_shapes(std::span<const PlumbShape> ids) override;
  PlumbResult create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) override;
  PlumbResult destroy_bodies(std::span<const PlumbBody> ids) override;
  PlumbResult set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) override;

  // fields.cpp
  PlumbResult read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) override;
  PlumbResult write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) override;

  // step.cpp
  PlumbResult set_gravity(const PlumbVec3& gravity) override;
  PlumbResult step(double dt) override;
  PlumbResult wait(PlumbStepReport& report) override;
  PlumbResult get_setting(const char* name, PlumbSettingValue& value) override;
  PlumbResult set_setting(const char* name, const PlumbSettingValue& value) override;

  // contacts/
  std::span<const PlumbContact> contacts() override { return listener_.contacts(); }
  std::span<const PlumbEvent> events() override { return events_; }

  IJoints* joints() override { return this; }
  IQueries* queries() override { return this; }
  IClosest* closest() override { return this; }
  ICollide* collide() override { return this; }
  IDebug* debug() override { return this; }
  ISettings* settings() override { return this; }
  IExceptions* exceptions() override { return this; }
  IModify* modify() override { return this; }

  // joints/world_joints.cpp
  PlumbResult create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) override;
  PlumbResult destroy_joints(std::span<const PlumbJoint> ids) override;
  PlumbResult read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) override;
  PlumbResult write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) override;

  // queries/
  Hits cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) override;
  Hits cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) override;
  Hits overlap_shapes(std::span<const PlumbOverlap> overlaps) override;
  Penetrations penetrations(std::span<const PlumbOverlap> overlaps) override;
  ClosestBodies closest_bodies(PlumbHitMode mode, std::span<const PlumbProbe> probes) override;
  PlumbResult collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                            std::span<const PlumbPairPoint>& points) override;

  // modify.cpp
  PlumbResult modify_bodies(std::span<const PlumbBodyChange> changes) override;
  PlumbResult modify_joints(std::span<const PlumbJointChange> changes) override;
  PlumbResult modify_shapes(std::span<const PlumbShape> shapes, std::span<const PlumbShapeDesc> descs) override;

  // debug.cpp
  PlumbResult candidate_pairs(std::span<const PlumbDebugPair>& pairs) override;
  PlumbResult tree_boxes(std::span<const PlumbDebugBox>& boxes) override;
  PlumbResult separating_axes(std::span<const PlumbDebugAxis>& axes) override;

 private:
  [[nodiscard]] bool needs(PlumbNeeds bits) const { return common_.needs_any(bits); }
  [[nodiscard]] Body& body(PlumbBody handle) { return *bodies_[slot_of(handle)]; }
  [[nodiscard]] Joint& joint(PlumbJoint handle) { return *joints_[slot_of(handle)]; }
  [[nodiscard]] const Shape& shape(PlumbShape handle) const { return *shapes_[slot_of(handle)]; }

  // bodies.cpp
  void add_body(Body& body);
  void remove_body(Body& body);
  void keep_apart(const Body& a, const Body& b, int reasons);
  /// Where who touches it may have changed: those that sleep within its bounds wake.
  void wake_around(const Body& body);

  void write_row(PlumbField field, Body& body, const double* row);

  // step.cpp
  void steer_kinematics(double dt);
  void settle_kinematics();
  void pull_scaled();
  void sort_scaled(Body& body);

  // contacts/events.cpp
  void gather_events();
  void track_touches();
  void track_sensors();
  void track_sleep();

  // joints/
  [[nodiscard]] Ends ends_of(const PlumbJointDesc& desc);
  void add_joint(Joint& joint);
  void remove_joint(Joint& joint);
  void wake_joint(const Joint& joint);
  void remember_turns();
  void break_joints();

  Common common_;
  std::uint32_t threads_;
  std::uint32_t dropped_ = 0;  ///< kinds of things that PhysX had no room for in the last step
  PairRules rules_;
  Listener listener_;
  SurfaceVelocities surfaces_;
  std::unique_ptr<PxDefaultCpuDispatcher, Release> dispatcher_;
  std::unique_ptr<PxScene, Release> scene_;
  std::vector<std::unique_ptr<Shape>> shapes_;  ///< by slot, null where none lives
  std::vector<std::unique_ptr<Body>> bodies_;
  std::vector<std::unique_ptr<Joint>> joints_;
  std::vector<Body*> kinematic_, scaled_;
  backend::TouchTracker touches_;
  std::vector<PlumbEvent> events_, pending_events_;
  /// What callers look at until they ask again.
  struct Lent {
    std::vector<PlumbDebugBox> boxes;
    std::vector<PlumbDebugAxis> axes;
  } lent_;
};

/// Makes room for a handle's slot and puts the object there.
template <class Object>
void put(std::vector<std::unique_ptr<Object>>& slots, std::uint64_t handle, std::unique_ptr<Object>&& object) {
  const std::uint32_t slot = slot_of(handle);
  if (slot >= slots.size()) slots.resize(slot + 1);
  slots[slot] = std::move(object);
}

}  // namespace plumb::px
