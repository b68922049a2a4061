// What ODE sees: the pairs and bounds of its space, where the last step has left the bodies.
#include "world.hpp"

namespace plumb::ode {

PlumbResult World::candidate_pairs(std::span<const PlumbDebugPair>& pairs) {
  return inside_ode([&] {
    debug_pairs_.clear();
    const auto collect = [](void* list, dGeomID one, dGeomID two) {
      const Body &a = *static_cast<const GeomTag*>(dGeomGetData(one))->body,
                 &b = *static_cast<const GeomTag*>(dGeomGetData(two))->body;
      static_cast<std::vector<PlumbDebugPair>*>(list)->push_back({a.handle, b.handle});
    };
    if (space_ != nullptr) dSpaceCollide(space_, &debug_pairs_, collect);
    pairs = debug_pairs_;
    return PLUMB_OK;
  });
}

PlumbResult World::tree_boxes(std::span<const PlumbDebugBox>& boxes) {
  return inside_ode([&] {
    debug_boxes_.clear();
    for (const Body* body : order_) {
      for (const auto& geom : body->geoms) {
        dReal b[6];
        dGeomGetAABB(geom->placed.geom, b);
        debug_boxes_.push_back({{b[0], b[2], b[4]}, {b[1], b[3], b[5]}, body->handle, -1, 0});
      }
    }
    boxes = debug_boxes_;
    return PLUMB_OK;
  });
}

PlumbResult World::separating_axes(std::span<const PlumbDebugAxis>&) {
  throw Error(PLUMB_E_UNSUPPORTED, "ODE does not tell the axes that it tries");
}

}  // namespace plumb::ode
