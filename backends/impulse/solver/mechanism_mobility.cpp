#include "solver/mechanism_mobility.hpp"

#include "joints/mechanisms.hpp"
#include "math/lane_vectors.hpp"

namespace plumb::impulse {

namespace {

/// Axes along which and about which a thread finds responses at once: a CPU's all six, as lanes.
constexpr std::uint32_t kAxesAtOnce = kLanes == 1 ? 1 : 6;

/// The response of one mechanism to unit wrenches on one body: along an axis for axis < 3, else about one.
struct UnitWrench {
  static constexpr std::uint32_t kThreads = 6 / kAxesAtOnce;  // a body

  JointSystem system;
  Mechanisms mechanisms;
  Real* scratch;
  const StepParameters* parameters;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t place = i / kThreads;
    const MechanismBody& body = mechanisms.bodies[place];
    if (body.count == 0 || mechanisms.loads[place].touched == 0) return;
    find(body, place, i % kThreads);
  }

 private:
  /// The impulse of row p of a joint, y, while it is found. By row, and the axes within.
  PLUMB_HD Real* impulse(const MechanismBody& body, std::uint32_t axis, std::uint32_t column, int p) const {
    const std::uint64_t row = std::uint64_t{column - body.first_column} * kJointRows + static_cast<std::uint32_t>(p);
    return scratch + body.scratch + row * kLaneGroup + axis;
  }
  PLUMB_HD Lanes get(const MechanismBody& body, std::uint32_t axis, std::uint32_t column, int p) const {
    Lanes y;
    __builtin_memcpy(&y, impulse(body, axis, column, p), sizeof y);
    return y;
  }
  PLUMB_HD void put(const MechanismBody& body, std::uint32_t axis, std::uint32_t column, int p, const Lanes& y) const {
    __builtin_memcpy(impulse(body, axis, column, p), &y, sizeof y);
  }

  /// axis: the first of those that are found at once.
  PLUMB_HD void find(const MechanismBody& body, std::uint32_t place, std::uint32_t axis) const {
    const std::uint32_t first = body.first_column, end = first + body.column_count;
    for (std::uint32_t c = first; c < end; ++c)
      for (int p = 0; p < kJointRows; ++p) put(body, axis, c, p, Lanes(0));
    start(body, place, axis);
    for (std::uint32_t c = first; c < end; ++c) forward(body, axis, c);
    for (std::uint32_t c = end; c-- > first;) backward(body, axis, c);
    for (std::uint32_t j = body.first; j < body.first + body.count; ++j) move(body, place, axis, j);
  }

  /// What the wrench alone would do to the joints of its body, with the other sign.
  PLUMB_HD void start(const MechanismBody& body, std::uint32_t place, std::uint32_t axis) const {
    const Real inverse_mass = system.view.inverse_mass(body.body);
    for (std::uint32_t k = system.body_first[place]; k < system.body_first[place + 1]; ++k) {
      const JointOnBody on = system.on_body[k];
      const JointWork& work = system.view.work[on.joint];
      const std::uint32_t column = on.joint - system.base;
      for (int p = 0; p < system.rows(column); ++p) {
        Lanes given(0);
        for (std::uint32_t lane = 0; lane < kAxesAtOnce; ++lane) {
          const int of = static_cast<int>((axis + lane) % 3);
          const Real along = inverse_mass * work.rows.direction(p)[of];
          const Vec& turn = on.is_b ? work.rows.turn_b(p) : work.rows.turn_a(p);
          lane_of(given, lane) = axis + lane < 3 ? (on.is_b ? along : -along) : turn[of];
        }
        put(body, axis, column, p, get(body, axis, column, p) - given);
      }
    }
  }

  PLUMB_HD void forward(const MechanismBody& body, std::uint32_t axis, std::uint32_t column) const {
    for (std::uint32_t r = system.row_first[column]; r < system.row_first[column + 1]; ++r) {
      const std::uint32_t e = system.row_entries[r];
      const std::uint32_t earlier = system.entries[e].column;
      for (int p = 0; p < system.rows(column); ++p) {
        Lanes y = get(body, axis, column, p);
        for (int q = 0; q < system.rows(earlier); ++q)
          y = y - Lanes(system.scaled[e](p, q)) * get(body, axis, earlier, q);
        put(body, axis, column, p, y);
      }
    }
  }

  PLUMB_HD void backward(const MechanismBody& body, std::uint32_t axis, std::uint32_t column) const {
    const int n = system.rows(column);
    Lanes z[kJointRows];
    for (int q = 0; q < n; ++q) z[q] = get(body, axis, column, q);
    solve_factored(system.work(column).factor, n, z);
    for (std::uint32_t e = system.column_first[column]; e < system.column_first[column + 1]; ++e) {
      const std::uint32_t later = system.entries[e].row;
      for (int p = 0; p < system.rows(later); ++p) {
        const Lanes from = get(body, axis, later, p);
        for (int q = 0; q < n; ++q) z[q] = z[q] - Lanes(system.scaled[e](p, q)) * from;
      }
    }
    for (int q = 0; q < n; ++q) put(body, axis, column, q, z[q]);
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

  /// What the wrench alone does to its body.
  PLUMB_HD void move_own(std::uint32_t place, std::uint32_t axis, Vec3<Lanes>& linear, Vec3<Lanes>& angular) const {
    const std::uint32_t moves = mechanisms.bodies[place].body;
    const Real own = Real(1) + turned_free(place);
    for (std::uint32_t lane = 0; lane < kAxesAtOnce; ++lane) {
      Vec unit = {0, 0, 0};
      unit[static_cast<int>((axis + lane) % 3)] = own;
      if (axis + lane < 3)
        put_lane(linear, lane, system.view.inverse_mass(moves) * unit);
      else
        put_lane(angular, lane, system.view.solver.inertia[moves].inverse * unit);
    }
  }

  /// What wrench and impulses do to the body at place j.
  PLUMB_HD void move(const MechanismBody& body, std::uint32_t place, std::uint32_t axis, std::uint32_t j) const {
    const Real inverse_mass = system.view.inverse_mass(mechanisms.bodies[j].body);
    Vec3<Lanes> linear = in_all_lanes(Vec{0, 0, 0}), angular = linear;
    if (j == place) move_own(place, axis, linear, angular);
    for (std::uint32_t k = system.body_first[j]; k < system.body_first[j + 1]; ++k) {
      const JointOnBody on = system.on_body[k];
      const JointWork& work = system.view.work[on.joint];
      const std::uint32_t column = on.joint - system.base;
      for (int p = 0; p < system.rows(column); ++p) {
        const Lanes z = get(body, axis, column, p), along = Lanes(inverse_mass) * z;
        linear += (on.is_b ? along : -along) * in_all_lanes(work.rows.direction(p));
        angular += z * in_all_lanes(on.is_b ? work.rows.turn_b(p) : work.rows.turn_a(p));
      }
    }
    put_response(linear, angular, axis,
                 mechanisms.mobility + body.mobility + std::uint64_t{j - body.first} * kMobilityNumbers);
  }
#if defined(PLUMB_IMPULSE_CUDA)
  PLUMB_HD static void put_response(const Vec& linear, const Vec& angular, std::uint32_t axis, Real* response) {
    for (std::uint32_t r = 0; r < 3; ++r) {
      response[6 * r + axis] = linear[static_cast<int>(r)];
      response[6 * (r + 3) + axis] = angular[static_cast<int>(r)];
    }
  }
#else
  static void put_response(const Vec3<Lanes>& linear, const Vec3<Lanes>& angular, std::uint32_t /*axis*/,
                           Real* response) {
    const Lanes rows[kLanes] = {linear.x, linear.y, linear.z, Lanes(0), angular.x, angular.y, angular.z, Lanes(0)};
    Lanes columns[kLanes];
    transpose(rows, columns);
    for (std::uint32_t c = 0; c < kAxesAtOnce; ++c)
      store_row(reinterpret_cast<Real(&)[kLanes]>(response[c * kLanes]), columns[c]);
  }
#endif
};

/// All of it, for a team. Rows that need not hold count where that is predicted.
template <JointCode kJoints>
struct FindMobility : MobilityWork {
  PLUMB_DEVICE void operator()(Team& team) const {
    const FindMobility self = *this;
    team.each(mechanisms.count, [self](std::uint32_t place) { self.mechanisms.begin_step(place); });
    team.each(counters->manifolds, [self](std::uint32_t row) {
      const Pair pair = self.cache.pairs[self.cache.candidate[row]];
      self.note_contact(self.proxies[pair.a].body);
      self.note_contact(self.proxies[pair.b].body);
    });
    team.each(mechanisms.count, [self](std::uint32_t place) { self.stiffen(place); });
    for_mechanisms(team, joints.system, [this](Team& own, const SystemMechanism& mechanism) {
      if (joints.system.level(mechanism) == kSettledLevel) return;
      if (joints.system.is_touched(mechanism))
        factor(own, mechanism);
      else
        make_rows(own, mechanism);
    });
    team.each(UnitWrench::kThreads * mechanisms.count, UnitWrench{joints.system, mechanisms, scratch, parameters});
  }

 private:
  PLUMB_HD void note_contact(std::uint32_t body) const {
    if (joints.view.solver.levels(body) != kSettledLevel) mechanisms.note_contact(body);
  }
  /// What tension asks of a body holds for contacts, too.
  PLUMB_HD void stiffen(std::uint32_t place) const {
    const JointView& view = joints.view;
    const std::uint32_t body = joints.system.bodies[place];
    view.keep_swing(body);
    view.solver.inertia[body].inverse = view.inverse_inertia(body, view.bodies.orientation[body]);
  }
  /// What touches nothing needs no more than rows where its bodies are: tension is looked for along them.
  PLUMB_DEVICE void make_rows(Team& team, const SystemMechanism& mechanism) const {
    const JointSystem& system = joints.system;
    const auto view = view_of<kJoints>(joints);
    for_columns(team, mechanism, [&](std::uint32_t column) {
      refresh_rows(mechanism, view, system.base + column);
      if constexpr (kJoints == JointCode::kAll) predict_rows(view, system.base + column, false, parameters->is_repeat);
    });
  }
  PLUMB_DEVICE void factor(Team& team, const SystemMechanism& mechanism) const {
    const JointSystem& system = joints.system;
    const Real h = levels->of[system.level(mechanism)].h;
    const auto view = view_of<kJoints>(joints);
    for_columns(team, mechanism, [&](std::uint32_t column) {
      const std::uint32_t j = system.base + column;
      refresh_rows(mechanism, view, j);
      choose_share(view, j, h);
      if constexpr (kJoints == JointCode::kAll) {
        predict_rows(view, j, true, parameters->is_repeat);
        if (!mechanism.is_plain) choose_rows_met(view, j);
      }
    });
    if (mechanism.is_plain) return factor_system(team, system, mechanism);
    if constexpr (kJoints == JointCode::kAll) factor_axis_system(team, system, mechanism, view);
  }
};

}  // namespace

void enqueue_mobility(Executor& executor, JointCode joints, const MobilityWork& work, Count contacts) {
  const std::uint32_t least = UnitWrench::kThreads * work.mechanisms.count;
  if (joints == JointCode::kAll)
    executor.team(contacts, least, FindMobility<JointCode::kAll>{work});
  else
    executor.team(contacts, least, FindMobility<JointCode::kPlain>{work});
}

}  // namespace plumb::impulse
