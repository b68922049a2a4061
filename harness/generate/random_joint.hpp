// A joint of chance between two bodies of a machine.
#pragma once

#include <optional>

#include "convert/builder.hpp"
#include "generate/features.hpp"

namespace plumb::harness {

/// Where it goes: between a body, or the world, and another, about a point in the world. Both are at rest in it.
struct JointSite {
  std::optional<std::size_t> body_a;  ///< by index; none: the world
  std::size_t body_b;
  referee::Vec3 anchor;
};

/// A joint that may move, with what the features allow.
void add_random_joint(Imported& imported, Chance& chance, const Features& features, const JointSite& site);

/// A joint that closes a loop of a tree: a rod between the two frames, a ball, or a joint that holds all.
void add_loop(Imported& imported, Chance& chance, std::size_t body_a, std::size_t body_b);

}  // namespace plumb::harness
