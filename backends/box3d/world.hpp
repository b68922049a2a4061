// One world: Box3D's, and what the interface asks for beside it.
#pragma once

#include <memory>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "body.hpp"
#include "joints/joint.hpp"
#include "plumb/backend/hit_collector.hpp"
#include "plumb/backend/touch_tracker.hpp"
#include "settings.hpp"

namespace plumb::box3d {

class World final : public IPhysicsWorld,
                    public IJoints,
                    public IQueries,
                    public ICollide,
                    public IDebug,
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

  // contacts.cpp, events.cpp
  std::span<const PlumbContact> contacts() override;
  std::span<const PlumbEvent> events() override { return events_; }

  IJoints* joints() override { return this; }
  IQueries* queries() override { return this; }
  ICollide* collide() override { return this; }
  IDebug* debug() override { return this; }
  ISettings* settings() override { return this; }
  ISnapshot* snapshot() override { return this; }
  IExceptions* exceptions() override { return this; }

  // joints/world_joints.cpp
  PlumbResult create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) override;
  PlumbResult destroy_joints(std::span<const PlumbJoint> ids) override;
  PlumbResult read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) override;
  PlumbResult write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) override;

  // queries/
  Hits cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) override;
  Hits cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) override;
  Hits overlap_shapes(std::span<const PlumbOverlap> overlaps) override;
  PlumbResult collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                            std::span<const PlumbPairPoint>& points) override;

  // debug.cpp
  PlumbResult candidate_pairs(std::span<const PlumbDebugPair>& pairs) override;
  PlumbResult tree_boxes(std::span<const PlumbDebugBox>& boxes) override;
  PlumbResult separating_axes(std::span<const PlumbDebugAxis>& axes) override;

  // snapshot.cpp
  PlumbResult save(std::span<const std::byte>& data) override;
  PlumbResult restore(std::span<const std::byte> data) override;

 private:
  struct Search;  ///< queries/search.hpp

  [[nodiscard]] bool needs(PlumbNeeds bits) const { return (needs_ & bits) != 0; }
  [[nodiscard]] Body& body(PlumbBody handle) { return *bodies_[slot_of(handle)]; }
  [[nodiscard]] Joint& joint(PlumbJoint handle) { return *joints_[slot_of(handle)]; }
  [[nodiscard]] const Shape& shape(PlumbShape handle) const { return *shapes_[slot_of(handle)]; }
  /// Whose shape it is.
  [[nodiscard]] const Body& owner(b3ShapeId shape) const;

  void make_body(Body& body);
  void write_row(PlumbField field, Body& body, const double* row);
  static bool may_collide(b3ShapeId a, b3ShapeId b, void* world);

  // step.cpp
  void steer_kinematics(double dt);
  void settle_kinematics();

  // contacts.cpp: visit(data, owner of shape a, owner of shape b, manifold)
  template <class Visit>
  void each_manifold(Visit&& visit);
  void gather_contacts();

  // events.cpp
  void gather_events();
  void track_touches();
  void track_sensors();
  void track_sleep();
  void break_joints();
  void remove_joint(Joint& joint);

  PlumbNeeds needs_;
  Settings settings_;
  b3WorldId world_{};
  b3BodyId ground_{};  ///< what joints with the world hold on to
  std::uint32_t threads_;
  std::vector<std::unique_ptr<Shape>> shapes_;  ///< by slot, null where none lives
  std::vector<std::unique_ptr<Body>> bodies_;
  std::vector<std::unique_ptr<Joint>> joints_;
  std::vector<Body*> kinematic_;
  std::uint32_t breakable_ = 0;                                 ///< joints that may break
  std::set<std::pair<std::uint32_t, std::uint32_t>> excepted_;  ///< by slot, the lower first

  std::vector<b3ContactData> contact_data_;
  std::vector<b3ShapeId> visitors_;
  std::vector<PlumbContact> contacts_;
  bool contacts_fresh_ = false;
  backend::TouchTracker touches_;
  std::vector<PlumbEvent> events_, pending_events_;
  /// What callers look at until they ask again.
  struct Lent {
    std::vector<PlumbDebugBox> boxes;
    std::vector<PlumbDebugAxis> axes;
    std::vector<std::byte> snapshot;
  } lent_;
};

/// The child of a compound, or the host's number of a triangle; triangle: Box3D's, or below 0.
[[nodiscard]] std::uint32_t child_of(const Body& body, b3ShapeId shape, int triangle);

/// Makes room for a handle's slot and puts the object there.
template <class Object>
void put(std::vector<std::unique_ptr<Object>>& slots, std::uint64_t handle, std::unique_ptr<Object>&& object) {
  const std::uint32_t slot = slot_of(handle);
  if (slot >= slots.size()) slots.resize(slot + 1);
  slots[slot] = std::move(object);
}

}  // namespace plumb::box3d
