#include "siconos_solver.hpp"

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>

#include <memory>

namespace plumb::reference::testing {

SecondOpinion solve_by_siconos(const ContactProblem& problem, Method method) {
  // Its solvers take W's entries to be of size 1: so the unit of mass is the one in which they are.
  const double unit = static_cast<double>(problem.q.size()) / problem.w.trace();
  ContactProblem given = problem;
  given.w *= unit;
  const int size = static_cast<int>(given.q.size());

  const auto free_matrix = [](NumericsMatrix* matrix) {
    NM_clear(matrix);
    free(matrix);
  };
  const std::unique_ptr<NumericsMatrix, decltype(free_matrix)> matrix(NM_create(NM_DENSE, size, size), free_matrix);
  std::copy_n(given.w.data(), given.w.size(), matrix->matrix0);
  FrictionContactProblem wanted{3, static_cast<int>(given.contacts()), matrix.get(), given.q.data(), given.mu.data()};

  const int solver = method == Method::gauss_seidel ? SICONOS_FRICTION_3D_NSGS : SICONOS_FRICTION_3D_PROX;
  const std::unique_ptr<::SolverOptions, decltype(&solver_options_delete)> options(solver_options_create(solver),
                                                                                   solver_options_delete);
  options->dparam[SICONOS_DPARAM_TOL] = 1e-12;
  options->iparam[SICONOS_IPARAM_MAX_ITER] = method == Method::gauss_seidel ? 10000 : 1000;
  SecondOpinion opinion;
  opinion.impulse.setZero(size);
  Eigen::VectorXd velocity = Eigen::VectorXd::Zero(size);
  opinion.converged = fc3d_driver(&wanted, opinion.impulse.data(), velocity.data(), options.get()) == 0;
  opinion.impulse *= unit;
  return opinion;
}

}  // namespace plumb::reference::testing
