// How large a scene may be. Sizes are judged from the file's counts and times before anything is made of them, so that
// a slip of the pen costs no minutes and no memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/node.hpp"

namespace plumb::harness {

constexpr std::size_t most_objects = 2'000'000;    ///< bodies or joints of a scene
constexpr std::size_t most_actions = 100'000;      ///< of a scene's host: each costs in every step
constexpr std::size_t most_vertices = 10'000'000;  ///< of all shapes of a scene, and heights of height fields
constexpr std::size_t most_cells = 10'000;         ///< that variants, or a study's combinations, make
constexpr std::size_t most_bytes = 64u << 20;      ///< of a scene or study file
constexpr double most_steps = 1e7;                 ///< of a run: two days of 60 Hz
constexpr double least_dt = 1e-9, most_dt = 1e6;   ///< s
constexpr std::size_t many_objects = 100'000;      ///< from here on a scene is made once only, by the worker

/// Steps that take a scene to its end; more than most_steps, infinity or NaN where the times make no sense.
[[nodiscard]] double steps_of(double seconds, double dt);

/// How often for_each_repeat would call, before its `when`; evaluates nothing but counts. Fails beyond `most`.
[[nodiscard]] std::size_t count_repeats(const Node& entry, std::size_t most);

/// Bodies and joints of a scene file whose parameters have values. Fails where one of the two is beyond most_objects,
/// or the host's actions beyond most_actions.
[[nodiscard]] std::size_t count_objects(const Node& root);
/// Likewise, of the scene that SceneFile::instantiate would make; throws as that does, and makes none.
[[nodiscard]] std::size_t count_objects(const SceneFile& file, const Parameters& given, const Times& times);

}  // namespace plumb::harness
