// Poses over time as a bundle keeps them: whole steps of a length and of a unit quaternion, each as the difference from
// where the two frames before it lead. What rests is stored once; what flies evenly, nearly so.
#pragma once

#include <array>
#include <vector>

#include "replay/container.hpp"
#include "simulation/simulation.hpp"

namespace plumb::harness {

/// poses[frame][body]. Every coordinate comes back within `step` (m).
///
/// Section: f32 [frames, bodies, 3], coding {"kind": "motion", "step", "planes", "raw": [bodies]}. Its bytes: u8 order
/// for each body; then for each axis, for each body that is not raw, for each frame a number n minus its prediction, as
/// planes (replay/planes.hpp); the coordinate is n * step. Predictions: 0 in the first frame; the last number (order 1,
/// and in the second frame), or twice the last minus the one before it (order 2). Then the raw bodies, which leave the
/// range of such numbers or have coordinates that are none: f32 [frames, raw, 3].
[[nodiscard]] BundleSection coded_positions(const std::vector<std::vector<PoseRow>>& poses, double step);

/// Largest angle by which an orientation comes back wrong, rad.
inline constexpr double angle_bound = 1e-3;

/// Section: i16 [frames, bodies, 4] in 1/32767, coding {"kind": "turns", "planes"}. Its bytes: u8 order for each body;
/// u8 number of the component that is left out, for each body and frame, XOR that of the frame before (0 before the
/// first); then for each body, for each frame the other three components in 1/8192 minus their prediction, as planes,
/// component by component. The one left out is above zero, from the unit norm, and rounded to 1/8192 where it takes
/// part in a prediction. Predictions are those of positions, of quaternions signed so that each is near the one before
/// it, and turned so that the component left out is not below zero; (0, 0, 0, 1) stands before the first.
[[nodiscard]] BundleSection coded_orientations(const std::vector<std::vector<PoseRow>>& poses);

}  // namespace plumb::harness
