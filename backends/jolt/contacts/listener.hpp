// What Jolt tells of contacts while it steps: where bodies touch, before that is solved.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Physics/Collision/ContactListener.h>
#include <Jolt/Physics/PhysicsStepListener.h>

#include <mutex>
#include <span>
#include <vector>

#include "body.hpp"

namespace plumb::jolt {

/// Up to four points with one normal.
struct Manifold {
  static constexpr std::size_t kMostPoints = 4;

  const Body* a = nullptr;
  const Body* b = nullptr;
  JPH::SubShapeIDPair parts;
  JPH::Vec3 normal;  ///< from a to b
  std::size_t count = 0;
  PlumbVec3 on_a[kMostPoints]{}, on_b[kMostPoints]{};

  [[nodiscard]] double depth(std::size_t point) const;
  [[nodiscard]] double deepest() const;
  /// They overlap, or no more is between them than Jolt calls nothing.
  [[nodiscard]] bool touches() const;
};

/// Jolt calls it from several threads.
class Listener final : public JPH::ContactListener, public JPH::PhysicsStepListener {
 public:
  /// keeps: manifolds; moves: surfaces have velocities of their own.
  Listener(bool keeps, bool moves) : keeps_(keeps), moves_(moves) {}

  [[nodiscard]] bool is_asked() const { return keeps_ || moves_; }
  void forget_all() { found_.clear(); }
  /// After a step: in an order that does not depend on threads, each pair of parts once.
  void finish_step();
  /// Of the last step, or of its last part.
  [[nodiscard]] std::span<const Manifold> manifolds() const { return found_; }

  void OnStep(const JPH::PhysicsStepListenerContext& /*context*/) override { forget_all(); }
  void OnContactAdded(const JPH::Body& a, const JPH::Body& b, const JPH::ContactManifold& manifold,
                      JPH::ContactSettings& settings) override {
    look_at(a, b, manifold, settings);
  }
  void OnContactPersisted(const JPH::Body& a, const JPH::Body& b, const JPH::ContactManifold& manifold,
                          JPH::ContactSettings& settings) override {
    look_at(a, b, manifold, settings);
  }

 private:
  void look_at(const JPH::Body& a, const JPH::Body& b, const JPH::ContactManifold& manifold,
               JPH::ContactSettings& settings);

  bool keeps_, moves_;
  std::mutex mutex_;
  std::vector<Manifold> found_;
};

}  // namespace plumb::jolt
