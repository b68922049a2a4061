#include "plumb/helpers/contact_modification.hpp"

#include <cmath>
#include <exception>

#include "common.hpp"

namespace plumb::helpers {

namespace {

constexpr double kLeastCosine = 0.5;  // of a slope on which one stands

/// Whether a body that begins to touch a platform so is one that comes from beyond it.
bool comes_through(const PlumbManifold& row, bool platform_is_a, const PlumbVec3& side) {
  return (platform_is_a ? 1 : -1) * dot(row.normal, side) < kLeastCosine;
}

}  // namespace

PlumbStepReport step_with(IPhysicsWorld& world, double dt, const ModifyContacts& modify) {
  IManifolds& manifolds = require_extension(world.manifolds(), "contact modification", PLUMB_EXT_MANIFOLDS,
                                            "PLUMB_NEED_CONTACT_MODIFICATION");
  check(world, world.step(dt));
  std::exception_ptr failed;
  try {
    for (bool goes_on = true; goes_on;) {
      std::span<const PlumbManifold> rows;
      check(world, manifolds.read_manifolds(rows));
      goes_on = !rows.empty();
      std::vector<PlumbManifoldChange> changes;
      modify(rows, changes);
      if (goes_on) check(world, manifolds.modify_manifolds(changes));
    }
  } catch (...) {
    failed = std::current_exception();
  }
  PlumbStepReport report{};
  report.struct_size = sizeof report;
  const PlumbResult result = world.wait(report);
  if (failed) std::rethrow_exception(failed);
  check(world, result);
  return report;
}

void OneWayPlatforms::add(PlumbBody platform, const PlumbVec3& side) {
  const double size = std::sqrt(dot(side, side));
  require(std::isfinite(size) && size > 0, "one-way platform: side has the length " + std::to_string(size) +
                                               ": give where one stands on it, as (0, 1, 0)");
  sides_[platform] = scale(1 / size, side);
}

void OneWayPlatforms::remove(PlumbBody platform) {
  sides_.erase(platform);
  std::erase_if(pairs_, [platform](const auto& pair) { return pair.first.first == platform; });
}

bool OneWayPlatforms::lets_through(PlumbBody platform, PlumbBody body) const {
  const auto found = pairs_.find({platform, body});
  return found != pairs_.end() && found->second.passes;
}

void OneWayPlatforms::operator()(std::span<const PlumbManifold> manifolds, std::vector<PlumbManifoldChange>& changes) {
  if (manifolds.empty()) return end_step();
  for (const PlumbManifold& row : manifolds) settle(row);
  for (auto& [pair, touch] : pairs_) touch.is_new = false;
  for (std::uint32_t row = 0; row < manifolds.size(); ++row) {
    const PlumbManifold& found = manifolds[row];
    if (!lets_through(found.body_a, found.body_b) && !lets_through(found.body_b, found.body_a)) continue;
    changes.push_back(manifold_change(row));
    changes.back().what = PLUMB_MANIFOLD_DISABLED;
  }
}

/// Of several manifolds of two that begin to touch, one that comes from the side is enough to hold.
void OneWayPlatforms::settle(const PlumbManifold& row) {
  for (const bool is_a : {true, false}) {
    const auto platform = sides_.find(is_a ? row.body_a : row.body_b);
    if (platform == sides_.end()) continue;
    const auto [found, is_new] = pairs_.try_emplace({platform->first, is_a ? row.body_b : row.body_a});
    Touch& touch = found->second;
    if (is_new) touch = {true, true, true};
    touch.seen = true;
    if (touch.is_new) touch.passes = touch.passes && comes_through(row, is_a, platform->second);
  }
}

void OneWayPlatforms::end_step() {
  std::erase_if(pairs_, [](const auto& pair) { return !pair.second.seen; });
  for (auto& [pair, touch] : pairs_) touch.seen = false;
}

}  // namespace plumb::helpers
