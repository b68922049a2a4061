// Scenes for hash tests in which bodies and joints become others while they live, and contacts before they are solved.
#pragma once

#include "tests/hashes/scene.hpp"

namespace plumb::impulse::test {

/// A heap in which a few bodies change their motion, shape, mass, flags or locks before each step, under a swinging
/// chain of hinges whose frames, limits, motors, springs and strength do.
void changers(Scene& scene);
/// A heap of all shapes on a shelf that lets them up and not down, in a room whose floor is ice, a belt or a trampoline
/// from patch to patch and step to step.
void sieves(Scene& scene);

}  // namespace plumb::impulse::test
