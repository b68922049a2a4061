#include "simulation.hpp"

#include <algorithm>

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
    : executor_(host, threads), features_(features), solver_(features) {
  parameters_.grow(1);
  counters_.grow(1);
  reserve_bodies(64);
  reserve_shapes(16);
  reserve_pairs(kLeastPairs);
}

void Simulation::reserve_bodies(std::uint32_t slots) {
  const std::size_t rows = std::size_t{slots} + 1;  // and nobody
  if (rows <= position.size()) return;
  bring_state_to_host();
  const std::size_t size = rows + rows / 2;
  position.grow(size);
  orientation.grow(size);
  velocity.grow(size);
  force.grow(size);
  mass.grow(size);
  proxies.grow(size);
  filters.grow(size);
  movers_.grow(size);
  statics_.grow(size);
  boxes_.grow(size);
  margins_.grow(size);
  for (std::size_t i = body_count_; i < size; ++i) orientation[i] = {0, 0, 0, 1};
  bodies_dirty_ = state_dirty_ = forces_dirty_ = true;
  reserve_pairs(pair_capacity_);
}

void Simulation::reserve_shapes(std::uint32_t rows) {
  if (rows <= shapes.size()) return;
  shapes.grow(rows + rows / 2);
  bodies_dirty_ = true;
  for (Recording& recording : recordings_) recording.forget();
}

void Simulation::reserve_pairs(std::uint32_t pairs) {
  pair_capacity_ = pairs;
  const auto slots = static_cast<std::uint32_t>(position.size());
  broad_phase_.reserve(executor_, slots, slots, pairs);
  narrow_phase_.reserve(executor_, slots, pairs);
  colouring_.reserve(executor_, slots, pairs);
  solver_.reserve(executor_, slots, pairs);
  for (Recording& recording : recordings_) recording.forget();
}

Bodies Simulation::bodies() {
  return {position.device(), orientation.device(), velocity.device(), force.device(), mass.device()};
}

Proxies Simulation::proxy_view() { return {proxies.device(), shapes.device(), hulls.device()}; }

void Simulation::bring_state_to_host() {
  if (!host_stale_) return;
  executor_.to_host(position, body_count_);
  executor_.to_host(orientation, body_count_);
  executor_.to_host(velocity, body_count_);
  executor_.wait();
  host_stale_ = false;
}

/// Bounds are floats from a place near the bodies, so that they are as sharp far from the world's origin as near it.
/// That place is the median of some of them: one body that was lost far out does not move it.
void Simulation::find_origin() {
  if (mover_count_ == 0) return;
  const std::uint32_t stride = mover_count_ / kOriginSamples + 1;
  std::vector<double> along;
  for (int axis = 0; axis < 3; ++axis) {
    along.clear();
    for (std::uint32_t i = 0; i < mover_count_; i += stride) along.push_back(position[proxies[movers_[i]].body][axis]);
    const auto middle = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
    std::nth_element(along.begin(), middle, along.end());
    origin_[axis] = *middle;
  }
}

void Simulation::upload_changes() {
  if (bodies_dirty_) {
    bring_state_to_host();
    mover_count_ = static_count_ = shape_types_ = 0;
    for (std::uint32_t i = 0; i < body_count_; ++i) {
      if (proxies[i].shape == kNone) continue;
      shape_types_ |= 1U << static_cast<std::uint32_t>(shapes[proxies[i].shape].type);
      if ((mass[i].flags & kBodyMoves) != 0)
        movers_[mover_count_++] = i;
      else
        statics_[static_count_++] = i;
    }
    executor_.to_device(mass, position.size());
    executor_.to_device(proxies, position.size());
    executor_.to_device(filters, position.size());
    executor_.to_device(shapes, shapes.size());
    hulls.upload(executor_);
    executor_.to_device(movers_, mover_count_);
    executor_.to_device(statics_, static_count_);
    find_origin();
    statics_dirty_ = true;
    for (Recording& recording : recordings_) recording.forget();  // the numbers of bodies are in them
  }
  if (joints.changed()) {
    joints.upload(mass);
    for (Recording& recording : recordings_) recording.forget();
  }
  if (state_dirty_) {
    executor_.to_device(position, position.size());
    executor_.to_device(orientation, position.size());
    executor_.to_device(velocity, position.size());
  }
  if (forces_dirty_) executor_.to_device(force, position.size());
  parameters_[0].origin = origin_;
  executor_.to_device(parameters_, 1);
  if (statics_dirty_) {
    executor_.run(static_count_, BoundProxies{bodies(), proxy_view(), parameters_.device(), statics_.device(),
                                              boxes_.data(), margins_.data()});
    broad_phase_.build_statics(executor_, boxes_.data(), statics_.device(), static_count_);
  }
  bodies_dirty_ = state_dirty_ = forces_dirty_ = statics_dirty_ = false;
}

void Simulation::step(const StepParameters& parameters) {
  if (parameters.solver != parameters_[0].solver) {
    solver_.choose(parameters.solver);
    for (Recording& recording : recordings_) recording.forget();
  }
  parameters_[0] = parameters;
  parameters_[0].step = ++step_;
  repeated_ = false;
  upload_changes();
  run_step();
}

void Simulation::run_step() {
  executor_.record(recordings_[step_ % 2], [this] { enqueue(); });
  host_stale_ = true;
}

/// The step, from bounds to poses.
void Simulation::enqueue() {
  const Bodies all = bodies();
  const Proxies shapes_on = proxy_view();
  StepCounters* counters = counters_.device();
  const StepParameters* parameters = parameters_.device();
  const ContactCache now = narrow_phase_.cache(step_), last = narrow_phase_.cache(step_ + 1);

  executor_.run(1U, ClearCounters{counters});
  solver_.begin(executor_, all, body_count_);
  if (features_.collision) {
    executor_.run(mover_count_,
                  BoundProxies{all, shapes_on, parameters, movers_.device(), boxes_.data(), margins_.data()});
    broad_phase_.find_pairs(executor_, boxes_.data(), movers_.device(), mover_count_,
                            PairFilter{filters.device(), joints.excluded(), joints.excluded_count()}, now.pairs,
                            now.ranges, &counters->pairs);
    narrow_phase_.collide(executor_, now, all, shapes_on, margins_.data(), shape_types_, counters);
    colouring_.begin(executor_);
    narrow_phase_.match(executor_, now, last, all, shapes_on, parameters, counters, colouring_.masks());
    if (solver_.needs_colours())
      colouring_.colour(executor_, now, velocity.device(), proxies.device(), counters);
    else
      colouring_.leave_out(executor_, counters);
    solver_.prepare(executor_, now, all, shapes_on, colouring_, parameters, counters);
  }
  solver_.solve(executor_, all, body_count_, parameters, counters, pair_capacity_, joints);
  if (features_.collision) solver_.keep_impulses(executor_, now, counters);
  executor_.to_host(counters_, 1);
}

void Simulation::wait() {
  executor_.wait();
  while (counters().pairs > pair_capacity_) {
    reserve_pairs(counters().pairs + counters().pairs / 2);
    repeated_ = true;
    run_step();
    executor_.wait();
  }
}

std::vector<ContactRecord> Simulation::contacts() {
  const std::uint32_t count = counters().manifolds;
  if (count == 0) return {};
  records_.grow(count);
  executor_.run(count, DescribeContacts{narrow_phase_.cache(step_), bodies(), proxy_view(), solver_.displacements(),
                                        solver_.step_impulses(), records_.data()});
  executor_.wait();
  return records_.to_host(count);
}

std::vector<Pair> Simulation::candidates() { return narrow_phase_.candidates(step_, counters().pairs); }

}  // namespace plumb::impulse
