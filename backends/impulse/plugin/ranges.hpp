// Sizes, masses, speeds of surfaces and lengths of steps that the engine's numbers cannot hold are refused.
#pragma once

#include <cstddef>
#include <string>

#include "plumb/plumb.h"

namespace plumb::impulse {

/// Throws Error PLUMB_E_INVALID_ARGUMENT, naming row i and its member.
void require_range(const PlumbShapeDesc& desc, std::size_t i);
void require_range(const PlumbBodyDesc& desc, std::size_t i);
/// Throws likewise; name: of the speed, which is in m/s.
void require_speed(const std::string& name, const PlumbVec3& speed);
/// Throws likewise; both in m.
void require_rolling_friction(const std::string& name, double rolling, double spinning);
/// Throws likewise where a step of dt, s, is too long, or its shortest parts are too short.
void require_step(double dt);

}  // namespace plumb::impulse
