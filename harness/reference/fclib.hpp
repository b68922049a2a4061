// Contact problems in the HDF5 layout of FCLIB, the collection of test problems for contact solvers
// (https://github.com/FrictionalContactLibrary/fclib; Acary et al. 2014, "FCLIB: a collection of discrete 3D frictional
// contact problems", Inria RT-0444):
//   /fclib_local/spacedim            2 or 3
//   /fclib_local/W/{m n nz nzmax p i x}   sparse: nz >= 0 triplets (p rows, i columns), -1 by columns, -2 by rows
//   /fclib_local/{V R}               likewise, where equations V' r + R l + s = 0 are part of the problem
//   /fclib_local/vectors/{q mu s}
//   /fclib_local/info/{title description math_info}
//   /solution/{u r}                  where a solution is known
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "reference/contact_problem.hpp"

namespace plumb::reference {

/// More would take W more memory than a machine has, and the solver hours.
constexpr int most_contacts = 2000;

struct FclibProblem {
  /// Always of three rows a contact: plane problems (spacedim 2) get a second tangent that nothing pushes. Equations
  /// are solved for l, which leaves W - V R^-1 V' and q - V R^-1 s.
  ContactProblem problem;
  int spacedim = 3;
  std::string title, description, math_info;  ///< "" where the file has none
  std::optional<Eigen::VectorXd> impulse;     ///< the solution's r, three a contact
};

/// Throws std::runtime_error that names the file and what is wrong with it: no such file, not HDF5, a global problem, a
/// group or data set that is missing, sizes that do not fit, a singular R, more than 2000 contacts.
[[nodiscard]] FclibProblem read_fclib(const std::filesystem::path& file);

/// All of the file of a local problem, with its solution where there is one.
[[nodiscard]] std::string fclib_bytes(const FclibProblem& problem);

}  // namespace plumb::reference
