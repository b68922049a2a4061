// What materials of children and triangles are to a contact.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Physics/PhysicsSystem.h>

#include "body.hpp"

namespace plumb::jolt {

/// Of a part of a body.
[[nodiscard]] const PlumbMaterial& material_of(const JPH::Body& body, JPH::SubShapeID part);

/// From then on Jolt asks for the coefficients of each contact; without it bodies have one each. Both combine alike.
void ask_for_materials(JPH::PhysicsSystem& system);

}  // namespace plumb::jolt
