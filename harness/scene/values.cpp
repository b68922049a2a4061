// Numbers that no engine may be given: held against the ranges of the interface, and told by the scene file's keys.
#include <fmt/format.h>

#include <algorithm>

#include "plumb/backend/check_descs.hpp"
#include "scene/build.hpp"

namespace plumb::harness {
namespace {

constexpr plumb::backend::Where here{"it", 0};

/// The interface says `it[0].material.friction is -1; it must be ...`, of a member that a file has under its last name.
[[noreturn]] void fail_value(const Node& node, const std::string& said) {
  std::string sentence = said.substr(said.find('.') + 1);
  for (const char* group : {"material.", "pose."})
    if (sentence.starts_with(group)) sentence.erase(0, std::string(group).size());
  const std::string key = sentence.substr(0, sentence.find_first_of(".[ "));
  const auto member = node.json().is_object() ? node.find(key.c_str()) : std::nullopt;
  // limits[3].lower is at limits.rx in a file.
  if (member && member->json().is_object())
    for_each_axis(*member, [&](std::size_t axis, const Node& values) {
      const std::string element = fmt::format("{}[{}].", key, axis);
      if (sentence.starts_with(element)) values.fail(sentence.substr(element.size()));
    });
  (member ? *member : node).fail(sentence);
}

template <class Check>
void check_with(const Node& node, const Check& check) {
  try {
    check();
  } catch (const Error& error) {
    fail_value(node, error.what());
  }
}

void check_inertia(const Node& node, const PlumbVec3& inertia) {
  const double sum = inertia.x + inertia.y + inertia.z;
  if (2 * std::max({inertia.x, inertia.y, inertia.z}) > sum * (1 + 1e-9))
    node.fail(
        fmt::format("no body has the principal moments {:g}, {:g}, {:g}: each is at most the sum of the other two",
                    inertia.x, inertia.y, inertia.z));
}

}  // namespace

void check_values(const Node& node, const SceneShape& shape) {
  if (shape.desc.type == PLUMB_COMPOUND) {
    if (shape.children.empty()) node.at("children").fail("a compound has one child or more");
    return;
  }
  check_with(node, [&] { backend::check_shape(here, shape.descriptor()); });
}

void check_values(const Node& node, const PlumbMaterial& material) {
  check_with(node, [&] { backend::check_material(here, "material", material); });
}

void check_values(const Node& node, const SceneBody& body) {
  PlumbBodyDesc desc = body.desc;
  desc.shape = body.shape ? 1 : 0;  // its handle is not known yet
  if (desc.motion == PLUMB_DYNAMIC && !body.shape) {
    if (desc.mass_mode == PLUMB_MASS_FROM_DENSITY)
      node.fail("a body without a shape has no mass from density; give its mass");
    if (desc.mass_mode == PLUMB_MASS_FROM_TOTAL && (desc.flags & PLUMB_BODY_NO_ROTATION) == 0)
      node.fail("a body without a shape turns by an inertia: give it, or the flag \"no_rotation\"");
  }
  check_with(node, [&] {
    backend::check_body(here, desc);
    // What does not move needs no mass, but one that is there is none below 0.
    if (node.find("density")) backend::require_positive(here, "density", desc.density);
    if (node.find("mass")) backend::require_positive(here, "mass", desc.mass);
  });
  if (const auto inertia = node.find("inertia")) check_inertia(*inertia, desc.inertia);
}

void check_values(const Node& node, const SceneJoint& joint) {
  if (joint.body_a == joint.body_b) node.at("body_b").fail("a joint holds two bodies, not one to itself");
  check_with(node, [&] { backend::check_joint(here, joint.desc); });
}

}  // namespace plumb::harness
