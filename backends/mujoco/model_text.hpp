// A world as MuJoCo's own text (MJCF), of which it makes a model.
#pragma once

#include <string>

#include "joints/tree.hpp"

namespace plumb::mujoco {

/// kg, kg m2: of what forces must not move.
inline constexpr double kHeavy = 1e10;

/// Whether a joint is one of the model's equalities, or two: a stiff rod, or what closes a loop.
[[nodiscard]] bool needs_equality(const Joint& joint);

[[nodiscard]] std::string model_text(const Tree& tree, const std::vector<std::unique_ptr<Joint>>& joints,
                                     bool collides);

}  // namespace plumb::mujoco
