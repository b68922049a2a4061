// One world. Bodies and joints are made into skeletons when these are next needed; what comes or goes makes them anew,
// and what moves is carried over.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "collisions.hpp"
#include "joints/tree.hpp"
#include "plumb/backend/touch_tracker.hpp"
#include "plumb/backend/world_init.hpp"
#include "skeletons.hpp"
#include "solver/pair_contact.hpp"
#include "solver/rows_constraint.hpp"
#include "solver/step_solver.hpp"

namespace plumb::dart6 {

class World final : public IPhysicsWorld,
                    public IJoints,
                    public IQueries,
                    public ISettings,
                    public ISnapshot,
                    public IExceptions {
 public:
  explicit World(const WorldInit& init);
  ~World() override;

  static const PlumbBackendInfo& info();
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

  std::span<const PlumbContact> contacts() override { return meeting_.rows; }
  std::span<const PlumbEvent> events() override { return events_; }

  IJoints* joints() override { return this; }
  IQueries* queries() override { return this; }
  ISettings* settings() override { return this; }
  ISnapshot* snapshot() override { return this; }
  IExceptions* exceptions() override { return this; }

  // joints/world_joints.cpp
  PlumbResult create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) override;
  PlumbResult destroy_joints(std::span<const PlumbJoint> ids) override;
  PlumbResult read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) override;
  PlumbResult write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) override;

  // rays.cpp
  Hits cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) override;
  Hits cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) override;
  Hits overlap_shapes(std::span<const PlumbOverlap> overlaps) override;

  // snapshot.cpp
  PlumbResult save(std::span<const std::byte>& data) override;
  PlumbResult restore(std::span<const std::byte> data) override;

 private:
  /// What one geom has with another in the step in hand.
  struct Impulses {
    std::vector<PlumbContact> points;  ///< of the first sub-step in which they touched
    PlumbVec3 sum{};                   ///< N s on the second, over all of the step
    int sub_step = -1;                 ///< which that was
  };
  /// A contact of the sub-step in hand, as DART has it: the force is on the first geom.
  struct Touch {
    const ::dart::collision::Contact* contact;
    std::shared_ptr<PairContact> constraint;
  };
  /// Contacts of the step in hand.
  struct Meeting {
    std::vector<Touch> touching;                                       ///< in its last sub-step
    std::map<std::pair<std::size_t, std::size_t>, Impulses> impulses;  ///< by geoms
    std::vector<PlumbContact> rows;                                    ///< as the host reads them
  };
  /// What holds a joint that is no link.
  struct Hold {
    Joint* joint;
    std::shared_ptr<RowsConstraint> rows;
  };

  [[nodiscard]] bool needs(PlumbNeeds bits) const { return (needs_ & bits) != 0; }
  [[nodiscard]] Body& body(PlumbBody handle) { return *bodies_[slot_of(handle)]; }
  [[nodiscard]] Joint& joint(PlumbJoint handle) { return *joints_[slot_of(handle)]; }
  [[nodiscard]] const Shape& shape(PlumbShape handle) const { return *shapes_[slot_of(handle)]; }

  // joints/world_joints.cpp
  PlumbResult write_motors(std::span<const PlumbJoint> ids, ConstRows rows);

  // state.cpp
  void prepare();  ///< the skeletons are those of the world, and what was written is in their coordinates
  void make_stale();
  void write_state();
  void read_state();
  void push(Body& body, const PlumbVec3& impulse, const PlumbVec3& twist);

  // fields.cpp
  void write_row(PlumbField field, Body& body, const double* row);
  void move_ground(const Body& body);

  // step.cpp
  void steer_kinematics(double dt);
  void move_kinematics(double h);
  void settle_kinematics();
  void require_finite() const;
  void apply_forces(double h);
  void sub_step(double h);
  void add_holds(double h, std::vector<::dart::constraint::ConstraintBasePtr>& constraints);
  void gather_reactions(double h);
  void break_joints();

  // contacts.cpp
  [[nodiscard]] bool may_meet(const Geom& a, const Geom& b) const;
  [[nodiscard]] std::vector<::dart::collision::Contact*> meeting_points();
  [[nodiscard]] PairMaterial material_of(const Geom& a, const Geom& b) const;
  void find_contacts(double h, std::vector<::dart::constraint::ConstraintBasePtr>& constraints);
  void gather_impulses(double h);
  void finish_contacts();

  PlumbNeeds needs_;
  Settings settings_;
  PlumbVec3 gravity_;
  std::vector<std::unique_ptr<Shape>> shapes_;  ///< by slot, null where none lives
  std::vector<std::unique_ptr<Body>> bodies_;
  std::vector<std::unique_ptr<Joint>> joints_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> excepted_;  ///< by slot, the lower first
  std::set<std::pair<std::uint32_t, std::uint32_t>> apart_;     ///< by joints, likewise; made with the skeletons

  Skeletons skeletons_;
  Collisions collisions_;
  std::mutex query_mutex_;
  StepSolver solver_;
  bool stale_ = true;  ///< what lives has changed since the skeletons were made

  Meeting meeting_;
  std::vector<Hold> holds_;
  int sub_step_ = 0;  ///< in hand
  backend::TouchTracker touches_;
  std::vector<PlumbEvent> events_, pending_events_;
  std::vector<std::byte> snapshot_;
};

/// Makes room for a handle's slot and puts the object there.
template <class Object>
void put_in(std::vector<std::unique_ptr<Object>>& slots, std::uint64_t handle, std::unique_ptr<Object>&& object) {
  const std::uint32_t slot = slot_of(handle);
  if (slot >= slots.size()) slots.resize(slot + 1);
  slots[slot] = std::move(object);
}

}  // namespace plumb::dart6
