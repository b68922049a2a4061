// The contacts that Jolt keeps for its next step, with the impulses that it has found. It shows them nowhere but in the
// bytes of a saved state.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Physics/Collision/Shape/SubShapeIDPair.h>

#include <vector>

#include "contacts/listener.hpp"

namespace JPH {
class PhysicsSystem;
}

namespace plumb::jolt {

/// Whether this Jolt saves contacts in the way that was read here, that of 5.5.1.
inline constexpr bool kReadsSavedContacts = JPH_VERSION_MAJOR == 5 && JPH_VERSION_MINOR == 5 && JPH_VERSION_PATCH == 1;

struct SavedManifold {
  JPH::SubShapeIDPair parts;
  JPH::Float3 normal;   ///< from the first to the second, in the second's axes
  float friction[2]{};  ///< N s on the second, along the tangents that Jolt makes of the normal
  float torsion = 0;    ///< N m s about the normal
  std::size_t count = 0;
  struct Point {
    JPH::Float3 in_a, in_b;  ///< m, from the centres of mass
    float impulse;           ///< N s
  } points[Manifold::kMostPoints]{};
};

/// In the order of parts; none where this Jolt is another, or where its bytes are not what they should be.
[[nodiscard]] std::vector<SavedManifold> saved_contacts(const JPH::PhysicsSystem& system);

/// Null: Jolt has none of these parts.
[[nodiscard]] const SavedManifold* find(const std::vector<SavedManifold>& manifolds, const JPH::SubShapeIDPair& parts);

}  // namespace plumb::jolt
