#include "schedule/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cell/machine.hpp"
#include "measure/registry/registry.hpp"
#include "plumb/nearest.hpp"
#include "scene/build.hpp"
#include "scene/catalogue.hpp"
#include "scene/limits.hpp"
#include "scene/parameters.hpp"

namespace plumb::harness {

namespace {

struct ParameterRequest {
  std::string name, text;
};

std::vector<ParameterRequest> parse_parameters(const std::vector<std::string>& arguments) {
  std::vector<ParameterRequest> requests;
  for (const std::string& argument : arguments) {
    const auto equals = argument.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("--param " + argument + ": a parameter is given as name=value");
    requests.push_back({argument.substr(0, equals), argument.substr(equals + 1)});
  }
  return requests;
}

// A parameter that one of several scenes has is for that one; what none has is a slip of the pen.
void check_parameter_names(const std::vector<ParameterRequest>& requests,
                           const std::vector<std::shared_ptr<const SceneFile>>& scenes) {
  for (const ParameterRequest& request : requests) {
    std::set<std::string> known;
    for (const auto& scene : scenes) {
      for (const ParameterSpec& spec : scene->parameters) known.insert(spec.name);
    }
    if (known.contains(request.name)) continue;
    const std::string who = scenes.size() == 1 ? "scene " + scenes[0]->id + " has no" : "no scene of this run has a";
    throw UsageError(fmt::format("{} parameter \"{}\"{}", who, request.name,
                                 suggestion(request.name, {known.begin(), known.end()})));
  }
}

Parameters given_to(const SceneFile& scene, const std::vector<ParameterRequest>& requests) {
  Parameters given;
  for (const ParameterRequest& request : requests) {
    for (const ParameterSpec& spec : scene.parameters) {
      if (spec.name == request.name) given[request.name] = parse_parameter(spec, request.text);
    }
  }
  return given;
}

// The scene's variants with the given values over theirs; those that have become equal count once.
std::vector<Parameters> variants_of(const SceneFile& scene, const Parameters& given) {
  std::vector<Parameters> variants;
  for (Parameters variant : scene.variants) {
    for (const auto& [name, value] : given) variant[name] = value;
    if (std::find(variants.begin(), variants.end(), variant) == variants.end()) variants.push_back(std::move(variant));
  }
  return variants;
}

std::vector<std::shared_ptr<const SceneFile>> scenes_for(const std::vector<std::string>& asked) {
  std::vector<std::shared_ptr<const SceneFile>> scenes;
  std::set<std::string> seen;
  for (const std::string& what : asked) {
    for (SceneFile& file : find_scenes(what)) {
      (void)find_measure(file);  // a misspelt measure is a wrong question, not a failed cell
      if (seen.insert(file.path.string()).second) scenes.push_back(std::make_shared<const SceneFile>(std::move(file)));
    }
  }
  return scenes;
}

// With nothing wrong in it, as far as that can be told without making many objects: those the worker makes and checks.
Scene checked_scene(const SceneFile& file, const Parameters& parameters, const Times& times) {
  if (count_objects(file, parameters, times) >= many_objects) return file.outline(parameters, times);
  Scene scene = file.instantiate(parameters, times);
  check_measure(file, scene);
  return scene;
}

void check_positive(const char* option, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw UsageError(fmt::format("{} {:g}: it must be above 0", option, value));
}

Sweep parse_sweep(const std::optional<SweepRequest>& request) {
  Sweep sweep;
  if (!request) return sweep;
  for (const std::string& argument : request->over) sweep.over.push_back(parse_sweep_axis("--over", argument));
  for (const std::string& argument : request->along) sweep.along.push_back(parse_sweep_axis("--along", argument));
  return sweep;
}

// The cell once for each of the sweep's settings, and the ladders by their places in the block.
void add_swept(CellBlock& block, const Cell& cell, const Sweep& sweep, const std::vector<SettingRequest>& fixed) {
  const std::size_t first = block.cells.size();
  SweptSettings swept = swept_settings(*cell.backend, cell.settings, sweep, fixed);
  for (Json& settings : swept.settings) {
    block.cells.push_back(cell);
    block.cells.back().settings = std::move(settings);
  }
  for (Ladder& ladder : swept.ladders) {
    ladder.base += first;
    ladder.probe += first;
    for (std::size_t& other : ladder.others) other += first;
    block.ladders.push_back(std::move(ladder));
  }
}

void check_words(const RunRequest& request) {
  const auto check_word = [](const char* option, const std::string& word, const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw UsageError(fmt::format("{} {}: there is no such choice{}", option, word, suggestion(word, known)));
  };
  check_word("--profile", request.profile, profile_words());
  check_needs("--needs", request.needs);
  if (request.dt) check_positive("--dt", *request.dt);
  if (request.seconds) check_positive("--seconds", *request.seconds);
  check_positive("--timeout", request.timeout);
  if (request.judge_timeout) check_positive("--judge-timeout", *request.judge_timeout);
}

}  // namespace

WorkerLimits RunRequest::limits() const {
  WorkerLimits limits;
  constexpr double a_minute = 60;
  limits.engine_seconds = timeout;
  limits.judge_seconds = judge_timeout.value_or(std::max(timeout, a_minute));
  limits.memory_bytes =
      memory_limit_mb > 0 ? static_cast<std::uint64_t>(memory_limit_mb * 1e6) : machine_memory_bytes() / 4 * 3;
  return limits;
}

void check_needs(const std::string& option, const std::string& needs) {
  if (needs == "scene" || needs == "all") return;
  const auto refuse = [&](const std::string& why) { throw UsageError(fmt::format("{} {}: {}", option, needs, why)); };
  std::vector<std::string> known{"scene", "all"};
  if (!needs.starts_with("scene+")) {
    known.emplace_back("scene+" + need_words().front());
    refuse("there is no such choice" + suggestion(needs, known));
  }
  for (std::size_t at = 5; at != std::string::npos;) {
    const std::size_t next = needs.find('+', at + 1);
    const std::string word = needs.substr(at + 1, next == std::string::npos ? next : next - at - 1);
    if (std::find(need_words().begin(), need_words().end(), word) == need_words().end())
      refuse("there is no need \"" + word + "\"" + suggestion(word, need_words()));
    at = next;
  }
}

std::vector<CellBlock> plan_blocks(const RunRequest& request, const std::vector<BuiltBackend>& backends) {
  check_words(request);
  const std::vector<std::shared_ptr<const SceneFile>> scenes = scenes_for(request.scenes);
  const std::vector<ParameterRequest> parameters = parse_parameters(request.parameters);
  check_parameter_names(parameters, scenes);
  std::vector<SettingRequest> settings;
  for (const std::string& argument : request.settings) settings.push_back(parse_setting_request(argument));
  std::vector<BackendDescription> descriptions;
  for (const BuiltBackend& backend : backends) descriptions.push_back(*backend.description);
  check_setting_requests(settings, descriptions);
  const Sweep sweep = parse_sweep(request.sweep);
  check_sweep(sweep, descriptions, settings);

  std::vector<CellBlock> blocks;
  for (const auto& file : scenes) {
    const Parameters given = given_to(*file, parameters);
    for (const Parameters& variant :
         request.own_variants ? variants_of(*file, given) : std::vector<Parameters>{given}) {
      const Scene scene = checked_scene(*file, variant, {request.dt, request.seconds});
      CellBlock block;
      for (const auto& [backend, build] : backends) {
        Cell cell{file,     scene.parameters, variant,         backend,
                  build,    Json::object(),   request.profile, request.needs,
                  scene.dt, scene.seconds,    request.threads};
        cell.settings = settings_for(*backend, file->id, request.profile, settings);
        if (request.sweep && backend->error.empty()) {
          add_swept(block, cell, sweep, settings);
        } else {
          block.cells.push_back(std::move(cell));
        }
      }
      blocks.push_back(std::move(block));
    }
  }
  return blocks;
}

Plan make_plan(const RunRequest& request) {
  check_words(request);
  (void)scenes_for(request.scenes);  // a misspelt scene is told before a backend is asked anything
  Plan plan;
  OpenedBackends opened = open_backends(request.backends, request.limits());
  plan.broken = std::move(opened.broken);
  plan.blocks = plan_blocks(request, build_ids(std::move(opened.usable)));
  return plan;
}

}  // namespace plumb::harness
