// The engine without its interface: bodies and shapes in memory, and the step.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "body_state.hpp"
#include "broadphase/broad_phase.hpp"
#include "broadphase/exclusions.hpp"
#include "constraints/belts.hpp"
#include "constraints/joint_store.hpp"
#include "contact_record.hpp"
#include "continuous/guard.hpp"
#include "continuous/impacts.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "exec/phase_clock.hpp"
#include "exec/table.hpp"
#include "geometry/hull_pool.hpp"
#include "geometry/surface_pool.hpp"
#include "islands/sleep.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "narrowphase/pieces.hpp"
#include "queries/query_trees.hpp"
#include "solver/colouring.hpp"
#include "solver/energy_bound.hpp"
#include "solver/solver.hpp"
#include "state_rows.hpp"
#include "step_counters.hpp"
#include "step_parameters.hpp"

namespace plumb::impulse {

class Simulation {
  Executor executor_;  // before all that works with it

 public:
  using Slots = std::vector<std::uint32_t>;

  Simulation(const PlumbHost* host, std::uint32_t threads, const SolverFeatures& features);

  // --- what the host fills; rows are body slots. The last row is nobody. ---
  BodyState state;  ///< say which rows were touched
  Table<BodyForce> force;
  Table<BodyMass> mass;
  Table<BodyFrame> frames;
  Table<Proxy> proxies;        // rows of their own: a body may have several, or none
  Table<ProxyFilter> filters;  // by proxy
  BeltSpeeds belts;            // in worlds that have them
  Table<Shape> shapes;
  JointStore joints;
  Exclusions exclusions;
  HullPool hulls;
  SurfacePool surfaces;

  /// Room for this many body slots, and the rows up to it.
  void reserve_bodies(std::uint32_t slots);
  void reserve_shapes(std::uint32_t rows);
  /// Room for this many proxies, at least one a body slot. New rows have no shape.
  void reserve_proxies(std::uint32_t rows);
  /// Slots in use; rows behind are nobody's.
  void set_body_count(std::uint32_t slots) { body_count_ = slots; }
  [[nodiscard]] std::uint32_t body_count() const { return body_count_; }
  /// From now on there may be bodies that must not pass through others; what they cost begins here.
  void expect_continuous() { continuous_ = features_.continuous; }
  /// Proxy rows in use; those among them without a shape are nobody's.
  void set_proxy_count(std::uint32_t rows) { proxy_count_ = rows; }

  void bodies_changed() {  ///< made, gone, asleep, awake
    bodies_dirty_ = origin_dirty_ = true;
    ++list_version_;
  }
  void statics_changed() {  ///< bodies that do not move: placed elsewhere
    statics_dirty_ = true;
    ++list_version_;
  }

  /// How many rows a snapshot has of each kind. Those that came later and are gone again are not in it.
  struct Extent {
    std::uint32_t bodies, proxies, joints, in_pieces;
  };
  /// Of a snapshot taken now; to restore one, of what there is room for.
  [[nodiscard]] Extent extent(bool to_restore);
  /// All that the steps to come depend on and that steps change, to or from a snapshot of that extent. The same bodies,
  /// joints and shapes must be there.
  void exchange(Archive& archive, const Extent& extent);

  // --- sleep, between steps; body slots. What wakes or falls asleep is told by its slots. ---
  [[nodiscard]] bool sleeps(std::uint32_t body) const { return sleep_.sleeps(body); }
  [[nodiscard]] std::uint32_t sleeper_count() const { return sleep_.count(); }
  /// 1 + the smallest body of those with whom it fell asleep; 0 where it is awake.
  [[nodiscard]] std::uint32_t island_asleep(std::uint32_t body) const { return sleep_.island(body); }
  /// With their islands.
  Slots wake(std::span<const std::uint32_t> bodies);
  /// Those who are joined to these, and where asked for those who touch them, with their islands.
  Slots wake_neighbours(std::span<const std::uint32_t> bodies, bool touching);
  Slots wake_all();
  /// With what is joined to them.
  Slots put_to_sleep(std::span<const std::uint32_t> bodies);
  /// These are gone: nothing is remembered of them.
  void forget(std::span<const std::uint32_t> bodies) { sleep_.forget(bodies); }
  /// Of the last step.
  [[nodiscard]] const Slots& woken() const { return woken_; }
  [[nodiscard]] const Slots& fallen_asleep() const { return fallen_asleep_; }

  /// How the steps to come find pairs; changes no result.
  void choose(BroadPhase::Method method);
  [[nodiscard]] const BroadPhase& broad_phase() const { return broad_phase_; }
  /// Enqueues a step. parameters.step and .origin are filled in here.
  void step(const StepParameters& parameters, const ShorterSubsteps& shorter);
  /// Returns when the step is done; grows what was too small and repeats the step then.
  void wait();

  [[nodiscard]] const StepCounters& counters() const { return *counters_.host(); }
  [[nodiscard]] std::uint32_t steps() const { return step_; }
  [[nodiscard]] bool repeated() const { return repeated_; }
  [[nodiscard]] bool grew() const { return grew_; }
  /// Whether all is as it was before the step: it made energy, or joints let go (solver/energy_bound.hpp).
  [[nodiscard]] bool taken_back() const { return counters().taken_back != 0; }
  /// Of the last step, s; NaN where it was not measured, and for phases that this engine does not tell apart.
  [[nodiscard]] double phase_seconds(PlumbPhase phase) const;
  [[nodiscard]] Executor& executor() { return executor_; }

  /// Manifolds of the last step, copied to the host. Impulses are 0 where the scene did not ask for them.
  [[nodiscard]] std::vector<ContactRecord> contacts();
  /// Likewise with the colours in which they were solved, which mean something where the solver has any.
  [[nodiscard]] std::vector<KeptPair> solved_manifolds() const;
  [[nodiscard]] bool solves_in_colours() const { return solver_.needs_colours(); }
  /// What the broad phase of the last step found.
  [[nodiscard]] std::vector<Pair> candidates();
  [[nodiscard]] std::uint32_t candidate_count() const { return narrow_phase_.candidate_count(counters()); }

  /// What queries look at, brought up to date. Between steps; one caller at a time, but what it gave to an earlier one
  /// stays as it is until bodies or shapes change.
  [[nodiscard]] QueryScene query_scene(const HitNames& names);
  /// The same without trees, for what asks of shapes alone.
  [[nodiscard]] QueryScene shape_scene();
  /// Nodes of the trees of the last step's broad phase, copied to the host, and what their boxes are relative to.
  [[nodiscard]] std::vector<TreeNode> tree_nodes(BroadPhase::Tree tree) const { return broad_phase_.nodes(tree); }
  [[nodiscard]] const Position& tree_origin() const { return parameters_[0].origin; }

  /// Rows of state by body slot, up to date. Steps bring them from now on. On the device they are there once what was
  /// enqueued is done; on the host they are there.
  [[nodiscard]] std::shared_ptr<RowBlock<PoseRow>> pose_rows(bool on_host) { return rows(poses_, on_host); }
  [[nodiscard]] std::shared_ptr<RowBlock<VelocityRow>> velocity_rows(bool on_host) {
    return rows(velocities_, on_host);
  }

 private:
  [[nodiscard]] bool finds_impacts() const { return continuous_ || features_.restitution; }
  /// Others than the default solver take errors of joints back by speeds that stay.
  [[nodiscard]] bool bounds_energy() const {
    return joints.count() != 0 && parameters_[0].solver == SolverKind::kTgsSoft;
  }
  /// What a recorded step holds of the host's numbers and addresses.
  struct Recorded {
    std::array<const void*, 11> addresses{};
    std::array<std::uint32_t, 9> numbers{};
    bool operator==(const Recorded&) const = default;
  };

  void upload_changes();
  void upload_bodies();
  void list_for_queries();
  [[nodiscard]] Position middle_of(const Mirror<std::uint32_t>& list, std::uint32_t count);
  void list_bodies();
  void find_origin();
  [[nodiscard]] std::uint32_t room_for(std::uint32_t n) const;
  std::uint32_t fill_room(Mirror<std::uint32_t>& list, std::uint32_t count);
  /// Rows that kernels of a step go through; those without a body are nobody's.
  [[nodiscard]] std::uint32_t bodies_in_step() const {
    return std::min<std::uint32_t>(room_for(body_count_), static_cast<std::uint32_t>(state.size()) - 1);
  }
  void find_candidates(const ContactCache& now);
  [[nodiscard]] EnergyWork energy_work(const ContactCache& now, const Bodies& all, const Proxies& shapes_on);
  void reserve_rows();
  void enqueue();
  void enqueue_rows();
  void launch();
  void run_step();
  void let_islands_rest();
  void fall_asleep(const Slots& island);
  void put_contacts_aside();
  [[nodiscard]] std::vector<ContactRecord> contacts_of_step();
  void forget_recordings();
  [[nodiscard]] Recorded what_is_recorded();
  template <class Row>
  std::shared_ptr<RowBlock<Row>> rows(FieldRows<Row>& field, bool on_host);
  [[nodiscard]] Bodies bodies();
  [[nodiscard]] Proxies proxy_view();
  void reserve_pairs(std::uint32_t pairs);

  SolverFeatures features_;
  std::uint32_t body_count_ = 0, proxy_count_ = 0, step_ = 0, pair_capacity_ = 0;
  bool bodies_dirty_ = true, origin_dirty_ = true, origin_known_ = false, statics_dirty_ = true, repeated_ = false,
       grew_ = false;
  std::uint64_t list_version_ = 1;  // changes when a body may have, but for those that the step moves
  Position origin_{0, 0, 0};

  Mirror<std::uint32_t> movers_, statics_, planes_;
  std::uint32_t mover_count_ = 0, static_count_ = 0, plane_count_ = 0;
  std::uint32_t mover_room_ = 0, static_room_ = 0;  // lengths of the lists as steps see them
  bool in_pieces_ = false;                          // once there was a plane or a surface
  bool continuous_ = false;                         // once there was a body that must not pass through others
  std::uint32_t shape_types_ = 0;                   // a bit for each ShapeType in the world
  Mirror<StepParameters> parameters_;
  Mirror<ShorterSubsteps> shorter_;
  Mirror<StepParameters> statics_parameters_;  // with which the statics were bounded
  bool bound_again_ = false;                   // the statics, as they were: with the same parameters
  bool restored_ = false;                      // since the last step: what it found is not known
  Mirror<StepCounters> counters_;
  Buffer<Box> boxes_;     // by proxy
  Buffer<Real> margins_;  // by proxy

  BroadPhase broad_phase_;
  Pieces pieces_;
  NarrowPhase narrow_phase_;
  Impacts impacts_;  // these two where the scene asks for them
  Guard guard_;
  Colouring colouring_;
  Solver solver_;
  EnergyBound energy_bound_;  // where there are joints
  Sleep sleep_;
  Slots woken_, fallen_asleep_;
  Buffer<ContactRecord> records_;
  struct ForQueries {
    QueryTrees trees;
    Mirror<std::uint32_t> movers, statics, planes;
    PlacedProxies placed{};
  };
  std::unique_ptr<ForQueries> for_queries_;  // made when the first query comes; the step's own are not touched
  FieldRows<PoseRow> poses_;
  FieldRows<VelocityRow> velocities_;
  PhaseClock phases_;
  Recording recordings_[2][2];  // steps that are measured or not, of each parity
  Recorded recorded_;
};

}  // namespace plumb::impulse
