// The engine without its interface: bodies and shapes in memory, and the step.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "contacts/contact_record.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "queries/query_trees.hpp"
#include "world/bounds_origin.hpp"
#include "world/recorder.hpp"
#include "world/step_context.hpp"

namespace plumb::impulse {

class Simulation {
  Executor executor_;  // before all that works with it

 public:
  using Slots = std::vector<std::uint32_t>;

  Simulation(const PlumbHost* host, std::uint32_t threads, const SolverFeatures& features);
  ~Simulation();

  // --- what the host fills ---
  BodyTable bodies;
  ColliderTable colliders;
  JointStore joints;
  Exclusions exclusions;

  /// Room for this many body slots, and the rows up to it.
  void reserve_bodies(std::uint32_t slots);
  void reserve_shapes(std::uint32_t rows);
  /// Room for this many proxies, at least one a body slot. New rows have no shape.
  void reserve_proxies(std::uint32_t rows);
  /// Whether there may be bodies that must not pass through others; what they cost begins here.
  void make_continuous(bool continuous) { stages_.continuous = continuous && stages_.features.continuous; }
  /// Whether there may be shapes of many pieces; likewise.
  void use_midphase(bool uses);

  /// Likewise of bodies whose contacts the host is shown: from now on a step is two halves.
  void expect_modification();

  void bodies_changed() {  ///< made, gone, asleep, awake
    dirty_.lists = true;
    origin_.bodies_changed();
    ++list_version_;
  }
  void statics_changed() {  ///< bodies that do not move: placed elsewhere
    dirty_.statics = true;
    ++list_version_;
  }

  /// How many rows a snapshot has of each kind. Those that came later and are gone again are not in it.
  struct Extent {
    std::uint32_t bodies, proxies, joints, uses_midphase;
  };
  [[nodiscard]] Extent extent() const {
    return {bodies.count, colliders.count, joints.slots(), stages_.uses_midphase ? 1U : 0U};
  }
  /// All that the steps to come depend on and that steps change, to or from a snapshot of that extent. The same bodies,
  /// joints and shapes must be there.
  void exchange(Archive& archive, const Extent& extent);

  // --- sleep, between steps; body slots. What wakes or falls asleep is told by its slots. (sleeping.cpp) ---
  [[nodiscard]] bool sleeps(std::uint32_t body) const { return sleep_.sleeps(body); }
  [[nodiscard]] std::uint32_t sleeper_count() const { return sleep_.count(); }
  /// 1 + the smallest body of those with whom it fell asleep; 0 where it is awake.
  [[nodiscard]] std::uint32_t island_asleep(std::uint32_t body) const { return sleep_.island(body); }
  /// With their islands.
  Slots wake(std::span<const std::uint32_t> slots);
  /// Those who are joined to these, and where asked for those who touch them, with their islands.
  Slots wake_neighbours(std::span<const std::uint32_t> slots, bool touching);
  Slots wake_all();
  /// With what is joined to them.
  Slots put_to_sleep(std::span<const std::uint32_t> slots);
  /// These are gone: nothing is remembered of them.
  void forget(std::span<const std::uint32_t> slots) { sleep_.forget(slots); }

  // --- steps ---
  /// How the steps to come find pairs; changes no result.
  void choose(BroadPhase::Method method);
  [[nodiscard]] const BroadPhase& broad_phase() const { return stages_.broad_phase; }
  /// Enqueues a step. parameters.step and .origin are filled in here.
  void step(const StepParameters& parameters, const SubstepLevels& levels);
  /// Returns when the step is done, and true; grows what was too small and repeats the step then. False: contacts are
  /// found and shown, and respond() makes the step go on.
  bool wait();
  /// What was found, where the world modifies contacts and wait() was false.
  [[nodiscard]] std::span<const ShownManifold> shown() { return stages_.modification.shown(executor_); }
  [[nodiscard]] std::uint32_t shown_count() const { return stages_.modification.shown_count(); }
  /// Solves what was shown, with a change for each.
  void respond(std::span<const ManifoldChange> changes);

  /// What a step did beside moving bodies.
  struct Outcome {
    bool repeated = false, grew = false;
    Slots woken, fallen_asleep;
  };
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  [[nodiscard]] const StepCounters& counters() const { return *numbers_.counters.host(); }
  [[nodiscard]] std::uint32_t steps() const { return step_; }
  /// Whether all is as it was before the step: it made energy, or joints let go or opened (solver/energy_bound.hpp).
  [[nodiscard]] bool taken_back() const { return counters().bound.taken_back != 0; }
  /// Of the last step, s; NaN where it was not measured, and for phases that this engine does not tell apart.
  [[nodiscard]] double phase_seconds(PlumbPhase phase) const;
  [[nodiscard]] Executor& executor() { return executor_; }
  /// The steps to come are taken with those of the others of the batch; null: by themselves. Between steps.
  void join(std::shared_ptr<Batch> batch) { executor_.join(std::move(batch)); }

  /// Manifolds of the last step, copied to the host. Impulses are 0 where the scene did not ask for them.
  [[nodiscard]] std::vector<ContactRecord> contacts();
  /// Likewise with the colours in which they were solved, which mean something where the solver has any.
  [[nodiscard]] std::vector<KeptPair> solved_manifolds() const;
  [[nodiscard]] bool solves_in_colours() const { return stages_.solver.needs_colours(); }
  /// What the broad phase of the last step found.
  [[nodiscard]] std::vector<Pair> candidates();
  [[nodiscard]] std::uint32_t candidate_count() const { return stages_.narrow_phase.candidate_count(counters()); }
  /// Nodes of the trees of the last step's broad phase, copied to the host, and what their boxes are relative to.
  [[nodiscard]] std::vector<TreeNode> tree_nodes(BroadPhase::Tree tree) const {
    return stages_.broad_phase.nodes(tree);
  }
  [[nodiscard]] const Position& tree_origin() const { return numbers_.parameters[0].origin; }

  // --- what is read between steps (queries.cpp) ---
  /// What queries look at, brought up to date. Between steps; one caller at a time, but what it gave to an earlier one
  /// stays as it is until bodies or shapes change.
  [[nodiscard]] QueryScene query_scene(const HitNames& names);
  /// The same without trees, for what asks of shapes alone.
  [[nodiscard]] QueryScene shape_scene();
  /// Rows of state by body slot, up to date. Steps bring them from now on. On the device they are there once what was
  /// enqueued is done; on the host they are there.
  [[nodiscard]] std::shared_ptr<RowBlock<PoseRow>> pose_rows(bool on_host) { return rows(output_.poses, on_host); }
  [[nodiscard]] std::shared_ptr<RowBlock<VelocityRow>> velocity_rows(bool on_host) {
    return rows(output_.velocities, on_host);
  }

  /// From now on rows stand there, too: in a block of those of many worlds. Between steps.
  void also_write(const RowSlice<PoseRow>& poses) {
    output_.poses.also_write(poses);
    recorder_.forget();
  }
  void also_write(const RowSlice<VelocityRow>& velocities) {
    output_.velocities.also_write(velocities);
    recorder_.forget();
  }

 private:
  /// What host and kernels tell each other of a step.
  struct Numbers {
    Numbers();
    Mirror<StepParameters> parameters;
    Mirror<SubstepLevels> levels;
    Mirror<StepCounters> counters;
  };
  struct Dirty {
    bool lists = true, statics = true;
    bool room = false;  ///< memory ran out while it was made: some arrays are shorter than others
  };
  /// What queries work with, made when the first comes: the step's own lists and trees are not touched.
  struct ForQueries {
    QueryTrees trees;
    ProxyLists lists;
    PlacedProxies placed{};
  };

  void reserve_pairs(std::uint32_t pairs);
  [[nodiscard]] std::uint32_t room_for(std::uint32_t n) const;
  bool find_proxies();
  void list_proxies();
  void list_for_queries();
  void upload_bodies();
  void upload_changes();
  void bound_statics();
  void reserve_rows();
  [[nodiscard]] StepInput input();
  void launch();
  void repeat_undone();
  template <class Act>
  void or_not_at_all(const Act& act);
  enum class Half : std::uint8_t { kBoth, kDetection, kResponse };
  void enqueue(Half half);
  void let_islands_rest();
  void fall_asleep(const Slots& island);
  void store_contacts();
  [[nodiscard]] MovableBodies body_view() { return bodies.view(stages_.features.rotation); }
  [[nodiscard]] std::vector<ContactRecord> contacts_of_step();
  template <class Row>
  std::shared_ptr<RowBlock<Row>> rows(FieldRows<Row>& field, bool on_host);

  Numbers numbers_;
  Stages stages_;
  ProxyLists lists_;
  BoundsOrigin origin_;
  Sleep sleep_;
  StepRecorder recorder_;
  Outcome outcome_;
  OutputRows output_;
  Buffer<ContactRecord> records_;
  std::unique_ptr<ForQueries> for_queries_;
  std::uint32_t step_ = 0;
  std::uint64_t list_version_ = 1;  // changes when a body may have, but for those that the step moves
  Dirty dirty_;
  bool restored_ = false;  // since the last step: what it found is not known
  /// Of the last step, or the one that is under way.
  struct Last {
    bool shows = false;     // what it has found waits for respond()
    bool measured = false;  // the times of its phases are known
  } last_;
};

}  // namespace plumb::impulse
