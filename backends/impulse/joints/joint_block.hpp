// Blocks of the joints' matrix, and the arithmetic of their columns. A CPU works on a column as one vector, whatever
// number of rows it has; a thread of a GPU goes through those that there are. Sums go in the same order on both.
#pragma once

#include "joints/joint_solve.hpp"
#include "math/block.hpp"
#include "math/wide.hpp"

namespace plumb::impulse {

/// A dense block of L, rows of the later joint by columns of the earlier one.
struct JointBlock {
  Real at[kJointRows][kLaneGroup];  ///< by column: its rows, and room up to a whole vector

  PLUMB_HD Real& operator()(int row, int column) { return at[column][row]; }
  PLUMB_HD const Real& operator()(int row, int column) const { return at[column][row]; }
};

#if !defined(PLUMB_IMPULSE_CUDA)

static_assert(kLanes == kLaneGroup);

/// f(n) with a number of rows that the compiler knows, so that columns stay in registers.
template <class F>
void with_rows(int n, const F& f) {
  switch (n) {
    case 1: return f(std::integral_constant<int, 1>{});
    case 2: return f(std::integral_constant<int, 2>{});
    case 3: return f(std::integral_constant<int, 3>{});
    case 4: return f(std::integral_constant<int, 4>{});
    case 5: return f(std::integral_constant<int, 5>{});
    case 6: return f(std::integral_constant<int, 6>{});
    default: return;
  }
  static_assert(kJointRows == 6);
}
inline Lanes column_of(const JointBlock& block, int column) { return load_row(block.at[column]); }

#endif

/// m -= left right^T, for `inner` columns.
PLUMB_HD inline void take_product(JointBlock& m, [[maybe_unused]] int rows, int columns, const JointBlock& left,
                                  const JointBlock& right, int inner) {
#if defined(PLUMB_IMPULSE_CUDA)
  for (int p = 0; p < rows; ++p)
    for (int q = 0; q < columns; ++q)
      for (int r = 0; r < inner; ++r) m(p, q) = m(p, q) - left(p, r) * right(q, r);
#else
  with_rows(inner, [&](auto count) {
    constexpr int kCount = count;
    Lanes of_left[kCount];
    PLUMB_UNROLL
    for (int r = 0; r < kCount; ++r) of_left[r] = column_of(left, r);
    for (int q = 0; q < columns; ++q) {
      Lanes column = column_of(m, q);
      PLUMB_UNROLL
      for (int r = 0; r < kCount; ++r) column = column - of_left[r] * Lanes(right(q, r));
      store_row(m.at[q], column);
    }
  });
#endif
}

/// y -= m x, for the first `columns` numbers of x.
PLUMB_HD inline void take_product(Real (&y)[kJointRows], int rows, const JointBlock& m, const Real (&x)[kJointRows],
                                  int columns) {
#if defined(PLUMB_IMPULSE_CUDA)
  for (int p = 0; p < rows; ++p)
    for (int q = 0; q < columns; ++q) y[p] = y[p] - m(p, q) * x[q];
#else
  Lanes sum(0);
  for (int p = 0; p < rows; ++p) lane_of(sum, static_cast<std::uint32_t>(p)) = y[p];
  for (int q = 0; q < columns; ++q) sum = sum - column_of(m, q) * Lanes(x[q]);
  for (int p = 0; p < rows; ++p) y[p] = lane_of(sum, static_cast<std::uint32_t>(p));
#endif
}

/// Each row of m becomes the solution of (L D L^T) y = row, of n columns.
PLUMB_HD inline void solve_rows(const Block& factors, int n, JointBlock& m, [[maybe_unused]] int rows) {
#if defined(PLUMB_IMPULSE_CUDA)
  for (int p = 0; p < rows; ++p) {
    Real row[kJointRows];
    for (int q = 0; q < n; ++q) row[q] = m(p, q);
    solve_factored(factors, n, row);
    for (int q = 0; q < n; ++q) m(p, q) = row[q];
  }
#else
  with_rows(n, [&](auto count) {
    constexpr int kCount = count;
    Lanes x[kCount];
    PLUMB_UNROLL
    for (int i = 0; i < kCount; ++i) x[i] = column_of(m, i);
    PLUMB_UNROLL
    for (int i = 0; i < kCount; ++i) PLUMB_UNROLL
    for (int k = 0; k < i; ++k) x[i] = x[i] - Lanes(factors(i, k)) * x[k];
    PLUMB_UNROLL
    for (int i = 0; i < kCount; ++i) x[i] = Lanes(factors(i, i)) * x[i];
    PLUMB_UNROLL
    for (int i = kCount - 1; i >= 0; --i) PLUMB_UNROLL
    for (int k = i + 1; k < kCount; ++k) x[i] = x[i] - Lanes(factors(k, i)) * x[k];
    PLUMB_UNROLL
    for (int i = 0; i < kCount; ++i) store_row(m.at[i], x[i]);
  });
#endif
}

}  // namespace plumb::impulse
