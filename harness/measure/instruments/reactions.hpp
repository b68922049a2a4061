// Forces of joints, as engines tell them.
#pragma once

#include <cstddef>

#include "measure/measure.hpp"
#include "referee/pose.hpp"

namespace plumb::harness {

/// Mean force and torque that a joint puts on its body b, over the steps added. For engines that tell reactions.
class ReactionAccount {
 public:
  explicit ReactionAccount(std::size_t joint) : joint_(joint) {}
  void add(Simulation& simulation);
  [[nodiscard]] referee::Vec3 force() const { return force_ / count_; }
  [[nodiscard]] referee::Vec3 torque() const { return torque_ / count_; }

 private:
  std::size_t joint_;
  referee::Vec3 force_ = referee::Vec3::Zero(), torque_ = referee::Vec3::Zero();
  double count_ = 0;
};
/// Whether the backend tells reactions of this joint's type.
[[nodiscard]] bool tells_reaction(MeasureContext& context, std::size_t joint);

}  // namespace plumb::harness
