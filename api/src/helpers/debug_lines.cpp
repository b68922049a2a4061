#include "plumb/helpers/debug_lines.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "common.hpp"

namespace plumb::helpers {

std::uint32_t island_colour(std::int32_t island, bool asleep) {
  const double brightness = asleep ? 90 : 255;
  if (island < 0) return 0x010101u * static_cast<std::uint32_t>(brightness / 2);
  const double hue = 6 * std::fmod(0.618033988749895 * island, 1.0);
  const auto channel = [&](double shift) {
    const double at = std::fmod(hue + shift, 6.0);
    return static_cast<std::uint32_t>(brightness * std::clamp(std::abs(at - 3) - 1, 0.15, 1.0));
  };
  return channel(0) << 16 | channel(4) << 8 | channel(2);
}

void DebugLines::add_axes(const PlumbPose& pose, double size) {
  const PlumbVec3 axes[3] = {{size, 0, 0}, {0, size, 0}, {0, 0, size}};
  const std::uint32_t colours[3] = {0xff0000, 0x00ff00, 0x0000ff};
  for (int i = 0; i < 3; ++i)
    lines_.push_back({pose.position, add(pose.position, rotate(pose.orientation, axes[i])), colours[i]});
}

void DebugLines::add_frames(double size) {
  const auto bodies = world_.bodies();
  std::vector<PlumbPose> poses(bodies.size());
  read_rows(world_, PLUMB_FIELD_POSE, bodies, std::span(poses));
  for (const PlumbPose& pose : poses) add_axes(pose, size);
}

void DebugLines::add_contacts(double least, double impulse_scale) {
  for (const PlumbContact& contact : world_.contacts()) {
    const double size = std::max(std::abs(contact.depth), least);
    lines_.push_back({contact.position, add(contact.position, scale(size, contact.normal)), 0xff0000});
    const double friction = length(contact.tangent_impulse);
    if (friction > 0)  // not where it is NaN
      lines_.push_back(
          {contact.position, add(contact.position, scale(impulse_scale, contact.tangent_impulse)), 0xffff00});
  }
}

void DebugLines::add_joints(std::span<const PlumbJointDesc> descs, double size) {
  for (const PlumbJointDesc& desc : descs) {
    const auto frame = [&](PlumbBody body, const PlumbPose& local) {
      return body == 0 ? local : compose(read_one<PlumbPose>(world_, PLUMB_FIELD_POSE, body), local);
    };
    const PlumbPose a = frame(desc.body_a, desc.frame_a), b = frame(desc.body_b, desc.frame_b);
    add_axes(a, size);
    add_axes(b, size);
    lines_.push_back({a.position, b.position, 0xff00ff});
  }
}

void DebugLines::add_boxes() {
  IDebug& debug = require_extension(world_.debug(), "debug lines of boxes", PLUMB_EXT_DEBUG, "nothing");
  std::unordered_map<PlumbBody, std::uint32_t> colours;
  std::span<const PlumbDebugBody> states;
  if (debug.body_states(states) >= 0)
    for (const PlumbDebugBody& state : states) colours[state.body] = island_colour(state.island, state.asleep != 0);
  std::span<const PlumbDebugBox> boxes;
  check(world_, debug.tree_boxes(boxes));
  for (const PlumbDebugBox& box : boxes) {
    const auto known = colours.find(box.body);
    add_box(box.lower, box.upper, box.body == 0 ? 0x606060 : known == colours.end() ? 0xffffff : known->second);
  }
}

void DebugLines::add_box(const PlumbVec3& lower, const PlumbVec3& upper, std::uint32_t colour) {
  const auto corner = [&](int i) {
    return PlumbVec3{i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z};
  };
  for (int i = 0; i < 8; ++i)
    for (int bit = 1; bit < 8; bit *= 2)
      if ((i & bit) == 0) lines_.push_back({corner(i), corner(i | bit), colour});
}

}  // namespace plumb::helpers
