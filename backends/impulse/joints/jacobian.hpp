// The rows of a joint as it is solved: J, and what impulses along them do to the two bodies. A CPU has the rows as
// lanes where they meet velocities, and each by itself as a row of velocities where it pushes; a thread of a GPU goes
// through them one by one. Sums go in the same order on both.
#pragma once

#include "joints/joint_block.hpp"
#include "math/lane_vectors.hpp"

namespace plumb::impulse {

/// I^-1 in world axes, and the sum of the inverse masses, of the bodies of a joint.
struct JointMass {
  Sym inertia_a, inertia_b;
  Real inverse_mass;
};

#if defined(PLUMB_IMPULSE_CUDA)

struct Jacobian {
  JointRow row[kJointRows];
  Vec turn_of_a[kJointRows], turn_of_b[kJointRows];

  PLUMB_HD const Vec& direction(int i) const { return row[i].direction; }
  PLUMB_HD const Vec& on_a(int i) const { return row[i].on_a; }
  PLUMB_HD const Vec& on_b(int i) const { return row[i].on_b; }
  /// What a unit impulse along a row does to the angular velocities.
  PLUMB_HD const Vec& turn_a(int i) const { return turn_of_a[i]; }
  PLUMB_HD const Vec& turn_b(int i) const { return turn_of_b[i]; }
};

/// The n rows that make(rows) makes, and K.
template <class Make>
PLUMB_HD void put_rows(Jacobian& rows, int n, const JointMass& mass, JointMatrix& mobility, const Make& make) {
  make(rows.row);
  for (int i = 0; i < n; ++i) {
    rows.turn_of_a[i] = mass.inertia_a * rows.on_a(i);
    rows.turn_of_b[i] = mass.inertia_b * rows.on_b(i);
    for (int k = 0; k <= i; ++k)
      mobility(i, k) = mass.inverse_mass * dot(rows.direction(i), rows.direction(k)) +
                       dot(rows.turn_a(i), rows.on_a(k)) + dot(rows.turn_b(i), rows.on_b(k));
  }
}

/// Speeds along n rows.
PLUMB_HD inline void speeds_along(const Jacobian& rows, int n, const Velocity& a, const Velocity& b,
                                  RowNumbers& speed) {
  for (int i = 0; i < n; ++i)
    speed[i] =
        dot(rows.direction(i), b.linear - a.linear) + dot(rows.on_a(i), a.angular) + dot(rows.on_b(i), b.angular);
}

/// Impulses along n rows push one of the bodies.
PLUMB_HD inline void push_along(const Jacobian& rows, int n, bool is_b, const Real* impulse, Velocity& body) {
  for (int i = 0; i < n; ++i) {
    const Real along = body.inverse_mass * impulse[i];
    body.linear += (is_b ? along : -along) * rows.direction(i);
    body.angular += impulse[i] * (is_b ? rows.turn_b(i) : rows.turn_a(i));
  }
}

#else

/// A vector of each row.
struct VectorOfRows {
  RowNumbers x, y, z;

  [[nodiscard]] Vec3<Lanes> lanes() const { return {load_row(x), load_row(y), load_row(z)}; }
  void put(const Vec3<Lanes>& v) {
    store_row(x, v.x);
    store_row(y, v.y);
    store_row(z, v.z);
  }
  [[nodiscard]] Vec operator[](int i) const { return {x[i], y[i], z[i]}; }
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

  [[nodiscard]] const Vec& direction(int i) const { return push_b[i].direction; }
  [[nodiscard]] Vec on_a(int i) const { return on_a_of[i]; }
  [[nodiscard]] Vec on_b(int i) const { return on_b_of[i]; }
  /// What a unit impulse along a row does to the angular velocities.
  [[nodiscard]] const Vec& turn_a(int i) const { return push_a[i].turn; }
  [[nodiscard]] const Vec& turn_b(int i) const { return push_b[i].turn; }
};

inline Sym33<Lanes> in_all_lanes(const Sym& s) {
  return {Lanes(s.xx), Lanes(s.yy), Lanes(s.zz), Lanes(s.xy), Lanes(s.xz), Lanes(s.yz)};
}
inline void put_pushes(const Vec3<Lanes>& direction, const Vec3<Lanes>& turn, RowPush (&pushes)[kJointRows]) {
  const Lanes numbers[kLanes] = {direction.x, direction.y, direction.z, Lanes(0), turn.x, turn.y, turn.z, Lanes(0)};
  Lanes rows[kLanes];
  transpose(numbers, rows);
  for (int i = 0; i < kJointRows; ++i) store_row(pushes[i], rows[i]);
}

/// Likewise vectors.
template <class Of>
[[gnu::always_inline]] inline Vec3<Lanes> vectors_of_rows(const Of& of) {
  return {lanes_of_rows([&](int i) { return of(i).x; }), lanes_of_rows([&](int i) { return of(i).y; }),
          lanes_of_rows([&](int i) { return of(i).z; })};
}

/// The n rows that make(rows) makes, and K.
template <class Make>
void put_rows(Jacobian& rows, int n, const JointMass& mass, JointMatrix& mobility, const Make& make) {
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
    store_row(mobility.at[k], Lanes(mass.inverse_mass) * dot(direction, in_all_lanes(made[k].direction)) +
                                  dot(turn_a, in_all_lanes(made[k].on_a)) + dot(turn_b, in_all_lanes(made[k].on_b)));
}

/// Speeds along the rows.
inline Lanes speeds_along(const Jacobian& rows, const Velocity& a, const Velocity& b) {
  return dot(rows.direction_of.lanes(), in_all_lanes(b.linear - a.linear)) +
         dot(rows.on_a_of.lanes(), in_all_lanes(a.angular)) + dot(rows.on_b_of.lanes(), in_all_lanes(b.angular));
}
inline void speeds_along(const Jacobian& rows, int /*n*/, const Velocity& a, const Velocity& b, RowNumbers& speed) {
  store_row(speed, speeds_along(rows, a, b));
}

/// Impulses along n rows push one of the bodies. Nothing else of its row changes, whatever they are.
inline void push_along(const Jacobian& rows, int n, bool is_b, const Real* impulse, Velocity& body) {
  const Real along = is_b ? body.inverse_mass : -body.inverse_mass;
  const Lanes share(Lanes::Vector{along, along, along, along, 1, 1, 1, 1}), before = load_row(body);
  const RowPush* push = is_b ? rows.push_b : rows.push_a;
  Lanes sum = before;
  for (int i = 0; i < n; ++i) sum = sum + (share * Lanes(impulse[i])) * load_row(push[i]);
  store_row(body, Lanes(__builtin_shufflevector(sum.v, before.v, 0, 1, 2, 11, 4, 5, 6, 15)));
}

#endif

}  // namespace plumb::impulse
