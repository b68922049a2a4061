// What a backend's class throws, as a result and a text: no exception crosses the wall.
#pragma once

#include <new>

#include "plumb/physics_world.hpp"

namespace plumb::backend {

/// Called where something is caught. failed(code, text) keeps the text, which lives until it returns, and gives the
/// result to return.
template <class Failed>
PlumbResult caught(const Failed& failed) {
  try {
    throw;
  } catch (const Error& error) {
    return failed(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return failed(PLUMB_E_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return failed(PLUMB_E_INTERNAL, error.what());
  } catch (...) {
    return failed(PLUMB_E_INTERNAL, "the backend threw something that is not a std::exception");
  }
}

}  // namespace plumb::backend
