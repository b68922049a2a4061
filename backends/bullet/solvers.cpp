#include "solvers.hpp"

#include <BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btLemkeSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>

#include <algorithm>

namespace plumb::bullet {
namespace {

/// Counts over the islands, which Bullet solves one after the other: the points and the worst residual.
template <class Solver>
class Counting final : public Solver {
 public:
  using Solver::Solver;

  btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int body_count,
                                         const btContactSolverInfo& info) override {
    contacts += static_cast<std::uint32_t>(this->m_tmpSolverContactConstraintPool.size());
    worst = std::max(worst, static_cast<double>(this->m_leastSquaresResidual));
    return Solver::solveGroupCacheFriendlyFinish(bodies, body_count, info);
  }

  std::uint32_t contacts = 0;
  double worst = 0;
};

template <class Solver>
class Iterative final : public TrackedSolver {
 public:
  btConstraintSolver& solver() override { return solver_; }
  void begin_step() override { solver_.worst = 0; }
  void begin_sub_step() override { solver_.contacts = 0; }
  [[nodiscard]] std::uint32_t contacts() const override { return solver_.contacts; }
  [[nodiscard]] double residual() const override { return solver_.worst; }
  [[nodiscard]] bool fell_back() const override { return false; }

 private:
  Counting<Solver> solver_;
};

template <class Direct>
class Mlcp final : public TrackedSolver {
 public:
  btConstraintSolver& solver() override { return solver_; }
  void begin_step() override { solver_.setNumFallbacks(0); }
  void begin_sub_step() override { solver_.contacts = 0; }
  [[nodiscard]] std::uint32_t contacts() const override { return solver_.contacts; }
  [[nodiscard]] double residual() const override { return std::numeric_limits<double>::quiet_NaN(); }
  [[nodiscard]] bool fell_back() const override { return solver_.getNumFallbacks() > 0; }

 private:
  Direct direct_;
  Counting<btMLCPSolver> solver_{&direct_};
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
