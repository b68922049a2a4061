// A body: PhysX's actor, and beside it what the interface knows and PhysX does not.
#pragma once

#include <memory>
#include <vector>

#include "shapes.hpp"

namespace plumb::px {

struct Body;

/// What a shape of an actor stands for; its user data point here.
struct Part {
  const Body* body = nullptr;
  const Piece* piece = nullptr;
};

struct Body {
  /// Of a kinematic body: with its velocity, to its target in the next step, or having come there by the last one.
  enum class Moving : std::uint8_t { as_told, to_target, arrived };

  PlumbBody handle = 0;
  PxRigidActor* actor = nullptr;  ///< its user data point back here
  PlumbBodyDesc desc{};           ///< material, filter, damping as they are now; of a kinematic one velocities, too
  const Shape* shape = nullptr;
  std::vector<std::unique_ptr<Part>> parts;
  Moving moving = Moving::as_told;
  PlumbPose target{};
  bool was_asleep = false;  ///< after the step before

  [[nodiscard]] bool is(PlumbMotion motion) const { return desc.motion == motion; }
  [[nodiscard]] bool is_sensor() const { return (desc.flags & PLUMB_BODY_SENSOR) != 0; }
  /// Of those that are not static.
  [[nodiscard]] PxRigidDynamic& dynamic() const { return static_cast<PxRigidDynamic&>(*actor); }
  [[nodiscard]] bool asleep() const { return is(PLUMB_DYNAMIC) && dynamic().isSleeping(); }
  [[nodiscard]] PlumbPose pose() const { return to_plumb(actor->getGlobalPose()); }
  [[nodiscard]] const PlumbMaterial& material_of(const Piece& piece) const {
    return piece.has_material ? piece.material : desc.material;
  }
};

[[nodiscard]] inline const Part& part_of(const PxShape& shape) { return *static_cast<const Part*>(shape.userData); }

}  // namespace plumb::px
