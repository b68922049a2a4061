// Scenes for hash tests with the shapes that have parts, or a round side.
#pragma once

#include "hashes/scene.hpp"

namespace plumb::impulse::test {

/// Cylinders, standing stacks of them and a heap, with boxes, balls, capsules and a hull among them.
void pile_of_cylinders(Scene& scene);
/// Compounds with other compounds and single shapes on a plane.
void pile_of_compounds(Scene& scene);
/// All convex shapes on a hilly mesh and a hilly height field, and a mesh that moves.
void pile_on_surfaces(Scene& scene);

}  // namespace plumb::impulse::test
