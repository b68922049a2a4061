// From a descriptor to Jolt's body.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Physics/Body/BodyCreationSettings.h>

#include "body.hpp"
#include "settings.hpp"

namespace plumb::jolt {

/// desc: dynamic bodies with their mass. Throws Error for what Jolt cannot hold.
[[nodiscard]] JPH::BodyCreationSettings body_settings(const PlumbBodyDesc& desc, const Shape* shape,
                                                      const Settings& settings, bool gyroscopic);

/// Gives a dynamic body the moments of the descriptor: of small ones Jolt makes its own.
void set_inertia(JPH::Body& body, const PlumbBodyDesc& desc);

}  // namespace plumb::jolt
