// A world of ODE behind plumb's interface. What one step does stands in step.cpp, from top to bottom.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "bodies.hpp"
#include "contacts.hpp"
#include "errors.hpp"
#include "events.hpp"
#include "joints/joints.hpp"
#include "plumb/backend/world_init.hpp"
#include "plumb/physics_world.hpp"
#include "settings.hpp"
#include "shapes.hpp"
#include "slots.hpp"

namespace plumb::ode {

class World final : public IPhysicsWorld,
                    public IJoints,
                    public IQueries,
                    public ICollide,
                    public IDebug,
                    public ISettings,
                    public ISnapshot,
                    public IExceptions,
                    public IModify,
                    public IManifolds {
 public:
  explicit World(const WorldInit& init);
  ~World() override;

  static const PlumbBackendInfo& info();
  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note);
  static std::span<const PlumbSettingInfo> setting_infos() { return settings_table().infos(); }

  PlumbResult create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) override;
  PlumbResult destroy_shapes(std::span<const PlumbShape> ids) override;
  PlumbResult create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) override;
  PlumbResult destroy_bodies(std::span<const PlumbBody> ids) override;
  PlumbResult read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) override;
  PlumbResult write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) override;
  PlumbResult set_gravity(const PlumbVec3& gravity) override;
  PlumbResult step(double dt) override;
  PlumbResult wait(PlumbStepReport& report) override;
  std::span<const PlumbContact> contacts() override { return contacts_.contacts(); }
  std::span<const PlumbEvent> events() override { return events_.events(); }

  IJoints* joints() override { return this; }
  IQueries* queries() override { return this; }
  ICollide* collide() override { return this; }
  IDebug* debug() override { return this; }
  ISettings* settings() override { return this; }
  ISnapshot* snapshot() override { return this; }
  IExceptions* exceptions() override { return this; }
  IModify* modify() override { return this; }
  IManifolds* manifolds() override { return this; }

 private:
  PlumbResult create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) override;
  PlumbResult destroy_joints(std::span<const PlumbJoint> ids) override;
  PlumbResult read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) override;
  PlumbResult write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) override;
  Hits cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) override;
  Hits cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) override;
  Hits overlap_shapes(std::span<const PlumbOverlap> overlaps) override;
  Penetrations penetrations(std::span<const PlumbOverlap> overlaps) override;
  PlumbResult collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                            std::span<const PlumbPairPoint>& points) override;
  PlumbResult candidate_pairs(std::span<const PlumbDebugPair>& pairs) override;
  PlumbResult tree_boxes(std::span<const PlumbDebugBox>& boxes) override;
  PlumbResult separating_axes(std::span<const PlumbDebugAxis>& axes) override;
  PlumbResult body_states(std::span<const PlumbDebugBody>& bodies) override;
  PlumbResult solved_constraints(std::span<const PlumbDebugConstraint>& constraints) override;
  PlumbResult get_setting(const char* name, PlumbSettingValue& value) override;
  PlumbResult set_setting(const char* name, const PlumbSettingValue& value) override;
  PlumbResult save(std::span<const std::byte>& data) override;
  PlumbResult restore(std::span<const std::byte> data) override;
  PlumbResult set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) override;
  PlumbResult modify_bodies(std::span<const PlumbBodyChange> changes) override;
  PlumbResult modify_shapes(std::span<const PlumbShape> shapes, std::span<const PlumbShapeDesc> descs) override;
  PlumbResult modify_joints(std::span<const PlumbJointChange> changes) override;
  PlumbResult read_manifolds(std::span<const PlumbManifold>& manifolds) override;
  PlumbResult modify_manifolds(std::span<const PlumbManifoldChange> changes) override;

  // Step phases (step.cpp).
  void detect();
  void respond(std::span<const PlumbManifoldChange> changes);
  void finish_step();
  void set_substep(double h);
  void forget_reactions();
  void steer_kinematics(double dt);
  void let_kinematics_rest();
  void push_bodies();
  void find_contacts();
  void prepare_joints(double h);
  void count_idling(double h);
  void solve(double h);
  void gather(double h, double share);
  void settle_kinematics();
  void break_joints();
  void note_sleep();
  void look_for_nonfinite();

  /// Runs a call into ODE whose errors become PLUMB_E_WORLD_LOST.
  template <class Call>
  auto inside_ode(Call&& call) {
    const ErrorScope scope(init_);
    try {
      return call();
    } catch (const Error& error) {
      if (error.code() == PLUMB_E_WORLD_LOST) usable_ = false;
      throw;
    }
  }

  // Bodies and joints (world_*.cpp).
  [[nodiscard]] Body& body(PlumbBody id) { return living(slots_.bodies, id); }
  [[nodiscard]] Joint& joint(PlumbJoint id) { return living(slots_.joints, id); }
  std::unique_ptr<Body> make_body(const PlumbBodyDesc& desc, PlumbBody handle);
  void embody(Body& body, const PlumbBodyDesc& desc);
  void make_body_geoms(Body& body);
  void dismantle(Body& body);
  void remake(Body& body, const PlumbBodyChange& change);
  void reshape(Body& at, const Shape& other);
  void enlist(Body& body);
  void list(Body& body);
  void strike_off(const Body& body);
  void wake_neighbours(const Body& body);
  void set_gravity_scale(Body& body, double scale);
  void apply_body_settings(Body& body);
  PlumbResult read_poses(std::span<const PlumbBody> ids, const Rows& rows);
  PlumbResult read_velocities(std::span<const PlumbBody> ids, const Rows& rows);
  void write_row(PlumbField field, Body& body, const double* row);
  /// Makes what ODE solves of a joint, where there is something to solve, and takes it away.
  void bind(Joint& joint);
  void unbind(Joint& joint);
  void remove_joint(Joint& joint);

  WorldInit init_;
  Settings settings_;
  PlumbVec3 gravity_;
  bool usable_ = true;  ///< false after an error inside ODE: its objects are left alone, even at the end
  dWorldID world_ = nullptr;
  dSpaceID space_ = nullptr;
  struct Threads {
    dThreadingImplementationID implementation = nullptr;
    dThreadingThreadPoolID pool = nullptr;
  } threads_;
  ContactPass contacts_;
  PairEvents events_;
  unsigned long seed_;

  struct Stocks {
    Stock<Shape> shapes;
    Stock<Body> bodies;
    Stock<GeomTag> tags;
  } stocks_;
  /// Who lives, by slot.
  struct Slots {
    std::vector<std::unique_ptr<Shape>> shapes;
    std::vector<std::unique_ptr<Body>> bodies;
    std::vector<std::unique_ptr<Joint>> joints;
    /// The body in ODE where its rows are ours as they are, else null. Bulk reads need not touch Body then.
    std::vector<dBodyID> plain;
  } slots_;
  /// Whom a step goes through.
  struct BodyLists {
    std::vector<Body*> all;  // as created
    std::vector<Body*> dynamic, kinematic, damped, locked, weighed, pushed;
    std::vector<dBodyID> dynamic_ids;  // of dynamic
  } lists_;
  struct JointLists {
    std::vector<Joint*> all;   // as created
    std::vector<Joint*> busy;  // with work in each sub-step
  } joint_lists_;

  struct Substep {
    double h = 0;  ///< for which damping and springs were set, s
    int left = 0;  ///< with the one in hand
  } substep_;
  /// What is told of the step.
  struct Figures {
    std::uint32_t nonfinite = 0, awake = 0;
    double broad_narrow_seconds = 0, solve_seconds = 0, output_seconds = 0;
  } figures_;

  std::mutex query_mutex_;  // ODE's spaces note things even while they are only asked
  /// What callers look at until they ask again.
  struct Lent {
    std::vector<PlumbDebugPair> pairs;
    std::vector<PlumbDebugBox> boxes;
    std::vector<PlumbDebugAxis> axes;
    std::vector<PlumbDebugBody> bodies;
    std::vector<std::byte> snapshot;
  } lent_;
};

}  // namespace plumb::ode
