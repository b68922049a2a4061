// A box that is carried along a line goes through a tree: a ray is a box of no size, an overlap one that stays.
//
// The tree's numbers are floats, and a node must not be missed for that. The line's point nearest to the origin of the
// boxes is found in double and rounded; the box is larger by that rounding, and all else that is rounded is a share of
// the way along the line, which the test allows for (after Ize, "Robust BVH ray traversal", JCGT 2, 2013).
#pragma once

#include "bvh/lbvh.hpp"
#include "queries/line_shapes.hpp"

namespace plumb::impulse {

class SweptBox {
 public:
  /// start: from the origin of the boxes; along: unit, or 0 for what stays; carried: about the start.
  PLUMB_HD SweptBox(const Vec64& start, const Vec64& along, double length, const Box& carried) {
    middle_ = -dot(start, along);
    const Vec64 from = start + middle_ * along;
    for (int k = 0; k < 3; ++k) {
      const Real at = static_cast<Real>(from[k]);
      const Real rounding = 4 * kEpsilon * (abs(at) + abs(carried.low[k]) + abs(carried.high[k]));
      ahead_[k] = at + carried.high[k] + rounding;
      behind_[k] = at + carried.low[k] - rounding;
      const Real d = static_cast<Real>(along[k]), least = 1 / kHuge;
      inverse_[k] = abs(d) > least ? 1 / d : (d < 0 ? -kHuge : kHuge);
    }
    const Real first = static_cast<Real>(-middle_);
    first_ = first - kSlack * abs(first);
    last = place_of(length);
  }

  Real last;  ///< beyond this nothing is looked for any more

  /// A length along the way as `last` has it.
  [[nodiscard]] PLUMB_HD Real place_of(double at) const {
    const Real place = static_cast<Real>(at - middle_);
    return place + kSlack * abs(place);
  }

  /// Whether the node may be met before `last`, and from where on.
  [[nodiscard]] PLUMB_HD bool meets(const TreeNode& node, Real& from) const {
    Real enter = first_, leave = last;
    for (int k = 0; k < 3; ++k) {
      const Real low = node.low[k] - ahead_[k], high = node.high[k] - behind_[k];
      const bool up = inverse_[k] > 0;
      enter = max(enter, (up ? low : high) * inverse_[k]);
      leave = min(leave, (up ? high : low) * inverse_[k]);
    }
    from = enter - kSlack * abs(enter);
    return from <= leave + kSlack * abs(leave);
  }

 private:
  static constexpr Real kSlack = 8 * kEpsilon;

  double middle_;
  Vec ahead_, behind_, inverse_;
  Real first_;
};

/// visit(proxy) for every leaf of the subtree at `id` that the sweep meets, in the tree's order; `end` follows it. A
/// sweep is a SweptBox, or has its `last` and meets().
template <class Sweep, class Visit>
PLUMB_HD void visit_subtree(const TreeView& tree, std::uint32_t id, std::uint32_t end, const Sweep& sweep,
                            Visit& visit) {
  while (id != end) {
    const TreeNode& node = tree.nodes[id];
    Real from;
    const bool met = sweep.meets(node, from), inner = TreeView::is_inner(id);
    if (met && !inner) visit(node.child);
    id = met && inner ? node.child : node.next;
  }
}
template <class Sweep, class Visit>
PLUMB_HD void visit_all(const TreeView& tree, const Sweep& sweep, Visit& visit) {
  visit_subtree(tree, tree.root(), TreeView::kEnd, sweep, visit);
}

/// The same, nearer subtrees first, for a visitor that brings sweep.last closer. What is left for later is noted; where
/// there is no more room for notes a subtree is gone through in the tree's order, so that nothing is ever missed.
template <class Sweep, class Visit>
PLUMB_HD void visit_nearest_first(const TreeView& tree, const Sweep& sweep, Visit& visit) {
  constexpr std::uint32_t kRoom = 32;
  std::uint32_t later[kRoom];
  Real later_from[kRoom];
  std::uint32_t id = tree.root(), noted = 0;
  Real from;
  if (id == TreeView::kEnd || !sweep.meets(tree.nodes[id], from)) return;
  for (;;) {
    const TreeNode& node = tree.nodes[id];
    if (!TreeView::is_inner(id)) {
      visit(node.child);
    } else {
      std::uint32_t first = node.child, second = tree.nodes[first].next;
      Real from_first, from_second;
      const bool meets_first = sweep.meets(tree.nodes[first], from_first),
                 meets_second = sweep.meets(tree.nodes[second], from_second);
      if (meets_first && meets_second) {
        if (noted == kRoom) {
          visit_subtree(tree, first, node.next, sweep, visit);
        } else {
          const bool swapped = from_second < from_first;
          later[noted] = swapped ? first : second;
          later_from[noted] = swapped ? from_first : from_second;
          ++noted;
          id = swapped ? second : first;
          continue;
        }
      } else if (meets_first || meets_second) {
        id = meets_first ? first : second;
        continue;
      }
    }
    do {
      if (noted == 0) return;
      --noted;
    } while (later_from[noted] > sweep.last);
    id = later[noted];
  }
}

}  // namespace plumb::impulse
