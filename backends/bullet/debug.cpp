// What Bullet sees: candidate pairs of the broad phase, the boxes of its two trees, the axes of its manifolds, its
// islands and what its solver took one after the other.
#include "world.hpp"

namespace plumb::bullet {
namespace {

PlumbBody handle_of(const btBroadphaseProxy* proxy) {
  return our_body(static_cast<const btCollisionObject*>(proxy->m_clientObject))->handle;
}

struct Visit {
  const btDbvtNode* node;
  std::int32_t depth;
};

void add_boxes(const btDbvt& tree, std::uint32_t number, std::vector<PlumbDebugBox>& boxes) {
  std::vector<Visit> open;
  if (tree.m_root != nullptr) open.push_back({tree.m_root, 0});
  while (!open.empty()) {
    const Visit at = open.back();
    open.pop_back();
    const bool leaf = at.node->isleaf();
    const PlumbBody body = leaf ? handle_of(static_cast<const btDbvtProxy*>(at.node->data)) : 0;
    boxes.push_back({to_plumb(at.node->volume.Mins()), to_plumb(at.node->volume.Maxs()), body, at.depth, number});
    if (leaf) continue;
    open.push_back({at.node->childs[1], at.depth + 1});
    open.push_back({at.node->childs[0], at.depth + 1});
  }
}

}  // namespace

PlumbResult World::candidate_pairs(std::span<const PlumbDebugPair>& pairs) {
  lent_.pairs.clear();
  const btBroadphasePairArray& array = parts_.broadphase.getOverlappingPairCache()->getOverlappingPairArray();
  for (int i = 0; i < array.size(); ++i)
    lent_.pairs.push_back({handle_of(array[i].m_pProxy0), handle_of(array[i].m_pProxy1)});
  pairs = lent_.pairs;
  return PLUMB_OK;
}

PlumbResult World::tree_boxes(std::span<const PlumbDebugBox>& boxes) {
  lent_.boxes.clear();
  for (std::uint32_t tree = 0; tree < 2; ++tree) add_boxes(parts_.broadphase.m_sets[tree], tree, lent_.boxes);
  boxes = lent_.boxes;
  return PLUMB_OK;
}

/// Of those that are near enough for contact points; Bullet keeps no axes of others.
PlumbResult World::separating_axes(std::span<const PlumbDebugAxis>& axes) {
  lent_.axes.clear();
  btDispatcher& dispatcher = parts_.dispatcher;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    const btManifoldPoint* deepest = nullptr;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      if (deepest == nullptr || point.m_distance1 < deepest->m_distance1) deepest = &point;
    }
    if (deepest == nullptr) continue;
    lent_.axes.push_back({our_body(manifold.getBody0())->handle, our_body(manifold.getBody1())->handle,
                          to_plumb(-deepest->m_normalWorldOnB), static_cast<double>(deepest->m_distance1)});
  }
  axes = lent_.axes;
  return PLUMB_OK;
}

/// Bullet's islands hold together what is near enough to be a candidate pair, whether it touches or not.
PlumbResult World::body_states(std::span<const PlumbDebugBody>& bodies) {
  lent_.bodies.clear();
  for (const auto& body : bodies_) {
    if (!body) continue;
    const bool dynamic = body->is(PLUMB_DYNAMIC);
    lent_.bodies.push_back({body->handle, dynamic ? body->getIslandTag() : -1, dynamic && body->is_asleep() ? 1U : 0U});
  }
  bodies = lent_.bodies;
  return PLUMB_OK;
}

PlumbResult World::solved_constraints(std::span<const PlumbDebugConstraint>& constraints) {
  if (solver_kind_ == SolverKind::MlcpDantzig || solver_kind_ == SolverKind::MlcpLemke)
    throw Error(PLUMB_E_UNSUPPORTED, "a direct solver of Bullet takes all constraints of an island as one system");
  lent_.constraints.clear();
  btDispatcher& dispatcher = parts_.dispatcher;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (manifold.getNumContacts() != 0 && is_solved(manifold))
      lent_.constraints.push_back(
          {our_body(manifold.getBody0())->handle, our_body(manifold.getBody1())->handle, 0, -1, 0});
  }
  const auto moves = [](const Body* body) { return body != nullptr && body->is(PLUMB_DYNAMIC) && body->isActive(); };
  for (const auto& joint : joints_)
    if (joint && (moves(joint->body_a) || moves(joint->body_b)))
      lent_.constraints.push_back({joint->desc.body_a, joint->desc.body_b, joint->handle, -1, 0});
  constraints = lent_.constraints;
  return PLUMB_OK;
}

}  // namespace plumb::bullet
