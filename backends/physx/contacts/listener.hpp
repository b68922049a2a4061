// What PhysX tells of contacts after a step.
#pragma once

#include <span>
#include <vector>

#include "body.hpp"

namespace plumb::px {

/// PhysX calls it on the thread that waits for the step.
class Listener final : public PxSimulationEventCallback {
 public:
  void forget_all() { contacts_.clear(); }
  /// After a step: in an order that does not depend on threads.
  void finish_step();
  [[nodiscard]] std::span<const PlumbContact> contacts() const { return contacts_; }

  void onContact(const PxContactPairHeader& header, const PxContactPair* pairs, PxU32 count) override;
  void onConstraintBreak(PxConstraintInfo*, PxU32) override {}
  void onWake(PxActor**, PxU32) override {}
  void onSleep(PxActor**, PxU32) override {}
  void onTrigger(PxTriggerPair*, PxU32) override {}
  void onAdvance(const PxRigidBody* const*, const PxTransform*, const PxU32) override {}

 private:
  static constexpr PxU32 kMostAnchors = 64;  ///< of a pair of shapes

  void add(const PxContactPair& pair);

  std::vector<PlumbContact> contacts_;
  std::vector<PxContactPairPoint> points_;
  std::vector<PxContactPairFrictionAnchor> anchors_;
};

}  // namespace plumb::px
