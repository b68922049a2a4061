#include "study/study_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "plumb/assert.hpp"
#include "plumb/nearest.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness {

namespace {

constexpr std::size_t largest_batch = 12;  // so that a kill or the end of a budget costs little

bool is_number(const SettingDescription& setting) { return setting.type == "int" || setting.type == "float"; }

std::string text_of(const Parameters& parameters) {
  std::string text;
  for (const auto& [name, value] : parameters) {
    if (name != "seed") text += name + std::visit([](const auto& v) { return fmt::format("={} ", v); }, value);
  }
  return text;
}

/// Where a cell stands in its set: which of the set's lists it takes other than the first value of.
struct Place {
  int stage;
  std::string batch;
};

class Planner {
 public:
  Planner(const StudyFile& study, bool fixed) : study_(study), fixed_(fixed) {}

  StudyPlan plan() {
    RunRequest request;
    request.timeout = study_.timeout;
    OpenedBackends opened = open_backends(study_.backends, request.limits());
    plan_.broken = std::move(opened.broken);
    backends_ = build_ids(std::move(opened.usable));
    for (std::size_t i = 0; i < study_.sets.size(); ++i) {
      const StudySet& set = study_.sets[i];
      try {
        add_set(set);
      } catch (const UsageError& error) {
        throw UsageError(fmt::format("study {}, set {}{}: {}", study_.name, i + 1,
                                     set.title.empty() ? "" : " (" + set.title + ")", error.what()));
      }
    }
    make_batches();
    return std::move(plan_);
  }

 private:
  [[nodiscard]] std::vector<BuiltBackend> backends_of(const StudySet& set) const {
    if (set.backends.empty()) return backends_;
    std::vector<BuiltBackend> chosen;
    std::vector<std::string> names;
    for (const BuiltBackend& backend : backends_) names.push_back(backend.description->name);
    for (const std::string& name : set.backends) {
      const auto at = std::find(names.begin(), names.end(), name);
      if (at == names.end())
        throw UsageError(fmt::format("no backend \"{}\" is part of this study{}", name, suggestion(name, names)));
      chosen.push_back(backends_[static_cast<std::size_t>(at - names.begin())]);
    }
    return chosen;
  }

  static std::vector<SceneFile> scenes_of(const StudySet& set) {
    std::vector<SceneFile> scenes;
    std::set<std::string> left_out, seen;
    for (const std::string& what : set.except) {
      for (const SceneFile& scene : find_scenes(what)) left_out.insert(scene.path.string());
    }
    for (const std::string& what : set.scenes) {
      for (SceneFile& scene : find_scenes(what)) {
        const std::string path = scene.path.string();
        if (!left_out.contains(path) && seen.insert(path).second) scenes.push_back(std::move(scene));
      }
    }
    return scenes;
  }

  static bool has_parameter(const SceneFile& scene, const std::string& name) {
    return std::any_of(scene.parameters.begin(), scene.parameters.end(),
                       [&](const ParameterSpec& spec) { return spec.name == name; });
  }

  static void check_parameters(const StudySet& set, const std::vector<SceneFile>& scenes) {
    std::vector<std::string> known;
    for (const SceneFile& scene : scenes) {
      for (const ParameterSpec& spec : scene.parameters) known.push_back(spec.name);
    }
    for (const auto& variant : set.params) {
      for (const std::string& text : variant) {
        const std::string name = text.substr(0, text.find('='));
        if (std::find(known.begin(), known.end(), name) == known.end())
          throw UsageError(fmt::format("no scene of the set has a parameter \"{}\"{}", name, suggestion(name, known)));
      }
    }
  }

  void add_set(const StudySet& set) {
    const std::vector<BuiltBackend> backends = backends_of(set);
    const std::vector<SceneFile> scenes = scenes_of(set);
    check_parameters(set, scenes);
    check_axes(set, backends);
    for (const SceneFile& scene : scenes) {
      const std::vector<std::vector<std::string>> as_it_is{{}};
      for (const auto& variant : set.params.empty() ? as_it_is : set.params) add_variant(set, backends, scene, variant);
    }
  }

  void add_variant(const StudySet& set, const std::vector<BuiltBackend>& backends, const SceneFile& scene,
                   const std::vector<std::string>& variant) {
    RunRequest request;
    request.scenes = {scene.path.string()};
    request.settings = set.settings;
    request.seconds = set.seconds;
    request.timeout = study_.timeout;
    request.own_variants = set.params.empty();
    for (const std::string& text : variant) {
      if (has_parameter(scene, text.substr(0, text.find('=')))) request.parameters.push_back(text);
    }
    const std::vector<double> one_seed{0};
    const bool seeded = !set.seeds.empty() && has_parameter(scene, "seed");
    for (const double seed : seeded ? set.seeds : one_seed) {
      RunRequest with_seed = request;
      if (seeded) with_seed.parameters.push_back(fmt::format("seed={}", seed));
      const bool first_seed = !seeded || seed == set.seeds.front();
      for (const std::string& profile : set.profiles) {
        std::vector<BuiltBackend> with_profile = backends;
        // A study is for any backend, and not every author has written such a file.
        std::erase_if(with_profile, [&](const BuiltBackend& backend) {
          return profile == "tuned" && !has_tuned_settings(*backend.description);
        });
        for (const std::uint32_t threads : set.threads) {
          for (const std::string& needs : set.needs) {
            with_seed.profile = profile;
            with_seed.threads = threads;
            with_seed.needs = needs;
            const bool first = first_seed && profile == set.profiles.front() && threads == set.threads.front();
            const bool alone = first && needs == set.needs.front();
            // What a need costs is told by a pair that was timed in turns, so that all needs of a scene go together.
            for (const CellBlock& block : plan_blocks(with_seed, with_profile)) {
              for (const Cell& cell : block.cells) add_cell(set, cell, first, alone);
            }
          }
        }
      }
    }
  }

  std::size_t add(const StudySet& set, const Cell& cell, int stage, const std::string& batch) {
    PlannedCell planned;
    planned.cell = cell;
    planned.id = cell_id(cell);
    planned.stage = stage;
    planned.batch = cell.scene->path.string() + " " + text_of(cell.shown) + batch;
    planned.repetitions = set.repetitions;
    if (fixed_) planned.repetitions.at_most = planned.repetitions.at_least;
    planned.record = set.record;
    return plan_.add(std::move(planned));
  }

  // The base cell, and what turns about it where the rest is as the set's first values say.
  void add_cell(const StudySet& set, const Cell& cell, bool first, bool alone) {
    const std::size_t base = add(set, cell, first ? 0 : 1, first ? "" : "other");
    if (!alone || !cell.backend->error.empty()) return;
    std::vector<Sweep> sweeps;
    for (Sweep& sweep : sweeps_of(set, *cell.backend)) sweeps.push_back(std::move(sweep));
    std::vector<std::size_t> turned{base};
    for (const Sweep& sweep : sweeps) {
      PLUMB_ASSERT(base < plan_.cells.size());
      const SweptSettings swept = swept_settings(*cell.backend, cell.settings, sweep, fixed_settings(set));
      std::vector<std::size_t> places;
      for (const Json& settings : swept.settings) {
        Cell next = cell;
        next.settings = settings;
        places.push_back(settings == cell.settings ? base : add(set, next, 1, "turned"));
      }
      turned.insert(turned.end(), places.begin(), places.end());
      for (const Ladder& ladder : swept.ladders) add_ladder(set, ladder, places);
    }
    add_steps(set, base, turned);
  }

  void add_ladder(const StudySet& set, const Ladder& ladder, const std::vector<std::size_t>& places) {
    PLUMB_ASSERT(ladder.base < places.size() && ladder.probe < places.size() && ladder.base != ladder.probe);
    const std::size_t base = places[ladder.base], probe = places[ladder.probe];
    StudyLadder mine;
    mine.knob = differing_knob(plan_.cells[base].cell, plan_.cells[probe].cell);
    mine.cells = {base, probe};
    for (const std::size_t other : ladder.others) {
      const std::size_t place = places[other];
      mine.cells.push_back(place);
      PlannedCell& rung = plan_.cells[place];
      if (rung.stage != 1) continue;  // a base of its own
      rung.stage = 2;
      if (!fixed_) rung.unless_same = {plan_.cells[base].id, plan_.cells[probe].id};
    }
    keep(set, std::move(mine));
  }

  void keep(const StudySet& set, StudyLadder ladder) {
    if (fixed_ || !set.refine || ladder.cells.size() < 3) return;
    plan_.ladders.push_back(std::move(ladder));
  }

  static std::string differing_knob(const Cell& a, const Cell& b) {
    for (const SettingDescription& setting : a.backend->settings) {
      if (is_number(setting) && knob_value(a, setting.name) != knob_value(b, setting.name)) return setting.name;
    }
    return "dt";
  }

  void add_steps(const StudySet& set, std::size_t base, const std::vector<std::size_t>& turned) {
    if (set.dt.empty()) return;
    StudyLadder ladder{"dt", {base}, 0};
    for (const double dt : set.dt) {
      for (const std::size_t place : set.cross ? turned : std::vector<std::size_t>{base}) {
        Cell next = plan_.cells[place].cell;
        if (next.dt == dt) continue;
        next.dt = dt;
        const std::size_t added = add(set, next, place == base ? 1 : 2, "turned");
        if (place == base) ladder.cells.push_back(added);
      }
    }
    keep(set, std::move(ladder));
  }

  static std::vector<SettingRequest> fixed_settings(const StudySet& set) {
    std::vector<SettingRequest> fixed;
    for (const std::string& text : set.settings) fixed.push_back(parse_setting_request(text));
    return fixed;
  }

  // A named setting, or all of a role and type that can be turned so.
  static std::vector<SweepAxis> axes_of(const std::vector<StudyAxis>& axes, const BackendDescription& backend,
                                        const std::string& option, const std::vector<SettingRequest>& fixed) {
    std::vector<SweepAxis> resolved;
    const auto taken = [&](const std::string& name) {
      const auto same = [&](const auto& other) { return other.name == name; };
      return std::any_of(resolved.begin(), resolved.end(), same) || std::any_of(fixed.begin(), fixed.end(), same);
    };
    for (const StudyAxis& axis : axes) {
      if (!axis.backend.empty() && axis.backend != backend.name) continue;
      for (const SettingDescription& setting : backend.settings) {
        const bool meant = axis.role.empty()
                               ? setting.name == axis.name
                               : setting.role == axis.role && (axis.type.empty() || axis.type == setting.type) &&
                                     is_number(setting) == (option == "--along");
        if (!meant || taken(setting.name)) continue;
        // A knob at 0 has no halves and doubles; whoever wants it turned names it with values.
        if (!axis.role.empty() && option == "--along" && !(setting.default_value.get<double>() > 0)) continue;
        resolved.push_back({option, backend.name, setting.name, axis.values});
      }
    }
    return resolved;
  }

  // Methods one at a time, each with the ladders about it, or all at once where the set is crossed.
  static std::vector<Sweep> sweeps_of(const StudySet& set, const BackendDescription& backend) {
    const std::vector<SettingRequest> fixed = fixed_settings(set);
    Sweep plain;
    plain.unnamed_knobs = false;
    plain.along = axes_of(set.along, backend, "--along", fixed);
    const std::vector<SweepAxis> over = axes_of(set.over, backend, "--over", fixed);
    if (over.empty()) return {plain};
    std::vector<Sweep> sweeps;
    for (const SweepAxis& axis : over) {
      sweeps.push_back(plain);
      sweeps.back().over = set.cross ? over : std::vector<SweepAxis>{axis};
      if (set.cross) break;
    }
    return sweeps;
  }

  static void check_axes(const StudySet& set, const std::vector<BuiltBackend>& backends) {
    std::vector<BackendDescription> descriptions;
    for (const BuiltBackend& backend : backends) descriptions.push_back(*backend.description);
    Sweep named;
    const auto gather = [&](const std::vector<StudyAxis>& axes, const char* option, std::vector<SweepAxis>& into) {
      for (const StudyAxis& axis : axes) {
        const bool known =
            std::any_of(descriptions.begin(), descriptions.end(), [&](const BackendDescription& backend) {
              return (axis.backend.empty() || axis.backend == backend.name) && backend.setting(axis.name) != nullptr;
            });
        if (!axis.name.empty() && (known || !axis.optional))
          into.push_back({option, axis.backend, axis.name, axis.values});
      }
    };
    gather(set.over, "--over", named.over);
    gather(set.along, "--along", named.along);
    check_sweep(named, descriptions, fixed_settings(set));
  }

  void make_batches() {
    std::map<std::pair<int, std::string>, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < plan_.cells.size(); ++i)
      groups[{plan_.cells[i].stage, plan_.cells[i].batch}].push_back(i);
    std::mt19937 random(study_.shuffle);
    std::vector<std::vector<std::size_t>> of_stage;
    for (int stage = 0; stage <= refined_stage; ++stage) {
      of_stage.clear();
      for (auto& [key, cells] : groups) {
        if (key.first != stage) continue;
        if (stage > 0) std::shuffle(cells.begin(), cells.end(), random);
        const std::size_t most = stage == 0 ? cells.size() : largest_batch;
        for (std::size_t at = 0; at < cells.size(); at += most) {
          const auto begin = cells.begin() + static_cast<std::ptrdiff_t>(at);
          of_stage.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(std::min(most, cells.size() - at)));
        }
      }
      std::shuffle(of_stage.begin(), of_stage.end(), random);
      plan_.batches.insert(plan_.batches.end(), of_stage.begin(), of_stage.end());
    }
  }

  const StudyFile& study_;
  bool fixed_;
  std::vector<BuiltBackend> backends_;
  StudyPlan plan_;
};

}  // namespace

std::size_t StudyPlan::add(PlannedCell cell) {
  const auto [at, is_new] = places.try_emplace(cell.id, cells.size());
  PLUMB_ASSERT(is_new ? at->second == cells.size() : at->second < cells.size());
  if (is_new) {
    cells.push_back(std::move(cell));
    return at->second;
  }
  PlannedCell& known = cells[at->second];
  if (cell.stage < known.stage) {
    known.stage = cell.stage;
    known.batch = cell.batch;
  }
  if (!cell.unless_same) known.unless_same.reset();
  known.record = known.record || cell.record;
  known.repetitions.at_least = std::max(known.repetitions.at_least, cell.repetitions.at_least);
  known.repetitions.at_most = std::max(known.repetitions.at_most, cell.repetitions.at_most);
  known.repetitions.within = std::max(known.repetitions.within, cell.repetitions.within);
  return at->second;
}

double knob_value(const Cell& cell, const std::string& knob) {
  if (knob == "dt") return cell.dt;
  const SettingDescription* setting = cell.backend->setting(knob);
  PLUMB_ASSERT(setting != nullptr && is_number(*setting));
  return cell.settings.value(knob, setting->default_value).get<double>();
}

Cell with_knob(Cell cell, const std::string& knob, double value) {
  if (knob == "dt") {
    cell.dt = value;
    return cell;
  }
  const SettingDescription* setting = cell.backend->setting(knob);
  PLUMB_ASSERT(setting != nullptr && is_number(*setting));
  const Json wanted = setting->type == "int" ? Json(static_cast<std::int64_t>(std::llround(value))) : Json(value);
  if (wanted == setting->default_value) {
    cell.settings.erase(knob);
  } else {
    cell.settings[knob] = wanted;
  }
  return cell;
}

StudyPlan plan_study(const StudyFile& study, bool fixed) { return Planner(study, fixed).plan(); }

}  // namespace plumb::harness
