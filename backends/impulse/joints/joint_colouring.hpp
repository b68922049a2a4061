// Colours of joints: those of one colour push no body that another pushes, and are solved at once.
#pragma once

#include "exec/memory.hpp"
#include "joints/joint_loops.hpp"
#include "joints/joint_order.hpp"

namespace plumb::impulse {

class JointColouring {
 public:
  /// Greedily in the order given: deterministic. What finds no colour goes last.
  void colour(const OrderedJoints& ordered, const Table<BodyMass>& masses);

  [[nodiscard]] JointColours view() {
    return {by_colour_.data(), first_.data(), system_first_.data(), colours_, overflow_};
  }
  /// f(j, colour) for each of `count` joints; kJointColours: it went by itself.
  template <class F>
  void for_joints(std::uint32_t count, const F& f) const {
    const std::vector<std::uint32_t> list = by_colour_.to_host(count), first = first_.to_host(kJointColours + 1);
    for (std::uint32_t colour = 0; colour < colours_; ++colour)
      for (std::uint32_t i = first[colour]; i < first[colour + 1]; ++i)
        f(list[i], overflow_ && colour + 1 == colours_ ? kJointColours : colour);
  }

 private:
  bool overflow_ = false;
  std::uint32_t colours_ = 0;
  Buffer<std::uint32_t> by_colour_, first_, system_first_;
};

}  // namespace plumb::impulse
