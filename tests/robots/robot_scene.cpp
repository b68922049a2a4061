#include "robot_scene.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

constexpr double gravity = 9.81;

std::string own_file() { return std::string(HARNESS_TEST_FOLDER) + "/robot-" + std::to_string(getpid()) + ".json"; }

double height_of(const Json& body) { return body.contains("position") ? double(body["position"][1]) : 0; }

}  // namespace

RobotScene::RobotScene(const std::filesystem::path& file, const std::vector<std::string>& options, double seconds) {
  std::vector<std::string> arguments{"convert", file, own_file(), "--dt", "1/60", "--seconds", std::to_string(seconds)};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Finished made = plumb(arguments);
  if (made.status != 0) throw std::runtime_error(made.err);
  std::ifstream in(own_file());
  scene_ = Json::parse(in);
}

bool RobotScene::moves(const Json& body) const { return body.value("motion", "dynamic") == "dynamic"; }

double RobotScene::weight() const {
  double mass = 0;
  for (const Json& body : scene_["bodies"])
    if (moves(body)) mass += double(body.value("mass", 0.0));
  return mass * gravity;
}

double RobotScene::height() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low = infinity, high = -infinity;
  for (const Json& body : scene_["bodies"]) {
    if (!moves(body)) continue;
    low = std::min(low, height_of(body));
    high = std::max(high, height_of(body));
  }
  return high - low;
}

void RobotScene::rub(double effort) {
  for (Json& joint : scene_["joints"])
    if (joint["type"] == "hinge" && !joint.contains("motors"))
      joint["motors"]["rx"] = {{"target_velocity", 0}, {"max_force", effort}};
}

void RobotScene::load(const std::string& body, double mass) {
  const Json& bodies = scene_["bodies"];
  const auto hand = std::find_if(bodies.begin(), bodies.end(), [&](const Json& b) { return b["name"] == body; });
  if (hand == bodies.end()) throw std::runtime_error("there is no body " + body);
  const Json place = hand->value("position", Json::array({0, 0, 0}));
  const double moment = 0.4 * mass * 0.05 * 0.05;  // of a ball of 5 cm
  scene_["bodies"].push_back(
      {{"name", "load"}, {"mass", mass}, {"inertia", {moment, moment, moment}}, {"position", place}});
  scene_["joints"].push_back(
      {{"name", "grip"}, {"type", "fixed"}, {"body_a", body}, {"body_b", "load"}, {"anchor", place}});
}

void RobotScene::watch(const std::string& name, const Json& quantity, const std::string& unit) {
  Json entry = quantity;
  entry["truth"] = 0;
  scene_["measure"]["quantities"][name] = entry;
  scene_["metrics"][name] = {{"unit", unit}, {"doc", name}, {"optional", true}};
}

Json RobotScene::run(const std::string& backend) const {
  std::ofstream(own_file()) << scene_.dump(1);
  const Finished finished = plumb({"run", own_file(), "--backend", backend, "--json"});
  if (finished.status != 0 || finished.rows().size() != 1) throw std::runtime_error(backend + ": " + finished.err);
  const Json row = finished.rows()[0];
  if (row["status"] != "ok" && row["status"] != "failed")
    throw std::runtime_error(backend + ": " + std::string(row["reason"]));
  return row["metrics"];
}

std::vector<std::string> exact_backends() {
  std::vector<std::string> exact;
  for (const Json& row : plumb({"backends", "--json"}).rows()) {
    if (row.at("status") != "ok") continue;  // it needs what this machine lacks, as a GPU
    const Json& needs = row.at("capabilities").at("needs");
    const auto native = [](const Json& degree) { return degree == "native"; };
    if (needs.contains("joints") && std::all_of(needs.begin(), needs.end(), native)) exact.push_back(row.at("name"));
  }
  return exact;
}

}  // namespace plumb::harness::testing
