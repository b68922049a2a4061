#include "world/bounds_origin.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::impulse {

namespace {

constexpr double kNear = 1000;  // m: floats from an origin so far still tell a tenth of a millimetre

}  // namespace

bool BoundsOrigin::find(const ProxyList& movers, const ColliderTable& colliders, BodyState& state) {
  if (!dirty_) return false;
  dirty_ = false;
  if (movers.count() == 0) return false;
  const Position middle = middle_of(movers, colliders, state);
  const Position off = middle - place_;
  if (known_ && std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) < kNear) return false;
  place_ = middle;
  known_ = true;
  return true;
}

}  // namespace plumb::impulse
