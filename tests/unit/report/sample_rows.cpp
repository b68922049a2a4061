#include "sample_rows.hpp"

#include <cmath>
#include <cstdint>
#include <string>

#include "rows/row.hpp"

namespace plumb::harness::testing {
namespace {

struct SampleScene {
  const char *id, *group, *parameter;
  std::vector<double> values;
  std::vector<const char*> metrics;
  double bodies;  ///< times the parameter, where it is a count
  double base_error;
};

const std::vector<SampleScene>& scenes() {
  static const std::vector<SampleScene> all{
      {"A1", "integrator", "height", {100}, {"drop", "speed"}, 1, 8e-3},
      {"A5b", "integrator", "", {0}, {"energy_drift", "angular_momentum_drift", "flips"}, 1, 0.3},
      {"A7", "integrator", "start_deg", {10, 90, 170}, {"period", "energy_drift", "length_error"}, 2, 0.02},
      {"B1", "collision", "e", {0, 0.25, 0.5, 0.75, 1}, {"apex_1", "apex_2"}, 2, 0.03},
      {"C1", "friction", "angle_deg", {26, 27, 30}, {"creep", "distance"}, 2, 0.01},
      {"C2", "friction", "", {0}, {"distance", "spread"}, 17, 0.02},
      {"D1", "stacking", "H", {10, 20, 50, 100}, {"deficit", "drift", "stands"}, 1, 0.004},
      {"D2", "stacking", "N", {20, 100}, {"survival", "asymmetry"}, 50, 0.05},
      {"E1", "joints", "L", {10, 50}, {"gap"}, 1, 0.08},
      {"F4", "robustness", "", {0}, {"speed"}, 3, 0.5},
      {"G1", "scale", "N", {1000, 8000, 32000}, {"penetration"}, 1, 0.12},
  };
  return all;
}

/// Uniform in [0, 1), the same for ever (splitmix64).
class Noise {
 public:
  double next() {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_ = 7;
};

struct SampleEngine {
  const char *name, *version;
  double error_factor, cost_factor, order;
};
constexpr SampleEngine engines[]{
    {"alpha", "3.24", 1.0, 1.0, 1.0}, {"alpha-f64", "3.24", 0.7, 1.25, 1.0}, {"omega", "0.16.2", 1.4, 2.1, 1.6}};

Json machine() {
  return {{"cpu", "AMD EPYC 9575F 64-Core Processor"},
          {"cores", 2},
          {"memory_mb", 7936},
          {"os", "Debian GNU/Linux 12"},
          {"compiler", "gcc 12.2.0"},
          {"build", "release"}};
}

Json metric(const std::string& name, double error) {
  const bool yes_no = name == "stands" || name == "survival";
  if (yes_no) error = error > 0.05 ? 1 : 0;
  const double threshold = yes_no ? 0 : 0.01, gold = yes_no ? 0 : 1e-4;
  return {{"value", yes_no ? 1 - error : 1 + error},
          {"unit", yes_no ? "1" : "m"},
          {"truth", 1},
          {"error", error},
          {"threshold", threshold},
          {"gold", gold},
          {"pass", error <= threshold}};
}

Json row_of(const SampleScene& scene, double value, const SampleEngine& engine, int sweep, Noise& noise) {
  const double refinement = std::pow(2.0, sweep / 2);  // odd sweeps turn the iterations instead of dt
  const int iterations = sweep % 2 == 0 ? 10 : 40;
  const bool count = value >= 10 && (scene.group == std::string("stacking") || scene.group == std::string("scale") ||
                                     scene.id[0] == 'E');
  const double bodies = scene.bodies * (count ? value : 1) + 1;
  const double ms = engine.cost_factor * (0.003 + 0.0022 * std::pow(bodies, 1.08)) * (iterations == 40 ? 2.3 : 1) *
                    (0.95 + 0.1 * noise.next());
  const double dt = 1.0 / 60 / refinement;
  Json metrics = Json::object();
  bool failed = false;
  for (const char* name : scene.metrics) {
    const double hardness = count ? std::pow(value / 10, 0.8) : 1;
    const double error = scene.base_error * engine.error_factor * hardness * std::pow(refinement, -engine.order) *
                         (iterations == 40 ? 0.7 : 1) * (0.5 + noise.next());
    metrics[name] = metric(name, error);
    failed = failed || !metrics[name]["pass"].get<bool>();
  }
  Json params = Json::object();
  if (*scene.parameter) params[scene.parameter] = value;
  return {{"format", row_format},
          {"scene", scene.id},
          {"group", scene.group},
          {"params", params},
          {"backend", engine.name},
          {"backend_version", engine.version},
          {"settings",
           {{"solver", "sequential_impulse"},
            {"iterations", iterations},
            {"erp", 0.2},
            {"split_impulse", true},
            {"contact_margin", 0.02}}},
          {"profile", "default"},
          {"dt", dt},
          {"seconds", 10},
          {"threads", 1},
          {"status", failed ? "failed" : "ok"},
          {"reason", ""},
          {"metrics", metrics},
          {"time",
           {{"ms_per_step", {{"median", ms}, {"min", ms * 0.93}, {"max", ms * 1.8}, {"p99", ms * 1.3}}},
            {"runs", Json::array()},
            {"ci95", nullptr},
            {"wall_s", nullptr},
            {"window", {60, 600}},
            {"steps", 600 * refinement},
            {"setup_ms", 0.4 + 0.01 * bodies},
            {"phase_ms", {{"broad", ms * 0.12}, {"narrow", ms * 0.3}, {"solve", ms * 0.5}, {"integrate", ms * 0.05}}}}},
          {"counts", {{"bodies", bodies}, {"contacts_max", bodies * 4}, {"dropped", 0}, {"nonfinite", 0}}},
          {"hash", "9f86d081884c7d65"},
          {"peak_mb", 40 + bodies * 0.01},
          {"machine", machine()},
          {"contended", nullptr},
          {"knobs", Json::array()},
          {"slug", ""},
          {"needs", ""},
          {"repeats", nullptr},
          {"backend_build", ""},
          {"cell", scene.id + params.dump() + engine.name + std::to_string(sweep)}};
}

/// What does not come through, one of a kind.
void spoil(Json& row, const std::string& scene, double value, const std::string& engine) {
  const auto end_as = [&](const char* status, const char* reason) {
    row["status"] = status;
    row["reason"] = reason;
    row["metrics"] = Json::object();
    row["time"]["ms_per_step"] = {{"median", nullptr}, {"min", nullptr}, {"max", nullptr}, {"p99", nullptr}};
  };
  if (scene == "F4" && engine == "omega") end_as("crashed", "SIGSEGV in step 10");
  if (scene == "C2" && engine == "alpha-f64") end_as("timeout", "stopped after 60 s in step 214");
  if (scene == "A5b" && engine == "omega") end_as("unsupported", "need gyroscopic: the engine has no gyroscopic term");
  if (scene == "G1" && value > 10000 && engine == "omega") end_as("out_of_memory", "4.1 GB resident, limit 4 GB");
  if (scene == "D1" && value > 50 && engine == "alpha") {
    row["status"] = "failed";
    row["metrics"]["deficit"]["error"] = nullptr;
    row["metrics"]["deficit"]["value"] = nullptr;
    row["metrics"]["deficit"]["pass"] = false;
    row["counts"]["nonfinite"] = 17;
  }
}

}  // namespace

Json sample_row(const char* scene, const char* backend, double error, double ms_per_step) {
  return {
      {"format", row_format},
      {"scene", scene},
      {"group", "sample"},
      {"params", Json::object()},
      {"backend", backend},
      {"backend_version", "1"},
      {"settings", Json::object()},
      {"profile", "default"},
      {"dt", 0.01},
      {"seconds", 1},
      {"threads", 1},
      {"status", error <= 0.01 ? "ok" : "failed"},
      {"reason", ""},
      {"metrics",
       {{"error_of_it",
         {{"value", error},
          {"unit", "m"},
          {"truth", 0},
          {"error", error},
          {"threshold", 0.01},
          {"gold", 1e-4},
          {"pass", error <= 0.01}}}}},
      {"time",
       {{"ms_per_step", {{"median", ms_per_step}, {"min", ms_per_step}, {"max", ms_per_step}, {"p99", ms_per_step}}},
        {"runs", Json::array()},
        {"ci95", nullptr},
        {"wall_s", nullptr},
        {"window", {0, 99}},
        {"steps", 100},
        {"setup_ms", 1},
        {"phase_ms", Json::object()}}},
      {"counts", {{"bodies", 2}, {"contacts_max", 1}, {"dropped", 0}, {"nonfinite", 0}}},
      {"hash", "00"},
      {"peak_mb", 10},
      {"machine", Json::object()},
      {"contended", nullptr},
      {"knobs", Json::array()},
      {"slug", ""},
      {"needs", ""},
      {"repeats", nullptr},
      {"backend_build", ""},
      {"cell", std::string(scene) + " " + backend}};
}

std::vector<Json> sample_rows(int sweeps) {
  std::vector<Json> rows;
  Noise noise;
  for (const SampleScene& scene : scenes()) {
    for (const double value : scene.values) {
      for (const SampleEngine& engine : engines) {
        for (int sweep = 0; sweep <= sweeps; ++sweep) {
          rows.push_back(row_of(scene, value, engine, sweep, noise));
          spoil(rows.back(), scene.id, value, engine.name);
        }
      }
    }
  }
  return rows;
}

}  // namespace plumb::harness::testing
