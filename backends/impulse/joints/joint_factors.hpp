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

#if defined(PLUMB_IMPULSE_CUDA)

/// The rows of a joint as those of others see them.
struct CouplingRows {
  const Jacobian& rows;
  std::uint32_t active;  ///< bits

  PLUMB_HD CouplingRows(const JointWork& of, int /*rows*/, std::uint32_t active_rows)
      : rows(of.rows), active(active_rows) {}
};

/// Speeds of the rows of joint i for unit impulses along those of joint j; 0 where either is not active.
PLUMB_HD inline void couple(const JointSystem& system, std::uint32_t i, std::uint32_t active, std::uint32_t j,
                            const CouplingRows& of_j, JointBlock& block) {
  const Joint &joint_i = system.view.joints[system.base + i], &joint_j = system.view.joints[system.base + j];
  for (int p = 0; p < system.rows(i); ++p)
    for (int q = 0; q < system.rows(j); ++q) {
      const JointRow& row = system.work(i).rows.row[p];
      Real sum = 0;
      if ((active >> p & 1U) != 0 && (of_j.active >> q & 1U) != 0)
        for_shared_bodies(joint_i, joint_j, [&](std::uint32_t body, bool b_of_i, bool b_of_j) {
          const Real along = system.view.inverse_mass(body) * dot(row.direction, of_j.rows.direction(q));
          sum = sum + (b_of_i == b_of_j ? along : -along) +
                dot(b_of_i ? row.on_b : row.on_a, b_of_j ? of_j.rows.turn_b(q) : of_j.rows.turn_a(q));
        });
      block(p, q) = sum;
    }
}

#else

/// The rows of a joint as those of others see them.
struct CouplingRows {
  const Jacobian& rows;
  std::uint32_t active;  ///< bits

  CouplingRows(const JointWork& of, int /*rows*/, std::uint32_t active_rows) : rows(of.rows), active(active_rows) {}
};

/// Speeds of the rows of joint i for unit impulses along those of joint j; 0 where either is not active.
inline void couple(const JointSystem& system, std::uint32_t i, std::uint32_t active, std::uint32_t j,
                   const CouplingRows& of_j, JointBlock& block) {
  const Jacobian& of_i = system.work(i).rows;
  const Vec3<Lanes> direction = of_i.direction_of.lanes();
  const int n = system.rows(j);
  for (Real(&column)[kLaneGroup] : block.at) store_row(column, Lanes(0));
  for_shared_bodies(system.view.joints[system.base + i], system.view.joints[system.base + j],
                    [&](std::uint32_t body, bool b_of_i, bool b_of_j) {
                      const Real inverse_mass = system.view.inverse_mass(body);
                      const Vec3<Lanes> on = (b_of_i ? of_i.on_b_of : of_i.on_a_of).lanes();
                      const RowPush* pushes = b_of_j ? of_j.rows.push_b : of_j.rows.push_a;
                      for (int q = 0; q < n; ++q) {
                        const Lanes along = Lanes(inverse_mass) * dot(direction, in_all_lanes(pushes[q].direction));
                        store_row(block.at[q], column_of(block, q) + (b_of_i == b_of_j ? along : -along) +
                                                   dot(on, in_all_lanes(pushes[q].turn)));
                      }
                    });
  if (active == kAllRows && of_j.active == kAllRows) return;
  const Mask is_active = lanes_of(active);
  for (int q = 0; q < n; ++q)
    store_row(block.at[q], (of_j.active >> q & 1U) != 0 ? select(is_active, column_of(block, q), Lanes(0)) : Lanes(0));
}

#endif

/// Takes off the diagonal block of column j what earlier columns give.
PLUMB_HD inline void take_earlier_columns(const JointSystem& system, std::uint32_t j, JointMatrix& diagonal) {
  const int n = system.rows(j);
  const std::uint32_t first = system.row_first[j], end = system.row_first[j + 1];
  if (first == end) return;
  WholeMatrix block(diagonal, n);
  for (std::uint32_t r = first; r < end; ++r) {
    const std::uint32_t e = system.row_entries[r];
    take_product(block.at, n, n, system.scaled[e], system.whole[e], system.rows(system.entries[e].column));
  }
  block.put(diagonal, n);
}

/// Takes the column's products off it and factors it. active(i): bits of the rows of joint i that are.
template <class Active>
PLUMB_HD void eliminate_column(const JointSystem& system, std::uint32_t j, const Active& active) {
  JointMatrix& diagonal = system.work(j).factor;
  const int n = system.rows(j);
  take_earlier_columns(system, j, diagonal);
  factor(diagonal, n);
  const CouplingRows of_j(system.work(j), n, active(j));
  for (std::uint32_t e = system.column_first[j]; e < system.column_first[j + 1]; ++e) {
    const std::uint32_t i = system.entries[e].row;
    PLUMB_ASSERT(i > j && system.entries[e].column == j);
    const int rows = system.rows(i);
    JointBlock block;
    couple(system, i, active(i), j, of_j, block);
    for (std::uint32_t t = system.product_first[e]; t < system.product_first[e + 1]; ++t) {
      const JointProduct product = system.products[t];
      take_product(block, rows, n, system.scaled[product.left], system.whole[product.right],
                   system.rows(system.entries[product.left].column));
    }
    system.whole[e] = block;
#if defined(PLUMB_IMPULSE_CUDA)
    solve_rows(diagonal, n, block, rows);
#else
    solve_rows(diagonal, n, block, system.turned[e]);
#endif
    system.scaled[e] = block;
  }
}

}  // namespace plumb::impulse
