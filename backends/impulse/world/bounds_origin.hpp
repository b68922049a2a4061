// Bounds are floats from a place near the bodies, so that they are as sharp far from the world's origin as near it.
#pragma once

#include "exec/archive.hpp"
#include "world/proxy_lists.hpp"

namespace plumb::impulse {

class BoundsOrigin {
 public:
  [[nodiscard]] const Position& place() const { return place_; }
  /// Bodies were made, or are gone: it may be better elsewhere.
  void bodies_changed() { dirty_ = true; }

  /// Looks for it anew where bodies have changed. Returns whether it is another: all is to be bounded anew then. A
  /// place that is near one that was good stays.
  bool find(const ProxyList& movers, const ColliderTable& colliders, BodyState& state);

  void exchange(Archive& archive) {
    archive.value(place_);
    archive.value(dirty_);
    archive.value(known_);
  }

 private:
  Position place_{0, 0, 0};
  bool dirty_ = true, known_ = false;
};

}  // namespace plumb::impulse
