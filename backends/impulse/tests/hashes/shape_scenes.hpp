// Scenes for hash tests with the shapes that have parts, or a round side.
#pragma once

#include "tests/hashes/scene.hpp"

namespace plumb::impulse::test {

/// One of each convex type, of about half a metre.
std::vector<PlumbShape> convex_shapes(Scene& scene);
PlumbShape make_cylinder(Scene& scene, double radius, double half_height);

/// Cylinders, standing stacks of them and a heap, with boxes, balls, capsules and a hull among them.
void pile_of_cylinders(Scene& scene);
/// Compounds with other compounds and single shapes on a plane.
void pile_of_compounds(Scene& scene);
/// All convex shapes on a hilly mesh and a hilly height field, and a mesh that moves.
void pile_on_surfaces(Scene& scene);
/// All convex shapes on a level mesh and a hilly height field whose cells are of four materials in turn, ice, sand,
/// rubber and the body's; some are flagged, some asleep at the start.
void chequers(Scene& scene);
/// What has faces, on a mesh and a moving height field of bumps far smaller than these.
void bumps(Scene& scene);
/// Flagged bodies of every convex shape, too fast for a step, into a mesh, a height field, a plane and a mesh that
/// moves.
void sheets(Scene& scene);
/// Stones of two hundred corners on hills, among themselves and with other shapes.
void boulders(Scene& scene);

}  // namespace plumb::impulse::test
