// What is refused is told with its name and a remedy, and the rest of the world goes on.
#include <cmath>
#include <limits>

#include "hosts/gazebo/tests/worlds.hpp"

namespace plumb::gazebo::tests {
namespace {

class Errors : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(PLUMB_TESTED_BACKENDS).find("impulse") == std::string::npos)
      GTEST_SKIP() << "the backend impulse is not built";
    host = std::make_unique<Host>("impulse");
  }

  /// Loads a world with a ball that falls, and gives what the console says.
  std::string told_of(const std::string& content) {
    testing::internal::CaptureStderr();
    const bool loaded = host->load(world(content + ball("ball", "9 0 9 0 0 0")));
    host->step(kDt, 100);
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(loaded);
    EXPECT_NEAR(host->velocity("ball::link").Z(), -kG * 0.1, 0.01);
    return told;
  }

  static void expect_words(const std::string& told, std::initializer_list<const char*> words) {
    for (const char* word : words)
      EXPECT_NE(told.find(word), std::string::npos) << "\"" << word << "\" is not in " << told;
  }

  std::unique_ptr<Host> host;
};

const std::string kBareBob = inertia(1, 0.004, 0.004, 0.004);

TEST(Backend, ThatIsUnknownIsToldWithThoseThatAreThere) {
  Host host("no-such-engine");
  testing::internal::CaptureStderr();
  EXPECT_FALSE(host.load(world("")));
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("no-such-engine"), std::string::npos) << told;
  EXPECT_NE(told.find("PLUMB_GAZEBO_BACKEND"), std::string::npos) << told;
}

TEST_F(Errors, JointTypesThatAreNotThere) {
  for (const std::string type : {"screw", "revolute2"}) {
    const std::string text = link(kBareBob, "a") + link(kBareBob, "b") + "<joint name='turns' type='" + type +
                             "'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis>"
                             "<axis2><xyz>0 1 0</xyz></axis2></joint>";
    expect_words(told_of(model("m", "0 0 0 0 0 0", text)), {"[turns]", type.c_str(), "revolute"});
    EXPECT_FALSE(host->has_joint("m::turns"));
    host = std::make_unique<Host>("impulse");
  }
}

TEST_F(Errors, ParallelAxes) {
  const std::string text = link(kBareBob, "a") +
                           "<joint name='turns' type='universal'><parent>world</parent><child>a</child>"
                           "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 0 1</xyz></axis2></joint>";
  expect_words(told_of(model("m", "0 0 0 0 0 0", text)), {"[turns]", "parallel"});
  EXPECT_FALSE(host->has_joint("m::turns"));
}

TEST_F(Errors, Heightmaps) {
  const std::string hills =
      "<static>true</static>" + link(collision("hills", "<heightmap><uri>hills.png</uri></heightmap>"));
  expect_words(told_of(model("land", "0 0 0 0 0 0", hills)), {"[hills]", "heightmap", "mesh"});
  EXPECT_EQ(host->shapes("land::link"), 0U);
}

TEST_F(Errors, MeshesThatAreMissing) {
  const std::string text = kBareBob + collision("hull", "<mesh><uri>no-such-file.dae</uri></mesh>");
  expect_words(told_of(model("ship", "0 0 0 0 0 0", link(text))), {"no-such-file.dae", "IGN_FILE_PATH"});
  EXPECT_EQ(host->shapes("ship::link"), 0U);
}

TEST_F(Errors, PlanesThatMove) {
  const std::string text = kBareBob + collision("floor", "<plane><normal>0 0 1</normal></plane>");
  expect_words(told_of(model("m", "0 0 0 0 0 0", link(text))), {"[floor]", "static"});
}

TEST_F(Errors, LinksWithoutMass) {
  EXPECT_EQ(told_of(""), "");
  testing::internal::CaptureStderr();
  EXPECT_FALSE(host->add_massless());
  expect_words(testing::internal::GetCapturedStderr(), {"[massless]", "mass is 0", "static"});
}

TEST_F(Errors, NumbersThatAreNone) {
  ASSERT_TRUE(
      host->load(world(cube("a", "0 0 0 0 0 0") +
                           model("p", "2 0 0 0 0 0",
                                 link(kBareBob, "bob") + "<joint name='j' type='revolute'><parent>world</parent>"
                                                         "<child>bob</child><axis><xyz>0 0 1</xyz></axis></joint>"),
                       "0 0 0")));
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  testing::internal::CaptureStderr();
  host->push("a::link", {nan, 0, 0}, {0, 0, 0});
  host->push("a::link", {1, 0, 0}, {0, inf, 0});
  host->twist("a::link", {inf, 0, 0});
  host->place("a", Pose(nan, 0, 0, 0, 0, 0));
  host->move("a", {inf, 0, 0}, {0, 0, nan});
  host->set_gravity({0, nan, 0});
  host->set_force("p::j", nan);
  host->set_force("p::j", inf);
  host->set_position("p::j", nan);
  host->set_rate("p::j", inf);
  host->command("p::j", nan);
  host->set_force("p::j", 1, 3);
  host->step(0);
  host->step(kDt, 10);
  const std::string told = testing::internal::GetCapturedStderr();
  expect_words(told, {"[link]", "[j]", "[w]", "not a finite number", "1 axes", "above 0"});
  expect_near(host->pose("a::link").Pos(), {0, 0, 0}, 1e-9);
  EXPECT_NEAR(host->position("p::j"), 0, 1e-9);
}

}  // namespace
}  // namespace plumb::gazebo::tests
