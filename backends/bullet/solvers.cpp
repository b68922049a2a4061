#include "solvers.hpp"

#include <BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btLemkeSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>

#include <algorithm>

namespace plumb::bullet {
namespace {

/// Keeps the worst residual of the islands, which Bullet solves one after the other.
template <class Solver>
class WorstResidual final : public Solver {
 public:
  using Solver::Solver;

  btScalar solveGroup(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds, int manifold_count,
                      btTypedConstraint** constraints, int constraint_count, const btContactSolverInfo& info,
                      btIDebugDraw* drawer, btDispatcher* dispatcher) override {
    const btScalar result = Solver::solveGroup(bodies, body_count, manifolds, manifold_count, constraints,
                                               constraint_count, info, drawer, dispatcher);
    worst = std::max(worst, static_cast<double>(this->m_leastSquaresResidual));
    return result;
  }

  double worst = 0;
};

template <class Solver>
class Iterative final : public TrackedSolver {
 public:
  btConstraintSolver& solver() override { return solver_; }
  void begin_step() override { solver_.worst = 0; }
  [[nodiscard]] double residual() const override { return solver_.worst; }
  [[nodiscard]] bool fell_back() const override { return false; }

 private:
  WorstResidual<Solver> solver_;
};

template <class Direct>
class Mlcp final : public TrackedSolver {
 public:
  btConstraintSolver& solver() override { return solver_; }
  void begin_step() override { solver_.setNumFallbacks(0); }
  [[nodiscard]] double residual() const override { return std::numeric_limits<double>::quiet_NaN(); }
  [[nodiscard]] bool fell_back() const override { return solver_.getNumFallbacks() > 0; }

 private:
  Direct direct_;
  btMLCPSolver solver_{&direct_};
};

}  // namespace

std::unique_ptr<TrackedSolver> make_solver(SolverKind kind) {
  switch (kind) {
    case SolverKind::Nncg: return std::make_unique<Iterative<btNNCGConstraintSolver>>();
    case SolverKind::MlcpDantzig: return std::make_unique<Mlcp<btDantzigSolver>>();
    case SolverKind::MlcpLemke: return std::make_unique<Mlcp<btLemkeSolver>>();
    default: return std::make_unique<Iterative<btSequentialImpulseConstraintSolver>>();
  }
}

}  // namespace plumb::bullet
