// The exact step of scenes at their start, whose forces are known.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "measure/instruments/reference_score.hpp"
#include "measure/instruments/step_contacts.hpp"
#include "reference/fclib.hpp"
#include "reference/solver.hpp"

namespace plumb::harness {
namespace {

struct Step {
  Scene scene;
  StepContacts contacts;
  std::vector<referee::BodyState> before;
  reference::StepProblem problem;
  reference::Solution solution;

  explicit Step(const Scene& given)
      : scene(given),
        contacts(scene),
        before(start()),
        problem(contacts.problem(before)),
        solution(reference::solve(problem.problem())) {}

  [[nodiscard]] std::vector<referee::BodyState> start() const {
    std::vector<referee::BodyState> states;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const PlumbBodyDesc& body = scene.bodies[i].desc;
      states.push_back({contacts.masses()[i], referee::pose(body.pose), referee::vec(body.linear_velocity),
                        referee::vec(body.angular_velocity)});
    }
    return states;
  }
  [[nodiscard]] Eigen::Vector3d velocity(std::size_t body) const {
    return problem.velocity_after(solution.impulse).segment<3>(6 * static_cast<Eigen::Index>(body));
  }
  /// On a body, relative to a weight in a step.
  [[nodiscard]] Eigen::Vector3d given(std::size_t body, double mass) const {
    return problem.impulse_on_bodies(solution.impulse).segment<3>(6 * static_cast<Eigen::Index>(body)) /
           (mass * 9.81 * scene.dt);
  }
};

SceneFile file_of(const std::string& name) {
  return SceneFile::load(std::filesystem::path(PLUMB_SCENES_FOLDER) / name);
}

TEST(StepContacts, FourSpheresRestAboveTheCriticalFriction) {
  const SceneFile file = file_of("stacking/D7-four-spheres.json");
  const Step stands(file.instantiate({{"mu", 0.34}}));
  ASSERT_TRUE(stands.solution.converged);
  EXPECT_EQ(stands.problem.contacts().size(), 9u);
  const double mass = stands.contacts.masses()[1].mass;
  for (std::size_t body = 1; body < 5; ++body) EXPECT_LT(stands.velocity(body).norm(), 1e-10) << body;
  EXPECT_LT((stands.given(0, mass) - Eigen::Vector3d(0, -4, 0)).norm(), 1e-9);
  EXPECT_LT((stands.given(4, mass) - Eigen::Vector3d(0, 1, 0)).norm(), 1e-9);
  const Step slides(file.instantiate({{"mu", 0.3}}));
  ASSERT_TRUE(slides.solution.converged);
  EXPECT_LT(slides.velocity(4).y(), -1e-4);
  // What is symmetric stays so: the lower three part alike, the top falls straight.
  EXPECT_LT(slides.velocity(4).cross(Eigen::Vector3d::UnitY()).norm(), 1e-10);
  EXPECT_NEAR(slides.velocity(1).norm(), slides.velocity(2).norm(), 1e-10);
  EXPECT_NEAR(slides.velocity(1).norm(), slides.velocity(3).norm(), 1e-10);
}

TEST(StepContacts, FourSpheresThroughAFile) {
  const Step step(file_of("stacking/D7-four-spheres.json").instantiate({{"mu", 0.3}}));
  const auto path = std::filesystem::path(::testing::TempDir()) / "plumb-d7.hdf5";
  reference::FclibProblem file;
  file.problem = step.problem.problem();
  file.impulse = step.solution.impulse;
  std::ofstream(path, std::ios::binary) << reference::fclib_bytes(file);
  const reference::FclibProblem read = reference::read_fclib(path);
  const reference::Solution again = reference::solve(read.problem);
  ASSERT_TRUE(again.converged);
  const double size = step.solution.impulse.norm();
  EXPECT_LT((again.impulse - step.solution.impulse).norm() / size, 1e-10);
  EXPECT_LT((*read.impulse - step.solution.impulse).norm() / size, 1e-10);
  EXPECT_LT((again.velocity - step.solution.velocity).norm(), 1e-10);
}

TEST(StepContacts, ACubeOnASlopeStaysOrGainsWhatFrictionLeaves) {
  const SceneFile file = file_of("friction/C1-incline.json");
  for (const double angle : {26.0, 30.0}) {
    const Step step(file.instantiate({{"slope", angle}}));
    ASSERT_TRUE(step.solution.converged);
    EXPECT_EQ(step.problem.contacts().size(), 4u);
    const double radians = angle * std::numbers::pi / 180;
    const double gained = 9.81 * step.scene.dt * std::max(0.0, std::sin(radians) - 0.5 * std::cos(radians));
    EXPECT_NEAR(step.velocity(step.scene.body("box")).norm(), gained, 1e-9) << angle;
  }
}

TEST(StepContacts, ATowerRests) {
  const Step step(file_of("stacking/D1-tower.json").instantiate({{"H", 10.0}}));
  ASSERT_TRUE(step.solution.converged);
  EXPECT_EQ(step.problem.contacts().size(), 40u);
  for (std::size_t body = 0; body < step.before.size(); ++body) EXPECT_LT(step.velocity(body).norm(), 1e-8) << body;
}

TEST(StepContacts, SaysWhatIsOutOfReach) {
  EXPECT_EQ(StepContacts(file_of("integrator/A7-pendulum.json").instantiate({})).obstacle(), "it has joints");
  EXPECT_NE(StepContacts(file_of("friction/C8-force-ramp.json").instantiate({})).obstacle(), "");
  EXPECT_NE(StepContacts(file_of("friction/C3-slide-to-roll.json").instantiate({{"kind", "cylinder"}})).obstacle(), "");
}

using Verdict = StepErrors::Verdict;

TEST(ReferenceScore, TheExactStepHasNoErrorAndNoContactsHaveOne) {
  const Step step(file_of("stacking/D1-tower.json").instantiate({{"H", 3.0}}));
  const Eigen::VectorXd exact = step.problem.velocity_after(step.solution.impulse);
  const Eigen::VectorXd told = step.problem.impulse_on_bodies(step.solution.impulse);
  std::vector<referee::BodyState> after = step.before, falling = step.before;
  for (std::size_t i = 0; i < after.size(); ++i) {
    after[i].linear = exact.segment<3>(6 * static_cast<Eigen::Index>(i));
    after[i].angular = exact.segment<3>(6 * static_cast<Eigen::Index>(i) + 3);
    if (falling[i].mass.mass > 0) falling[i].linear.y() = -9.81 * step.scene.dt;
  }
  const StepErrors found = step_errors(step.contacts, step.scene.dt, step.before, after, told);
  EXPECT_EQ(found.verdict, Verdict::scored);
  EXPECT_LT(found.velocity, 1e-8);
  ASSERT_TRUE(found.force.has_value());
  EXPECT_LT(*found.force, 1e-8);
  EXPECT_LT(found.residual, 1e-10);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(told.size());
  const StepErrors bad = step_errors(step.contacts, step.scene.dt, step.before, falling, nothing);
  EXPECT_NEAR(bad.velocity, 1, 1e-8);
  EXPECT_NEAR(bad.force.value_or(0), 1, 1e-8);
  EXPECT_FALSE(step_errors(step.contacts, step.scene.dt, step.before, after, std::nullopt).force.has_value());
}

TEST(ReferenceScore, StepsInWhichBodiesMeetAreLeftOut) {
  const Step step(file_of("stacking/D1-tower.json").instantiate({{"H", 2.0}}));
  std::vector<referee::BodyState> before = step.before;
  const auto verdict = [&] { return step_errors(step.contacts, step.scene.dt, before, before, std::nullopt).verdict; };
  EXPECT_EQ(verdict(), Verdict::scored);
  before.back().linear.y() = -1;
  EXPECT_EQ(verdict(), Verdict::meeting);
  before.back().linear.y() = -0.2;  // a step of gravity and a little: how a resting body may sink
  EXPECT_EQ(verdict(), Verdict::scored);
  for (referee::BodyState& body : before)
    if (body.mass.mass > 0) body.pose.position.y() *= 2;
  before.back().linear.y() = 0;
  EXPECT_EQ(verdict(), Verdict::apart);
}

}  // namespace
}  // namespace plumb::harness
