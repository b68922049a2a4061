// The factors L D of the joints' matrix, column by column: what the joints of a mechanism are to each other.
#pragma once

#include "joints/joint_matrix.hpp"
#include "math/lane_vectors.hpp"

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
  const JointWork& work;
  std::uint32_t active;  ///< bits

  PLUMB_HD CouplingRows(const JointWork& of, int /*rows*/, std::uint32_t active_rows) : work(of), active(active_rows) {}
};

/// Speeds of the rows of joint i for unit impulses along those of joint j; 0 where either is not active.
PLUMB_HD inline void couple(const JointSystem& system, std::uint32_t i, std::uint32_t active, std::uint32_t j,
                            const CouplingRows& of_j, JointBlock& block) {
  const Joint &joint_i = system.view.joints[system.base + i], &joint_j = system.view.joints[system.base + j];
  for (int p = 0; p < system.rows(i); ++p)
    for (int q = 0; q < system.rows(j); ++q) {
      const JointRow& row = system.work(i).rows[p];
      Real sum = 0;
      if ((active >> p & 1U) != 0 && (of_j.active >> q & 1U) != 0)
        for_shared_bodies(joint_i, joint_j, [&](std::uint32_t body, bool b_of_i, bool b_of_j) {
          const Real along = system.view.inverse_mass(body) * dot(row.direction, of_j.work.rows[q].direction);
          sum = sum + (b_of_i == b_of_j ? along : -along) +
                dot(b_of_i ? row.on_b : row.on_a, b_of_j ? of_j.work.turn_b[q] : of_j.work.turn_a[q]);
        });
      block(p, q) = sum;
    }
}

#else

/// The rows of a joint as those of others see them, one a lane.
struct CouplingRows {
  Vec3<Lanes> direction = {Lanes(0), Lanes(0), Lanes(0)}, turn_a = direction, turn_b = direction;
  Lanes active = Lanes(0);  ///< 1 or 0

  CouplingRows(const JointWork& of, int rows, std::uint32_t active_rows) {
    for (std::uint32_t q = 0; q < static_cast<std::uint32_t>(rows); ++q) {
      put_lane(direction, q, of.rows[q].direction);
      put_lane(turn_a, q, of.turn_a[q]);
      put_lane(turn_b, q, of.turn_b[q]);
      lane_of(active, q) = static_cast<Real>(active_rows >> q & 1U);
    }
  }
};

/// Speeds of the rows of joint i for unit impulses along those of joint j; 0 where either is not active.
inline void couple(const JointSystem& system, std::uint32_t i, std::uint32_t active, std::uint32_t j,
                   const CouplingRows& of_j, JointBlock& block) {
  const Joint &joint_i = system.view.joints[system.base + i], &joint_j = system.view.joints[system.base + j];
  const Mask is_active = of_j.active > Lanes(0);
  Lanes rows[kLanes], columns[kLanes];
  for (Lanes& row : rows) row = Lanes(0);
  for (int p = 0; p < system.rows(i); ++p) {
    if ((active >> p & 1U) == 0) continue;
    const JointRow& row = system.work(i).rows[p];
    Lanes sum(0);
    for_shared_bodies(joint_i, joint_j, [&](std::uint32_t body, bool b_of_i, bool b_of_j) {
      const Lanes along = Lanes(system.view.inverse_mass(body)) * dot(in_all_lanes(row.direction), of_j.direction);
      sum = sum + (b_of_i == b_of_j ? along : -along) +
            dot(in_all_lanes(b_of_i ? row.on_b : row.on_a), b_of_j ? of_j.turn_b : of_j.turn_a);
    });
    rows[p] = select(is_active, sum, Lanes(0));
  }
  transpose(rows, columns);
  for (int q = 0; q < kJointRows; ++q) store_row(block.at[q], columns[q]);
}

#endif

/// Takes off the diagonal block of column j what earlier columns give.
PLUMB_HD inline void take_earlier_columns(const JointSystem& system, std::uint32_t j, Block& diagonal) {
  const int n = system.rows(j);
  const std::uint32_t first = system.row_first[j], end = system.row_first[j + 1];
  if (first == end) return;
  JointBlock block{};  // by the diagonal's columns, of which only the lower half counts
  for (int p = 0; p < n; ++p)
    for (int q = 0; q <= p; ++q) block(p, q) = diagonal(p, q);
  for (std::uint32_t r = first; r < end; ++r) {
    const std::uint32_t e = system.row_entries[r];
    take_product(block, n, n, system.scaled[e], system.whole[e], system.rows(system.entries[e].column));
  }
  for (int p = 0; p < n; ++p)
    for (int q = 0; q <= p; ++q) diagonal(p, q) = block(p, q);
}

/// Takes the column's products off it and factors it. active(i): bits of the rows of joint i that are.
template <class Active>
PLUMB_HD void eliminate_column(const JointSystem& system, std::uint32_t j, const Active& active) {
  Block& diagonal = system.work(j).factor;
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
    solve_rows(diagonal, n, block, rows);
    system.scaled[e] = block;
  }
}

}  // namespace plumb::impulse
