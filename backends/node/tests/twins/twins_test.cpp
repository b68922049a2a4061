// What a backend tells of five scenes is what a program tells that is written straight against the package:
// twins/NAME.mjs. The environment names the backend's library, PLUMB_TWIN_BACKEND, and the program with its arguments,
// PLUMB_TWIN.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

namespace {
const char* required(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr) throw std::runtime_error(std::string(name) + " is not set; run this by ctest");
  return value;
}
}  // namespace
#define PLUMB_BACKEND_FILE required("PLUMB_TWIN_BACKEND")
#include "plumb_scene.hpp"

namespace scenes {
namespace {

using Json = nlohmann::json;
using Row = std::array<double, 13>;  // pose, velocity

constexpr int kSteps = 120;
constexpr double kStep = 1.0 / 60;

Scene falling_ball() {
  Item ball = box({0, 2, 0}, {0.5, 0.5, 0.5});
  ball.is_sphere = true;
  ball.velocity = {1, 0, 0.5};
  return {"falling_ball", {ground(), ball}, {}};
}
Scene sliding_box() {
  Item slides = box({0, 0.25, 0}, {0.5, 0.25, 0.4}, 20);
  slides.velocity = {3, 0, 1};
  return {"sliding_box", {ground(), slides}, {}};
}
Scene stack() {
  Scene scene = tower(4);
  scene.name = "stack";
  return scene;
}
Scene tumbling_box() {
  Item tumbles = box({0, 20, 0}, {0.5, 0.2, 0.1}, 3);
  tumbles.velocity = {0, 9, 0};
  tumbles.spin = {0.1, 4, 0.1};
  return {"tumbling_box", {tumbles}, {}};
}
Scene chain_of_three() {
  Scene scene = chain(3);
  scene.items.back().mass = 5;
  return scene;
}

Json json_of(const PlumbVec3& v) { return {v.x, v.y, v.z}; }
Json json_of(const Scene& scene) {
  Json items = Json::array(), joints = Json::array();
  for (const Item& item : scene.items) {
    const PlumbQuat& q = item.pose.orientation;
    items.push_back({{"still", item.is_static},
                     {"sphere", item.is_sphere},
                     {"half", json_of(item.is_sphere ? PlumbVec3{item.half.x, item.half.x, item.half.x} : item.half)},
                     {"position", json_of(item.pose.position)},
                     {"orientation", {q.x, q.y, q.z, q.w}},
                     {"mass", item.mass},
                     {"inertia", json_of(inertia(item))},
                     {"velocity", json_of(item.velocity)},
                     {"spin", json_of(item.spin)}});
  }
  for (const Joint& joint : scene.joints)
    joints.push_back({{"hinge", joint.is_hinge},
                      {"a", joint.a},
                      {"b", joint.b},
                      {"inA", json_of(joint.in_a)},
                      {"inB", json_of(joint.in_b)}});
  return {{"dt", kStep},    {"steps", kSteps}, {"gravity", {0, -9.81, 0}}, {"friction", kPlumbFriction},
          {"items", items}, {"joints", joints}};
}

std::vector<Row> of_twin(const Scene& scene) {
  const std::string file = testing::TempDir() + "twin_" +
                           std::to_string(std::hash<std::string>{}(required("PLUMB_TWIN"))) + scene.name + ".json";
  std::ofstream(file) << json_of(scene);
  FILE* pipe = popen((std::string("node ") + required("PLUMB_TWIN") + " < '" + file + "'").c_str(), "r");
  std::string told;
  char piece[4096];
  while (const std::size_t got = std::fread(piece, 1, sizeof piece, pipe)) told.append(piece, got);
  EXPECT_EQ(pclose(pipe), 0) << "the twin failed; its words are above";
  std::remove(file.c_str());
  return Json::parse(told).get<std::vector<Row>>();
}

/// What the engine lacks is not asked of it.
PlumbNeeds needs_there() {
  PlumbNeeds all = kNeeds;
  for (std::uint32_t bit = 0; bit < 64; ++bit)
    if ((all >> bit & 1) != 0 && backend().capability(PLUMB_CAP_NEED, bit, 0) == PLUMB_NONE)
      all &= ~(PlumbNeeds{1} << bit);
  return all;
}

/// "friction=points": a setting of words.
std::vector<PlumbSetting> settings() {
  static const std::string given =
      std::getenv("PLUMB_TWIN_SETTING") != nullptr ? std::getenv("PLUMB_TWIN_SETTING") : "";
  if (given.empty()) return {};
  static const std::string name = given.substr(0, given.find('=')), word = given.substr(given.find('=') + 1);
  return {word_setting(name.c_str(), word.c_str())};
}

std::vector<Row> of_backend(const Scene& scene) {
  const PlumbScene made(scene, needs_there(), settings());
  for (int i = 0; i < kSteps; ++i) advance(*made.world, kStep);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < scene.items.size(); ++i) {
    if (scene.items[i].is_static) continue;
    const auto pose = read_row<7>(*made.world, PLUMB_FIELD_POSE, made.bodies[i]);
    const auto velocity = read_row<6>(*made.world, PLUMB_FIELD_VELOCITY, made.bodies[i]);
    Row& row = rows.emplace_back();
    std::copy(velocity.begin(), velocity.end(), std::copy(pose.begin(), pose.end(), row.begin()));
  }
  return rows;
}

/// How near the two come where they have not the same bits: PLUMB_TWIN_NEAR, "pendulum=1e-6 stack=1e-7".
double allowed(const std::string& scene) {
  const std::string given = std::getenv("PLUMB_TWIN_NEAR") != nullptr ? std::getenv("PLUMB_TWIN_NEAR") : "";
  const std::size_t at = given.find(scene + "=");
  return at == std::string::npos ? 0 : std::stod(given.substr(at + scene.size() + 1));
}

class Twins : public testing::TestWithParam<Scene> {};

TEST_P(Twins, TellTheSame) {
  const std::vector<Row> mine = of_backend(GetParam()), twin = of_twin(GetParam());
  ASSERT_EQ(mine.size(), twin.size());
  double largest = 0;
  for (std::size_t i = 0; i < mine.size(); ++i)
    for (std::size_t k = 0; k < mine[i].size(); ++k)
      largest = std::fmax(largest, mine[i][k] == twin[i][k] ? 0 : std::fabs(mine[i][k] - twin[i][k]));
  std::printf("%s: %g apart\n", GetParam().name.c_str(), largest);
  EXPECT_LE(largest, allowed(GetParam().name));
  for (const Row& row : mine)
    for (const double number : row) EXPECT_TRUE(std::isfinite(number));
}

INSTANTIATE_TEST_SUITE_P(Node, Twins,
                         testing::Values(falling_ball(), sliding_box(), stack(), tumbling_box(), pendulum(),
                                         chain_of_three()),
                         [](const auto& twin) { return twin.param.name; });

}  // namespace
}  // namespace scenes
