// The smallest scene that is still wrong in the same way.
#pragma once

#include <functional>

#include "base/json.hpp"

namespace plumb::harness {

/// scene: of plain_scene(); it fails. Takes out bodies, joints, and what is not usual of them (parts_of()), and
/// shortens the time, until nothing more can go. `fails` is asked of candidates, `shrunk` told of each that is the
/// smallest so far.
[[nodiscard]] Json reduced(const Json& scene, const std::function<bool(const Json&)>& fails,
                           const std::function<void(const Json&)>& shrunk);

}  // namespace plumb::harness
