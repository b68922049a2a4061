// Steps with surface velocities or rolling friction, and with any joints, on a device.
#include "solver/enqueue_step.hpp"

namespace plumb::impulse {

void enqueue_step_with_surface_effects(Executor& executor, const StepWork& work) {
  enqueue_step<JointCode::kAll, true>(executor, work);
}

}  // namespace plumb::impulse
