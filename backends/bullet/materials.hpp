// The pair's coefficients, as every backend understands them: friction sqrt(mu_a mu_b), restitution
// max(e_a, e_b), rolling and spinning friction the larger.
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

/// Of one manifold.
void refresh_materials(btPersistentManifold& manifold);

/// By how much b's surface runs over a's while both stand, m/s.
[[nodiscard]] btVector3 surface_velocity_between(const Body& a, const Body& b);
/// Directs the friction of a manifold along the slip against surfaces that run so, for this step.
void run_surface(btPersistentManifold& manifold, const btVector3& b_over_a);
/// Its friction goes where Bullet wants it to again.
void stop_surface(btPersistentManifold& manifold);
/// Directs the friction of conveying bodies' contacts along the slip against their moving surfaces, for this step.
/// Bullet then drives that slip to 0 (its SOLVER_ENABLE_FRICTION_DIRECTION_CACHING mode).
void apply_surface_velocities(btDispatcher& dispatcher);

}  // namespace plumb::bullet
