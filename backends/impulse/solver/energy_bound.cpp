#include "solver/energy_bound.hpp"

#include "exec/atomic.hpp"
#include "exec/union_find.hpp"
#include "joints/joint_axis_solve.hpp"
#include "math/ordered_bits.hpp"
#include "plumb/assert.hpp"
#include "solver/opened_joints.hpp"

namespace plumb::impulse {

namespace {

struct Keep {
  EnergyWork work;
  KeptBody* bodies;
  KeptJoint* joints;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const JointView& view = work.joints.view;
    if (i < work.body_count) bodies[i] = state_of(view, i);
    if (i >= work.joints.count) return;
    const std::uint32_t slot = view.joints[i].slot;
    joints[i].impulse = view.impulses[slot];
    if (work.code != JointCode::kAll) return;
    joints[i].force = work.joints.axes.reactions[slot].force;
    joints[i].torque = work.joints.axes.reactions[slot].torque;
    joints[i].way = work.joints.axes.reactions[slot].way;
    for (int k = 0; k < kJointRows; ++k) joints[i].held_for[k] = work.joints.axes.reactions[slot].held_for[k];
  }
};

/// Numbers as whole multiples of 2^-40 of a power of two near the peak, and no more than twice it.
class Quanta {
 public:
  PLUMB_HD explicit Quanta(std::uint32_t peak) {
    const int exponent = static_cast<int>(peak >> 23) - 127;
    per_unit_ = __builtin_bit_cast(double, static_cast<std::uint64_t>(1023 + 40 - exponent) << 52);
  }
  PLUMB_HD std::int64_t of(Real x) const {
    constexpr double kMost = 4398046511104.0;  // 2^42
    return static_cast<std::int64_t>(max(-kMost, min(kMost, static_cast<double>(x) * per_unit_)));
  }

 private:
  double per_unit_;
};
PLUMB_HD inline void add_whole(std::int64_t* to, std::int64_t number) {
  atomic_add(reinterpret_cast<std::uint64_t*>(to), static_cast<std::uint64_t>(number));
}

PLUMB_HD inline Real kinetic_energy(const BodyMass& mass, const Velocity& velocity, const Quat& orientation) {
  const Vec turn = rotate_back(orientation, velocity.angular);
  const Real turning =
      mass.inertia.x * turn.x * turn.x + mass.inertia.y * turn.y * turn.y + mass.inertia.z * turn.z * turn.z;
  return (length_squared(velocity.linear) / velocity.inverse_mass + turning) / 2;
}

struct EnergyParents {
  IslandEnergy* islands;
  PLUMB_HD std::uint32_t* operator()(std::uint32_t i) const { return &islands[i].parent; }
};

/// Energies of a body, J.
struct BodyEnergy {
  Real kinetic, may_have, work;
};

struct JudgeEnergy {
  EnergyWork work;
  const KeptBody* kept;
  const KeptJoint* kept_joints;
  IslandEnergy* islands;
  Real* given;
  SettledIslands settled;
  bool* tried;

  PLUMB_DEVICE void operator()(Team& team) const {
    if (is_undone(*work.counters, work.pair_capacity)) return;
    const JudgeEnergy self = *this;
    const std::uint32_t bodies = work.body_count, joints = work.joints.count;
    if (work.settles && work.parameters->is_repeat) put_settled(team);
    team.each(bodies, [self](std::uint32_t i) {
      self.islands[i] = IslandEnergy{i, i, 0, 0, 0, 0, 0, 0, 0, false, false, 1, 0, 0, 0};
      if (!self.work.parameters->is_repeat) self.tried[i] = false;
    });
    team.each(work.counters->manifolds, [self](std::uint32_t row) { self.join_contact(row); });
    team.each(joints, [self](std::uint32_t j) { self.join_joint(j); });
    team.each(bodies, [self](std::uint32_t i) { self.find_root(i); });
    if (predicts()) {
      const std::uint32_t base = work.joints.system.base;
      team.each(joints - base, [self, base](std::uint32_t i) { self.find_let_go(base + i); });
      team.barrier();
      if (work.counters->bound.let_go != 0) {
        team.each(joints - base, [self, base](std::uint32_t i) { self.distrust(base + i); });
        if (work.settles) set_settled_aside(team);
        return put_all_back(team);
      }
    }
    if (work.levels != nullptr) {
      team.each(joints, [self](std::uint32_t j) { self.find_opened(j); });
      team.each(bodies, [self](std::uint32_t i) { self.choose_again(i); });
      team.each(bodies, [self](std::uint32_t i) { self.note_attempt(i); });
      team.barrier();
      if (work.counters->bound.opened != 0) {
        if (work.settles) set_settled_aside(team);
        return put_all_back(team);
      }
      if (work.counters->bound.still_open != 0 && work.parameters->may_be_taken_back) return put_all_back(team);
    }
    team.each(joints, [self](std::uint32_t j) { self.find_given(j); });
    team.each(bodies, [self](std::uint32_t i) { self.find_peak(i); });
    team.each(bodies, [self](std::uint32_t i) { self.add_body(i); });
    team.each(joints, [self](std::uint32_t j) { self.add_given(j); });
    team.each(bodies, [self](std::uint32_t i) { self.judge(i); });
    team.barrier();
    if (work.counters->bound.gained == 0) return;
    if (work.parameters->may_be_taken_back) return put_all_back(team);
    team.each(bodies, [self](std::uint32_t i) { self.take_gain_out(i); });
    team.each(joints, [self](std::uint32_t j) { self.put_joint_back(j, false); });
  }

 private:
  PLUMB_DEVICE void set_settled_aside(Team& team) const {
    const JudgeEnergy self = *this;
    const JointView view = work.joints.view;
    team.each(work.body_count, [self, view](std::uint32_t i) {
      const IslandEnergy& island = self.islands[self.islands[i].root];
      self.settled.set_body_aside(view, i, self.is_pushed(i) && island.let_go == 0 && !island.again);
    });
    team.each(work.joints.count, [self](std::uint32_t j) { self.settled.set_joint_aside(self.work.joints, j); });
    team.each(work.counters->manifolds, [self, view](std::uint32_t row) {
      self.settled.set_contact_aside(view, self.work.cache, self.work.proxies.rows, row);
    });
  }
  PLUMB_DEVICE void put_settled(Team& team) const {
    const JudgeEnergy self = *this;
    const JointView view = work.joints.view;
    team.each(work.body_count, [self, view](std::uint32_t i) {
      self.settled.put_body(self.work.bodies, view, i);
      if (self.settled.bodies[i].is_settled && self.is_lost(i)) atomic_add(&self.work.counters->nonfinite, 1U);
    });
    team.each(work.joints.count, [self](std::uint32_t j) { self.settled.put_joint(self.work.joints, j); });
    team.each(work.counters->manifolds, [self, view](std::uint32_t row) {
      self.settled.put_contact(view, self.work.cache, self.work.proxies.rows, row);
    });
  }
  PLUMB_DEVICE void put_all_back(Team& team) const {
    const JudgeEnergy self = *this;
    team.each(work.body_count, [self](std::uint32_t i) {
      self.put_back(i);
      if (self.work.levels != nullptr) self.put_pace_back(i);
    });
    team.each(work.joints.count, [self](std::uint32_t j) { self.put_joint_back(j, true); });
    team.single([self] { self.work.counters->bound.taken_back = 1; });
  }
  /// Whether contacts were told that rows of joints hold which need not.
  PLUMB_HD bool predicts() const {
    return work.code == JointCode::kAll && work.joints.view.solver.mechanisms.count != 0;
  }
  PLUMB_HD void find_let_go(std::uint32_t j) const {
    if (work.joints.axes.work[j].let_go == 0) return;
    atomic_add(&work.counters->bound.let_go, 1U);
    atomic_max(&islands[root_of(work.joints.view.joints[j])].let_go, 1U);
  }
  PLUMB_HD void distrust(std::uint32_t j) const {
    if (islands[root_of(work.joints.view.joints[j])].let_go != 0) work.joints.axes.work[j].is_trusted = false;
  }
  /// Whether the step has opened a joint.
  PLUMB_HD void find_opened(std::uint32_t j) const {
    const Joint& joint = work.joints.view.joints[j];
    if (!is_pushed(joint.body_a) && !is_pushed(joint.body_b)) return;
    const std::uint32_t root = root_of(joint);
    if (work.levels[root].level == kSettledLevel) return;
    const JointAxes* axes = work.code == JointCode::kAll ? &work.joints.axes.axes[j] : nullptr;
    const Real after = openness(joint, axes, place_after(joint));
    if (!(after > 1) || !(after > openness(joint, axes, place_before(joint)) + kOpensBy)) return;
    atomic_max(&islands[root].opened, 1U);
  }
  /// Of the root of an island of which a joint was opened.
  PLUMB_HD void choose_again(std::uint32_t i) const {
    IslandEnergy& island = islands[i];
    if (island.root != i || island.opened == 0) return;
    island.again = !tried[i] && may_have_more(i);
    atomic_add(island.again ? &work.counters->bound.opened : &work.counters->bound.still_open, 1U);
  }
  /// Its root is the same in each attempt.
  PLUMB_HD void note_attempt(std::uint32_t i) const {
    if (islands[islands[i].root].again) tried[i] = true;
  }
  PLUMB_HD Real substeps_of(std::uint32_t level) const { return static_cast<Real>(work.substeps->of[level].substeps); }
  /// Sub-steps, of a body's island; what asked for more than it had will not get them by asking again.
  PLUMB_HD bool may_have_more(std::uint32_t body) const {
    const BodyLevel& level = work.levels[body];
    const Real has = substeps_of(level.level);
    return has < substeps_of(work.substeps->count - 1) &&
           !(level.before.load_rate * work.parameters->dt > has * kDenied);
  }
  /// As it was, but that the island of an opened joint asks for other sub-steps.
  PLUMB_HD void put_pace_back(std::uint32_t i) const {
    BodyPace& pace = work.paces[i];
    pace = work.levels[i].before;
    if (!is_pushed(i)) return;
    if (islands[islands[i].root].again)
      pace.load_rate = max(pace.load_rate, kMoreForOpened * substeps_of(work.levels[i].level) / work.parameters->dt);
  }
  PLUMB_HD JointPlace place_after(const Joint& joint) const {
    const Bodies& all = work.joints.view.bodies;
    return place_at(
        joint, [&](std::uint32_t body) -> const Position& { return all.position[body]; },
        [&](std::uint32_t body) -> const Quat& { return all.orientation[body]; });
  }
  PLUMB_HD JointPlace place_before(const Joint& joint) const {
    return place_at(
        joint, [&](std::uint32_t body) -> const Position& { return kept[body].position; },
        [&](std::uint32_t body) -> const Quat& { return kept[body].orientation; });
  }
  template <class PositionOf, class OrientationOf>
  PLUMB_HD static JointPlace place_at(const Joint& joint, const PositionOf& position,
                                      const OrientationOf& orientation) {
    const auto end = [&](std::uint32_t body) -> JointEnd {
      if (body == kWorld) return {{0, 0, 0}, {0, 0, 0, 1}};
      return {{0, 0, 0}, orientation(body)};
    };
    const Position from = joint.body_a == kWorld ? joint.world_anchor : position(joint.body_a);
    return place_joint(joint, between(from, position(joint.body_b)), end(joint.body_a), end(joint.body_b));
  }
  PLUMB_HD bool is_pushed(std::uint32_t body) const {
    return body != kWorld && work.joints.view.bodies.velocity[body].inverse_mass > 0;
  }
  /// It came out not finite, and was left where it was (motion.hpp).
  PLUMB_HD bool is_lost(std::uint32_t body) const {
    const Displacement& moved = work.joints.view.solver.displacement[body];
    return !is_finite(moved.linear) || !is_finite(moved.rotation.w);
  }
  PLUMB_HD std::uint32_t root_of(const Joint& joint) const {
    return islands[is_pushed(joint.body_b) ? joint.body_b : joint.body_a].root;
  }

  PLUMB_HD void join(std::uint32_t a, std::uint32_t b) const {
    if (is_pushed(a) && is_pushed(b))
      unite(EnergyParents{islands}, a, b);
    else if (is_pushed(a))
      note_mover(a, b);
    else if (is_pushed(b))
      note_mover(b, a);
  }
  PLUMB_HD void note_mover(std::uint32_t body, std::uint32_t by) const {
    if (by == kWorld) return;
    const Velocity& velocity = work.joints.view.bodies.velocity[by];
    if (length_squared(velocity.linear) + length_squared(velocity.angular) == 0) return;
    atomic_max(&islands[body].speed, ordered_bits(length(velocity.linear)));
    atomic_max(&islands[body].spin, ordered_bits(length(velocity.angular)));
    atomic_max(&islands[body].mover, by + 1);
  }
  PLUMB_HD void join_contact(std::uint32_t row) const {
    const std::uint32_t candidate = work.cache.candidate[row];
    const Pair pair = work.cache.pairs[candidate];
    const std::uint32_t a = work.proxies.rows[pair.a].body, b = work.proxies.rows[pair.b].body;
    join(a, b);
    if (work.surface_velocities == nullptr) return;
    const ManifoldChange* change = work.changes.find(candidate, PLUMB_MANIFOLD_SURFACE_VELOCITY);
    const Real speed = change != nullptr
                           ? length(change->surface_velocity)
                           : length(work.surface_velocities[pair.a]) + length(work.surface_velocities[pair.b]);
    if (is_pushed(a)) atomic_max(&islands[a].speed, ordered_bits(speed));
    if (is_pushed(b)) atomic_max(&islands[b].speed, ordered_bits(speed));
  }
  PLUMB_HD void join_joint(std::uint32_t j) const {
    const Joint& joint = work.joints.view.joints[j];
    join(joint.body_a, joint.body_b);
  }
  /// What the host moves at a body moves its island.
  PLUMB_HD void find_root(std::uint32_t i) const {
    const std::uint32_t at = impulse::find_root(EnergyParents{islands}, i);
    IslandEnergy& own = islands[i];
    own.root = at;
    if (at == i) return;
    if (own.speed != 0) atomic_max(&islands[at].speed, own.speed);
    if (own.spin != 0) atomic_max(&islands[at].spin, own.spin);
    if (own.mover != 0) atomic_max(&islands[at].mover, own.mover);
  }

  /// A motor gives no more than its force at the speed that it wants; a spring no more than it holds.
  PLUMB_HD void find_given(std::uint32_t j) const {
    const Joint& joint = work.joints.view.joints[j];
    if (is_pushed(joint.body_a) || is_pushed(joint.body_b)) atomic_max(&islands[root_of(joint)].joined, 1U);
    given[j] = 0;
    const int first = rows_of(joint.type);
    if (work.code != JointCode::kAll || first == row_count(joint)) return;
    const JointAxes& axes = work.joints.axes.axes[j];
    const JointReaction& reaction = work.joints.axes.reactions[joint.slot];
    const JointDrive& drive = work.joints.axes.drives[joint.slot];
    RowNumbers places;
    all_errors(joint, axes, place_before(joint), places);
    Real sum = 0;
    for (int i = 0; i < row_count(joint) - first; ++i) {
      const std::uint32_t k = axes.row[i].coordinate;
      if (k == kLocked) continue;
      const Real most = drive.max_force[k] * work.parameters->dt;
      const Real pushed = k < 3 ? length(reaction.force) : length(reaction.torque);
      sum = sum + min(most, pushed) * sqrt(drive.velocity[k] * drive.velocity[k]);
      if (!axes.has_spring(i)) continue;
      const Real off = places[first + i] - drive.rest[k];
      const Real bent = goes_round(axes.row[i].kind) ? wrapped(off) : off;
      sum = sum + axes.spring_unit(i, reaction.spring_mass[first + i]) * axes.stiffness[i] * bent * bent / 2;
    }
    given[j] = sum;
    atomic_max(&islands[root_of(joint)].peak, ordered_bits(sum));
  }

  PLUMB_HD BodyEnergy energy_of(std::uint32_t i) const {
    const Bodies& all = work.joints.view.bodies;
    const BodyMass& mass = all.mass[i];
    PLUMB_ASSERT(kept[i].velocity.inverse_mass > 0);
    const Velocity &before = kept[i].velocity, &after = all.velocity[i];
    const Displacement& moved = work.joints.view.solver.displacement[i];
    const IslandEnergy& island = islands[islands[i].root];
    const Real inertia = Real(1) / before.inverse_mass, dt = work.parameters->dt;
    const Vec weight = (inertia * mass.gravity_scale) * work.parameters->gravity;
    BodyEnergy energy;
    const Real beyond = max(length(moved.linear) / dt - kFreeSpeedOfWay, Real(0));
    energy.kinetic = max(kinetic_energy(mass, after, all.orientation[i]), inertia * beyond * beyond / 2);
    energy.work = dot(weight + all.force[i].force, moved.linear);
    Real driven = number_of(island.speed);
    if (island.mover != 0)
      driven = driven + number_of(island.spin) * length(between(all.position[island.mover - 1], kept[i].position));
    energy.may_have = kinetic_energy(mass, before, kept[i].orientation) + kFreeWay * length(weight) +
                      inertia * (kFreeSpeed * kFreeSpeed / 2 + 2 * driven * driven) +
                      dt * sqrt(length_squared(all.force[i].torque) * length_squared(after.angular));
    return energy;
  }
  PLUMB_HD void find_peak(std::uint32_t i) const {
    if (!is_pushed(i)) return;
    const BodyEnergy energy = energy_of(i);
    const Real largest = max(max(energy.kinetic, energy.may_have), sqrt(energy.work * energy.work));
    atomic_max(&islands[islands[i].root].peak, is_lost(i) ? kNotFinite : ordered_bits(largest));
  }
  PLUMB_HD void add_body(std::uint32_t i) const {
    if (!is_pushed(i)) return;
    IslandEnergy& island = islands[islands[i].root];
    if (!is_finite_number(island.peak)) return;
    const BodyEnergy energy = energy_of(i);
    const Quanta quanta(island.peak);
    add_whole(&island.kinetic, quanta.of(energy.kinetic));
    add_whole(&island.may_have, quanta.of(energy.may_have));
    add_whole(&island.work, quanta.of(energy.work));
  }
  PLUMB_HD void add_given(std::uint32_t j) const {
    if (!(given[j] > 0)) return;
    IslandEnergy& island = islands[root_of(work.joints.view.joints[j])];
    if (is_finite_number(island.peak)) add_whole(&island.may_have, Quanta(island.peak).of(given[j]));
  }

  /// Of the root of an island.
  PLUMB_HD void judge(std::uint32_t i) const {
    IslandEnergy& island = islands[i];
    if (!is_pushed(i) || island.root != i || island.joined == 0) return;
    const Real gain = gain_of(island);
    if (!(gain > kMostGain)) return;
    island.is_held = gain > kMostGainAtLast;
    island.keeps = island.is_held ? kHeldShare : sqrt(Real(1) / gain);
    atomic_add(&work.counters->bound.gained, 1U);
  }
  /// What an island has over what it may have.
  PLUMB_HD static Real gain_of(const IslandEnergy& island) {
    if (!is_finite_number(island.peak)) return kHuge;
    const double work = static_cast<double>(island.work > 0 ? island.work : 0);
    const double may_have = static_cast<double>(island.may_have) + work;
    return static_cast<Real>(static_cast<double>(island.kinetic) / max(may_have, 1.0));
  }

  /// Of a body, to where it was before the step.
  PLUMB_HD void put_back(std::uint32_t i) const {
    if ((work.bodies.mass[i].flags & kBodyMoves) != 0)
      put_state(work.bodies, work.joints.view, i, kept[i], {{0, 0, 0}, 0, {0, 0, 0, 1}});
  }
  /// Of a body whose island gained.
  PLUMB_HD void take_gain_out(std::uint32_t i) const {
    const IslandEnergy& island = islands[islands[i].root];
    if (!is_pushed(i) || !(island.keeps < 1)) return;
    if (island.is_held) put_back(i);
    Velocity& velocity = work.bodies.velocity[i];
    velocity.linear = island.keeps * velocity.linear;
    velocity.angular = island.keeps * velocity.angular;
  }
  PLUMB_HD void put_joint_back(std::uint32_t j, bool all_is) const {
    const Joint& joint = work.joints.view.joints[j];
    JointImpulse& impulse = work.joints.view.impulses[joint.slot];
    if (!all_is) {
      if (!islands[root_of(joint)].is_held) return;
      for (int i = 0; i < kJointRows; ++i) impulse.along[i] = kHeldShare * kept_joints[j].impulse.along[i];
      if (work.code == JointCode::kAll) work.joints.axes.reactions[joint.slot].way = kept_joints[j].way;
      return;
    }
    impulse = kept_joints[j].impulse;
    if (work.code != JointCode::kAll) return;
    work.joints.axes.reactions[joint.slot].way = kept_joints[j].way;
    work.joints.axes.reactions[joint.slot].force = kept_joints[j].force;
    work.joints.axes.reactions[joint.slot].torque = kept_joints[j].torque;
    const std::uint32_t let_go = predicts() && j >= work.joints.system.base ? work.joints.axes.work[j].let_go : 0;
    for (int i = 0; i < kJointRows; ++i)
      work.joints.axes.reactions[joint.slot].held_for[i] =
          (let_go >> i & 1U) != 0 ? Real(0) : kept_joints[j].held_for[i];
  }
};

}  // namespace

void EnergyBound::keep(Executor& executor, const EnergyWork& work) {
  executor.run(max(work.body_count, work.joints.count), Keep{work, bodies_.data(), joints_.data()});
}

void EnergyBound::judge(Executor& executor, const EnergyWork& work, Count contacts) {
  executor.team(contacts, work.body_count,
                JudgeEnergy{work,
                            bodies_.data(),
                            joints_.data(),
                            islands_.data(),
                            given_.data(),
                            {settled_bodies_.data(), settled_joints_.data(), settled_contacts_.data()},
                            tried_.data()});
}

}  // namespace plumb::impulse
