// The floating-point control word that results rely on: round to nearest, no flush to zero, all exceptions masked.
#pragma once

#include <cstdint>

namespace plumb::impulse {

/// Sets it for a scope and puts the caller's back.
class FloatingPointScope {
 public:
  FloatingPointScope();
  ~FloatingPointScope();
  FloatingPointScope(const FloatingPointScope&) = delete;
  FloatingPointScope& operator=(const FloatingPointScope&) = delete;

 private:
  std::uint64_t saved_;
};

}  // namespace plumb::impulse
