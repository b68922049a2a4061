#include "joints/joint_colouring.hpp"

#include <algorithm>

namespace plumb::impulse {

void JointColouring::colour(const OrderedJoints& ordered, const Table<BodyMass>& masses) {
  constexpr std::uint32_t kNoColour = kJointColours - 1;
  std::vector<std::uint32_t> taken(masses.size());  // by body
  struct Colour {
    std::vector<std::uint32_t> single, in_system;
  };
  std::vector<Colour> colours(kJointColours);
  colours_ = 0;
  for (std::uint32_t j = 0; j < ordered.count(); ++j) {
    const Joint& joint = ordered.joints[j];
    const bool a = is_pushed(joint.body_a, masses), b = is_pushed(joint.body_b, masses);
    const std::uint32_t mask = (a ? taken[joint.body_a] : 0) | (b ? taken[joint.body_b] : 0);
    std::uint32_t colour = 0;
    while (colour < kNoColour && (mask >> colour & 1U) != 0) ++colour;
    if (a) taken[joint.body_a] |= 1U << colour;
    if (b) taken[joint.body_b] |= 1U << colour;
    (j < ordered.base ? colours[colour].single : colours[colour].in_system).push_back(j);
    colours_ = std::max(colours_, colour + 1);
  }
  overflow_ = colours_ == kJointColours;
  std::vector<std::uint32_t> list, first, system;
  for (const Colour& colour : colours) {
    first.push_back(static_cast<std::uint32_t>(list.size()));
    list.insert(list.end(), colour.single.begin(), colour.single.end());
    system.push_back(static_cast<std::uint32_t>(list.size()));
    list.insert(list.end(), colour.in_system.begin(), colour.in_system.end());
  }
  first.push_back(static_cast<std::uint32_t>(list.size()));
  by_colour_.assign(list);
  first_.assign(first);
  system_first_.assign(system);
}

}  // namespace plumb::impulse
