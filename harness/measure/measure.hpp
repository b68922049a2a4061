// Measures: what is observed in a scene and which truth it is held against. A scene file names its measure; the measure
// runs the scene (or several transformed copies of it) and hands metrics to its context.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "run/simulation.hpp"
#include "scene/scene.hpp"

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

struct MeasureEntry {
  const char* name;
  const char* doc;                    ///< one line
  std::span<const char* const> args;  ///< argument names that the scene file may give
  MeasureFunction run;
};

/// All measures; each file of measure/ has a list of its own that registry.cpp joins.
[[nodiscard]] std::span<const MeasureEntry> all_measures();

/// The measure of a scene file. Throws UsageError with file, line and the nearest word when its kind or an argument is
/// unknown.
[[nodiscard]] const MeasureEntry& find_measure(const SceneFile& file);

}  // namespace plumb::harness
