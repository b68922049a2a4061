// Materials of PhysX, one for all surfaces that have the same coefficients.
#pragma once

#include <map>
#include <utility>

#include "physx_math.hpp"

namespace plumb::px {

/// Coefficients of a pair come out as the interface asks: friction the root of the product, restitution the larger.
class Materials {
 public:
  explicit Materials(bool strong_friction) : strong_friction_(strong_friction) {}
  Materials(const Materials&) = delete;
  Materials& operator=(const Materials&) = delete;
  ~Materials();

  /// It lives as long as this does.
  [[nodiscard]] PxMaterial& of(const PlumbMaterial& material);

 private:
  bool strong_friction_;
  std::map<std::pair<float, float>, PxMaterial*> made_;
};

}  // namespace plumb::px
