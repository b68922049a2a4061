// FCLIB's own reader and writer (https://github.com/FrictionalContactLibrary/fclib).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "reference/contact_problem.hpp"

namespace plumb::reference::testing {

/// A local problem as FCLIB's library has it, every matrix dense.
struct LocalProblem {
  int spacedim = 3;
  Eigen::MatrixXd w, v, r;  ///< v and r of no size: there are no equations
  Eigen::VectorXd q, mu, s;
  std::string title, description, math_info;

  [[nodiscard]] ContactProblem contacts() const { return {w, q, mu}; }
};

struct ReadFile {
  LocalProblem problem;
  std::optional<Eigen::VectorXd> impulse, velocity;
  std::optional<double> merit;  ///< FCLIB's MERIT_1 of the solution in the file
};

/// Throws std::runtime_error where FCLIB cannot read the problem. The library ends the whole program where a part that
/// it asks for is missing, a solution as well: so it must be said whether there is one.
[[nodiscard]] ReadFile read_by_fclib(const std::filesystem::path& file, bool with_solution);

/// Matrices by triplets (nz of FCLIB is their number), by columns or by rows. Throws std::runtime_error where FCLIB
/// cannot write.
enum class Layout { triplets, columns, rows };
void write_by_fclib(const LocalProblem& problem, Layout layout, const std::filesystem::path& file);

}  // namespace plumb::reference::testing
