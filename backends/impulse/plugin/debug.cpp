// plumb.debug/1: candidates and trees of the last step's broad phase, the axes along which candidates are apart, and
// how the solver took what binds the bodies. All is worked out or copied when it is asked for; no step pays.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "plugin/world.hpp"

namespace plumb::impulse {

/// The body of a proxy that the last step knew; 0 where it is gone.
PlumbBody World::body_of_last_step(std::uint32_t proxy) const {
  const Proxy& row = simulation_.colliders.proxies[proxy];
  return row.shape == kNone || row.first_step > simulation_.steps() ? 0 : bodies_[row.body].id;
}

/// Candidates of the last step whose bodies are still there.
std::vector<Pair> World::known_candidates() {
  std::vector<Pair> pairs = simulation_.candidates();
  std::erase_if(pairs,
                [&](const Pair& pair) { return body_of_last_step(pair.a) == 0 || body_of_last_step(pair.b) == 0; });
  return pairs;
}

PlumbResult World::candidate_pairs(std::span<const PlumbDebugPair>& pairs) {
  lent_.pairs.clear();
  for (const Pair& pair : known_candidates())
    lent_.pairs.push_back({body_of_last_step(pair.a), body_of_last_step(pair.b)});
  pairs = lent_.pairs;
  return PLUMB_OK;
}

PlumbResult World::tree_boxes(std::span<const PlumbDebugBox>& boxes) {
  lent_.boxes.clear();
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
        lent_.boxes.push_back({corner(node.low), corner(node.high), body, static_cast<std::int32_t>(ends.size()),
                               static_cast<std::uint32_t>(tree)});
      if (inner) ends.push_back(node.next);
      id = inner ? node.child : node.next;
    }
  }
  boxes = lent_.boxes;
  return PLUMB_OK;
}

PlumbResult World::separating_axes(std::span<const PlumbDebugAxis>& axes) {
  const std::vector<Pair> pairs = known_candidates();
  const QueryScene scene = simulation_.query_scene(hit_names());
  Executor& executor = simulation_.executor();
  const auto n = static_cast<std::uint32_t>(pairs.size());
  Buffer<Pair> candidates;
  candidates.from_host(pairs.data(), n);
  PairBatch batch;
  batch.reserve(n);
  pose_pairs(executor, scene, candidates.data(), n, batch.pairs.device());
  answer_pairs(executor, batch.pairs.device(), n, scene, (scene.types & kMidphaseTypes) != 0, batch.answers.device());
  executor.to_host(batch.answers, n);
  executor.wait();
  lent_.axes.clear();
  for (std::uint32_t i = 0; i < n; ++i) {
    const PairAnswer& answer = batch.answers[i];
    if (!std::isfinite(answer.distance)) continue;  // two surfaces: nothing is convex
    lent_.axes.push_back({body_of_last_step(pairs[i].a),
                          body_of_last_step(pairs[i].b),
                          {answer.normal.x, answer.normal.y, answer.normal.z},
                          answer.distance});
  }
  axes = lent_.axes;
  return PLUMB_OK;
}

/// By slot: 1 + the smallest slot of those who are bound to it by contacts and joints, or with whom it fell asleep; 0
/// for a body that nothing pushes.
std::vector<std::uint32_t> World::islands_of_bodies() {
  std::vector<std::uint32_t> parent(bodies_.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t slot) {
    while (parent[slot] != slot) slot = parent[slot] = parent[parent[slot]];
    return slot;
  };
  const auto is_pushed = [&](std::uint32_t slot) {
    return bodies_[slot].id != 0 && bodies_[slot].motion == PLUMB_DYNAMIC;
  };
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    if (!is_pushed(a) || !is_pushed(b) || simulation_.sleeps(a) || simulation_.sleeps(b)) return;
    const std::uint32_t root_a = root(a), root_b = root(b);
    parent[std::max(root_a, root_b)] = std::min(root_a, root_b);
  };
  for (const ContactRecord& record : records())
    if (body_of_last_step(record.pair.a) != 0 && body_of_last_step(record.pair.b) != 0)
      join(record.bodies.a, record.bodies.b);
  for (const JointRecord& joint : joints_.records)
    if (joint.id != 0 && joint.desc.body_a != 0) join(slot_of(joint.desc.body_a), slot_of(joint.desc.body_b));
  std::vector<std::uint32_t> islands(bodies_.size());
  for (std::uint32_t slot = 0; slot < bodies_.size(); ++slot)
    if (is_pushed(slot)) islands[slot] = simulation_.sleeps(slot) ? simulation_.island_asleep(slot) : root(slot) + 1;
  return islands;
}

PlumbResult World::body_states(std::span<const PlumbDebugBody>& bodies) {
  lent_.bodies.clear();
  const std::vector<std::uint32_t> islands = islands_of_bodies();
  for (std::uint32_t slot = 0; slot < bodies_.size(); ++slot)
    if (bodies_[slot].id != 0)
      lent_.bodies.push_back(
          {bodies_[slot].id, static_cast<std::int32_t>(islands[slot]) - 1, simulation_.sleeps(slot) ? 1U : 0U});
  bodies = lent_.bodies;
  return PLUMB_OK;
}

/// Contacts have the first colours. A sub-step takes them and the joints in turn, so joints have colours of their own.
PlumbResult World::solved_constraints(std::span<const PlumbDebugConstraint>& constraints) {
  if (!simulation_.solves_in_colours())
    throw Error(PLUMB_E_UNSUPPORTED, "the solver jacobi takes all contacts at once, in no colours");
  lent_.constraints.clear();
  for (const KeptPair& contact : simulation_.solved_manifolds()) {
    const PlumbBody a = body_of_last_step(contact.pair.a), b = body_of_last_step(contact.pair.b);
    if (a == 0 || b == 0) continue;
    if (bodies_[slot_of(a)].motion != PLUMB_DYNAMIC && bodies_[slot_of(b)].motion != PLUMB_DYNAMIC) continue;
    const std::uint32_t colour = contact.kept.colour;
    lent_.constraints.push_back({a, b, 0, colour < kOverflow ? static_cast<std::int32_t>(colour) : -1, 0});
  }
  const StepCounters& counters = simulation_.counters();
  const std::uint32_t first = *std::max_element(std::begin(counters.colour_count), std::end(counters.colour_count));
  for (const SolvedJoint& solved : simulation_.joints.solved()) {
    const JointRecord& joint = joints_.records[solved.slot];
    if (joint.id == 0 || joint.made_after == simulation_.steps()) continue;
    const std::int32_t colour = solved.colour < kJointColours ? static_cast<std::int32_t>(first + solved.colour) : -1;
    lent_.constraints.push_back({joint.desc.body_a, joint.desc.body_b, joint.id, colour, 0});
  }
  constraints = lent_.constraints;
  return PLUMB_OK;
}

}  // namespace plumb::impulse
