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

  /// It lives as long as a shape has it.
  [[nodiscard]] PxMaterial& of(const PlumbMaterial& material);

 private:
  void forget_unused();

  bool strong_friction_;
  std::map<std::pair<float, float>, PxMaterial*> made_;
  std::size_t most_ = 1024;  ///< of so many those that no shape has any more are forgotten: PhysX numbers 65,535
};

}  // namespace plumb::px
