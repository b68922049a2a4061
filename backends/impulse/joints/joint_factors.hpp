// The factors L D of the joints' matrix, column by column: what the joints of a mechanism are to each other.
#pragma once

#include "joints/joint_matrix.hpp"

namespace plumb::impulse {

/// Bits: all rows of a joint.
inline constexpr std::uint32_t kAllRows = (1U << kJointRows) - 1;

/// How the rows of joint i and those of joint j (columns) move each other through the bodies that they share: f(body,
/// whether it is b of i, whether it is b of j).
template <class F>
PLUMB_HD void for_shared_bodies(const Joint& i, const Joint& j, const F& f) {
  if (i.body_a == j.body_a) f(i.body_a, false, false);
  if (i.body_a == j.body_b) f(i.body_a, false, true);
  if (i.body_b == j.body_a) f(i.body_b, true, false);
  if (i.body_b == j.body_b) f(i.body_b, true, true);
}

/// The rows of a joint as those of others see them.
struct CouplingRows {
  const Jacobian& rows;
  std::uint32_t active;  ///< bits
};

/// Speeds of the rows of joint i for unit impulses along those of joint j; 0 where either is not active.
PLUMB_HD inline void couple(const JointSystem& system, std::uint32_t i, std::uint32_t active, std::uint32_t j,
                            const CouplingRows& of_j, BlockAtWork& block) {
  const Jacobian& of_i = system.work(i).rows;
  const Vec3<Lanes> direction = of_i.direction_of.lanes();
  const int n = system.rows(j);
  count_rows(kJointRows, [&](int q) { put_column(block, q, Lanes(0)); });
  for_shared_bodies(
      system.view.joints[system.base + i], system.view.joints[system.base + j],
      [&](std::uint32_t body, bool b_of_i, bool b_of_j) {
        const Real inverse_mass = system.view.inverse_mass(body);
        const Vec3<Lanes> on = (b_of_i ? of_i.on_b_of : of_i.on_a_of).lanes();
        const RowPush* pushes = b_of_j ? of_j.rows.push_b : of_j.rows.push_a;
        count_rows(n, [&](int q) {
          const Lanes along = Lanes(inverse_mass) * dot(direction, in_all_lanes(pushes[q].direction));
          put_column(block, q,
                     column_of(block, q) + (b_of_i == b_of_j ? along : -along) + dot(on, in_all_lanes(pushes[q].turn)));
        });
      });
  if (active == kAllRows && of_j.active == kAllRows) return;
  const Mask is_active = lanes_of(active);
  count_rows(n, [&](int q) {
    const bool both = (of_j.active >> q & 1U) != 0;
    put_column(block, q, both ? select(is_active, column_of(block, q), Lanes(0)) : Lanes(0));
  });
}

/// Takes the column's products off it and factors it. diagonal: its own block. active(i): bits of the rows of joint i
/// that are.
template <class Active>
PLUMB_HD void eliminate_column(const JointSystem& system, std::uint32_t j, BlockAtWork& diagonal,
                               const Active& active) {
  const int n = system.rows(j);
  for (std::uint32_t r = system.row_first[j]; r < system.row_first[j + 1]; ++r) {
    const std::uint32_t e = system.row_entries[r];
    take_product(diagonal, n, system.scaled[e], system.whole[e], system.rows(system.entries[e].column));
  }
  JointMatrix& factors = system.work(j).factor;
  factor(diagonal, n);
  copy_columns(diagonal, n, factors);
  lanes_meet();
  const CouplingRows of_j = {system.work(j).rows, active(j)};
  for (std::uint32_t e = system.column_first[j]; e < system.column_first[j + 1]; ++e) {
    const std::uint32_t i = system.entries[e].row;
    PLUMB_ASSERT(i > j && system.entries[e].column == j);
    BlockAtWork block;
    couple(system, i, active(i), j, of_j, block);
    for (std::uint32_t t = system.product_first[e]; t < system.product_first[e + 1]; ++t) {
      const JointProduct product = system.products[t];
      take_product(block, n, system.scaled[product.left], system.whole[product.right],
                   system.rows(system.entries[product.left].column));
    }
    copy_columns(block, n, system.whole[e]);
    solve_rows(factors, n, block, system.turned[e]);
    copy_columns(block, n, system.scaled[e]);
  }
}

}  // namespace plumb::impulse
