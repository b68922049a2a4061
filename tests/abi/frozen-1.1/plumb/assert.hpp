// Checks within: what must hold whatever a host does. A host's mistake is an error that says so (PlumbResult); a check
// that fails is a mistake of ours, and ends the program where it is.
//
// They are compiled where PLUMB_ASSERTS is defined (the presets debug, asan and tsan), on the CPU and in kernels; else
// they cost nothing, and their condition is not evaluated: it must have no effect.
#pragma once

#if defined(PLUMB_ASSERTS)

#include <cstdio>
#include <cstdlib>

#if defined(__CUDACC__)
#define PLUMB_ASSERT_ANYWHERE __host__ __device__
#else
#define PLUMB_ASSERT_ANYWHERE
#endif

namespace plumb {

inline constexpr bool kAsserts = true;

PLUMB_ASSERT_ANYWHERE inline void assertion_failed(const char* condition, const char* file, int line) {
#if defined(__CUDA_ARCH__)
  printf("plumb: %s:%d: must hold: %s\n", file, line, condition);
  __trap();
#else
  std::fprintf(stderr, "plumb: %s:%d: must hold: %s\n", file, line, condition);
  std::abort();
#endif
}

}  // namespace plumb

#define PLUMB_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : ::plumb::assertion_failed(#condition, __FILE__, __LINE__))

#else

namespace plumb {
inline constexpr bool kAsserts = false;
}

#define PLUMB_ASSERT(condition) static_cast<void>(sizeof((condition) ? 1 : 0))

#endif
