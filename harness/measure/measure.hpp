// Measures: what is observed in a scene and which truth it is held against. A scene file names its measure; the measure
// runs the scene (or several transformed copies of it) and hands metrics to its context.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "simulation/simulation.hpp"

namespace plumb::harness {

/// A number that came out. error is what is scored; pass and gold follow from the scene's MetricSpec of the name.
struct Metric {
  std::string name;
  double value;
  std::optional<double> truth;
  double error;
  std::optional<double> unbiased_error;  ///< after the scheme's known bias is taken away
  std::string note;                      ///< "" or one line, for example which model the truth assumes
};

/// What a measure gets and gives.
class MeasureContext {
 public:
  virtual ~MeasureContext() = default;
  [[nodiscard]] virtual const Scene& scene() const = 0;

  /// A world with this scene in it, on the cell's backend with the cell's settings. The first one made is the cell's
  /// own: its times, counts, hash and trajectory are recorded. Simulations may live side by side.
  virtual Simulation simulate(const Scene& scene) = 0;
  virtual Simulation simulate(const Scene& scene, const SimulationOptions& options) = 0;
  [[nodiscard]] virtual const SimulationOptions& options() const = 0;
  /// The backend itself, for measures that do not step (bad input, queries).
  [[nodiscard]] virtual Backend& backend() = 0;

  virtual void add(Metric metric) = 0;

  /// A metric whose error is abs(value - truth) / scale.
  void compare(const std::string& name, double value, double truth, double scale, const std::string& note = "");
  /// A metric that is itself an error: truth 0, error abs(value).
  void deviation(const std::string& name, double value, const std::string& note = "");
  /// A yes/no question: value and truth are 0 or 1, error 0 when they agree.
  void expect(const std::string& name, bool value, bool truth, const std::string& note = "");
};

using MeasureFunction = void (*)(MeasureContext&);
/// Throws UsageError for what the scene's measure cannot do, beyond arguments that are missing or of another type.
using MeasureCheck = void (*)(const SceneFile&, const Scene&);

/// What an argument of a measure is: numbers may be expressions, body and joint are names, bodies is what comes before
/// the number in the names of several.
enum class ArgumentType { number, numbers, word, body, bodies, joint, object };

struct MeasureArgument {
  const char* name;
  ArgumentType type;
  bool optional = false;
};
inline constexpr bool may_be_left_out = true;

struct MeasureEntry {
  /// There is no measure without a name and a line that says what it measures: such a list does not compile.
  consteval MeasureEntry(const char* its_name, const char* its_doc, std::span<const MeasureArgument> its_args,
                         MeasureFunction function, MeasureCheck its_check = nullptr)
      : name(its_name), doc(its_doc), args(its_args), run(function), check(its_check) {
    if (*name == '\0' || *doc == '\0') throw "a measure has a name and a doc";
  }

  const char* name;
  const char* doc;                        ///< one line
  std::span<const MeasureArgument> args;  ///< what the scene file gives
  MeasureFunction run;
  MeasureCheck check;  ///< null where there is nothing more to check
};

/// "number", "body" ...: what an argument of the type is called.
[[nodiscard]] const char* word_of(ArgumentType type);

}  // namespace plumb::harness
