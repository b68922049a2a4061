// The pair's coefficients, as every backend understands them: friction sqrt(mu_a mu_b), restitution max(e_a, e_b).
#pragma once

#include "body.hpp"

namespace plumb::bullet {

/// Puts our rules into Bullet's global callbacks. They act on our bodies only: others in the process, which belong to a
/// host that uses Bullet by itself, go on to whatever was installed before.
void install_material_callbacks();

/// Whether Bullet must ask for the material of every new contact point of this body: its children have their own.
[[nodiscard]] bool needs_contact_material(const Body& body);

/// Brings the contact points that already exist in line with the bodies' materials.
void refresh_materials(btDispatcher& dispatcher, const Body& body);

/// Directs the friction of conveying bodies' contacts along the slip against their moving surfaces, for this step.
/// Bullet then drives that slip to 0 (its SOLVER_ENABLE_FRICTION_DIRECTION_CACHING mode).
void apply_surface_velocities(btDispatcher& dispatcher);

}  // namespace plumb::bullet
