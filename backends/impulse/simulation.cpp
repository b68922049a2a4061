#include "simulation.hpp"

#include <algorithm>
#include <limits>

#include "constraints/prepare_contacts.hpp"
#include "geometry/proxy_bounds.hpp"

namespace plumb::impulse {

namespace {

struct ClearCounters {
  StepCounters* counters;
  PLUMB_HD void operator()(std::uint32_t) const { *counters = StepCounters{}; }
};

constexpr std::uint32_t kLeastPairs = 1024;
constexpr std::uint32_t kOriginSamples = 256;

}  // namespace

Simulation::Simulation(const PlumbHost* host, std::uint32_t threads, const SolverFeatures& features)
    : executor_(host, threads), state(executor_), features_(features), solver_(features) {
  parameters_.grow(1);
  counters_.grow(1);
  reserve_bodies(64);
  reserve_shapes(16);
  reserve_pairs(kLeastPairs);
}

void Simulation::reserve_bodies(std::uint32_t slots) {
  const std::size_t rows = std::size_t{slots} + 1;  // and nobody
  if (rows <= state.size()) return;
  const std::size_t size = rows + rows / 2;
  state.grow(size);
  force.grow(size);
  mass.grow(size);
  frames.grow(size);
  proxies.grow(size);
  filters.grow(size);
  movers_.grow(size);
  statics_.grow(size);
  boxes_.grow(size);
  margins_.grow(size);
  if (features_.sleeping) sleep_.reserve(static_cast<std::uint32_t>(size));
  bodies_dirty_ = true;
  reserve_pairs(pair_capacity_);
}

void Simulation::reserve_shapes(std::uint32_t rows) {
  if (rows > shapes.size()) shapes.grow(rows + rows / 2);
}

void Simulation::reserve_pairs(std::uint32_t pairs) {
  pair_capacity_ = pairs;
  const auto slots = static_cast<std::uint32_t>(state.size());
  broad_phase_.reserve(executor_, slots, slots, pairs);
  narrow_phase_.reserve(executor_, slots, pairs);
  colouring_.reserve(executor_, slots, pairs);
  solver_.reserve(executor_, slots, pairs);
  forget_recordings();
}

void Simulation::forget_recordings() {
  for (auto& of_each_parity : recordings_)
    for (Recording& recording : of_each_parity) recording.forget();
}

Bodies Simulation::bodies() {
  return {state.position.device(), state.orientation.device(), state.velocity.device(), force.device(),
          mass.device(),           features_.rotation};
}

Proxies Simulation::proxy_view() { return {proxies.device(), shapes.device(), hulls.device()}; }

/// Bounds are floats from a place near the bodies, so that they are as sharp far from the world's origin as near it.
/// That place is the median of some of them: one body that was lost far out does not move it.
void Simulation::find_origin() {
  if (mover_count_ == 0) return;
  std::vector<std::uint32_t> some;
  for (std::uint32_t i = 0; i < mover_count_; i += mover_count_ / kOriginSamples + 1)
    some.push_back(proxies[movers_[i]].body);
  state.fetch(some, kPosePart);
  std::vector<double> along;
  for (int axis = 0; axis < 3; ++axis) {
    along.clear();
    for (const std::uint32_t body : some) along.push_back(state.position[body][axis]);
    const auto middle = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
    std::nth_element(along.begin(), middle, along.end());
    origin_[axis] = *middle;
  }
}

/// Who has a shape, and whether it moves.
void Simulation::list_bodies() {
  mover_count_ = static_count_ = shape_types_ = 0;
  for (std::uint32_t i = 0; i < body_count_; ++i) {
    if (proxies[i].shape == kNone) continue;
    shape_types_ |= 1U << static_cast<std::uint32_t>(shapes[proxies[i].shape].type);
    if ((mass[i].flags & kBodyMoves) != 0)
      movers_[mover_count_++] = i;
    else
      statics_[static_count_++] = i;
  }
  executor_.to_device(movers_, mover_count_);
  executor_.to_device(statics_, static_count_);
  narrow_phase_.forget_found(executor_, statics_.device(), static_count_);
  find_origin();
  statics_dirty_ = true;
  bodies_dirty_ = false;
}

void Simulation::upload_changes() {
  if (bodies_dirty_) list_bodies();
  force.upload(executor_);
  mass.upload(executor_);
  frames.upload(executor_);
  proxies.upload(executor_);
  filters.upload(executor_);
  shapes.upload(executor_);
  hulls.upload(executor_);
  state.upload();
  joints.drives.upload(executor_);
  if (joints.changed()) {
    joints.upload(mass);
    forget_recordings();
  }
  if (features_.sleeping) {
    sleep_.upload(executor_);
    parameters_[0].woken_contacts = sleep_.woken_count();
  }
  parameters_[0].origin = origin_;
  executor_.to_device(parameters_, 1);
  if (statics_dirty_) {
    executor_.run(static_count_, BoundProxies{bodies(), proxy_view(), parameters_.device(), statics_.device(),
                                              boxes_.data(), margins_.data()});
    broad_phase_.build_statics(executor_, boxes_.data(), statics_.device(), static_count_);
    statics_dirty_ = false;
  }
}

Simulation::Recorded Simulation::what_is_recorded() {
  const Hulls all = hulls.device();
  return {{shapes.device(), all.ranges, all.vertices, all.faces, all.loops, all.edges, joints.excluded()},
          {body_count_, mover_count_, static_count_, shape_types_, joints.excluded_count(),
           static_cast<std::uint32_t>(parameters_[0].solver), sleep_.count() == 0 ? 0U : 1U}};
}

void Simulation::step(const StepParameters& parameters) {
  if (parameters.solver != parameters_[0].solver) solver_.choose(parameters.solver);
  parameters_[0] = parameters;
  parameters_[0].step = ++step_;
  repeated_ = grew_ = false;
  woken_.clear();
  fallen_asleep_.clear();
  launch();
}

void Simulation::launch() {
  upload_changes();
  reserve_rows();
  if (const Recorded now = what_is_recorded(); now != recorded_) {
    forget_recordings();
    recorded_ = now;
  }
  run_step();
}

void Simulation::run_step() {
  executor_.record(recordings_[PhaseClock::measures(step_) ? 1 : 0][step_ % 2], [this] { enqueue(); });
  state.stepped();
  if (poses_.in_step()) poses_.written(state.version());
  if (velocities_.in_step()) velocities_.written(state.version());
}

/// The step, from bounds to poses.
void Simulation::enqueue() {
  const Bodies all = bodies();
  const Proxies shapes_on = proxy_view();
  StepCounters* counters = counters_.device();
  const StepParameters* parameters = parameters_.device();
  const ContactCache now = narrow_phase_.cache(step_), last = narrow_phase_.cache(step_ + 1);

  phases_.start(executor_);
  executor_.run(1U, ClearCounters{counters});
  if (features_.collision) {
    executor_.run(mover_count_,
                  BoundProxies{all, shapes_on, parameters, movers_.device(), boxes_.data(), margins_.data()});
    broad_phase_.find_pairs(executor_, boxes_.data(), movers_.device(), mover_count_,
                            PairFilter{filters.device(), joints.excluded(), joints.excluded_count()}, now.pairs,
                            now.ranges, &counters->pairs);
    phases_.end(executor_, PLUMB_PHASE_BROAD);
    narrow_phase_.collide(executor_, now, all, shapes_on, margins_.data(), shape_types_, counters);
    colouring_.begin(executor_);
    const KeptPair* woken = features_.sleeping ? sleep_.woken_pairs() : nullptr;
    narrow_phase_.match(executor_, now, last, woken, all, shapes_on, parameters, counters, colouring_.masks());
    if (sleep_.count() != 0) sleep_.find_touched(executor_, now, pair_capacity_, all, shapes_on, counters);
    phases_.end(executor_, PLUMB_PHASE_NARROW);
    if (solver_.needs_colours())
      colouring_.colour(executor_, now, all.velocity, proxies.device(), counters);
    else
      colouring_.leave_out(executor_, counters);
    phases_.end(executor_, PLUMB_PHASE_ISLANDS);
  }
  if (features_.collision || joints.count() != 0) {
    solver_.begin(executor_, all, body_count_);
    if (features_.collision) solver_.prepare(executor_, now, all, shapes_on, colouring_, parameters, counters);
    solver_.solve(executor_, all, body_count_, parameters, counters, pair_capacity_, joints);
    if (features_.collision) solver_.keep_impulses(executor_, now, counters);
  } else {
    solver_.move_freely(executor_, all, body_count_, parameters, counters);
  }
  if (features_.sleeping) sleep_.time_rest(executor_, all, body_count_, parameters, counters, pair_capacity_);
  phases_.end(executor_, PLUMB_PHASE_SOLVE);
  enqueue_rows();
  executor_.to_host(counters_, 1);
  phases_.end(executor_, PLUMB_PHASE_OUTPUT);
}

void Simulation::wait() {
  executor_.wait();
  while (is_undone(counters(), pair_capacity_)) {
    if (counters().pairs > pair_capacity_) {
      reserve_pairs(counters().pairs + counters().pairs / 2);
      grew_ = true;
    } else {
      const Slots roused = wake(sleep_.touched());
      woken_.insert(woken_.end(), roused.begin(), roused.end());
    }
    repeated_ = true;
    launch();
    executor_.wait();
  }
  if (!features_.sleeping) return;
  sleep_.stepped();
  if (step_ % Sleep::kPeriod == 0) let_islands_rest();
}

double Simulation::phase_seconds(PlumbPhase phase) const {
  const bool told = phase <= PLUMB_PHASE_SOLVE || phase == PLUMB_PHASE_OUTPUT;
  return told && PhaseClock::measures(step_) ? phases_.seconds(phase) : std::numeric_limits<double>::quiet_NaN();
}

std::vector<ContactRecord> Simulation::contacts() {
  std::vector<ContactRecord> all = contacts_of_step();
  sleep_.for_records(step_, [&](const ContactRecord& record) { all.push_back(record); });
  return all;
}

std::vector<ContactRecord> Simulation::contacts_of_step() {
  const std::uint32_t count = counters().manifolds;
  if (count == 0) return {};
  records_.grow(count);
  executor_.run(count, DescribeContacts{narrow_phase_.cache(step_), bodies(), proxy_view(), solver_.displacements(),
                                        solver_.step_impulses(), records_.data()});
  executor_.wait();
  return records_.to_host(count);
}

/// Room for the rows that steps bring, before a step is recorded.
void Simulation::reserve_rows() {
  bool anew = poses_.in_step() && poses_.reserve(state.size(), false);
  anew = (velocities_.in_step() && velocities_.reserve(state.size(), false)) || anew;
  if (anew) forget_recordings();
}

void Simulation::enqueue_rows() {
  if (poses_.in_step()) poses_.write(executor_, bodies(), frames.device(), body_count_);
  if (velocities_.in_step()) velocities_.write(executor_, bodies(), frames.device(), body_count_);
}

template <class Row>
std::shared_ptr<RowBlock<Row>> Simulation::rows(FieldRows<Row>& field, bool on_host) {
  if (field.want(on_host)) forget_recordings();
  if (field.fresh(state.version(), on_host)) return field.block();
  if (field.fresh(state.version(), false)) {
    field.bring(executor_, body_count_);
  } else {
    if (field.reserve(state.size(), true)) forget_recordings();
    frames.upload(executor_);
    state.upload();
    field.write(executor_, bodies(), frames.device(), body_count_);
  }
  field.written(state.version());
  executor_.wait();
  return field.block();
}

template std::shared_ptr<RowBlock<PoseRow>> Simulation::rows(FieldRows<PoseRow>& field, bool on_host);
template std::shared_ptr<RowBlock<VelocityRow>> Simulation::rows(FieldRows<VelocityRow>& field, bool on_host);

std::vector<Pair> Simulation::candidates() { return narrow_phase_.candidates(step_, counters().pairs); }

}  // namespace plumb::impulse
