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
// After Jolt ("manifold reduction"), which takes normals for equal within 5 degrees; here within a thousandth, so that
// a surface that bends is not taken for one that does not. A height does not count: each point knows its own
// separation. Where the host is shown what touches, for it may treat triangles each in its own way, all stay as they
// are.
#pragma once

#include "bodies/body.hpp"
#include "exec/executor.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// Of all candidates that touch, those with surfaces: leaves one for each side from which a shape is touched
/// (cache.touching, found), writes down whose triangle each point is (cache.point_triangles), and puts that into the
/// points' features. impacts: Impacts::times(), or null; contacts of another time stay as they are.
void reduce_manifolds(Executor& executor, Count candidates, const ContactCache& cache, const ContactCache& last,
                      const Bodies& bodies, const Proxies& proxies, const Real* impacts);

}  // namespace plumb::impulse
