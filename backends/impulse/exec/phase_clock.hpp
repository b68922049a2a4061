// Time of a step by phase, measured where the kernels run and without waiting for them. Both executors' clocks have the
// same members:
//
//   measures(step)         whether the step of this number is measured
//   measure(on)            whether what is enqueued from here on is
//   start(executor)        the step begins here
//   end(executor, phase)   what was enqueued since the last call belongs to the phase; a phase ends once a step
//   seconds(phase)         after wait(): what the phase took in the last measured step, 0 where it was left out
#pragma once

#include "exec/executor.hpp"

#if defined(PLUMB_IMPULSE_CUDA)
#include "exec/cuda/phase_clock.hpp"
#else
#include "exec/cpu/phase_clock.hpp"
#endif
