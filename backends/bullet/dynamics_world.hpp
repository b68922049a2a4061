// Bullet's world with its step cut into the pieces that we must reach: kinematic bodies move between sub-steps, locks
// and breaking joints act between the solver and the integration, and each phase is timed.
#pragma once

#include <array>
#include <chrono>
#include <memory>

#include "bullet_math.hpp"

namespace plumb::bullet {

struct CollisionOptions {
  bool epa;        ///< depth by EPA, else by sampling directions (btMinkowskiPenetrationDepthSolver)
  int multipoint;  ///< extra perturbed GJK runs for pairs that get one point a step
};

/// Bullet's dispatcher with the contact breaking threshold as a number of its own: Bullet keeps it in a global.
class Dispatcher final : public btCollisionDispatcher {
 public:
  using btCollisionDispatcher::btCollisionDispatcher;
  btPersistentManifold* getNewManifold(const btCollisionObject* a, const btCollisionObject* b) override;

  btScalar breaking_threshold = gContactBreakingThreshold;  ///< m, scaled down for small shapes as Bullet does
};

/// The parts that Bullet's world refers to and that must outlive it.
struct WorldParts {
  explicit WorldParts(const CollisionOptions& options);

  btDefaultCollisionConfiguration configuration;
  Dispatcher dispatcher;
  btDbvtBroadphase broadphase;
};

/// What we do in the middle of a step.
class StepHooks {
 public:
  virtual ~StepHooks() = default;
  virtual void before_motion(btScalar h) = 0;  ///< before velocities are damped and motion is predicted
  virtual void before_solve() = 0;             ///< contacts are known
  virtual void after_solve() = 0;              ///< velocities are known, poses are not yet
};

class DynamicsWorld final : public btDiscreteDynamicsWorld {
 public:
  DynamicsWorld(WorldParts& parts, btConstraintSolver& solver, StepHooks& hooks)
      : btDiscreteDynamicsWorld(&parts.dispatcher, &parts.broadphase, &solver, &parts.configuration), hooks_(hooks) {}

  /// The parts of stepSimulation: begin, one sub-step or more, end; a sub-step is two halves, between which contacts
  /// are known. With one sub-step of h this does what stepSimulation(h, 0) does to bodies without motion states.
  void begin_step();
  void find_contacts(btScalar h);
  void respond(btScalar h);
  void end_step() { clearForces(); }

  /// Bullet keeps the contacts that it foresees for CCD bodies until the next step, outside of its pairs, so that
  /// removing a body leaves them pointing at it: to be called after removeRigidBody.
  void forget_predictions(const btCollisionObject& gone);

  /// Seconds by PlumbPhase since begin_step.
  [[nodiscard]] const std::array<double, PLUMB_PHASE_COUNT>& seconds() const { return seconds_; }

  void performDiscreteCollisionDetection() override;
  void solveConstraints(btContactSolverInfo& info) override;

 protected:
  void predictUnconstraintMotion(btScalar h) override;
  void createPredictiveContacts(btScalar h) override;
  void calculateSimulationIslands() override;
  void integrateTransforms(btScalar h) override;

 private:
  using Clock = std::chrono::steady_clock;
  /// Adds the time since the last call to a phase.
  void charge(PlumbPhase phase);

  StepHooks& hooks_;
  Clock::time_point mark_;
  std::array<double, PLUMB_PHASE_COUNT> seconds_{};
};

}  // namespace plumb::bullet
