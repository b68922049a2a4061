// IPhysicsWorld over a Simulation: handles and doubles outside, rows and Reals inside.
#pragma once

#include <mutex>
#include <span>
#include <vector>

#include "plugin/rows/batch_pool.hpp"
#include "plugin/rows/body_record.hpp"
#include "plugin/rows/compound.hpp"
#include "plugin/rows/joint_record.hpp"
#include "plugin/rows/proxy_slots.hpp"
#include "plugin/rows/slot_list.hpp"
#include "plugin/rows/world_group.hpp"
#include "plugin/settings.hpp"
#include "plumb/backend/cooking.hpp"
#include "plumb/backend/touch_tracker.hpp"
#include "plumb/backend/world_init.hpp"
#include "plumb/physics_world.hpp"
#include "queries/closest_batch.hpp"
#include "queries/query_batch.hpp"
#include "world/simulation.hpp"

namespace plumb::impulse {

class World final : public IPhysicsWorld,
                    public IJoints,
                    public IQueries,
                    public ICollide,
                    public IDebug,
                    public ISettings,
                    public ISnapshot,
                    public IState,
                    public IExceptions,
                    public IModify,
                    public IManifolds,
                    public IWorlds,
                    public IClosest,
                    public backend::ICookedShapes {
 public:
  explicit World(const WorldInit& init);
  ~World() override;

  static const PlumbBackendInfo& info();
  static std::string unmet_requirement() { return Executor::unmet_requirement(); }
  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note);
  static backend::CookedFormat cooked_format();
  static std::vector<std::byte> cook(const PlumbShapeDesc& desc);
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
  std::span<const PlumbContact> contacts() override;
  std::span<const PlumbEvent> events() override { return told_.events; }

  /// Of the last step.
  [[nodiscard]] const StepCounters& counters() const { return simulation_.counters(); }
  [[nodiscard]] const BroadPhase& broad_phase() const { return simulation_.broad_phase(); }
  /// To where kernels run, since the world was made.
  [[nodiscard]] std::uint64_t uploaded_bytes() { return simulation_.executor().uploaded_bytes(); }

  IJoints* joints() override { return this; }
  IQueries* queries() override { return this; }
  ICollide* collide() override { return this; }
  IDebug* debug() override { return this; }
  ISettings* settings() override { return this; }
  ISnapshot* snapshot() override { return this; }
  IState* state() override { return this; }
  IExceptions* exceptions() override { return this; }
  IModify* modify() override { return this; }
  IManifolds* manifolds() override { return this; }
  IWorlds* worlds() override { return this; }
  IClosest* closest() override { return this; }

 private:
  PlumbResult create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) override;
  PlumbResult destroy_joints(std::span<const PlumbJoint> ids) override;
  PlumbResult read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) override;
  PlumbResult write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) override;
  Hits cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) override;
  Hits cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) override;
  Hits overlap_shapes(std::span<const PlumbOverlap> overlaps) override;
  Penetrations penetrations(std::span<const PlumbOverlap> overlaps) override;
  Hits turning_casts(PlumbHitMode mode, std::span<const PlumbTurningCast> casts) override;
  ClosestBodies closest_bodies(PlumbHitMode mode, std::span<const PlumbProbe> probes) override;
  PlumbResult collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                            std::span<const PlumbPairPoint>& points) override;
  void put_joint(std::uint32_t slot);
  void remove_joint(std::uint32_t slot);
  void break_joints();
  PlumbResult candidate_pairs(std::span<const PlumbDebugPair>& pairs) override;
  PlumbResult tree_boxes(std::span<const PlumbDebugBox>& boxes) override;
  PlumbResult separating_axes(std::span<const PlumbDebugAxis>& axes) override;
  PlumbResult body_states(std::span<const PlumbDebugBody>& bodies) override;
  PlumbResult solved_constraints(std::span<const PlumbDebugConstraint>& constraints) override;
  PlumbResult get_setting(const char* name, PlumbSettingValue& value) override;
  PlumbResult set_setting(const char* name, const PlumbSettingValue& value) override;
  PlumbResult save(std::span<const std::byte>& data) override;
  PlumbResult restore(std::span<const std::byte> data) override;
  std::string_view format() const override;
  PlumbResult borrow(const PlumbStateRequest& request, PlumbDLManagedTensor*& tensor, PlumbFence* fence) override;
  PlumbResult row_map(std::span<const PlumbBody>& ids, std::uint64_t& generation) override;
  PlumbResult set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) override;
  PlumbResult modify_bodies(std::span<const PlumbBodyChange> changes) override;
  PlumbResult modify_joints(std::span<const PlumbJointChange> changes) override;
  PlumbResult modify_shapes(std::span<const PlumbShape> shapes, std::span<const PlumbShapeDesc> descs) override;
  PlumbResult read_manifolds(std::span<const PlumbManifold>& manifolds) override;
  PlumbResult modify_manifolds(std::span<const PlumbManifoldChange> changes) override;

  PlumbResult create_cooked(std::span<const backend::CookedPayload> shapes, std::span<const PlumbShape> ids) override;
  PlumbResult group(std::span<IPhysicsWorld* const> others) override;
  PlumbResult borrow_all(const PlumbStateRequest& request, PlumbDLManagedTensor*& tensor, PlumbFence* fence) override;

  /// A share of a step that the simulation takes as a whole.
  struct StepPart {
    double dt;    ///< s
    int divided;  ///< how many times over
  };

  void leave_group();
  template <class Row>
  void share_rows(std::shared_ptr<RowBlock<Row>>& block);
  void exchange(Archive& archive);
  void make_room(const Simulation::Extent& rows);
  void exchange_proxies(Archive& archive);
  void exchange_targets(Archive& archive);
  void make_body(const PlumbBodyDesc& desc, PlumbBody id);
  void unmake_body(std::uint32_t slot);
  void embody(std::uint32_t slot, const PlumbBodyDesc& desc);
  void remake_body(const PlumbBodyChange& change);
  void put_joints_of(std::span<const PlumbBodyChange> changes);
  void change_joint(std::uint32_t slot, const PlumbJointDesc& desc, bool enabled);
  void change_surface(std::uint32_t row, const PlumbShapeDesc& desc);
  void place_again(std::uint32_t slot, bool frame_is_other);
  void find_sleepers_in(const Extent& where, std::uint32_t of_body, Simulation::Slots& found);
  [[nodiscard]] double reach_of(std::uint32_t slot) const;
  void place(std::uint32_t slot, const PlumbPose& pose);
  [[nodiscard]] PlumbPose pose(std::uint32_t slot) const;
  void read_state(PlumbField field, std::span<const PlumbBody> ids, Rows rows);
  void fetch_for_write(PlumbField field, std::span<const PlumbBody> ids);
  void write_row(PlumbField field, std::uint32_t slot, const double* row);
  void hold_locked(std::uint32_t slot);
  Shape to_shape(const PlumbShapeDesc& desc, std::uint32_t row, Compound& parts);
  template <class Make>
  PlumbResult add_shapes(std::span<const PlumbShape> ids, const Make& make);
  static Shape placed_surface(ShapeType type, const AddedSurface& added, std::uint32_t row, Compound& parts);
  [[nodiscard]] Shape hull_shape(std::uint32_t hull) const;
  void dismantle(const Shape& shape);
  [[nodiscard]] const Compound* parts_of(std::uint32_t shape) const;
  void attach(std::uint32_t slot, std::uint32_t shape);
  void fill_proxies(std::uint32_t slot);
  void attach_part(std::uint32_t slot, std::uint32_t row, std::uint32_t shape, const PlumbPose* pose);
  void detach(std::uint32_t slot);
  void make_continuous(bool continuous);
  void put_body_rows(std::uint32_t slot);
  void put_proxy_row(std::uint32_t slot, std::uint32_t row);
  [[nodiscard]] std::uint32_t child_of(std::uint32_t proxy, std::uint32_t triangle) const;
  void stop_infinite(std::uint32_t slot);
  void push(std::uint32_t slot, const Vec& force, const Vec& torque);
  void kick(std::uint32_t slot, const Vec& impulse, const Vec& angular_impulse);
  void start(const StepPart& part, bool is_repeat = false);
  void divide(const StepPart& whole);
  bool advance();
  void finish_part();
  void keep_part();
  void steer_kinematics(double dt);
  void settle_kinematics();
  void clear_forces();
  void find_events();
  void find_touches();
  void sense();
  void tell(PlumbEventType type, const Simulation::Slots& bodies, std::vector<PlumbEvent>& events);
  void wake_for_write(PlumbField field, std::span<const PlumbBody> ids);
  void wake_for_joint(const PlumbJointDesc& desc);
  void write_awake(std::span<const PlumbBody> ids, ConstRows rows);
  const std::vector<ContactRecord>& records();
  template <class Batch, class Ask>
  auto ask(BatchPool<Batch>& batches, const Ask& ask);
  HitNames hit_names();
  void pose_parts(PlumbShape id, const PlumbPose& pose, std::vector<PosedShape>& parts) const;
  [[nodiscard]] PlumbBody body_of_last_step(std::uint32_t proxy) const;
  [[nodiscard]] std::vector<Pair> known_candidates();
  [[nodiscard]] std::vector<std::uint32_t> islands_of_bodies();

  static constexpr int kParts = 4;
  /// Of the step that is under way, which may go in parts.
  struct Parts {
    std::vector<StepPart> to_do;          // the last one is under way
    std::vector<ContactRecord> contacts;  // of all but the last, where impulses or events are needed
    std::uint32_t nonfinite = 0;          // likewise
    bool any_done = false;
    bool repeated = false, grew = false, gained = false;  // one of them, or what was taken back; gained: energy
  };
  /// How long the steps are that the simulation takes.
  struct Pacing {
    double last_h = 0, dt = 0;
    double divides_for = 0;  // for so long steps go in parts from the start, s
    bool lets_go = false;    // since the last step the host took away or changed what others may be squeezed by
    Parts parts;
  };
  struct JointTable {
    std::vector<JointRecord> records;  // by slot
    std::uint32_t breakable = 0;
  };
  /// What is told of the last step.
  struct Told {
    bool records_known = false, contacts_known = false;  // contacts: Lent has them
    std::vector<ContactRecord> records;                  // their proxies may be others' by now, or nobody's
    std::vector<PlumbEvent> events, early_events;        // early: of what the host did since
    backend::TouchTracker touches;
  };
  /// What callers look at until they ask again.
  struct Lent {
    std::vector<PlumbContact> contacts;
    std::vector<PlumbManifold> manifolds;
    std::vector<PlumbDebugPair> pairs;
    std::vector<PlumbDebugBox> boxes;
    std::vector<PlumbDebugAxis> axes;
    std::vector<PlumbDebugBody> bodies;
    std::vector<PlumbDebugConstraint> constraints;
    std::vector<std::byte> snapshot;
    std::shared_ptr<WorldGroup> group;  // null where it is by itself
  };
  struct Queries {
    std::mutex mutex;  // of what queries build when they need it, and of the batches
    BatchPool<QueryBatch> batches;
    BatchPool<ClosestBatch> closest_batches;
    BatchPool<PairBatch> pair_batches;
    std::vector<std::uint32_t> hit_children;  // by proxy; as of that generation of the rows
    std::uint64_t hit_children_generation = 0;
  };
  struct RowIds {
    std::vector<PlumbBody> ids;    // by slot; 0 where nobody is
    std::uint64_t generation = 0;  // changes with them
  };

  WorldInit init_;
  Simulation simulation_;
  Settings settings_;
  PlumbVec3 gravity_;
  Pacing pacing_;
  std::vector<BodyRecord> bodies_;    // by slot
  std::vector<Compound> compounds_;   // by shape slot, as far as there are any
  std::vector<ProxyRecord> proxies_;  // by proxy, as far as one is not as it comes
  ProxySlots proxy_slots_;
  JointTable joints_;
  std::uint32_t dynamic_count_ = 0;
  bool continuous_ = false;
  std::uint32_t stopped_ = 0;  // bodies whose velocity a write made infinite, since the last step
  std::vector<std::uint32_t> pushed_;
  SlotList steered_;  // kinematic bodies with a target, or that have arrived at one
  SlotList sensors_;
  Told told_;
  Lent lent_;
  Queries queries_;
  RowIds rows_;
};

}  // namespace plumb::impulse
