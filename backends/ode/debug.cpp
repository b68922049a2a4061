// What ODE sees: the pairs and bounds of its space, and what touches, where the last step has left the bodies.
#include <algorithm>
#include <map>

#include "world.hpp"

namespace plumb::ode {

PlumbResult World::candidate_pairs(std::span<const PlumbDebugPair>& pairs) {
  return inside_ode([&] {
    lent_.pairs.clear();
    const auto collect = [](void* list, dGeomID one, dGeomID two) {
      const Body &a = *tag_of(one).body, &b = *tag_of(two).body;
      static_cast<std::vector<PlumbDebugPair>*>(list)->push_back({a.handle, b.handle});
    };
    if (space_ != nullptr) dSpaceCollide(space_, &lent_.pairs, collect);
    pairs = lent_.pairs;
    return PLUMB_OK;
  });
}

PlumbResult World::tree_boxes(std::span<const PlumbDebugBox>& boxes) {
  return inside_ode([&] {
    lent_.boxes.clear();
    for (const Body* body : lists_.all) {
      for (const auto& geom : body->geoms) {
        dReal b[6];
        dGeomGetAABB(geom->placed.geom, b);
        lent_.boxes.push_back({{b[0], b[2], b[4]}, {b[1], b[3], b[5]}, body->handle, -1, 0});
      }
    }
    boxes = lent_.boxes;
    return PLUMB_OK;
  });
}

/// Of those that touch: ODE does not tell along which axes others are apart.
PlumbResult World::separating_axes(std::span<const PlumbDebugAxis>& axes) {
  return inside_ode([&] {
    lent_.axes.clear();
    if (space_ != nullptr)
      for (const ContactPass::Touch& touch : contacts_.look(space_))
        lent_.axes.push_back({touch.a->handle, touch.b->handle, touch.normal, -touch.depth});
    axes = lent_.axes;
    return PLUMB_OK;
  });
}

/// ODE finds its islands anew in each step and does not tell them: the same are worked out here, of the bodies that
/// contacts and joints bind.
PlumbResult World::body_states(std::span<const PlumbDebugBody>& bodies) {
  return inside_ode([&] {
    std::map<const Body*, const Body*> parent;
    const auto root = [&](const Body* body) {
      for (auto at = parent.find(body); at != parent.end() && at->second != body; at = parent.find(body))
        body = at->second;
      return body;
    };
    const auto join = [&](const Body* a, const Body* b) {
      if (a == nullptr || b == nullptr || !a->dynamic() || !b->dynamic()) return;
      parent[root(a)] = root(b);
    };
    if (space_ != nullptr)
      for (const ContactPass::Touch& touch : contacts_.look(space_)) join(touch.a, touch.b);
    for (const Joint* joint : joint_lists_.all)
      if (joint->solved()) join(joint->a, joint->b);
    lent_.bodies.clear();
    for (const Body* body : lists_.all) {
      const std::int32_t island = body->dynamic() ? static_cast<std::int32_t>(slot_of(root(body)->handle)) : -1;
      lent_.bodies.push_back({body->handle, island, body->dynamic() && body->asleep() ? 1U : 0U});
    }
    bodies = lent_.bodies;
    return PLUMB_OK;
  });
}

/// Also for quickstep, which goes row by row in an order that it draws anew: what it worked on is gone after the step.
PlumbResult World::solved_constraints(std::span<const PlumbDebugConstraint>&) {
  throw Error(PLUMB_E_UNSUPPORTED, "ODE does not keep its contact constraints beyond the step that solves them");
}

}  // namespace plumb::ode
