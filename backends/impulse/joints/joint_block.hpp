// Blocks of the joints' matrix, and the arithmetic of their columns. A CPU works on a column as one vector, whatever
// number of rows it has; a thread of a GPU goes through those that there are. Sums go in the same order on both.
#pragma once

#include "joints/joint.hpp"
#include "math/block.hpp"

namespace plumb::impulse {

/// A dense block of L, rows of the later joint by columns of the earlier one. Of one on the diagonal only the lower
/// half counts.
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
/// of(i) of each row in a lane: in registers, for numbers that go to memory one by one are slow to read at once.
template <class Of>
[[gnu::always_inline]] inline Lanes lanes_of_rows(const Of& of) {
  static_assert(kLanes == 8 && kJointRows == 6);
  return Lanes(Lanes::Vector{of(0), of(1), of(2), of(3), of(4), of(5), 0, 0});
}
/// Numbers that have just been put to memory one by one.
inline Lanes lanes_of_numbers(const Real* numbers) {
  return lanes_of_rows([numbers](int i) { return numbers[i]; });
}
inline Lanes column_of(const JointBlock& block, int column) { return load_row(block.at[column]); }

/// K of a joint, and then its factors.
using JointMatrix = JointBlock;

/// A matrix as a block while products are taken off it.
struct WholeMatrix {
  JointBlock& at;

  WholeMatrix(JointMatrix& m, int /*n*/) : at(m) {}
  void put(JointMatrix& /*m*/, int /*n*/) const {}
};

/// Bits as lanes.
inline Mask lanes_of(std::uint32_t bits) {
  constexpr Mask::Vector kBits = {1, 2, 4, 8, 16, 32, 64, 128};
  const auto all = static_cast<Mask::Bits>(bits);
  return {(Mask::Vector{all, all, all, all, all, all, all, all} & kBits) != 0};
}

/// Adds a number to each of the first n on the diagonal.
inline void add_to_diagonal(JointBlock& m, int n, const RowNumbers& numbers) {
  for (int j = 0; j < n; ++j) {
    const Lanes column = column_of(m, j);
    store_row(m.at[j], select(lanes_of(1U << j), column + load_row(numbers), column));
  }
}

/// As of Block.
inline void factor(JointBlock& m, int n) {
  PLUMB_ASSERT(n >= 0 && n <= kJointRows);
  with_rows(n, [&](auto count) {
    constexpr int kCount = count;
    Lanes whole[kCount];  // columns of L D, and m those of L
    PLUMB_UNROLL
    for (int j = 0; j < kCount; ++j) {
      const Real own = m(j, j);
      whole[j] = column_of(m, j);
      PLUMB_UNROLL
      for (int k = 0; k < j; ++k) whole[j] = whole[j] - whole[k] * Lanes(m(j, k));
      const Real left = whole[j].v[j];
      const Real inverse = left > 64 * kEpsilon * own ? Real(1) / left : Real(0);
      store_row(m.at[j], select(lanes_of(1U << j), Lanes(inverse), whole[j] * Lanes(inverse)));
    }
  });
}

/// x, of n numbers or vectors of those in registers, becomes the solution of (L D L^T) y = x.
template <int n, class N>
[[gnu::always_inline]] inline void solve_factored_now(const JointBlock& m, N* x) {
  PLUMB_UNROLL
  for (int i = 0; i < n; ++i) PLUMB_UNROLL
  for (int k = 0; k < i; ++k) x[i] = x[i] - N(m(i, k)) * x[k];
  PLUMB_UNROLL
  for (int i = 0; i < n; ++i) x[i] = N(m(i, i)) * x[i];
  PLUMB_UNROLL
  for (int i = n - 1; i >= 0; --i) PLUMB_UNROLL
  for (int k = i + 1; k < n; ++k) x[i] = x[i] - N(m(k, i)) * x[k];
}
/// As of Block.
template <class N>
void solve_factored(const JointBlock& m, int n, N* x) {
  with_rows(n, [&](auto count) {
    constexpr int kCount = count;
    N y[kCount];
    PLUMB_UNROLL
    for (int i = 0; i < kCount; ++i) y[i] = x[i];
    solve_factored_now<kCount>(m, y);
    PLUMB_UNROLL
    for (int i = 0; i < kCount; ++i) x[i] = y[i];
  });
}
/// Its solution as lanes.
inline Lanes solved_lanes(const JointBlock& m, int n, const RowNumbers& x) {
  Lanes solved(0);
  with_rows(n, [&](auto count) {
    constexpr int kCount = count;
    Real y[kJointRows] = {};
    PLUMB_UNROLL
    for (int i = 0; i < kCount; ++i) y[i] = x[i];
    solve_factored_now<kCount>(m, y);
    solved = lanes_of_rows([&y](int i) { return y[i]; });
  });
  return solved;
}

/// Each row of m becomes the solution of (L D L^T) y = row, of n columns. turned: the same by rows.
inline void solve_rows(const JointBlock& factors, int n, JointBlock& m, JointBlock& turned) {
  with_rows(n, [&](auto count) {
    constexpr int kCount = count;
    Lanes x[kLanes], y[kLanes];
    PLUMB_UNROLL
    for (int q = 0; q < kCount; ++q) x[q] = column_of(m, q);
    PLUMB_UNROLL
    for (int q = kCount; q < static_cast<int>(kLanes); ++q) x[q] = Lanes(0);
    solve_factored_now<kCount>(factors, x);
    PLUMB_UNROLL
    for (int q = 0; q < kCount; ++q) store_row(m.at[q], x[q]);
    transpose(x, y);
    PLUMB_UNROLL
    for (int p = 0; p < kJointRows; ++p) store_row(turned.at[p], y[p]);
  });
}

#else

/// Each row of m becomes the solution of (L D L^T) y = row, of n columns.
PLUMB_HD inline void solve_rows(const Block& factors, int n, JointBlock& m, int rows) {
  for (int p = 0; p < rows; ++p) {
    Real row[kJointRows];
    for (int q = 0; q < n; ++q) row[q] = m(p, q);
    solve_factored(factors, n, row);
    for (int q = 0; q < n; ++q) m(p, q) = row[q];
  }
}

/// K of a joint, and then its factors.
using JointMatrix = Block;

/// A matrix as a block while products are taken off it.
struct WholeMatrix {
  JointBlock at{};

  PLUMB_HD WholeMatrix(const JointMatrix& m, int n) {
    for (int p = 0; p < n; ++p)
      for (int q = 0; q <= p; ++q) at(p, q) = m(p, q);
  }
  PLUMB_HD void put(JointMatrix& m, int n) const {
    for (int p = 0; p < n; ++p)
      for (int q = 0; q <= p; ++q) m(p, q) = at(p, q);
  }
};

PLUMB_HD inline void add_to_diagonal(Block& m, int n, const RowNumbers& numbers) {
  for (int i = 0; i < n; ++i) m(i, i) = m(i, i) + numbers[i];
}

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

#if defined(PLUMB_IMPULSE_CUDA)
/// y -= m x, for the first `columns` numbers of x.
PLUMB_HD inline void take_product(RowNumbers& y, int rows, const JointBlock& m, const RowNumbers& x, int columns) {
  for (int p = 0; p < rows; ++p)
    for (int q = 0; q < columns; ++q) y[p] = y[p] - m(p, q) * x[q];
}
#else
/// y - m x, for the first `columns` numbers of x.
inline Lanes without_product(Lanes y, const JointBlock& m, const RowNumbers& x, int columns) {
  for (int q = 0; q < columns; ++q) y = y - column_of(m, q) * Lanes(x[q]);
  return y;
}
#endif

}  // namespace plumb::impulse
