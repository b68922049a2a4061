// What moves bodies in a step beside Bullet's solver: kinematic targets and velocities, exact damping, locked axes.
#include <cmath>

#include "plumb/assert.hpp"
#include "world.hpp"

namespace plumb::bullet {

/// Bullet derives a kinematic body's velocity from the pose that it has at the beginning of a sub-step and the one of
/// the sub-step before: put it where it must be at the end.
void World::move_kinematic(int sub_steps_left, btScalar h) {
  PLUMB_ASSERT(sub_steps_left > 0 && h > 0);
  for (Body* body : lists_.kinematic) {
    PLUMB_ASSERT(body->is(PLUMB_KINEMATIC));
    const btTransform from = body->getWorldTransform();
    btTransform to = from;
    if (body->has_target) {
      if (sub_steps_left == 1) {
        to = body->target;
      } else {
        btVector3 linear, angular;
        btTransformUtil::calculateVelocity(from, body->target, h * static_cast<btScalar>(sub_steps_left), linear,
                                           angular);
        btTransformUtil::integrateTransform(from, linear, angular, h, to);
      }
    } else if (body->coasting.on) {
      btTransformUtil::integrateTransform(from, body->coasting.linear, body->coasting.angular, h, to);
    }
    if (body->has_target || body->coasting.on) wake(*body);
    body->setInterpolationWorldTransform(from);
    body->setWorldTransform(to);
  }
}

/// Bullet's derived velocity carries the rounding of the poses; a body that coasts keeps its own.
void World::keep_coasting() {
  for (Body* body : lists_.kinematic) {
    if (!body->coasting.on || body->has_target) continue;
    body->setLinearVelocity(body->coasting.linear);
    body->setAngularVelocity(body->coasting.angular);
  }
}

/// dv/dt = -c v, solved exactly.
void World::damp(btScalar h) {
  for (Body* body : lists_.damped) {
    PLUMB_ASSERT(body->is(PLUMB_DYNAMIC));
    body->setLinearVelocity(body->getLinearVelocity() *
                            static_cast<btScalar>(std::exp(-body->linear_damping * static_cast<double>(h))));
    body->setAngularVelocity(body->getAngularVelocity() *
                             static_cast<btScalar>(std::exp(-body->angular_damping * static_cast<double>(h))));
  }
}

/// Bullet's factors keep impulses off locked axes, but not the gyroscopic term.
void World::hold_locks() {
  for (Body* body : lists_.locked) {
    body->setLinearVelocity(body->getLinearVelocity() * body->getLinearFactor());
    body->setAngularVelocity(body->getAngularVelocity() * body->getAngularFactor());
  }
}

}  // namespace plumb::bullet
