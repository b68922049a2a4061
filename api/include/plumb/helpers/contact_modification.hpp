// Steps in which the host says what becomes of contacts before they are solved (manifolds.h), and the platforms of
// games, which hold from one side only (Box2D's one-sided platforms, by its pre-solve callback).
#pragma once

#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

/// Puts changes of what was found into the list, each row at most once. It is called for each part of a step that has
/// found something, and once more at the end of a step, without any. Rows live until it returns; the world must not be
/// called meanwhile.
using ModifyContacts =
    std::function<void(std::span<const PlumbManifold> manifolds, std::vector<PlumbManifoldChange>& changes)>;

/// A step of dt (s) and its report, the contacts changed by modify. The world declares PLUMB_NEED_CONTACT_MODIFICATION,
/// and bodies that have PLUMB_BODY_MODIFY_CONTACTS are shown. Throws Error when a call fails, or what modify throws;
/// the step is done all the same then, with what was not changed as it is.
PlumbStepReport step_with(IPhysicsWorld& world, double dt, const ModifyContacts& modify);

/// Platforms on which bodies stand from one side, and through which they come from all others: jumped through from
/// below, walked through from aside. Whether a platform holds a body is settled when the two begin to touch, and stays
/// so until they part: who comes to rest in the middle of one falls back out of it. Queries see a platform from all
/// sides.
class OneWayPlatforms {
 public:
  static constexpr PlumbNeeds needs = PLUMB_NEED_COLLISION | PLUMB_NEED_CONTACT_MODIFICATION;

  /// platform: has PLUMB_BODY_MODIFY_CONTACTS. side: unit, world axes: where one stands on it; by another call it is
  /// another. Throws Error for one that has no length.
  void add(PlumbBody platform, const PlumbVec3& side = {0, 1, 0});
  /// It is a body like others again.
  void remove(PlumbBody platform);
  /// Lets a body through that stands on the platform now, until the two have parted: a character that climbs down.
  void let_through(PlumbBody platform, PlumbBody body) { pairs_[{platform, body}] = {true, true, false}; }
  [[nodiscard]] bool lets_through(PlumbBody platform, PlumbBody body) const;

  /// As ModifyContacts.
  void operator()(std::span<const PlumbManifold> manifolds, std::vector<PlumbManifoldChange>& changes);

 private:
  struct Touch {
    bool passes = false;  // else it is held
    bool seen = false;    // in this step
    bool is_new = false;  // in this batch
  };
  void settle(const PlumbManifold& row);
  void end_step();

  using Pair = std::pair<PlumbBody, PlumbBody>;  // of a platform and a body
  std::map<PlumbBody, PlumbVec3> sides_;
  std::map<Pair, Touch> pairs_;  // that touch
};

}  // namespace plumb::helpers
