#include "exec/floating_point.hpp"

#include "exec/simd.hpp"

namespace plumb::impulse {

FloatingPointScope::FloatingPointScope() : saved_(simd::control_word()) {
  simd::set_control_word(simd::kDefaultControlWord);
}
FloatingPointScope::~FloatingPointScope() { simd::set_control_word(saved_); }

}  // namespace plumb::impulse
