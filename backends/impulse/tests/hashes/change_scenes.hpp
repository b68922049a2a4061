// A scene for hash tests in which bodies and joints become others while they live.
#pragma once

#include "tests/hashes/scene.hpp"

namespace plumb::impulse::test {

/// A heap in which a few bodies change their motion, shape, mass, flags or locks before each step, under a swinging
/// chain of hinges whose frames, limits, motors, springs and strength do.
void changers(Scene& scene);

}  // namespace plumb::impulse::test
