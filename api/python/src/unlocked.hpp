// Calls during which Python's other threads run.
#pragma once

#include "core.hpp"

namespace plumb::python {

/// What act() gives, called without the GIL. pybind11's own gil_scoped_release takes it back in a destructor: where the
/// program is ending meanwhile, Python ends a daemon thread there, and unwinding out of a destructor ends the process.
template <class Act>
auto unlocked(Act&& act) {
  PyThreadState* const state = PyEval_SaveThread();
  std::exception_ptr thrown;
  decltype(act()) result{};
  try {
    result = act();
  } catch (const std::exception&) {
    thrown = std::current_exception();
  }
  PyEval_RestoreThread(state);
  if (thrown) std::rethrow_exception(thrown);
  return result;
}

}  // namespace plumb::python
