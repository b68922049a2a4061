// Manifold reduction: contacts of a shape with triangles of one surface that face the same way become one contact.
//
//     .--------------.          A box on a mesh has a manifold with every triangle below it, and where it lies across
//     |      .  box  |   /      the mesh's edges points on both sides of each. A rigid body needs four of all these:
//     o----.-*-----o-*--/-.     those at its corners (o). The rest (*) lie between them, load the same body again and
//     |  . / |     | / .        again, and come and go as it slides.
//     | ./   *     |/ .
//     o----------*-o.           The four points are chosen from all as they are from one manifold's (candidates.hpp),
//       mesh                    and one of the candidates, the leader, has them from then on.
//
// After Jolt ("manifold reduction"), which takes normals for equal within 5 degrees and gives all points one of them;
// here normals are one within a thousandth, so that a surface that bends is not taken for one that does not. A height
// does not count: each point knows its own separation.
//
// A face that lies on bumps smaller than itself touches hundreds of triangles of which no two are level. There, of
// those within 5 degrees of each other, what bears is left and four points besides, each where it is and along its own
// normal: with one normal for all, a box that slides through a round trough comes a tenth less far on the other side.
//
// What is left may be recycled as a whole (contact_recycling.hpp): while the two hardly move against each other, other
// triangles are not looked at (midphase.hpp). Where the host is shown what touches, for it may treat triangles each in
// its own way, all stay as they are, and are found anew.
#pragma once

#include "exec/executor.hpp"
#include "narrowphase/narrow_phase_work.hpp"

namespace plumb::impulse {

/// Of all candidates that touch, those with surfaces: leaves one for each side from which a shape is touched
/// (cache.touching, found), writes down whose triangle each point is (cache.point_triangles), puts that into the
/// points' features, and keeps what may be recycled (cache.collided). impacts: Impacts::times(), or null; contacts of
/// another time stay as they are.
void reduce_manifolds(Executor& executor, Count candidates, const NarrowPhaseWork& work, const PairTime* impacts);

}  // namespace plumb::impulse
