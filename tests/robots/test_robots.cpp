// Robots that Debian ships fall, stand and hold: what must be true of them at the settings that an engine ships with.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "program.hpp"
#include "robot_scene.hpp"

namespace plumb::harness::testing {
namespace {

struct Package {
  const char* name;
  std::filesystem::path folder;
};

struct Robot {
  const char* name;
  const Package& package;
  const char* file;
  const char* hand = "";  ///< an arm's body that a load is fixed to
  double load = 0;        ///< kg
  double falls = 15;      ///< s, until it lies
  bool rubs = true;       ///< whether its joints are made to: without that, what is not damped swings for ever
};

class Robots : public ::testing::TestWithParam<Robot> {
 protected:
  /// What the robot does on every exact backend, or why it is not looked at on this machine.
  void on_each(const std::vector<std::string>& options, double seconds, const std::function<void(RobotScene&)>& prepare,
               const std::function<void(const RobotScene&, const Json& metrics)>& expect) {
    const Package& package = GetParam().package;
    const std::filesystem::path file = package.folder / GetParam().file;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "there is no " << file << ": apt-get install " << package.name;
    const std::vector<std::string> backends = exact_backends();
    if (backends.empty()) GTEST_SKIP() << "no backend here has all that robots need as its own";
    try {
      RobotScene scene(file, options, seconds);
      prepare(scene);
      for (const std::string& backend : backends) {
        SCOPED_TRACE(backend);
        expect(scene, scene.run(backend));
      }
    } catch (const std::runtime_error& error) {
      const std::string what = error.what();
      if (what.find("this program was built without") != std::string::npos) GTEST_SKIP() << what;
      FAIL() << what;
    }
  }
};

double value(const Json& metrics, const char* name) {
  return metrics.contains(name) && metrics[name]["value"].is_number() ? double(metrics[name]["value"]) : NAN;
}

/// The last of the run: what is watched there, named so.
Json at_the_end(const char* quantity, const char* take, double seconds) {
  return {{"quantity", quantity}, {"take", take}, {"over", {seconds - 2, seconds}}};
}

void watch_rest(RobotScene& scene, double seconds) {
  scene.watch("rest_speed", at_the_end("speed", "max", seconds), "m/s");
  scene.watch("rest_gap", at_the_end("gap", "max", seconds), "m");
  scene.watch("rest_limit", at_the_end("limit_angle", "max", seconds), "rad");
  Json force = at_the_end("ground_force", "mean", seconds);
  force["along"] = "y";
  scene.watch("ground_force", force, "N");
  scene.watch("way", {{"quantity", "way"}, {"take", "max"}}, "m");
}

void expect_rest(const RobotScene& scene, const Json& metrics) {
  EXPECT_LT(value(metrics, "rest_speed"), 1e-3);
  EXPECT_LT(value(metrics, "rest_gap"), 1e-4);
  EXPECT_LT(value(metrics, "rest_limit"), 0.01);
  EXPECT_NEAR(value(metrics, "ground_force"), scene.weight(), 0.005 * scene.weight());
  EXPECT_LT(value(metrics, "overlap"), 1e-3);
}

/// Of weight times size; that of springs under tension is not known.
void expect_no_energy(const Json& metrics, double most) {
  if (!metrics.contains("energy_made")) return;
  EXPECT_LT(double(metrics["energy_made"]["error"]), most);
}

class RobotsThatFall : public Robots {};
class RobotsThatStand : public Robots {};
class ArmsThatHold : public Robots {};

TEST_P(RobotsThatFall, ComeToRest) {
  const double seconds = GetParam().falls;
  const auto prepare = [&](RobotScene& scene) {
    if (GetParam().rubs) scene.rub(1e-4 * scene.weight() * scene.height());
    watch_rest(scene, seconds);
    scene.watch("limit", {{"quantity", "limit_angle"}, {"take", "max"}}, "rad");
    scene.watch("bent", {{"quantity", "misalignment"}, {"take", "max"}}, "rad");
  };
  on_each({"--ground"}, seconds, prepare, [](const RobotScene& scene, const Json& metrics) {
    expect_rest(scene, metrics);
    expect_no_energy(metrics, 3e-3);  // legs that strike at their limits sink in by a sub-step's way, and are lifted
    EXPECT_LT(value(metrics, "gap"), 0.01) << "when it strikes the ground, too";
    EXPECT_LT(value(metrics, "limit"), 0.03) << "likewise";
    EXPECT_LT(value(metrics, "bent"), 0.03) << "likewise";
    EXPECT_GT(value(metrics, "way"), 0.1 * scene.height()) << "it has not fallen";
  });
}

TEST_P(RobotsThatStand, KeepTheirPose) {
  constexpr double seconds = 30;
  const auto prepare = [&](RobotScene& scene) { watch_rest(scene, seconds); };
  on_each({"--ground", "--hold"}, seconds, prepare, [](const RobotScene& scene, const Json& metrics) {
    expect_rest(scene, metrics);
    expect_no_energy(metrics, 1e-4);
    EXPECT_LT(value(metrics, "gap"), 1e-3);
    EXPECT_LT(value(metrics, "way"), 0.01) << "it comes down onto the soles of its feet, and no farther";
  });
}

TEST_P(ArmsThatHold, ALoad) {
  constexpr double seconds = 30;
  const auto prepare = [&](RobotScene& scene) {
    scene.load(GetParam().hand, GetParam().load);
    scene.watch("way", {{"quantity", "way"}, {"take", "max"}}, "m");
    scene.watch("rest_speed", at_the_end("speed", "max", seconds), "m/s");
    Json force = at_the_end("force", "mean", seconds);
    force["joint"] = "grip";
    force["along"] = "y";
    scene.watch("grip", force, "N");
  };
  on_each({"--fix-base", "--hold"}, seconds, prepare, [](const RobotScene&, const Json& metrics) {
    EXPECT_LT(value(metrics, "way"), 1e-3);
    EXPECT_LT(value(metrics, "rest_speed"), 1e-3);
    EXPECT_LT(value(metrics, "gap"), 1e-3);
    expect_no_energy(metrics, 1e-4);
    const double load = GetParam().load * 9.81;
    EXPECT_NEAR(value(metrics, "grip"), load, 0.005 * load);
  });
}

std::string name_of(const ::testing::TestParamInfo<Robot>& info) { return info.param.name; }

/// What gtest would print of it otherwise is its bytes.
void PrintTo(const Robot& robot, std::ostream* out) { *out << robot.file << " of " << robot.package.name; }

const Package dart{"dart-doc", "/usr/share/doc/dart/data"}, samples{"libmujoco-samples", "/usr/share/mujoco/model"};
const Robot atlas{"Atlas", dart, "sdf/atlas/atlas_v3_no_head.urdf", "r_hand", 2},
    atlas_sdf{"AtlasSdf", dart, "sdf/atlas/atlas_v3_no_head.sdf"},
    hubo{"DrcHubo", dart, "urdf/drchubo/drchubo.urdf", "Body_RWP", 2, 10},
    quadruped{"Quadruped", dart, "sdf/quad.sdf", "", 0, 15, false},
    kr5{"KukaKr5", dart, "urdf/KR5/KR5 sixx R650.urdf", "palm", 5}, ant{"Ant", dart, "mjcf/openai/ant.xml.gz"},
    fetch{"Fetch", dart, "mjcf/openai/robotics/fetch/reach.xml", "robot0:wrist_roll_link", 2},
    humanoid{"Humanoid", samples, "humanoid/humanoid.xml"},
    limp_with_springs{"OpenAiHumanoid", dart, "mjcf/openai/humanoid.xml.gz"};

INSTANTIATE_TEST_SUITE_P(Debian, RobotsThatFall,
                         ::testing::Values(atlas, atlas_sdf, hubo, quadruped, ant, humanoid, limp_with_springs),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Debian, RobotsThatStand, ::testing::Values(atlas, hubo, quadruped, humanoid), name_of);
INSTANTIATE_TEST_SUITE_P(Debian, ArmsThatHold, ::testing::Values(atlas, kr5, hubo, fetch), name_of);

}  // namespace
}  // namespace plumb::harness::testing
