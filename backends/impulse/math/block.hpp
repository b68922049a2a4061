// Small dense symmetric matrices of up to six rows, factored as L D L^T.
#pragma once

#include "math/real.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

constexpr int kBlockSize = 6;

/// Lower triangle by rows; after factor(): L below the diagonal and 1 / D on it.
struct Block {
  Real at[kBlockSize * (kBlockSize + 1) / 2];

  PLUMB_HD Real& operator()(int row, int column) {
    PLUMB_ASSERT(0 <= column && column <= row && row < kBlockSize);
    return at[row * (row + 1) / 2 + column];
  }
  PLUMB_HD const Real& operator()(int row, int column) const {
    PLUMB_ASSERT(0 <= column && column <= row && row < kBlockSize);
    return at[row * (row + 1) / 2 + column];
  }
};

/// Factors the first n rows. A row with a zero pivot, which moves nothing or repeats those before it, gets 0.
PLUMB_HD inline void factor(Block& m, int n) {
  PLUMB_ASSERT(n >= 0 && n <= kBlockSize);
  for (int j = 0; j < n; ++j) {
    const Real whole = m(j, j);
    Real left = whole;
    Real scaled[kBlockSize];
    for (int k = 0; k < j; ++k) {
      scaled[k] = m(j, k);  // L D so far
      m(j, k) = scaled[k] * m(k, k);
    }
    for (int k = 0; k < j; ++k) left = left - scaled[k] * m(j, k);
    const Real inverse = left > 64 * kEpsilon * whole ? Real(1) / left : Real(0);
    m(j, j) = inverse;
    for (int i = j + 1; i < n; ++i)
      for (int k = 0; k < j; ++k) m(i, j) = m(i, j) - m(i, k) * m(j, k);
  }
}

/// x becomes the solution of (L D L^T) y = x, or of several at once, as lanes.
template <class N>
PLUMB_HD void solve_factored(const Block& m, int n, N* x) {
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < i; ++k) x[i] = x[i] - N(m(i, k)) * x[k];
  for (int i = 0; i < n; ++i) x[i] = N(m(i, i)) * x[i];
  for (int i = n - 1; i >= 0; --i)
    for (int k = i + 1; k < n; ++k) x[i] = x[i] - N(m(k, i)) * x[k];
}

}  // namespace plumb::impulse
