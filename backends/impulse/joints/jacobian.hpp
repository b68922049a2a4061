// The rows of a joint as it is solved: J, and what impulses along them do to the two bodies: the rows as lanes where
// they meet velocities, and each by itself as a row of velocities where it pushes.
#pragma once

#include "joints/joint_block.hpp"

namespace plumb::impulse {

/// I^-1 in world axes, and the sum of the inverse masses, of the bodies of a joint.
struct JointMass {
  Sym inertia_a, inertia_b;
  Real inverse_mass;
};

/// A vector of each row.
struct VectorOfRows {
  RowNumbers x, y, z;

  [[nodiscard]] PLUMB_HD Vec3<Lanes> lanes() const { return {load_row(x), load_row(y), load_row(z)}; }
  PLUMB_HD void put(const Vec3<Lanes>& v) {
    store_row(x, v.x);
    store_row(y, v.y);
    store_row(z, v.z);
  }
  [[nodiscard]] PLUMB_HD Vec operator[](int i) const { return {x[i], y[i], z[i]}; }
};

/// What a unit impulse along a row does to a body: its direction, and the change of the angular velocity.
struct alignas(4 * sizeof(Real)) RowPush {
  Vec direction;
  Real unused0;
  Vec turn;
  Real unused1;
};

struct Jacobian {
  VectorOfRows direction_of, on_a_of, on_b_of;  ///< 0 of rows that there are not
  RowPush push_a[kJointRows], push_b[kJointRows];

  [[nodiscard]] PLUMB_HD const Vec& direction(int i) const { return push_b[i].direction; }
  [[nodiscard]] PLUMB_HD Vec on_a(int i) const { return on_a_of[i]; }
  [[nodiscard]] PLUMB_HD Vec on_b(int i) const { return on_b_of[i]; }
  /// What a unit impulse along a row does to the angular velocities.
  [[nodiscard]] PLUMB_HD const Vec& turn_a(int i) const { return push_a[i].turn; }
  [[nodiscard]] PLUMB_HD const Vec& turn_b(int i) const { return push_b[i].turn; }
};

PLUMB_HD inline Sym33<Lanes> in_all_lanes(const Sym& s) {
  return {Lanes(s.xx), Lanes(s.yy), Lanes(s.zz), Lanes(s.xy), Lanes(s.xz), Lanes(s.yz)};
}
PLUMB_HD inline void put_pushes(const Vec3<Lanes>& direction, const Vec3<Lanes>& turn, RowPush (&pushes)[kJointRows]) {
  const Lanes numbers[kLaneGroup] = {direction.x, direction.y, direction.z, Lanes(0), turn.x, turn.y, turn.z, Lanes(0)};
  store_turned(numbers, pushes);
}

/// Likewise vectors.
template <class Of>
PLUMB_INLINE inline Vec3<Lanes> vectors_of_rows(const Of& of) {
  return {lanes_of_rows([&](int i) { return of(i).x; }), lanes_of_rows([&](int i) { return of(i).y; }),
          lanes_of_rows([&](int i) { return of(i).z; })};
}

/// The n rows that make(rows) makes, and K.
template <class Make>
PLUMB_HD void put_rows(Jacobian& rows, int n, const JointMass& mass, JointMatrix& mobility, const Make& make) {
  JointRow made[kJointRows] = {};
  make(made);
  const Vec3<Lanes> direction = vectors_of_rows([&](int i) -> const Vec& { return made[i].direction; });
  const Vec3<Lanes> on_a = vectors_of_rows([&](int i) -> const Vec& { return made[i].on_a; });
  const Vec3<Lanes> on_b = vectors_of_rows([&](int i) -> const Vec& { return made[i].on_b; });
  rows.direction_of.put(direction);
  rows.on_a_of.put(on_a);
  rows.on_b_of.put(on_b);
  const Vec3<Lanes> turn_a = in_all_lanes(mass.inertia_a) * on_a, turn_b = in_all_lanes(mass.inertia_b) * on_b;
  put_pushes(direction, turn_a, rows.push_a);
  put_pushes(direction, turn_b, rows.push_b);
  for (int k = 0; k < n; ++k)
    put_column(mobility, k,
               Lanes(mass.inverse_mass) * dot(direction, in_all_lanes(made[k].direction)) +
                   dot(turn_a, in_all_lanes(made[k].on_a)) + dot(turn_b, in_all_lanes(made[k].on_b)));
  lanes_meet();
}

/// Speeds along the rows.
PLUMB_HD inline Lanes speeds_along(const Jacobian& rows, const Velocity& a, const Velocity& b) {
  return dot(rows.direction_of.lanes(), in_all_lanes(b.linear - a.linear)) +
         dot(rows.on_a_of.lanes(), in_all_lanes(a.angular)) + dot(rows.on_b_of.lanes(), in_all_lanes(b.angular));
}

/// The numbers of a body's velocity, as lanes, with what impulses along n rows give it.
PLUMB_HD inline Lanes pushed_along(const Jacobian& rows, int n, bool is_b, Real inverse_mass, const Real* impulse,
                                   Lanes velocity) {
  constexpr std::uint32_t kLinear = 0b00001111;
  const Lanes share = select(lanes_of(kLinear), Lanes(is_b ? inverse_mass : -inverse_mass), Lanes(1));
  const RowPush* push = is_b ? rows.push_b : rows.push_a;
  for (int i = 0; i < n; ++i) velocity = velocity + (share * Lanes(impulse[i])) * load_row(push[i]);
  return velocity;
}
/// Bits: the lanes of a velocity that are its own.
constexpr std::uint32_t kVelocityLanes = 0b01110111;
/// Those that are no velocity as they were.
PLUMB_HD inline Lanes only_velocity(const Lanes& now, const Lanes& before) {
  return select(lanes_of(kVelocityLanes), now, before);
}

/// Impulses along n rows push one of the bodies. Nothing else of its row changes, whatever they are.
PLUMB_HD inline void push_along(const Jacobian& rows, int n, bool is_b, const Real* impulse, Velocity& body) {
#if defined(PLUMB_IMPULSE_CUDA)
  const RowPush* push = is_b ? rows.push_b : rows.push_a;
  for (int i = 0; i < n; ++i) {
    const Real along = body.inverse_mass * impulse[i];
    body.linear += (is_b ? along : -along) * push[i].direction;
    body.angular += impulse[i] * push[i].turn;
  }
#else
  const Lanes before = load_row(body);
  store_row(body, only_velocity(pushed_along(rows, n, is_b, body.inverse_mass, impulse, before), before));
#endif
}

}  // namespace plumb::impulse
