// What Bullet sees: candidate pairs of the broad phase and the boxes of its two trees.
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
  debug_pairs_.clear();
  const btBroadphasePairArray& array = parts_.broadphase.getOverlappingPairCache()->getOverlappingPairArray();
  for (int i = 0; i < array.size(); ++i)
    debug_pairs_.push_back({handle_of(array[i].m_pProxy0), handle_of(array[i].m_pProxy1)});
  pairs = debug_pairs_;
  return PLUMB_OK;
}

PlumbResult World::tree_boxes(std::span<const PlumbDebugBox>& boxes) {
  debug_boxes_.clear();
  for (std::uint32_t tree = 0; tree < 2; ++tree) add_boxes(parts_.broadphase.m_sets[tree], tree, debug_boxes_);
  boxes = debug_boxes_;
  return PLUMB_OK;
}

PlumbResult World::separating_axes(std::span<const PlumbDebugAxis>& /*axes*/) {
  throw Error(PLUMB_E_UNSUPPORTED, "Bullet does not keep separating axes");
}

}  // namespace plumb::bullet
