// Steps with limits, motors, springs, universal and generic joints, or reactions.
#include "solver/enqueue_step.hpp"

namespace plumb::impulse {

void enqueue_step_with_axes(Executor& executor, const StepWork& work) { enqueue_step<JointCode::kAll>(executor, work); }

}  // namespace plumb::impulse
