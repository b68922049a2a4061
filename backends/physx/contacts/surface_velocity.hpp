// Surfaces that run while their bodies stand: what PhysX is told of the contacts of such bodies before it solves them.
#pragma once

#include "body.hpp"

namespace plumb::px {

/// PhysX calls it from several threads.
class SurfaceVelocities final : public PxContactModifyCallback {
 public:
  void onContactModify(PxContactModifyPair* pairs, PxU32 count) override;
};

}  // namespace plumb::px
