// Exact symmetries of mechanics, applied to scenes: what a transformed copy does must be the transform of what the
// original does. Nothing is said about how an engine should do it, so no reference solution is needed.
#pragma once

#include <span>
#include <vector>

#include "referee/pose.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

/// Every length times `scale` and every time times sqrt(scale), under the same gravity and density: so speeds go with
/// sqrt(scale), masses with scale^3, forces with scale^3, torques with scale^4. Froude's similarity.
[[nodiscard]] Scene scaled(Scene scene, double scale);

/// Every mass, inertia and force of the scene times `factor`; nothing moves differently.
[[nodiscard]] Scene heavier(Scene scene, double factor);

/// Everything shifted.
[[nodiscard]] Scene translated(Scene scene, const referee::Vec3& offset);

/// Everything seen from a frame that moves with -velocity: the same motion, with `velocity` added to it. Throws
/// std::logic_error for scenes with bodies that do not move freely or joints to the world, which would stay behind.
[[nodiscard]] Scene boosted(Scene scene, const referee::Vec3& velocity);

/// Everything turned about the origin, gravity too. Throws std::logic_error for scenes with locked axes, which are the
/// world's.
[[nodiscard]] Scene rotated(Scene scene, const referee::Quat& turn);

/// Everything in the mirror x -> -x. Throws std::logic_error for scenes with locked axes, joints other than balls and
/// distances (the axes of which have a hand), compounds and height fields.
[[nodiscard]] Scene mirrored(Scene scene);

/// Bodies in another order of creation: body i of the result is body order[i] of the scene.
[[nodiscard]] Scene permuted(const Scene& scene, std::span<const std::size_t> order);

}  // namespace plumb::harness
