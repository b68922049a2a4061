#include "exec/floating_point.hpp"

#include <xmmintrin.h>

namespace plumb::impulse {

namespace {

constexpr std::uint32_t kRoundToNearestNoFlush = 0x1f80;  // all exceptions masked, as a thread starts

}  // namespace

FloatingPointScope::FloatingPointScope() : saved_(_mm_getcsr()) { _mm_setcsr(kRoundToNearestNoFlush); }
FloatingPointScope::~FloatingPointScope() { _mm_setcsr(saved_); }

}  // namespace plumb::impulse
