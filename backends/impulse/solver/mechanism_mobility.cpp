#include "solver/mechanism_mobility.hpp"

#include "joints/axis_mechanisms.hpp"
#include "joints/mechanisms.hpp"

namespace plumb::impulse {

namespace {

/// The response of one mechanism to a unit wrench on one body: along an axis for axis < 3, else about one.
struct UnitWrench {
  JointSystem system;
  Mechanisms mechanisms;
  MechanismColumns columns;
  const StepParameters* parameters;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t place = i / 6;
    const MechanismBody& body = mechanisms.bodies[place];
    if (body.count == 0 || mechanisms.loads[place].touched == 0) return;
    find(body, place, i % 6);
  }

 private:
  /// The impulses of a joint, y, while they are found.
  PLUMB_HD Real* impulses(const MechanismBody& body, std::uint32_t axis, std::uint32_t column) const {
    const std::uint64_t row = std::uint64_t{axis} * body.column_count + columns.number[column];
    return columns.scratch + body.scratch + row * kJointRows;
  }

  PLUMB_HD void find(const MechanismBody& body, std::uint32_t place, std::uint32_t axis) const {
    const std::uint32_t* list = columns.columns + body.first_column;
    for (std::uint32_t c = 0; c < body.column_count; ++c) {
      Real* y = impulses(body, axis, list[c]);
      for (int p = 0; p < kJointRows; ++p) y[p] = 0;
    }
    start(body, place, axis);
    for (std::uint32_t c = 0; c < body.column_count; ++c) forward(body, axis, list[c]);
    for (std::uint32_t c = body.column_count; c-- > 0;) backward(body, axis, list[c]);
    for (std::uint32_t j = body.first; j < body.first + body.count; ++j) move(body, place, axis, j);
  }

  /// What the wrench alone would do to the joints of its body, with the other sign.
  PLUMB_HD void start(const MechanismBody& body, std::uint32_t place, std::uint32_t axis) const {
    const Real inverse_mass = system.view.velocity(body.body).inverse_mass;
    for (std::uint32_t k = system.body_first[place]; k < system.body_first[place + 1]; ++k) {
      const JointOnBody on = system.on_body[k];
      const JointWork& work = system.view.work[on.joint];
      const std::uint32_t column = on.joint - system.base;
      Real* y = impulses(body, axis, column);
      for (int p = 0; p < system.rows(column); ++p) {
        const Real along = inverse_mass * work.rows[p].direction[static_cast<int>(axis % 3)];
        const Vec& turn = on.is_b ? work.turn_b[p] : work.turn_a[p];
        y[p] = y[p] - (axis < 3 ? (on.is_b ? along : -along) : turn[static_cast<int>(axis % 3)]);
      }
    }
  }

  PLUMB_HD void forward(const MechanismBody& body, std::uint32_t axis, std::uint32_t column) const {
    Real* y = impulses(body, axis, column);
    for (std::uint32_t r = system.row_first[column]; r < system.row_first[column + 1]; ++r) {
      const std::uint32_t e = system.row_entries[r];
      const std::uint32_t earlier = system.entries[e].column;
      const Real* from = impulses(body, axis, earlier);
      for (int p = 0; p < system.rows(column); ++p)
        for (int q = 0; q < system.rows(earlier); ++q) y[p] = y[p] - system.scaled[e].at[p][q] * from[q];
    }
  }

  PLUMB_HD void backward(const MechanismBody& body, std::uint32_t axis, std::uint32_t column) const {
    Real* z = impulses(body, axis, column);
    solve_factored(system.work(column).factor, system.rows(column), z);
    for (std::uint32_t e = system.column_first[column]; e < system.column_first[column + 1]; ++e) {
      const std::uint32_t later = system.entries[e].row;
      const Real* from = impulses(body, axis, later);
      for (int p = 0; p < system.rows(later); ++p)
        for (int q = 0; q < system.rows(column); ++q) z[q] = z[q] - system.scaled[e].at[p][q] * from[p];
    }
  }

  /// Of the body's own mobility the share that its mechanism may leave it before the step is over, beyond what it does
  /// now, by the angle by which the arms of its joints, or those of its neighbours, turn: its square, or half of it in
  /// a loop, such as a rope between two hooks, which holds most when it is straight.
  PLUMB_HD Real turned_free(std::uint32_t place) const {
    Real square = 0;
    bool in_ring = false;
    for (std::uint32_t k = system.body_first[place]; k < system.body_first[place + 1]; ++k) {
      const Joint& joint = system.view.joints[system.on_body[k].joint];
      square = max(square, max(turn_of_arm(joint.body_a, joint.frame_a), turn_of_arm(joint.body_b, joint.frame_b)));
      in_ring = in_ring || joint.in_ring;
    }
    return min(in_ring ? max(square, sqrt(square) / 2) : square, Real(1));
  }
  /// Squared.
  PLUMB_HD Real turn_of_arm(std::uint32_t body, const Frame& frame) const {
    if (body == kWorld) return 0;
    const Vec arm = rotate(system.view.end(body).orientation, frame.position);
    const Real length2 = length_squared(arm), step = parameters->dt;
    const Real way2 = length_squared(cross(system.view.velocity(body).angular, arm));
    return length2 > 0 ? step * step * way2 / length2 : Real(0);
  }

  /// What wrench and impulses do to the body at place j.
  PLUMB_HD void move(const MechanismBody& body, std::uint32_t place, std::uint32_t axis, std::uint32_t j) const {
    const std::uint32_t moves = mechanisms.bodies[j].body;
    const Real inverse_mass = system.view.velocity(moves).inverse_mass;
    Vec linear = {0, 0, 0}, angular = {0, 0, 0};
    const Real own = j == place ? Real(1) + turned_free(place) : Real(0);
    if (j == place && axis < 3) linear[static_cast<int>(axis)] = own * inverse_mass;
    if (j == place && axis >= 3) {
      Vec unit = {0, 0, 0};
      unit[static_cast<int>(axis - 3)] = own;
      angular = system.view.solver.inertia[moves].inverse * unit;
    }
    for (std::uint32_t k = system.body_first[j]; k < system.body_first[j + 1]; ++k) {
      const JointOnBody on = system.on_body[k];
      const JointWork& work = system.view.work[on.joint];
      const std::uint32_t column = on.joint - system.base;
      const Real* z = impulses(body, axis, column);
      for (int p = 0; p < system.rows(column); ++p) {
        const Real along = inverse_mass * z[p];
        linear += (on.is_b ? along : -along) * work.rows[p].direction;
        angular += z[p] * (on.is_b ? work.turn_b[p] : work.turn_a[p]);
      }
    }
    Real* to = mechanisms.mobility + body.mobility + std::uint64_t{j - body.first} * 36 + axis;
    for (int r = 0; r < 3; ++r) {
      to[6 * r] = linear[r];
      to[6 * (r + 3)] = angular[r];
    }
  }
};

/// All of it, for a team. kJoints: some rows may not always hold, and do not count.
template <JointCode kJoints>
struct FindMobility : MobilityWork {
  PLUMB_DEVICE void operator()(Team& team) const {
    const FindMobility self = *this;
    team.each(mechanisms.count, [self](std::uint32_t place) { self.mechanisms.loads[place].touched = 0; });
    team.each(counters->manifolds, [self](std::uint32_t row) {
      const Pair pair = self.cache.pairs[self.cache.candidate[row]];
      self.touch(self.proxies[pair.a].body);
      self.touch(self.proxies[pair.b].body);
    });
    team.each(mechanisms.count, [self](std::uint32_t place) { self.stiffen(place); });
    factor(team);
    team.each(6 * mechanisms.count, UnitWrench{joints.system, mechanisms, columns, parameters});
  }

 private:
  PLUMB_HD void touch(std::uint32_t body) const {
    if (mechanisms.hold(body)) mechanisms.loads[mechanisms.place_of[body] - 1].touched = 1;
  }
  /// What tension asks of a body holds for contacts, too.
  PLUMB_HD void stiffen(std::uint32_t place) const {
    const JointView& view = joints.view;
    const std::uint32_t body = joints.system.bodies[place];
    view.solver.inertia[body].inverse = view.inverse_inertia(body, view.bodies.orientation[body]);
  }
  PLUMB_DEVICE void factor(Team& team) const {
    const Real h = parameters->h;
    [[maybe_unused]] const bool predicts = parameters->predicts_rows;
    if constexpr (kJoints == JointCode::kAll) {
      const AxisView view = axis_view(joints);
      const std::uint32_t base = joints.system.base;
      team.each(joints.count - base, [=](std::uint32_t column) {
        const std::uint32_t j = base + column;
        refresh_axis_joint(view, j);
        choose_share(view, j, h);
        predict_rows(view, j, predicts);
        choose_rows_met(view, j);
      });
      factor_axis_system(team, joints.system, view);
    } else {
      const JointView view = joints.view;
      const std::uint32_t base = joints.system.base;
      team.each(joints.count - base, [=](std::uint32_t column) {
        make_joint_rows(view, base + column);
        choose_share(view, base + column, h);
      });
      factor_system(team, joints.system);
    }
  }
};

}  // namespace

void enqueue_mobility(Executor& executor, JointCode joints, const MobilityWork& work, Count contacts) {
  const std::uint32_t least = 6 * work.mechanisms.count;
  if (joints == JointCode::kAll)
    executor.team(contacts, least, FindMobility<JointCode::kAll>{work});
  else
    executor.team(contacts, least, FindMobility<JointCode::kPlain>{work});
}

}  // namespace plumb::impulse
