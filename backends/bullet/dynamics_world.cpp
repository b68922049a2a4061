#include "dynamics_world.hpp"

#include <algorithm>

#include "moving_mesh.hpp"

namespace plumb::bullet {
namespace {

btDefaultCollisionConstructionInfo construction(const CollisionOptions& options) {
  btDefaultCollisionConstructionInfo info;
  info.m_useEpaPenetrationAlgorithm = options.epa ? 1 : 0;
  return info;
}

}  // namespace

btPersistentManifold* Dispatcher::getNewManifold(const btCollisionObject* a, const btCollisionObject* b) {
  btPersistentManifold* manifold = btCollisionDispatcher::getNewManifold(a, b);
  if (breaking_threshold != gContactBreakingThreshold)
    manifold->setContactBreakingThreshold(
        std::min(a->getCollisionShape()->getContactBreakingThreshold(breaking_threshold),
                 b->getCollisionShape()->getContactBreakingThreshold(breaking_threshold)));
  return manifold;
}

WorldParts::WorldParts(const CollisionOptions& options)
    : configuration(construction(options)), dispatcher(&configuration) {
  collide_moving_meshes(dispatcher);
  if (options.multipoint > 0) {
    configuration.setConvexConvexMultipointIterations(options.multipoint, options.multipoint);
    configuration.setPlaneConvexMultipointIterations(options.multipoint, options.multipoint);
  }
}

void DynamicsWorld::charge(PlumbPhase phase) {
  const Clock::time_point now = Clock::now();
  seconds_[phase] += std::chrono::duration<double>(now - mark_).count();
  mark_ = now;
}

void DynamicsWorld::begin_step() {
  seconds_.fill(0);
  mark_ = Clock::now();
  applyGravity();
}

/// These two are internalSingleStepSimulation, which calls nobody in between.
void DynamicsWorld::find_contacts(btScalar h) {
  saveKinematicState(h);
  predictUnconstraintMotion(h);
  btDispatcherInfo& info = getDispatchInfo();
  info.m_timeStep = h;
  info.m_stepCount = 0;
  info.m_debugDraw = getDebugDrawer();
  createPredictiveContacts(h);
  performDiscreteCollisionDetection();
}

void DynamicsWorld::respond(btScalar h) {
  mark_ = Clock::now();  // the host may have been at work
  calculateSimulationIslands();
  getSolverInfo().m_timeStep = h;
  solveConstraints(getSolverInfo());
  integrateTransforms(h);
  updateActions(h);
  updateActivationState(h);
  charge(PLUMB_PHASE_ISLANDS);
}

void DynamicsWorld::predictUnconstraintMotion(btScalar h) {
  hooks_.before_motion(h);
  btDiscreteDynamicsWorld::predictUnconstraintMotion(h);
  charge(PLUMB_PHASE_INTEGRATE);
}

void DynamicsWorld::createPredictiveContacts(btScalar h) {
  btDiscreteDynamicsWorld::createPredictiveContacts(h);
  charge(PLUMB_PHASE_CONTINUOUS);
}

void DynamicsWorld::forget_predictions(const btCollisionObject& gone) {
  for (int i = m_predictiveManifolds.size() - 1; i >= 0; --i) {
    btPersistentManifold* manifold = m_predictiveManifolds[i];
    if (manifold->getBody0() != &gone && manifold->getBody1() != &gone) continue;
    m_predictiveManifolds.swap(i, m_predictiveManifolds.size() - 1);
    m_predictiveManifolds.pop_back();
    m_dispatcher1->releaseManifold(manifold);
  }
}

void DynamicsWorld::performDiscreteCollisionDetection() {
  updateAabbs();
  computeOverlappingPairs();
  charge(PLUMB_PHASE_BROAD);
  m_dispatcher1->dispatchAllCollisionPairs(m_broadphasePairCache->getOverlappingPairCache(), getDispatchInfo(),
                                           m_dispatcher1);
  charge(PLUMB_PHASE_NARROW);
}

void DynamicsWorld::calculateSimulationIslands() {
  btDiscreteDynamicsWorld::calculateSimulationIslands();
  charge(PLUMB_PHASE_ISLANDS);
}

void DynamicsWorld::solveConstraints(btContactSolverInfo& info) {
  hooks_.before_solve();
  btDiscreteDynamicsWorld::solveConstraints(info);
  hooks_.after_solve();
  charge(PLUMB_PHASE_SOLVE);
}

void DynamicsWorld::integrateTransforms(btScalar h) {
  btDiscreteDynamicsWorld::integrateTransforms(h);
  charge(PLUMB_PHASE_INTEGRATE);
}

}  // namespace plumb::bullet
