// The generic joint, which ODE does not have, out of rows that it has.
//
// Translations are rows of contacts at frame b's origin, made anew in each sub-step. The two friction rows of a contact
// hold a velocity both ways, with any bound on their force: without one that is a locked axis, with one a motor, with
// slip a spring. Limits are rows that push one way. Rotations are an angular motor in ODE's user mode.
#pragma once

#include "joints/joints.hpp"

namespace plumb::ode {

/// Of the angular motor that was just attached.
void prepare_motor(Joint& joint);

/// The rows of a sub-step.
void prepare_generic(Joint& joint, const RowMaker& rows);

}  // namespace plumb::ode
