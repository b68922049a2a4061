// The pair viewer's recordings: one shape passes around and into another, and an engine says of every pose what it
// finds, without a step (plumb.collide/1). The referee does the same, as a backend of its own.
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "plumb/loader.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

/// Two shapes, the first at rest, the second on its way; named by their kinds, "capsule-box".
struct PairTour {
  std::string name;
  Scene scene;                   ///< two bodies
  std::vector<PlumbPose> poses;  ///< of the second body, one a frame; one frame lasts scene.dt
};

/// Of all pairs of kinds of shapes of which at least one may move: spheres, boxes, capsules, cylinders, hulls,
/// compounds among each other, and those on a mesh, a height field and a plane.
[[nodiscard]] std::vector<PairTour> all_pair_tours();

/// Writes what the backend answers to a trajectory of kind "pairs" (record/trajectory.hpp) with the layers answers
/// (one: distance, true_distance, depth_error, contacts), penetration (by the referee), contacts (points, normals,
/// depths and features of the engine), axes (the normal of its deepest point). Throws Error: PLUMB_E_UNSUPPORTED, in
/// words, where the backend lacks the pair.
void record_pair(Backend& backend, const PairTour& tour, const std::string& file);
/// Likewise the referee's own answers; an axis also where the shapes are apart.
void record_pair_of_referee(const PairTour& tour, const std::string& file);

/// What a worker is asked: {"request":"pairs","pair":NAME,"file":FILE} -> {"status","reason"}.
[[nodiscard]] Json answer_pair_request(Backend& backend, const Json& request);

}  // namespace plumb::harness
