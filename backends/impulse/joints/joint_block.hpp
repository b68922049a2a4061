// Blocks of the joints' matrix, and the arithmetic of their columns, by the lanes of row_lanes.hpp.
#pragma once

#include "joints/row_lanes.hpp"

namespace plumb::impulse {

/// A dense block of L, rows of the later joint by columns of the earlier one. Of one on the diagonal only the lower
/// half counts.
struct JointBlock {
  Real at[kJointRows][kLaneGroup];  ///< by column: its rows, and room up to a whole vector

  PLUMB_HD Real& operator()(int row, int column) { return at[column][row]; }
  PLUMB_HD const Real& operator()(int row, int column) const { return at[column][row]; }
};

PLUMB_HD inline Lanes column_of(const JointBlock& block, int column) { return load_row(block.at[column]); }
PLUMB_HD inline void put_column(JointBlock& block, int column, const Lanes& numbers) {
  store_row(block.at[column], numbers);
}

#if defined(PLUMB_IMPULSE_CUDA)

/// A block that is worked on: a thread has the row of its lane in registers.
struct BlockAtWork {
  Lanes column[kJointRows];
};
PLUMB_HD inline Lanes column_of(const BlockAtWork& block, int column) { return block.column[column]; }
PLUMB_HD inline void put_column(BlockAtWork& block, int column, const Lanes& numbers) {
  block.column[column] = numbers;
}

#else

using BlockAtWork = JointBlock;

#endif

/// For the first n columns.
template <class From, class To>
PLUMB_HD void copy_columns(const From& from, int n, To& to) {
  count_rows(n, [&](int q) { put_column(to, q, column_of(from, q)); });
}

/// K of a joint, and then its factors.
using JointMatrix = JointBlock;

/// Adds numbers to the diagonal.
template <class B>
PLUMB_HD void add_to_diagonal(B& m, int n, const Lanes& numbers) {
  count_rows(n, [&](int j) {
    const Lanes column = column_of(m, j);
    put_column(m, j, select(lanes_of(1U << j), column + numbers, column));
  });
}

/// Factors the first n rows as L D L^T: L below the diagonal and 1 / D on it. A row with a zero pivot, which moves
/// nothing or repeats those before it, gets 0.
template <class B>
PLUMB_HD void factor(B& m, int n) {
  PLUMB_ASSERT(n >= 0 && n <= kJointRows);
  with_rows(n, [&](auto count) {
    constexpr int kCount = count;
    Lanes whole[kCount], scaled[kCount];  // columns of L D, and of L
    PLUMB_UNROLL
    for (int j = 0; j < kCount; ++j) {
      if (!is_row(j, n)) continue;
      whole[j] = column_of(m, j);
      const Real own = in_lane(whole[j], j);
      PLUMB_UNROLL
      for (int k = 0; k < j; ++k) whole[j] = whole[j] - whole[k] * Lanes(in_lane(scaled[k], j));
      const Real left = in_lane(whole[j], j);
      const Real inverse = left > 64 * kEpsilon * own ? Real(1) / left : Real(0);
      scaled[j] = select(lanes_of(1U << j), Lanes(inverse), whole[j] * Lanes(inverse));
      put_column(m, j, scaled[j]);
    }
  });
}

/// x, of n numbers or vectors of those in registers, becomes the solution of (L D L^T) y = x. kCount: as of with_rows.
template <int kCount, class N>
PLUMB_INLINE inline void solve_factored_now(const JointBlock& m, int n, N* x) {
  PLUMB_UNROLL
  for (int i = 0; i < kCount; ++i) {
    if (!is_row(i, n)) continue;
    PLUMB_UNROLL
    for (int k = 0; k < i; ++k) x[i] = x[i] - N(m(i, k)) * x[k];
  }
  PLUMB_UNROLL
  for (int i = 0; i < kCount; ++i)
    if (is_row(i, n)) x[i] = N(m(i, i)) * x[i];
  PLUMB_UNROLL
  for (int i = kCount - 1; i >= 0; --i) {
    PLUMB_UNROLL
    for (int k = i + 1; k < kCount; ++k)
      if (is_row(k, n)) x[i] = x[i] - N(m(k, i)) * x[k];
  }
}
/// Likewise n numbers or vectors in memory.
template <class N>
PLUMB_HD void solve_factored(const JointBlock& m, int n, N* x) {
  with_rows(n, [&](auto count) {
    constexpr int kCount = count;
    N y[kCount];
    PLUMB_UNROLL
    for (int i = 0; i < kCount; ++i)
      if (is_row(i, n)) y[i] = x[i];
    solve_factored_now<kCount>(m, n, y);
    PLUMB_UNROLL
    for (int i = 0; i < kCount; ++i)
      if (is_row(i, n)) x[i] = y[i];
  });
}
/// The solution for x; 0 in other lanes.
PLUMB_HD inline Lanes solved_lanes(const JointBlock& m, int n, const Lanes& x) {
  RowNumbers y{};
  spread(x, y);
  Lanes solved(0);
  with_rows(n, [&](auto count) {
    constexpr int kCount = count;
    solve_factored_now<kCount>(m, n, y);
    PLUMB_UNROLL
    for (int i = 0; i < kJointRows; ++i)
      if (i >= n) y[i] = 0;
    solved = lanes_of_rows([&y](int i) { return y[i]; });
  });
  return solved;
}

/// Each row of m becomes the solution of (L D L^T) y = row, of n columns. turned: the same by rows.
PLUMB_HD inline void solve_rows(const JointBlock& factors, int n, BlockAtWork& m, JointBlock& turned) {
  with_rows(n, [&](auto count) {
    constexpr int kCount = count;
    Lanes x[kLaneGroup];
    PLUMB_UNROLL
    for (int q = 0; q < kCount; ++q) x[q] = is_row(q, n) ? column_of(m, q) : Lanes(0);
    PLUMB_UNROLL
    for (int q = kCount; q < static_cast<int>(kLaneGroup); ++q) x[q] = Lanes(0);
    solve_factored_now<kCount>(factors, n, x);
    PLUMB_UNROLL
    for (int q = 0; q < kCount; ++q)
      if (is_row(q, n)) put_column(m, q, x[q]);
    store_turned(x, turned.at);
  });
}

/// m -= left right^T, for `inner` columns.
PLUMB_HD inline void take_product(BlockAtWork& m, int columns, const JointBlock& left, const JointBlock& right,
                                  int inner) {
  with_rows(inner, [&](auto count) {
    constexpr int kCount = count;
    Lanes of_left[kCount];
    PLUMB_UNROLL
    for (int r = 0; r < kCount; ++r)
      if (is_row(r, inner)) of_left[r] = column_of(left, r);
    count_rows(columns, [&](int q) {
      Lanes column = column_of(m, q);
      PLUMB_UNROLL
      for (int r = 0; r < kCount; ++r)
        if (is_row(r, inner)) column = column - of_left[r] * Lanes(right(q, r));
      put_column(m, q, column);
    });
  });
}

/// y - m x, for the first `columns` numbers of x.
PLUMB_HD inline Lanes without_product(Lanes y, const JointBlock& m, const RowNumbers& x, int columns) {
  for (int q = 0; q < columns; ++q) y = y - column_of(m, q) * Lanes(x[q]);
  return y;
}

}  // namespace plumb::impulse
