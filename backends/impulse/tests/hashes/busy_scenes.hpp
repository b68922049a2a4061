// Scenes for hash tests in which bodies come, go, sleep, wake and are moved about.
#pragma once

#include "tests/hashes/scene.hpp"

namespace plumb::impulse::test {

/// A heap out of which bodies are taken while others fall into it, where those may sleep that lie still.
void comers(Scene& scene);
/// A press that closes on cubes and lets go, a turning table, a lift, and a wall that is put elsewhere.
void machines(Scene& scene);
/// Boxes, balls and capsules on belts that run level, uphill, round a corner and back, and on one that moves.
void belts(Scene& scene);
/// Balls, capsules, cylinders, boxes and hulls that roll and spin against friction, more or less of it from step to
/// step: on level ground, down a slope, over a belt, joined in pairs.
void rollers(Scene& scene);
/// A rope bridge on which people land who are too heavy for whole steps (solver/energy_bound.hpp).
void heavy_bridge(Scene& scene);
/// A heap, heavy cubes on light ones, which have sub-steps of their own (solver/choose_substeps.hpp), one of which the
/// heap meets, and a bouncing ball.
void islands(Scene& scene);
/// A tower, a heap, a chain and a sensor, 100 km from the origin.
void far_off(Scene& scene);

}  // namespace plumb::impulse::test
