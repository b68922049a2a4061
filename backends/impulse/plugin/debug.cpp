// plumb.debug/1: candidates and trees of the last step's broad phase, and the axes along which candidates are apart.
#include "exec/floating_point.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

/// The body of a proxy that the last step knew; 0 where it is gone.
PlumbBody World::body_of_last_step(std::uint32_t proxy) const {
  const Proxy& row = simulation_.proxies[proxy];
  return row.shape == kNone || row.born > simulation_.steps() ? 0 : bodies_[row.body].id;
}

/// Candidates of the last step whose bodies are still there.
std::vector<Pair> World::known_candidates() {
  std::vector<Pair> pairs = simulation_.candidates();
  std::erase_if(pairs,
                [&](const Pair& pair) { return body_of_last_step(pair.a) == 0 || body_of_last_step(pair.b) == 0; });
  return pairs;
}

PlumbResult World::candidate_pairs(std::span<const PlumbDebugPair>& pairs) {
  debug_pairs_.clear();
  for (const Pair& pair : known_candidates())
    debug_pairs_.push_back({body_of_last_step(pair.a), body_of_last_step(pair.b)});
  pairs = debug_pairs_;
  return PLUMB_OK;
}

PlumbResult World::tree_boxes(std::span<const PlumbDebugBox>& boxes) {
  debug_boxes_.clear();
  const Position& origin = simulation_.tree_origin();
  const auto corner = [&](const Vec& v) {
    const Position at = moved(origin, v);
    return PlumbVec3{at.x, at.y, at.z};
  };
  for (const BroadPhase::Tree tree : {BroadPhase::Tree::kMovers, BroadPhase::Tree::kStatics}) {
    const std::vector<TreeNode> nodes = simulation_.tree_nodes(tree);
    const TreeView view = {nodes.data(), static_cast<std::uint32_t>((nodes.size() + 1) / 2)};
    std::vector<std::uint32_t> ends;  // of the subtrees about the node, from the root on
    for (std::uint32_t id = view.root(); id != TreeView::kEnd;) {
      while (!ends.empty() && ends.back() == id) ends.pop_back();
      const TreeNode& node = nodes[id];
      const bool inner = TreeView::is_inner(id);
      const PlumbBody body = inner ? 0 : body_of_last_step(node.child);
      if (is_sound({node.low, node.high}) && (inner || body != 0))
        debug_boxes_.push_back({corner(node.low), corner(node.high), body, static_cast<std::int32_t>(ends.size()),
                                static_cast<std::uint32_t>(tree)});
      if (inner) ends.push_back(node.next);
      id = inner ? node.child : node.next;
    }
  }
  boxes = debug_boxes_;
  return PLUMB_OK;
}

PlumbResult World::separating_axes(std::span<const PlumbDebugAxis>& axes) {
  const FloatingPointScope scope;
  const std::vector<Pair> pairs = known_candidates();
  const QueryScene scene = simulation_.query_scene(hit_names());
  Executor& executor = simulation_.executor();
  const auto n = static_cast<std::uint32_t>(pairs.size());
  Buffer<Pair> candidates;
  candidates.from_host(pairs.data(), n);
  PairBatch batch;
  batch.reserve(n);
  pose_pairs(executor, scene, candidates.data(), n, batch.pairs.device());
  answer_pairs(executor, batch.pairs.device(), n, scene, (scene.types & kTypesInPieces) != 0, batch.answers.device());
  executor.to_host(batch.answers, n);
  executor.wait();
  debug_axes_.clear();
  for (std::uint32_t i = 0; i < n; ++i) {
    const PairAnswer& answer = batch.answers[i];
    debug_axes_.push_back({body_of_last_step(pairs[i].a),
                           body_of_last_step(pairs[i].b),
                           {answer.normal.x, answer.normal.y, answer.normal.z},
                           answer.distance});
  }
  axes = debug_axes_;
  return PLUMB_OK;
}

}  // namespace plumb::impulse
