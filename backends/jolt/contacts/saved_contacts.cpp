#include "contacts/saved_contacts.hpp"

#include <Jolt/Math/Vector.h>
#include <Jolt/Physics/Body/BodyPair.h>
#include <Jolt/Physics/PhysicsSystem.h>

#include <algorithm>

#include "recorder.hpp"

namespace plumb::jolt {
namespace {

/// As ContactConstraintManager::ManifoldCache::SaveState writes it.
SavedManifold read_manifold(Recorder& from) {
  SavedManifold manifold;
  JPH::uint16 count = 0;
  JPH::Vector<2> friction;
  from.Read(manifold.parts);
  from.Read(count);
  from.Read(manifold.normal);
  from.Read(friction);
  from.Read(manifold.torsion);
  manifold.friction[0] = friction[0];
  manifold.friction[1] = friction[1];
  manifold.count = std::min<std::size_t>(count, Manifold::kMostPoints);
  for (std::size_t i = 0; i < manifold.count; ++i) {
    from.Read(manifold.points[i].in_a);
    from.Read(manifold.points[i].in_b);
    from.Read(manifold.points[i].impulse);
  }
  return manifold;
}

std::vector<SavedManifold> read_pairs(Recorder& from) {
  JPH::EStateRecorderState what{};
  JPH::uint32 pairs = 0, swept = 0;
  from.Read(what);
  from.Read(pairs);
  std::vector<SavedManifold> manifolds;
  for (JPH::uint32 i = 0; i < pairs && !from.IsFailed(); ++i) {
    JPH::BodyPair bodies;
    JPH::Float3 moved, turned;
    JPH::uint32 count = 0;
    from.Read(bodies);
    from.Read(moved);
    from.Read(turned);
    from.Read(count);
    for (JPH::uint32 k = 0; k < count && !from.IsFailed(); ++k) manifolds.push_back(read_manifold(from));
  }
  from.Read(swept);
  if (from.IsFailed() || from.rest().size() != swept * sizeof(JPH::SubShapeIDPair)) manifolds.clear();
  return manifolds;
}

}  // namespace

std::vector<SavedManifold> saved_contacts(const JPH::PhysicsSystem& system) {
  if (!kReadsSavedContacts) return {};
  std::vector<std::byte> bytes;
  Recorder to(bytes);
  system.SaveState(to, JPH::EStateRecorderState::Contacts);
  Recorder from{std::span<const std::byte>(bytes)};
  std::vector<SavedManifold> manifolds = read_pairs(from);
  std::sort(manifolds.begin(), manifolds.end(),
            [](const SavedManifold& a, const SavedManifold& b) { return a.parts < b.parts; });
  return manifolds;
}

const SavedManifold* find(const std::vector<SavedManifold>& manifolds, const JPH::SubShapeIDPair& parts) {
  const auto at = std::lower_bound(manifolds.begin(), manifolds.end(), parts,
                                   [](const SavedManifold& a, const JPH::SubShapeIDPair& b) { return a.parts < b; });
  return at != manifolds.end() && at->parts == parts ? &*at : nullptr;
}

}  // namespace plumb::jolt
