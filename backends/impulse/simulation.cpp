#include "simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "constraints/prepare_contacts.hpp"
#include "geometry/proxy_bounds.hpp"
#include "narrowphase/sweep_rims.hpp"
#include "solver/choose_substeps.hpp"

namespace plumb::impulse {

namespace {

struct ClearCounters {
  StepCounters* counters;
  PLUMB_HD void operator()(std::uint32_t) const { *counters = StepCounters{}; }
};

constexpr std::uint32_t kLeastPairs = 1024;
constexpr std::uint32_t kOriginSamples = 256;
constexpr double kNear = 1000;  // m: floats from an origin so far still tell a tenth of a millimetre

}  // namespace

Simulation::Simulation(const PlumbHost* host, std::uint32_t threads, const SolverFeatures& features)
    : executor_(host, threads), state(executor_), features_(features), solver_(features) {
  parameters_.grow(1);
  shorter_.grow(1);
  statics_parameters_.grow(1);
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
  joints.reserve_bodies(size);
  bodies_dirty_ = true;
  reserve_proxies(static_cast<std::uint32_t>(size));
  reserve_pairs(pair_capacity_);
}

void Simulation::reserve_proxies(std::uint32_t rows) {
  if (rows <= proxies.size()) return;
  const std::size_t before = proxies.size();
  const std::size_t size = std::max<std::size_t>(rows, before + before / 2);
  proxies.grow(size);
  for (std::size_t i = before; i < size; ++i) proxies.edit(i).shape = kNone;
  filters.grow(size);
  if (features_.belts) belts.grow(size);
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
  const auto slots = static_cast<std::uint32_t>(state.size()), rows = static_cast<std::uint32_t>(proxies.size());
  broad_phase_.reserve(executor_, rows, rows, pairs);
  narrow_phase_.reserve(executor_, rows, pairs);
  if (features_.continuous || features_.restitution) impacts_.reserve(pairs);
  if (features_.continuous) guard_.reserve(slots);
  if (in_pieces_) pieces_.reserve(rows, pairs);
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

Proxies Simulation::proxy_view() { return {proxies.device(), shapes.device(), hulls.device(), surfaces.device()}; }

/// Bounds are floats from a place near the bodies, so that they are as sharp far from the world's origin as near it.
/// That place is the median of some of them: one body that was lost far out does not move it.
Position Simulation::middle_of(const Mirror<std::uint32_t>& list, std::uint32_t count) {
  std::vector<std::uint32_t> some;
  for (std::uint32_t i = 0; i < count; i += count / kOriginSamples + 1) some.push_back(proxies[list[i]].body);
  state.fetch(some, kPosePart);
  Position middle = {0, 0, 0};
  std::vector<double> along;
  for (int axis = 0; axis < 3; ++axis) {
    along.clear();
    for (const std::uint32_t body : some) along.push_back(state.position[body][axis]);
    const auto half = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
    std::nth_element(along.begin(), half, along.end());
    middle[axis] = *half;
  }
  return middle;
}

/// Places that are near one that was good stay: what is bounded from there need not be bounded anew.
void Simulation::find_origin() {
  origin_dirty_ = false;
  if (mover_count_ == 0) return;
  const Position middle = middle_of(movers_, mover_count_);
  const Position off = middle - origin_;
  if (origin_known_ && std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) < kNear) return;
  origin_ = middle;
  origin_known_ = true;
  statics_changed();
}

/// Who has a shape, and whether it moves.
void Simulation::list_bodies() {
  const std::uint32_t statics_before = static_count_, room_before = static_room_;
  bool same_statics = true;
  mover_count_ = static_count_ = plane_count_ = shape_types_ = 0;
  for (std::uint32_t i = 0; i < proxy_count_; ++i) {
    if (proxies[i].shape == kNone || (filters[i].flags & kProxyUnseen) != 0) continue;
    const ShapeType type = shapes[proxies[i].shape].type;
    shape_types_ |= bit_of(type);
    if (type == ShapeType::kPlane) {
      planes_.grow(plane_count_ + 1);
      planes_[plane_count_++] = i;
    } else if ((mass[proxies[i].body].flags & kBodyMoves) != 0) {
      movers_[mover_count_++] = i;
    } else {
      same_statics = same_statics && static_count_ < statics_before && statics_[static_count_] == i;
      statics_[static_count_++] = i;
    }
  }
  mover_room_ = fill_room(movers_, mover_count_);
  static_room_ = fill_room(statics_, static_count_);
  executor_.to_device(movers_, mover_room_);
  executor_.to_device(statics_, static_room_);
  narrow_phase_.forget_found(executor_, statics_.device(), static_count_);
  if (plane_count_ != 0) executor_.to_device(planes_, plane_count_);
  if (!in_pieces_ && (shape_types_ & kTypesInPieces) != 0) {
    in_pieces_ = true;
    narrow_phase_.take_pieces();
    reserve_pairs(pair_capacity_);
  }
  if (origin_dirty_) find_origin();
  if (!same_statics || static_count_ != statics_before || static_room_ != room_before) statics_changed();
  bodies_dirty_ = false;
}

/// So many of a thing that a recorded step has room for, when there are n now. While bodies come and go the numbers
/// stay in coarse steps, and the recording serves on.
std::uint32_t Simulation::room_for(std::uint32_t n) const {
  if (!Executor::kRecords || step_ <= 1 || n == 0) return n;
  std::uint32_t unit = 64;
  while (unit * 32 <= n) unit *= 2;
  return (n + unit - 1) / unit * unit;
}

/// Makes up a list with a row of nobody, who touches nothing. Returns the length.
std::uint32_t Simulation::fill_room(Mirror<std::uint32_t>& list, std::uint32_t count) {
  const auto nobody = static_cast<std::uint32_t>(proxies.size()) - 1;
  const std::uint32_t room = proxy_count_ > nobody ? count : std::min<std::uint32_t>(room_for(count), nobody);
  std::fill(list.host() + count, list.host() + room, nobody);
  return room;
}

/// Where all are, and of what shape.
void Simulation::upload_bodies() {
  proxies.upload(executor_);
  filters.upload(executor_);
  shapes.upload(executor_);
  hulls.upload(executor_);
  surfaces.upload(executor_);
  state.upload();
}

void Simulation::upload_changes() {
  if (bodies_dirty_) list_bodies();
  upload_bodies();
  force.upload(executor_);
  mass.upload(executor_);
  belts.upload(executor_);
  frames.upload(executor_);
  joints.drives.upload(executor_);
  if (joints.changed()) {
    joints.upload(mass);
    exclusions.set_joined(joints.excluded());
    forget_recordings();
  }
  shorter_[0].work_of_joints = kWorkOfJoint * joints.count();
  if (bounds_energy()) energy_bound_.reserve(state.size(), joints.count());
  exclusions.upload();
  if (features_.sleeping) {
    sleep_.upload(executor_);
    parameters_[0].woken_contacts = sleep_.woken_count();
  }
  parameters_[0].origin = origin_;
  executor_.to_device(parameters_, 1);
  executor_.to_device(shorter_, 1);
  if (statics_dirty_) {
    if (!bound_again_) statics_parameters_[0] = parameters_[0];
    bound_again_ = false;
    executor_.to_device(statics_parameters_, 1);
    const auto bound = [this](std::uint32_t count, const std::uint32_t* list) {
      executor_.run(count, BoundProxies{bodies(), proxy_view(), statics_parameters_.device(), list, boxes_.data(),
                                        margins_.data()});
    };
    bound(static_room_, statics_.device());
    if (plane_count_ != 0) bound(plane_count_, planes_.device());
    broad_phase_.build_statics(executor_, boxes_.data(), statics_.device(), static_room_);
    statics_dirty_ = false;
  }
}

Simulation::Recorded Simulation::what_is_recorded() {
  const Hulls all = hulls.device();
  const Surfaces on = surfaces.device();
  return {{shapes.device(), all.ranges, all.vertices, all.faces, all.loops, all.edges, exclusions.device(), on.meshes,
           on.fields, planes_.device(), sleep_.woken_pairs()},
          {bodies_in_step(), mover_room_, static_room_, plane_count_, shape_types_, exclusions.count(),
           static_cast<std::uint32_t>(parameters_[0].solver), sleep_.count() == 0 ? 0U : 1U, continuous_ ? 1U : 0U}};
}

void Simulation::choose(BroadPhase::Method method) {
  if (broad_phase_.method == method) return;
  broad_phase_.method = method;
  reserve_pairs(pair_capacity_);
}

void Simulation::step(const StepParameters& parameters, const ShorterSubsteps& shorter) {
  if (parameters.solver != parameters_[0].solver) solver_.choose(parameters.solver);
  parameters_[0] = parameters;
  shorter_[0] = shorter;
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
  restored_ = false;
  if (poses_.in_step()) poses_.written(state.version());
  if (velocities_.in_step()) velocities_.written(state.version());
}

/// The pairs that are worth a look, and of those that have pieces the pieces.
void Simulation::find_candidates(const ContactCache& now) {
  StepCounters* counters = counters_.device();
  const PairFilter filter{filters.device(), exclusions.device(), exclusions.count()};
  broad_phase_.find_pairs(executor_, boxes_.data(), movers_.device(), mover_room_, filter,
                          in_pieces_ ? pieces_.pairs() : now.pairs, in_pieces_ ? pieces_.ranges() : now.ranges,
                          &counters->pairs);
  if (!in_pieces_) return;
  pieces_.find(executor_,
               {bodies(), proxy_view(), parameters_.device(), filter, boxes_.data(), margins_.data(), movers_.device(),
                mover_room_, planes_.device(), plane_count_},
               now, counters, continuous_);
}

/// The step, from bounds to poses.
void Simulation::enqueue() {
  const Bodies all = bodies();
  const Proxies shapes_on = proxy_view();
  StepCounters* counters = counters_.device();
  const StepParameters* parameters = parameters_.device();
  const ContactCache now = narrow_phase_.cache(step_), last = narrow_phase_.cache(step_ + 1);

  const Mechanisms mechanisms = solver_.meet(joints);
  phases_.start(executor_);
  executor_.run(1U, ClearCounters{counters});
  if (features_.collision) {
    executor_.run(mover_room_,
                  BoundProxies{all, shapes_on, parameters, movers_.device(), boxes_.data(), margins_.data()});
    find_candidates(now);
    phases_.end(executor_, PLUMB_PHASE_BROAD);
    narrow_phase_.collide(executor_, now, all, shapes_on, margins_.data(), shape_types_, counters);
    if (all.turn && (shape_types_ & bit_of(ShapeType::kCylinder)) != 0)
      sweep_rims(executor_, narrow_phase_.candidates(counters), now, all, shapes_on, parameters);
    if (finds_impacts())
      impacts_.find(executor_, now, narrow_phase_.candidates(counters), all, shapes_on, margins_.data(), parameters,
                    in_pieces_);
    narrow_phase_.number(executor_, now, counters);
    colouring_.begin(executor_);
    const KeptPair* woken = features_.sleeping ? sleep_.woken_pairs() : nullptr;
    narrow_phase_.match(executor_, now, last, woken, all, shapes_on, parameters, counters, mechanisms,
                        colouring_.masks());
    if (sleep_.count() != 0) sleep_.find_touched(executor_, now, pair_capacity_, all, shapes_on, counters);
    phases_.end(executor_, PLUMB_PHASE_NARROW);
    if (solver_.needs_colours())
      colouring_.colour(executor_, now, all.velocity, proxies.device(), mechanisms, counters);
    else
      colouring_.leave_out(executor_, counters);
    phases_.end(executor_, PLUMB_PHASE_ISLANDS);
  }
  if (features_.collision || joints.count() != 0) {
    solver_.choose_substeps(executor_, now, all, shapes_on, shorter_.device(), parameters_.device(), counters);
    solver_.begin(executor_, all, bodies_in_step());
    if (features_.collision && mechanisms.count != 0)
      solver_.find_mobility(executor_, now, all, shapes_on, parameters, counters, joints);
    if (features_.collision)
      solver_.prepare(executor_, now, all, shapes_on, colouring_, finds_impacts() ? impacts_.times() : nullptr,
                      parameters, counters);
    if (features_.belts)
      put_drifts(executor_, now, pair_capacity_, all, shapes_on, belts.device(), colouring_.order(),
                 colouring_.colours(), solver_.rows(), counters);
    const EnergyWork energy = energy_work(now, all, shapes_on);
    if (bounds_energy()) energy_bound_.keep(executor_, energy);
    solver_.solve(executor_, all, bodies_in_step(), parameters, counters, pair_capacity_, joints);
    if (continuous_)
      guard_.hold(
          executor_,
          {now, narrow_phase_.candidates(counters), pair_capacity_, counters, parameters, shapes_on, boxes_.data(),
           movers_.device(), mover_room_, broad_phase_.statics(), planes_.device(), plane_count_},
          all, bodies_in_step(), solver_.displacements());
    if (bounds_energy()) energy_bound_.judge(executor_, energy, {&counters->manifolds, pair_capacity_});
    if (features_.collision) solver_.keep_impulses(executor_, now, counters);
  } else {
    solver_.move_freely(executor_, all, bodies_in_step(), parameters, counters);
  }
  if (features_.sleeping) sleep_.time_rest(executor_, all, bodies_in_step(), parameters, counters, pair_capacity_);
  phases_.end(executor_, PLUMB_PHASE_SOLVE);
  enqueue_rows();
  executor_.to_host(counters_, 1);
  phases_.end(executor_, PLUMB_PHASE_OUTPUT);
}

EnergyWork Simulation::energy_work(const ContactCache& now, const Bodies& all, const Proxies& shapes_on) {
  return {now,
          shapes_on,
          features_.belts ? belts.device() : nullptr,
          solver_.joint_set(all, joints),
          joints.code(),
          bodies_in_step(),
          pair_capacity_,
          parameters_.device(),
          counters_.device()};
}

void Simulation::wait() {
  executor_.wait();
  while (is_undone(counters(), pair_capacity_) && !taken_back()) {
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
  if (taken_back()) --step_;
  if (taken_back() || !features_.sleeping) return;
  sleep_.stepped();
  if (step_ % Sleep::kPeriod == 0) let_islands_rest();
}

double Simulation::phase_seconds(PlumbPhase phase) const {
  const bool told = phase <= PLUMB_PHASE_SOLVE || phase == PLUMB_PHASE_OUTPUT;
  return told && PhaseClock::measures(step_) ? phases_.seconds(phase) : std::numeric_limits<double>::quiet_NaN();
}

Simulation::Extent Simulation::extent(bool to_restore) {
  if (to_restore && bodies_dirty_) list_bodies();
  return {body_count_, proxy_count_, joints.slots(), in_pieces_ ? 1U : 0U};
}

void Simulation::exchange(Archive& archive, const Extent& extent) {
  archive.value(step_);
  archive.value(origin_);
  archive.value(origin_dirty_);
  archive.value(origin_known_);
  archive.value(statics_parameters_[0]);
  bool statics_dirty = statics_dirty_;
  archive.value(statics_dirty);
  archive.value(*counters_.host());
  if (in_pieces_ && extent.in_pieces == 0) counters_.host()->pieces = counters().pairs;
  if (candidate_count() > pair_capacity_) reserve_pairs(candidate_count());
  state.exchange(archive, extent.bodies);
  narrow_phase_.exchange(archive, step_, extent.proxies, counters(), extent.in_pieces != 0);
  joints.exchange(archive, extent.joints);
  if (features_.sleeping) sleep_.exchange(archive, extent.bodies, mass);
  if (!archive.reads()) return;
  bodies_dirty_ = restored_ = true;
  bound_again_ = !statics_dirty && !origin_dirty_;
  forget_recordings();
}

std::vector<ContactRecord> Simulation::contacts() {
  std::vector<ContactRecord> all = contacts_of_step();
  sleep_.for_records(step_, [&](const ContactRecord& record) { all.push_back(record); });
  return all;
}

std::vector<KeptPair> Simulation::solved_manifolds() const {
  return restored_ || counters().manifolds == 0 ? std::vector<KeptPair>() : narrow_phase_.kept(step_, counters());
}

std::vector<ContactRecord> Simulation::contacts_of_step() {
  const std::uint32_t count = counters().manifolds;
  if (count == 0 || restored_) return {};
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
  if (poses_.in_step()) poses_.write(executor_, bodies(), frames.device(), bodies_in_step());
  if (velocities_.in_step()) velocities_.write(executor_, bodies(), frames.device(), bodies_in_step());
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

std::vector<Pair> Simulation::candidates() {
  std::vector<Pair> found = narrow_phase_.candidates(step_, candidate_count());
  const auto same = [](const Pair& a, const Pair& b) { return a.a == b.a && a.b == b.b; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());  // of a pair's pieces one
  return found;
}

}  // namespace plumb::impulse
