
#include "measure/quantities/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "measure/instruments/args.hpp"
#include "measure/instruments/referee_view.hpp"
#include "plumb/nearest.hpp"
#include "scene/build.hpp"
#include "scene/expressions.hpp"

namespace plumb::harness {
namespace {

using nlohmann::json;

/// An argument that waits for the time, as the scene file's reader left it.
bool waits_for_time(const json& argument) { return argument.is_object() && argument.contains("expression"); }

/// A truth as a function of time.
class TruthOfTime {
 public:
  explicit TruthOfTime(const json& argument) : text_(argument.at("expression").get<std::string>()) {
    for (const auto& [name, value] : argument.at("names").items()) expressions_.set(name, value.get<double>());
  }
  /// Throws std::invalid_argument.
  double operator()(double time) {
    expressions_.set("t", time);
    return expressions_.evaluate(text_);
  }

 private:
  Expressions expressions_;
  std::string text_;
};

const std::vector<std::string>& axis_words() {
  static const std::vector<std::string> words{"x", "y", "z"};
  return words;
}

/// Reads one entry, and says where it is wrong.
class EntryReader {
 public:
  EntryReader(const Scene& scene, const SceneFile* file, const std::string& name, const json& entry)
      : scene_(scene), file_(file), name_(name), entry_(entry) {}

  QuantityRequest read() {
    if (!entry_.is_object()) fail("", "must be an object, not " + entry_.dump());
    for (const auto& [key, value] : entry_.items())
      if (const auto& keys = quantity_keys(); std::find(keys.begin(), keys.end(), key) == keys.end())
        fail(key, fmt::format("unknown key \"{}\"{}", key, suggestion(key, keys)));
    QuantityRequest request;
    request.name = name_;
    read_target(request.target);
    read_reduction(request);
    read_unit(request);
    read_truth(request);
    return request;
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& sentence) const {
    const std::string what = fmt::format("quantity \"{}\": {}", name_, sentence);
    if (file_ == nullptr) throw UsageError(fmt::format("scene {}: {}", scene_.id, what));
    JsonPath path{std::string("measure"), std::string("quantities"), name_};
    if (!key.empty()) path.emplace_back(key);
    fail_at(*file_, path, what);
  }

  [[nodiscard]] bool has(const char* key) const { return entry_.contains(key); }

  const std::string& text(const char* key) const {
    if (!has(key)) fail("", fmt::format("the key \"{}\" is missing here", key));
    if (!entry_.at(key).is_string()) fail(key, fmt::format("{} must be a name, not {}", key, entry_.at(key).dump()));
    return entry_.at(key).get_ref<const std::string&>();
  }
  double number(const char* key) const { return number_in(key, entry_.at(key)); }
  double number_in(const char* key, const json& value) const {
    if (waits_for_time(value)) fail(key, fmt::format("{} may not use the time t; truth alone may", key));
    if (!value.is_number())
      fail(key, fmt::format("{} must be a number, or an expression that starts with =, not {}", key, value.dump()));
    return value.get<double>();
  }
  bool flag(const char* key) const {
    if (!has(key)) return false;
    if (!entry_.at(key).is_boolean()) fail(key, fmt::format("{} must be true or false", key));
    return entry_.at(key).get<bool>();
  }

  std::size_t body_named(const char* key, const json& name) const {
    if (!name.is_string()) fail(key, fmt::format("{} must name a body, not {}", key, name.dump()));
    try {
      return scene_.body(name.get_ref<const std::string&>());
    } catch (const UsageError& error) {
      fail(key, error.what());
    }
  }

  /// What is observed: of = which of the keys body, joint and pair stands here, or none.
  void read_target(QuantityWatch::Target& target) {
    Observed of = Observed::all;
    if (has("body") + has("joint") + has("pair") > 1) fail("", "has more than one of body, joint and pair");
    if (has("body")) {
      of = Observed::body;
      target.first = body_named("body", entry_.at("body"));
    } else if (has("joint")) {
      of = Observed::joint;
      try {
        target.first = scene_.joint(text("joint"));
      } catch (const UsageError& error) {
        fail("joint", error.what());
      }
    } else if (has("pair")) {
      of = Observed::pair;
      const json& pair = entry_.at("pair");
      if (!pair.is_array() || pair.size() != 2) fail("pair", "pair must name two bodies: [\"a\", \"b\"]");
      target.first = body_named("pair", pair[0]);
      target.second = body_named("pair", pair[1]);
      if (target.first == target.second) fail("pair", "pair names the same body twice");
    }
    find_spec(of, target);
    read_along(target);
    target.since_start = flag("since_start");
    if (target.since_start && target.spec->has(QuantitySpec::of_step))
      fail("since_start", fmt::format("{} belongs to a step, and the start has none", target.spec->name));
    check_needs(target);
  }

  void find_spec(Observed of, QuantityWatch::Target& target) {
    const std::string& name = text("quantity");
    std::vector<std::string> known;
    target.spec = nullptr;
    for (const QuantitySpec& spec : quantity_specs()) {
      if (spec.of != of) continue;
      known.emplace_back(spec.name);
      if (name == spec.name) target.spec = &spec;
    }
    if (target.spec != nullptr) return;
    const char* what =
        of == Observed::all ? "all bodies together (name a body, joint or pair for others)" : word_of(of);
    fail("quantity", fmt::format("there is no \"{}\" of {}{}", name, what, suggestion(name, known)));
  }

  void read_along(QuantityWatch::Target& target) {
    if (!has("along")) return;
    if (!target.spec->takes_direction()) fail("along", fmt::format("{} has no direction", target.spec->name));
    const json& along = entry_.at("along");
    if (along.is_string()) {
      const auto axis = std::find(axis_words().begin(), axis_words().end(), along.get_ref<const std::string&>());
      if (axis == axis_words().end()) fail("along", "along must be x, y, z or an array of three numbers");
      target.along = referee::Vec3::Unit(axis - axis_words().begin());
      return;
    }
    if (!along.is_array() || along.size() != 3) fail("along", "along must be x, y, z or an array of three numbers");
    const referee::Vec3 direction(number_in("along", along[0]), number_in("along", along[1]),
                                  number_in("along", along[2]));
    if (direction.norm() == 0) fail("along", "a direction must not be 0 0 0");
    target.along = direction.normalized();
  }

  void check_needs(const QuantityWatch::Target& target) {
    const QuantitySpec& spec = *target.spec;
    for (std::uint32_t bit = 0; !metric().optional && bit < PLUMB_NEED_COUNT; ++bit)
      if ((spec.needs >> bit & 1) != 0 && (scene_.needs >> bit & 1) == 0)
        fail("quantity",
             fmt::format("{} of a {} is for scenes that need \"{}\": add it to needs, or make the metric optional",
                         spec.name, word_of(spec.of), need_words()[bit]));
    const bool of_shapes =
        spec.of == Observed::pair && (spec.name == std::string("distance") || spec.name == std::string("overlap"));
    for (const std::size_t body : {target.first, target.second})
      if (of_shapes && !scene_.bodies[body].shape)
        fail("pair", fmt::format("body {} has no shape, so it is at no {}", scene_.bodies[body].name, spec.name));
    const double mass = spec.of == Observed::all ? RefereeView(scene_).total_mass() : 1;
    if (spec.name == std::string("centre") && mass == 0) fail("quantity", "no body has mass, so they have no centre");
  }

  void read_reduction(QuantityRequest& request) {
    ReductionSpec& reduction = request.reduction;
    reduction.dt = scene_.dt;
    reduction.of_step = request.target.spec->has(QuantitySpec::of_step);
    if (has("take")) {
      const std::string& word = text("take");
      const auto found = std::find(take_words().begin(), take_words().end(), word);
      if (found == take_words().end())
        fail("take", fmt::format("there is no take \"{}\"{}", word, suggestion(word, take_words())));
      reduction.take = static_cast<Take>(found - take_words().begin());
    }
    reduction.smooth = flag("smooth");
    if (reduction.smooth && reduction.of_step)
      fail("smooth", fmt::format("{} belongs to a step: nothing lies between two", request.target.spec->name));
    if (needs_a_level(reduction.take) != has("level"))
      fail(has("level") ? "level" : "",
           has("level") ? "level is for take crossing_time and period" : "crossing_time and period need a level");
    if (has("level")) reduction.level = number("level");
    read_times(reduction);
  }

  void read_times(ReductionSpec& reduction) {
    reduction.end = scene_.seconds;
    if (reduction.take == Take::at) {
      if (has("over")) fail("over", "over needs a take, such as max or mean");
      if (has("at")) reduction.end = number("at");
      reduction.begin = reduction.end;
      check_time("at", reduction.begin);
      return;
    }
    if (has("at")) fail("at", "at is for a value at a time, not for a take");
    if (has("over")) {
      const json& over = entry_.at("over");
      if (!over.is_array() || over.size() != 2) fail("over", "over must be a window of two times: [begin, end]");
      reduction.begin = number_in("over", over[0]);
      reduction.end = number_in("over", over[1]);
      check_time("over", reduction.begin);
      check_time("over", reduction.end);
    }
    const double least = needs_a_level(reduction.take) ? 2 : 1;
    if (samples_within(reduction) < least)
      fail("over", fmt::format("the window from {:g} to {:g} s is empty: it holds {:g} of the {:g} samples that it "
                               "takes, one each {:g} s",
                               reduction.begin, reduction.end, samples_within(reduction), least, scene_.dt));
  }

  void check_time(const char* key, double time) const {
    if (time < 0) fail(key, fmt::format("{:g} s is before the start", time));
    if (time > scene_.seconds + scene_.dt * 1e-6)
      fail(key, fmt::format("{:g} s is beyond the scene's end at {:g} s", time, scene_.seconds));
  }

  [[nodiscard]] const MetricSpec& metric() const {
    return *std::find_if(scene_.metrics.begin(), scene_.metrics.end(),
                         [&](const MetricSpec& spec) { return spec.name == name_; });
  }

  void read_unit(QuantityRequest& request) {
    const std::string unit = gives_a_time(request.reduction.take) ? "s" : request.target.spec->unit;
    try {
      request.in_unit = conversion(unit, metric().unit);
    } catch (const std::invalid_argument&) {
      fail("quantity", fmt::format("it is in {}, and its metric is in \"{}\"", unit, metric().unit));
    }
  }

  void read_truth(QuantityRequest& request) {
    if (!has("truth")) fail("", "the key \"truth\" is missing here: what it should be, 0 for what should not be there");
    const json& truth = entry_.at("truth");
    if (waits_for_time(truth)) {
      const ReductionSpec& reduction = request.reduction;
      if (gives_a_time(reduction.take)) fail("truth", "what is taken is a time, so its truth has no t");
      try {
        TruthOfTime at(truth);
        request.truth = at(reduction.begin);
        static_cast<void>(at(reduction.end));
      } catch (const std::invalid_argument& error) {
        fail("truth", error.what());
      }
      if (reduction.take != Take::at) {
        request.truth = 0;
        request.truth_of_time = truth;
      }
    } else {
      request.truth = number("truth");
    }
    request.scale = request.truth != 0 ? std::abs(request.truth) : 1;
    if (!has("scale")) return;
    request.scale = number("scale");
    if (!(request.scale > 0)) fail("scale", fmt::format("scale must be above 0, not {:g}", request.scale));
  }

  const Scene& scene_;
  const SceneFile* file_;
  const std::string& name_;
  const json& entry_;
};

/// Whether the scene has a metric of the name: the file's metrics whose `when` is 0 it has not.
bool stands_in(const Scene& scene, const std::string& name) {
  return std::any_of(scene.metrics.begin(), scene.metrics.end(),
                     [&](const MetricSpec& spec) { return spec.name == name; });
}

/// A quantity for each metric, and a metric for each quantity.
void check_names(const SceneFile& file, const json& quantities) {
  const json& metrics = file.json.at("metrics");
  std::vector<std::string> known;
  for (const auto& [name, metric] : metrics.items()) known.push_back(name);
  for (const auto& [name, entry] : quantities.items())
    if (!metrics.contains(name))
      fail_at(file, {std::string("measure"), std::string("quantities"), name},
              fmt::format("quantity \"{}\" is no metric of the scene{}", name, suggestion(name, known)));
  for (const std::string& name : known)
    if (!quantities.contains(name))
      fail_at(file, {std::string("metrics"), name},
              fmt::format("metric \"{}\" has no entry in the quantities of the measure", name));
}

bool names_something_t(const SceneFile& file) {
  const json definitions = file.json.value("let", json::array());
  return std::any_of(file.parameters.begin(), file.parameters.end(),
                     [](const auto& spec) { return spec.name == "t"; }) ||
         std::any_of(definitions.begin(), definitions.end(), [](const json& let) { return let.at("name") == "t"; });
}

/// A request at work.
class Measured {
 public:
  explicit Measured(const QuantityRequest& request)
      : request_(request), watch_(request.target), reduction_(make_reduction(request.reduction)) {
    if (!request.truth_of_time.is_null()) truth_ = std::make_unique<TruthOfTime>(request.truth_of_time);
  }

  void observe(ObservedScene& scene, Simulation& now) {
    const bool wanted = reduction_->wants(now.time());
    if (!wanted && !watch_.has_memory() && now.steps() != 0) return;
    const std::optional<double> value = watch_.value(scene, now);
    if (!value || !wanted) return;
    // Beyond the window only parabolas look, and there the truth need not be defined.
    const bool within = reduction_->holds(now.time());
    if (truth_ && !within && !request_.reduction.smooth) return;
    try {
      const double truth = truth_ ? (*truth_)(now.time()) : 0;
      reduction_->add({now.time(), *value - truth});
    } catch (const std::invalid_argument& error) {
      if (within)
        throw Error(PLUMB_E_INVALID_ARGUMENT,
                    fmt::format("metric {} at t = {:g}: {}", request_.name, now.time(), error.what()));
    }
  }

  void add_to(MeasureContext& context) const {
    const auto [value, trouble] = reduction_->result();
    const double unit = request_.in_unit, error = std::abs(value - request_.truth) / request_.scale;
    context.add({request_.name, value * unit, request_.truth * unit, error, std::nullopt, trouble});
  }

 private:
  const QuantityRequest& request_;
  QuantityWatch watch_;
  std::unique_ptr<Reduction> reduction_;
  std::unique_ptr<TruthOfTime> truth_;
};

}  // namespace

const std::vector<std::string>& quantity_keys() {
  static const std::vector<std::string> keys{"quantity", "body", "joint", "pair",   "along", "since_start", "at",
                                             "over",     "take", "level", "smooth", "truth", "scale"};
  return keys;
}

std::vector<QuantityRequest> read_quantities(const Scene& scene, const SceneFile* file) {
  std::vector<QuantityRequest> requests;
  for (const auto& [name, entry] : scene.measure_args.at("quantities").items())
    if (stands_in(scene, name)) requests.push_back(EntryReader(scene, file, name, entry).read());
  return requests;
}

void check_quantities(const SceneFile& file, const Scene& scene) {
  if (names_something_t(file))
    fail_at(file, {std::string("measure")}, "t is the time in truths of quantities: give what is named t another name");
  check_names(file, scene.measure_args.at("quantities"));
  static_cast<void>(read_quantities(scene, &file));
}

void measure_quantities(MeasureContext& context) {
  std::vector<QuantityRequest> requests = read_quantities(context.scene(), nullptr);
  // What an optional metric takes is asked of the engine where it has it.
  PlumbNeeds wanted = 0;
  for (const QuantityRequest& request : requests) wanted |= request.target.spec->needs;
  const PlumbNeeds declared = context.scene().needs;
  const auto [scene, granted] = with_wanted(context, wanted & ~declared);
  if (!granted)
    std::erase_if(requests, [&](const QuantityRequest& one) { return (one.target.spec->needs & ~declared) != 0; });
  ObservedScene observed(scene);
  std::vector<Measured> all;
  for (const QuantityRequest& request : requests) all.emplace_back(request);
  Simulation simulation = context.simulate(scene);
  const auto observe = [&](Simulation& now) {
    for (Measured& one : all) one.observe(observed, now);
  };
  observe(simulation);
  simulation.run(observe);
  for (const Measured& one : all) one.add_to(context);
}

std::span<const MeasureEntry> quantity_measures() {
  using enum ArgumentType;
  static constexpr MeasureArgument quantities_args[] = {{"quantities", object}};
  static constexpr MeasureEntry entries[] = {
      {"quantities", "what the scene file itself says: quantities of bodies, joints or pairs against expressions",
       quantities_args, measure_quantities, check_quantities},
  };
  return entries;
}

}  // namespace plumb::harness
