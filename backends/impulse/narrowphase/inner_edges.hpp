// Edges of a static box that are none, because another static box lies beside it: a floor of flush blocks is one plane.
//
//      rider        The rider is over A. Of B it sees the nearest point, on B's edge, along the slanted normal, and
//       .-.         would be held off a plane through that edge which nothing in the world has: it hops at the seam.
//      |   | \ n    Of each contact whose normal is between two or three faces of a static box (an edge's or a
//      corner's)
//       '-'   \     the place just outside of one of these faces and inside of the others is looked up. Where another
//    ------+-\----  static box is there, the rider meets that one first, and the contact is dropped.
//      A   | q  B
//
// What is inside of A, a little below B's edge, is q. After what Jolt does for triangles ("active edges"), and meshes
// do here (geometry/surface.hpp); but blocks are bodies of their own, which may lie anywhere and cover an edge in part,
// and so each contact asks for itself, in the tree of the statics. Boxes that ride see faces already.
#pragma once

#include "bodies/step_parameters.hpp"
#include "broadphase/pair_filter.hpp"
#include "bvh/tree_view.hpp"
#include "exec/executor.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// Whether a world may have such edges: more than one static, boxes, and something that is no box.
constexpr bool may_have_inner_edges(std::uint32_t statics, std::uint32_t shape_types) {
  constexpr std::uint32_t kBox = bit_of(ShapeType::kBox);
  return statics > 1 && (shape_types & kBox) != 0 && (shape_types & ~kBox) != 0;
}

/// Of all candidates that touch: points on such edges are no contacts.
void drop_inner_edges(Executor& executor, Count candidates, const ContactCache& cache, const Bodies& bodies,
                      const Proxies& proxies, const PairFilter& filter, const TreeView& statics,
                      const StepParameters* parameters);

}  // namespace plumb::impulse
