// From a descriptor to PhysX's actor.
#pragma once

#include "body.hpp"
#include "materials.hpp"
#include "settings.hpp"

namespace plumb::px {

/// What all bodies of a world have in common.
struct Common {
  PlumbNeeds needs;
  Settings settings;
  Materials materials;

  Common(PlumbNeeds declared, const Settings& chosen)
      : needs(declared), settings(chosen), materials(chosen.friction.strong) {}
  [[nodiscard]] bool needs_any(PlumbNeeds bits) const { return (needs & bits) != 0; }
};

/// Throws Error for numbers that PhysX cannot hold.
void check_body(const PlumbBodyDesc& desc);

/// Makes the actor of a body from its descriptor and shape, and its parts. It is in no scene yet. desc: checked;
/// dynamic bodies with their mass.
void make_actor(Body& body, Common& common);
void release_actor(Body& body);
/// Gives an actor the pieces that its shape has by now.
void attach_anew(Body& body, Common& common);

/// Puts the descriptor's numbers into its actor.
void put_material(const Body& body, Common& common);
void put_gravity(const Body& body);
void put_damping(const Body& body);

/// Velocities along what is locked are gone.
struct Velocity {
  PlumbVec3 linear, angular;
};
[[nodiscard]] Velocity unlocked(const PlumbBodyDesc& desc, Velocity velocity);
void put_velocity(const Body& body, const Velocity& velocity);

}  // namespace plumb::px
