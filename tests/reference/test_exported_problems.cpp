// What `plumb problem` writes, read by FCLIB's own library and solved once more by Siconos.
#include <gtest/gtest.h>

#include "agreement.hpp"
#include "fclib_library.hpp"
#include "program.hpp"
#include "reference/fclib.hpp"
#include "reference/solver.hpp"
#include "siconos_solver.hpp"

namespace plumb::reference::testing {
namespace {

using harness::testing::Finished;
using harness::testing::fresh_folder;

struct Step {
  std::vector<std::string> scene;  ///< and its parameters
  int steps = 0;                   ///< of the first backend that was built
};

/// Towers at rest and on the point of sliding, arches, cards, a ladder, slopes, a belt, a rod, balls; and what an
/// engine has made of some of them after a third of a second.
std::vector<Step> steps() {
  std::vector<Step> list{{{"C1"}},         {{"C1", "friction=0"}},
                         {{"C3"}},         {{"C5"}},
                         {{"C7"}},         {{"C9"}},
                         {{"C10"}},        {{"C11"}},
                         {{"D1", "H=5"}},  {{"D1", "H=10"}},
                         {{"D3"}},         {{"D3", "R=1000"}},
                         {{"D5"}},         {{"D6"}},
                         {{"D7"}},         {{"D7", "mu=0.3"}},
                         {{"D7", "mu=0"}}, {{"D8"}},
                         {{"D10"}},        {{"D10", "storeys=3"}},
                         {{"D13"}},        {{"I11"}},
                         {{"I12"}},        {{"I28"}}};
  if (std::string(FIRST_BACKEND).empty()) return list;
  for (const char* scene : {"C1", "C5", "D3", "D5", "D7", "D10", "I12"}) list.push_back({{scene}, 20});
  return list;
}

/// Both of Siconos's methods against ours. Where one of them does not get there the other has to. With friction bodies
/// may have several velocities after a step, as a cube whose weight on its four corners decides how its spin is braked:
/// where the two differ each must be an answer. The number of such differences.
int differences(const ContactProblem& problem, const std::string& name) {
  const Solution ours = solve(problem);
  EXPECT_LT(ours.residual.natural_map, 1e-6) << name;
  int opinions = 0, different = 0;
  for (const Method method : {Method::gauss_seidel, Method::proximal_newton}) {
    const SecondOpinion theirs = solve_by_siconos(problem, method);
    if (!theirs.converged) continue;
    ++opinions;
    EXPECT_LT(residual(problem, theirs.impulse).natural_map, 1e-9) << name;
    const double difference = difference_of_velocities(problem, ours.impulse, theirs.impulse);
    if (difference < 1e-6) continue;
    EXPECT_TRUE(ours.converged && problem.mu.maxCoeff() > 0) << name << ": " << difference;
    ++different;
  }
  EXPECT_GT(opinions, 0) << name;
  return different;
}

TEST(ExportedProblems, AreReadByFclibAndSolvedAlikeBySiconos) {
  const std::filesystem::path file = fresh_folder("exported") / "step.hdf5";
  int different = 0;
  for (const Step& step : steps()) {
    std::vector<std::string> arguments{"problem", step.scene.front(), "--out", file.string(), "--json"};
    std::string name = step.scene.front() + ", step " + std::to_string(step.steps);
    for (std::size_t i = 1; i < step.scene.size(); ++i) {
      arguments.insert(arguments.end(), {"--param", step.scene[i]});
      name += ", " + step.scene[i];
    }
    if (step.steps > 0)
      arguments.insert(arguments.end(), {"--backend", FIRST_BACKEND, "--step", std::to_string(step.steps)});
    const Finished written = harness::testing::plumb(arguments);
    ASSERT_EQ(written.status, 0) << name << ": " << written.err;
    const harness::Json row = written.rows().at(0);
    const auto contacts = row.at("contacts").get<Eigen::Index>();
    ASSERT_GT(contacts, 0) << name;
    // Bodies that an engine left on the brink of sliding may be too hard for 1e-10; then the file has no solution.
    const bool solved = row.at("converged").get<bool>();
    EXPECT_TRUE(solved || step.steps > 0) << name;

    const ReadFile read = read_by_fclib(file, solved);
    EXPECT_EQ(read.problem.spacedim, 3) << name;
    EXPECT_EQ(read.problem.title.substr(0, step.scene.front().size()), step.scene.front());
    EXPECT_EQ(read.problem.math_info.substr(0, 3), "dt ") << name;
    EXPECT_EQ(read.problem.r.size(), 0) << name;
    ContactProblem problem = read.problem.contacts();
    ASSERT_EQ(problem.contacts(), contacts) << name;
    EXPECT_NO_THROW(problem.check()) << name;
    const FclibProblem own = read_fclib(file);
    EXPECT_EQ(own.problem.w, problem.w) << name;
    EXPECT_EQ(own.problem.q, problem.q) << name;
    EXPECT_EQ(own.problem.mu, problem.mu) << name;

    if (solved) {
      ASSERT_TRUE(read.impulse && read.velocity && read.merit) << name;
      EXPECT_LT(residual(problem, *read.impulse).natural_map, 1e-10) << name;
      EXPECT_LT((problem.velocity(*read.impulse) - *read.velocity).norm(), 1e-12 * problem.q.norm()) << name;
      EXPECT_LT(*read.merit, 1e-9) << name;
    }
    different += differences(problem, name);
    problem.mu.setZero();
    EXPECT_EQ(differences(problem, name + ", without friction"), 0);
  }
  EXPECT_LE(different, 4);
}

}  // namespace
}  // namespace plumb::reference::testing
