// Points of a contact that runs round a rim.
//
// A coin that has been spun, or Euler's disk, touches the ground at one point of its rim, and within a step that point
// runs along the rim by half a radian and more. A contact at the place where it began lets the coin sink, and what then
// takes the overlap back lifts it: energy out of nothing. So such a contact gets three more points, where the rim will
// be lowest after a third, two thirds and all of the step.
#pragma once

#include "bodies/body.hpp"
#include "bodies/step_parameters.hpp"
#include "exec/executor.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// Of all candidates that touch at one point. For scenes with cylinders.
void sweep_rims(Executor& executor, Count candidates, const ContactCache& cache, const Bodies& bodies,
                const Proxies& proxies, const StepParameters* parameters);

}  // namespace plumb::impulse
