// One world: Bullet's, and what the interface asks for beside it. The step is in step.cpp.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "body.hpp"
#include "dynamics_world.hpp"
#include "joints/joint.hpp"
#include "materials.hpp"
#include "plumb/assert.hpp"
#include "plumb/backend/cooking.hpp"
#include "plumb/backend/touch_tracker.hpp"
#include "settings.hpp"

namespace plumb::bullet {

class World final : public IPhysicsWorld,
                    public IJoints,
                    public IQueries,
                    public ICollide,
                    public IDebug,
                    public ISettings,
                    public ISnapshot,
                    public IExceptions,
                    public IModify,
                    public IManifolds,
                    public IClosest,
                    public backend::ICookedShapes,
                    private btOverlapFilterCallback,
                    private StepHooks {
 public:
  explicit World(const WorldInit& init);
  ~World() override;

  static const PlumbBackendInfo& info();
  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note);
  static backend::CookedFormat cooked_format();
  static std::vector<std::byte> cook(const PlumbShapeDesc& desc);
  static std::span<const PlumbSettingInfo> setting_infos() { return Settings::infos(); }

  // bodies.cpp
  PlumbResult create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) override;
  PlumbResult destroy_shapes(std::span<const PlumbShape> ids) override;
  PlumbResult create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) override;
  PlumbResult destroy_bodies(std::span<const PlumbBody> ids) override;
  PlumbResult set_gravity(const PlumbVec3& gravity) override;
  PlumbResult set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) override;

  // cooking/cooking.cpp
  PlumbResult create_cooked(std::span<const backend::CookedPayload> shapes, std::span<const PlumbShape> ids) override;

  // fields.cpp
  PlumbResult read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) override;
  PlumbResult write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) override;

  // step.cpp
  PlumbResult step(double dt) override;
  PlumbResult wait(PlumbStepReport& report) override;

  // contacts.cpp
  std::span<const PlumbContact> contacts() override;
  std::span<const PlumbEvent> events() override { return events_.rows; }

  IJoints* joints() override { return this; }
  IQueries* queries() override { return this; }
  ICollide* collide() override { return this; }
  IDebug* debug() override { return this; }
  ISettings* settings() override { return this; }
  ISnapshot* snapshot() override { return this; }
  IExceptions* exceptions() override { return this; }
  IModify* modify() override { return this; }
  IManifolds* manifolds() override { return this; }
  IClosest* closest() override { return this; }

  // joints/joints.cpp
  PlumbResult create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) override;
  PlumbResult destroy_joints(std::span<const PlumbJoint> ids) override;
  PlumbResult read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) override;
  PlumbResult write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) override;

  // modify.cpp
  PlumbResult modify_bodies(std::span<const PlumbBodyChange> changes) override;
  PlumbResult modify_joints(std::span<const PlumbJointChange> changes) override;
  PlumbResult modify_shapes(std::span<const PlumbShape> shapes, std::span<const PlumbShapeDesc> descs) override;

  // manifolds.cpp
  PlumbResult read_manifolds(std::span<const PlumbManifold>& manifolds) override;
  PlumbResult modify_manifolds(std::span<const PlumbManifoldChange> changes) override;

  // queries/queries.cpp
  Hits cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) override;
  Hits cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) override;
  Hits overlap_shapes(std::span<const PlumbOverlap> overlaps) override;
  Penetrations penetrations(std::span<const PlumbOverlap> overlaps) override;

  // queries/turning_casts.cpp
  Hits turning_casts(PlumbHitMode mode, std::span<const PlumbTurningCast> casts) override;

  // queries/closest.cpp
  ClosestBodies closest_bodies(PlumbHitMode mode, std::span<const PlumbProbe> probes) override;

  // queries/collide.cpp
  PlumbResult collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                            std::span<const PlumbPairPoint>& points) override;

  // debug.cpp
  PlumbResult candidate_pairs(std::span<const PlumbDebugPair>& pairs) override;
  PlumbResult tree_boxes(std::span<const PlumbDebugBox>& boxes) override;
  PlumbResult separating_axes(std::span<const PlumbDebugAxis>& axes) override;
  PlumbResult body_states(std::span<const PlumbDebugBody>& bodies) override;
  PlumbResult solved_constraints(std::span<const PlumbDebugConstraint>& constraints) override;

  // step.cpp
  PlumbResult get_setting(const char* name, PlumbSettingValue& value) override;
  PlumbResult set_setting(const char* name, const PlumbSettingValue& value) override;

  // snapshot.cpp
  PlumbResult save(std::span<const std::byte>& data) override;
  PlumbResult restore(std::span<const std::byte> data) override;

 private:
  void put_shapes(std::vector<std::shared_ptr<const Shape>> made, std::span<const PlumbShape> ids);
  [[nodiscard]] bool needs(PlumbNeeds bits) const { return (needs_ & bits) != 0; }
  /// The guard has refused handles of those who are gone.
  template <class Slots>
  [[nodiscard]] static auto& living(Slots& slots, std::uint64_t handle) {
    PLUMB_ASSERT(slot_of(handle) < slots.size() && slots[slot_of(handle)] != nullptr);
    return slots[slot_of(handle)];
  }
  [[nodiscard]] Body& body(PlumbBody handle) {
    Body& at = *living(bodies_, handle);
    PLUMB_ASSERT(at.handle == handle);
    return at;
  }
  [[nodiscard]] Joint& joint(PlumbJoint handle) {
    Joint& at = *living(joints_, handle);
    PLUMB_ASSERT(at.handle == handle);
    return at;
  }
  [[nodiscard]] const std::shared_ptr<const Shape>& shape(PlumbShape handle) const { return living(shapes_, handle); }

  // bodies.cpp
  [[nodiscard]] MadeOf made_of(const PlumbBodyDesc& desc) const;
  [[nodiscard]] btRigidBody::btRigidBodyConstructionInfo construction(const MadeOf& made, const btTransform& pose);
  [[nodiscard]] std::unique_ptr<Body> make_body(const PlumbBodyDesc& desc, PlumbBody handle);
  void add_to_bullet(Body& body);
  void take_from_bullet(Body& body);
  void prepare_motion(Body& body);
  void prepare_ccd(Body& body) const;
  void set_anchor(Body& body) const;
  void apply_gravity_scale(Body& body) const;
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
  /// Drops the contact points of two bodies: those that Bullet may no longer collide would else be solved for ever.
  void forget_contacts(Body& a, Body& b);
  void wake(Body& body);
  void wake_neighbours(const Body& body);

  // fields.cpp
  void write_pose(Body& body, const double* row);
  void write_row(PlumbField field, Body& body, const double* row);
  void write_awake(Body& body, bool awake);

  // kinematics.cpp
  void move_kinematic(int sub_steps_left, btScalar h);
  void keep_coasting();
  void damp(btScalar h);
  void hold_locks();

  // step.cpp
  void apply_settings();
  void find_contacts();
  void respond();
  void finish_step();
  void before_motion(btScalar h) override;
  void before_solve() override;
  void after_solve() override;
  void begin_events();
  void keep_sub_step_contacts();
  void forget_targets();
  void finish_events();
  void track_sleep();
  void count_bodies(PlumbStepReport& report) const;

  // contacts.cpp
  [[nodiscard]] bool is_solved(const btPersistentManifold& manifold) const;
  void gather_contacts();
  void add_sub_step_impulses();
  void track_touches();

  // manifolds.cpp
  void apply_manifold_changes();
  void take_back_manifold_changes();

  // joints/joints.cpp
  void prepare_joints(btScalar h);
  void break_joints();
  [[nodiscard]] std::unique_ptr<Joint> make_joint(const PlumbJointDesc& desc, PlumbJoint handle);
  static void check_drive_row(PlumbJointField field, const PlumbJointDesc& desc, const double* row);
  void add_to_bullet(Joint& joint);
  void take_from_bullet(Joint& joint);
  void remove_joint(Joint& joint);
  // modify.cpp
  void remake_body(const PlumbBodyChange& change, MadeOf made);
  void reshape(Body& at, const std::shared_ptr<const Shape>& other);
  void remake_joints_of(std::span<const PlumbBodyChange> changes);
  void replace_joint(std::unique_ptr<Joint> joint);

  PlumbNeeds needs_;
  Settings settings_;
  WorldParts parts_;
  SolverKind solver_kind_;
  std::unique_ptr<TrackedSolver> solver_;
  DynamicsWorld world_;
  btEmptyShape no_shape_;  ///< of bodies without one
  btRigidBody ground_;     ///< what joints to the world hold on to
  PlumbVec3 gravity_;

  std::vector<std::shared_ptr<const Shape>> shapes_;  ///< by slot, null where none lives
  std::vector<std::unique_ptr<Body>> bodies_;
  std::vector<std::unique_ptr<Joint>> joints_;
  /// Those that a step must look at.
  struct Lists {
    std::vector<Body*> kinematic, damped, locked;
    std::uint32_t joint_count = 0;  ///< that it must prepare
  } lists_;

  struct Contacts {
    std::vector<PlumbContact> rows;
    std::vector<PlumbContact> of_sub_steps;  ///< of all sub-steps but the last
    bool fresh = false;
    std::uintptr_t last_point_id = 0;
  } contacts_;
  struct Events {
    backend::TouchTracker touches;
    std::vector<PlumbEvent> rows, pending;
  } events_;
  /// Contacts that the host is shown, and what it changes of them.
  struct Modification {
    std::vector<PlumbManifold> manifolds;
    std::vector<btPersistentManifold*> shown;  ///< Bullet's own of manifolds, and as long as these
    std::vector<std::pair<btPersistentManifold*, PlumbManifoldChange>> changed;  ///< in the sub-step in hand
  } modification_;
  /// What callers look at until they ask again.
  struct Lent {
    std::vector<PlumbDebugPair> pairs;
    std::vector<PlumbDebugBox> boxes;
    std::vector<PlumbDebugAxis> axes;
    std::vector<PlumbDebugBody> bodies;
    std::vector<PlumbDebugConstraint> constraints;
    std::vector<std::byte> snapshot;
  } lent_;
  struct SubStep {
    double h = 0;  ///< of the one in hand, s
    int left = 0;  ///< with that one
  } sub_step_;
  std::mutex query_mutex_;  ///< Bullet's tree keeps one stack for all of its rays
};

}  // namespace plumb::bullet
