// Scenes for hash tests of bodies whose motion is bound in other ways than by contact, or too fast for a step.
#pragma once

#include "tests/hashes/scene.hpp"

namespace plumb::impulse::test {

/// Puppets on hinges, universal and generic joints with limits, motors and springs, some of which break.
void puppets(Scene& scene);
/// Chains of limbs on swing-twist joints, in round and elliptic cones and in none, that are twisted by motors and
/// springs, fall over a block, and some of which hang.
void sockets(Scene& scene);
/// Chains of limbs whose springs lead them from pose to pose, some in cones, some driven by motors too, over a block
/// and under boxes.
void led_limbs(Scene& scene);
/// Doors, pistons and cranks: motors that turn back, limits that are struck, springs, and a bridge that gives way.
void clockwork(Scene& scene);
/// Trains of wheels with gears and racks: driven ones that lift tables with boxes, one that closes on itself, and
/// wheels that are geared and fall.
void gears(Scene& scene);
/// Continuous collision: bullets through a wall of cubes, and a spinning rod.
void bullets(Scene& scene);
/// A heap of bodies with locked axes.
void held(Scene& scene);
/// Machines that bear loads: a cart and a table with boxes on them, a chain in a heap, a rope with a heavy ball.
void loads(Scene& scene);

}  // namespace plumb::impulse::test
