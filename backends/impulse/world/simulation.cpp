#include "world/simulation.hpp"

#include <algorithm>
#include <limits>

#include "bodies/proxy_bounds.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

constexpr std::uint32_t kLeastPairs = 1024;

}  // namespace

Simulation::Numbers::Numbers() {
  parameters.grow(1);
  levels.grow(1);
  counters.grow(1);
}

Simulation::Simulation(const PlumbHost* host, std::uint32_t threads, const SolverFeatures& features)
    : executor_(host, threads), bodies(executor_), stages_(features) {
  reserve_bodies(64);
  reserve_shapes(16);
  reserve_pairs(kLeastPairs);
}

/// What a batch has yet to launch works with memory that goes with this.
Simulation::~Simulation() { executor_.leave(); }

// --- room ---

void Simulation::reserve_bodies(std::uint32_t slots) {
  const std::size_t rows = std::size_t{slots} + 1;  // and nobody
  if (rows <= bodies.size() && !dirty_.room) return;
  const std::size_t size = rows <= bodies.size() ? bodies.size() : rows + rows / 2;
  dirty_.room = true;
  bodies.grow(size, stages_.features.rolling_friction);
  joints.reserve_bodies(size);
  dirty_.lists = true;
  reserve_proxies(static_cast<std::uint32_t>(size));
  reserve_pairs(stages_.pair_capacity);
}

void Simulation::reserve_proxies(std::uint32_t rows) {
  const std::size_t before = colliders.proxies.size();
  if (rows <= before && !dirty_.room) return;
  const std::size_t size = rows <= before ? before : std::max<std::size_t>(rows, before + before / 2);
  dirty_.room = true;
  colliders.grow(size, stages_.features.surface_velocity);
  if (stages_.features.sleeping) sleep_.reserve(static_cast<std::uint32_t>(size));
  dirty_.lists = true;
  reserve_pairs(stages_.pair_capacity);
}

void Simulation::reserve_shapes(std::uint32_t rows) {
  if (rows > colliders.shapes.size()) colliders.shapes.grow(rows + rows / 2);
}

void Simulation::reserve_pairs(std::uint32_t pairs) {
  recorder_.forget();
  dirty_.room = true;
  stages_.reserve(executor_, static_cast<std::uint32_t>(bodies.size()),
                  static_cast<std::uint32_t>(colliders.proxies.size()), pairs);
  dirty_.room = false;
}

/// So many of a thing that a recorded step has room for, when there are n now. While bodies come and go the numbers
/// stay in coarse steps, and the recording serves on.
std::uint32_t Simulation::room_for(std::uint32_t n) const {
  if (!Executor::records() || step_ <= 1 || n == 0) return n;
  std::uint32_t unit = 64;
  while (unit * 32 <= n) unit *= 2;
  return (n + unit - 1) / unit * unit;
}

void Simulation::expect_modification() {
  if (stages_.modifies_contacts || !stages_.features.contact_modification) return;
  stages_.modifies_contacts = true;
  reserve_pairs(stages_.pair_capacity);
}

void Simulation::use_midphase(bool uses) {
  if (stages_.uses_midphase == uses) return;
  stages_.uses_midphase = uses;
  stages_.narrow_phase.use_midphase(uses);
  reserve_pairs(stages_.pair_capacity);
}

void Simulation::choose(BroadPhase::Method method) {
  if (stages_.broad_phase.method == method) return;
  stages_.broad_phase.method = method;
  reserve_pairs(stages_.pair_capacity);
}

// --- what the host has changed, on its way to where kernels run ---

/// Returns whether the statics are others than before.
bool Simulation::find_proxies() {
  const bool other_statics = lists_.find(colliders, bodies.mass);
  const auto sentinel = static_cast<std::uint32_t>(colliders.proxies.size()) - 1;
  for (ProxyList* list : {&lists_.movers, &lists_.statics}) {
    const std::uint32_t count = list->count();
    list->fill(colliders.count > sentinel ? count : std::min<std::uint32_t>(room_for(count), sentinel), sentinel);
  }
  return other_statics;
}

void Simulation::list_proxies() {
  const std::uint32_t statics_before = lists_.statics.view().count;
  const bool other_statics = find_proxies();
  for (ProxyList* list : {&lists_.movers, &lists_.statics, &lists_.planes}) list->upload(executor_);
  const ProxyRows statics = lists_.statics.view();
  stages_.narrow_phase.forget_found(executor_, statics.rows, lists_.statics.count());
  if ((lists_.types & kMidphaseTypes) != 0) use_midphase(true);
  if (origin_.find(lists_.movers, colliders, bodies.state) || other_statics) statics_changed();
  dirty_.statics = dirty_.statics || statics.count != statics_before;  // to fill up the tree
  dirty_.lists = false;
}

/// Where all are, and of what shape.
void Simulation::upload_bodies() {
  colliders.upload(executor_);
  bodies.state.upload();
}

void Simulation::upload_changes() {
  if (dirty_.lists) list_proxies();
  upload_bodies();
  bodies.force.upload(executor_);
  bodies.mass.upload(executor_);
  bodies.frames.upload(executor_);
  bodies.rolling_frictions.upload(executor_);
  colliders.surface_velocities.upload(executor_);
  joints.drives.upload(executor_);
  if (joints.changed()) {
    joints.upload(bodies.mass);
    exclusions.set_joined(joints.excluded());
    recorder_.forget();
  }
  StepParameters& parameters = numbers_.parameters[0];
  if (joints.count() != 0 && parameters.solver == SolverKind::kTgsSoft)
    stages_.energy_bound.reserve(bodies.size(), joints.count(), stages_.pair_capacity,
                                 joints.code() == JointCode::kAll);
  exclusions.upload();
  if (stages_.features.sleeping) {
    sleep_.upload(executor_);
    parameters.woken_contacts = sleep_.woken_count();
  }
  parameters.origin = origin_.place();
  executor_.to_device(numbers_.parameters, 1);
  executor_.to_device(numbers_.levels, 1);
  if (dirty_.statics) bound_statics();
}

void Simulation::bound_statics() {
  const ProxyRows statics = lists_.statics.view();
  for (const ProxyRows& list : {statics, lists_.planes.view()})
    executor_.run(list.count, BoundProxies{body_view(), colliders.view(), numbers_.parameters.device(), list.rows,
                                           stages_.boxes.data(), stages_.margins.data()});
  stages_.broad_phase.build_statics(executor_, stages_.boxes.data(), statics.rows, statics.count);
  dirty_.statics = false;
}

/// Room for the rows that steps bring, before a step is recorded.
void Simulation::reserve_rows() {
  const auto reserve = [&](auto& rows) { return rows.in_step() && rows.reserve(bodies.size(), false); };
  const bool poses = reserve(output_.poses), velocities = reserve(output_.velocities);
  if (poses || velocities) recorder_.forget();
}

// --- the step ---

StepInput Simulation::input() {
  return {body_view(),
          colliders.view(),
          bodies.frames.device(),
          stages_.features.surface_velocity ? colliders.surface_velocities.device() : nullptr,
          stages_.features.rolling_friction ? bodies.rolling_frictions.device() : nullptr,
          {colliders.filters.device(), exclusions.device(), exclusions.count()},
          lists_.movers.view(),
          lists_.statics.view(),
          lists_.planes.view(),
          std::min<std::uint32_t>(room_for(bodies.count), static_cast<std::uint32_t>(bodies.size()) - 1),
          stages_.pair_capacity,
          lists_.types,
          stages_.uses_midphase,
          stages_.continuous,
          sleep_.count() != 0,
          stages_.features.sleeping ? sleep_.woken_pairs() : nullptr,
          numbers_.parameters[0].solver,
          recorder_.generation()};
}

void Simulation::step(const StepParameters& parameters, const SubstepLevels& levels) {
  if (parameters.solver != numbers_.parameters[0].solver) stages_.solver.choose(parameters.solver);
  numbers_.parameters[0] = parameters;
  numbers_.levels[0] = levels;
  numbers_.parameters[0].step = ++step_;
  outcome_ = {};
  or_not_at_all([this] { launch(); });
}

/// Where memory runs out there was no step: nobody has moved, and what the last one found is not known any more, but to
/// the next.
template <class Act>
void Simulation::or_not_at_all(const Act& act) {
  try {
    act();
  } catch (...) {
    --step_;
    *numbers_.counters.host() = {};
    restored_ = true;
    last_.shows = false;
    recorder_.forget();
    throw;
  }
}

void Simulation::launch() {
  reserve_bodies(bodies.count);
  upload_changes();
  reserve_rows();
  PLUMB_ASSERT(numbers_.parameters[0].dt > 0);
  PLUMB_ASSERT(bodies.count < bodies.size() && colliders.count <= colliders.proxies.size());
  last_.shows = stages_.modifies_contacts;
  enqueue(last_.shows ? Half::kDetection : Half::kBoth);
}

void Simulation::respond(std::span<const ManifoldChange> changes) {
  PLUMB_ASSERT(last_.shows);
  last_.shows = false;
  stages_.modification.change(executor_, changes);
  enqueue(Half::kResponse);
}

void Simulation::enqueue(Half half) {
  NarrowPhase& narrow_phase = stages_.narrow_phase;
  const StepInput known = input();
  // A batch has no time for one of its worlds; and what modifies contacts has the host's time in its own.
  last_.measured = PhaseClock::measures(step_) && !executor_.is_in_batch() && !stages_.modifies_contacts;
  stages_.phases.measure(last_.measured);
  executor_.record(recorder_.recording(step_, last_.measured, known, half == Half::kResponse), [&] {
    const StepContext step = {known,
                              executor_,
                              stages_,
                              joints,
                              sleep_,
                              output_,
                              numbers_.parameters.device(),
                              numbers_.levels.device(),
                              numbers_.counters,
                              stages_.solver.take_mechanisms(joints),
                              narrow_phase.cache(step_),
                              narrow_phase.cache(step_ + 1)};
    switch (half) {
      case Half::kBoth: return enqueue_step(step);
      case Half::kDetection: return enqueue_detection(step);
      case Half::kResponse: return enqueue_response(step);
    }
  });
  if (half == Half::kDetection) return;
  bodies.state.stepped();
  restored_ = false;
  if (output_.poses.in_step()) output_.poses.written(bodies.state.version());
  if (output_.velocities.in_step()) output_.velocities.written(bodies.state.version());
}

void Simulation::repeat_undone() {
  while (is_undone(counters(), stages_.pair_capacity) && !taken_back()) {
    if (counters().pairs > stages_.pair_capacity) {
      reserve_pairs(counters().pairs + counters().pairs / 2);
      outcome_.grew = true;
    } else {
      const Slots roused = wake(sleep_.touched());
      outcome_.woken.insert(outcome_.woken.end(), roused.begin(), roused.end());
    }
    outcome_.repeated = true;
    launch();
    executor_.wait();
  }
}

bool Simulation::wait() {
  executor_.wait();
  or_not_at_all([this] { repeat_undone(); });
  PLUMB_ASSERT(candidate_count() <= stages_.pair_capacity || taken_back());
  if (last_.shows) return false;
  PLUMB_ASSERT(counters().manifolds <= candidate_count());
  if (taken_back()) --step_;
  if (taken_back() || !stages_.features.sleeping) return true;
  sleep_.stepped();
  if (step_ % Sleep::kPeriod == 0) let_islands_rest();
  return true;
}

// --- what is told of it ---

double Simulation::phase_seconds(PlumbPhase phase) const {
  const bool told = phase <= PLUMB_PHASE_SOLVE || phase == PLUMB_PHASE_OUTPUT;
  return told && last_.measured ? stages_.phases.seconds(phase) : std::numeric_limits<double>::quiet_NaN();
}

std::vector<ContactRecord> Simulation::contacts() {
  std::vector<ContactRecord> all = contacts_of_step();
  sleep_.for_records(step_, [&](const ContactRecord& record) { all.push_back(record); });
  return all;
}

std::vector<ContactRecord> Simulation::contacts_of_step() {
  const std::uint32_t count = counters().manifolds;
  if (count == 0 || restored_) return {};
  records_.grow(count);
  executor_.run(count,
                DescribeContacts{stages_.narrow_phase.cache(step_), body_view(), colliders.view(),
                                 stages_.solver.displacements(), stages_.solver.step_impulses(), records_.data()});
  executor_.wait();
  return records_.to_host(count);
}

std::vector<KeptPair> Simulation::solved_manifolds() const {
  return restored_ || counters().manifolds == 0 ? std::vector<KeptPair>()
                                                : stages_.narrow_phase.kept(step_, counters());
}

std::vector<Pair> Simulation::candidates() {
  std::vector<Pair> found = stages_.narrow_phase.candidates(step_, candidate_count());
  const auto same = [](const Pair& a, const Pair& b) { return a.a == b.a && a.b == b.b; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());  // of a pair's pieces one
  return found;
}

// --- snapshots ---

void Simulation::exchange(Archive& archive, const Extent& extent) {
  archive.value(step_);
  origin_.exchange(archive);
  StepCounters& counted = *numbers_.counters.host();
  archive.value(counted);
  if (candidate_count() > stages_.pair_capacity) reserve_pairs(candidate_count());
  bodies.state.exchange(archive, extent.bodies);
  stages_.narrow_phase.exchange(archive, step_, extent.proxies, counters());
  joints.exchange(archive, extent.bodies);
  stages_.solver.exchange(archive, extent.bodies);
  if (stages_.features.sleeping) sleep_.exchange(archive, extent.bodies, bodies.mass);
  if (!archive.reads()) return;
  (void)find_proxies();  // so that what comes next tells whether the host has changed the statics since
  dirty_.lists = dirty_.statics = restored_ = true;
  recorder_.forget();
}

}  // namespace plumb::impulse
