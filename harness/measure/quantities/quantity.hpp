// What the measure "quantities" can observe of a body, a joint, a pair of bodies, or all bodies together: by the
// harness's own float64 from poses and velocities; forces of contacts and joints as the engine tells them.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/measure.hpp"

namespace plumb::harness {

/// What a quantity is of.
enum class Observed { body, joint, pair, all };

/// "body", "joint", "pair", "all".
[[nodiscard]] const char* word_of(Observed observed);

/// What observations of one scene share. Scene must outlive it.
class ObservedScene {
 public:
  explicit ObservedScene(const Scene& scene) : scene_(&scene), view_(scene) {}
  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const RefereeView& view() const { return view_; }
  [[nodiscard]] const referee::Shape& shape_of_body(std::size_t body);

 private:
  const Scene* scene_;
  RefereeView view_;
  std::map<std::size_t, referee::ShapePtr> shapes_;  ///< by body, when first asked for
};

/// One moment of one quantity.
struct Observation {
  ObservedScene& scene;
  Simulation& now;
  std::size_t first, second;  ///< the body, the joint, or the two bodies of a pair
  const std::optional<referee::Vec3>& along;
};

struct QuantitySpec {
  Observed of;
  const char* name;
  const char* unit;
  const char* doc;
  /// One of both is set. A vector's part along a direction is taken, or its length where no direction is given.
  referee::Vec3 (*vector)(const Observation&) = nullptr;
  double (*scalar)(const Observation&) = nullptr;
  enum Trait : unsigned {
    none = 0,
    directed = 1,    ///< a scalar that takes a direction
    turns = 2,       ///< an angle with a direction: whole turns count
    of_step = 4,     ///< belongs to a step and not to an instant: the start has none
    difference = 8,  ///< what is observed is its change in a step, over dt
  };
  unsigned traits = none;
  PlumbNeeds needs = 0;  ///< what the scene must declare for it

  [[nodiscard]] bool has(Trait trait) const { return (traits & trait) != 0; }
  [[nodiscard]] bool takes_direction() const { return vector != nullptr || has(directed); }
};

[[nodiscard]] std::span<const QuantitySpec> quantity_specs();

/// A quantity of one scene, followed from its start on.
class QuantityWatch {
 public:
  struct Target {
    const QuantitySpec* spec;
    std::size_t first = 0, second = 0;
    std::optional<referee::Vec3> along;
    bool since_start = false;  ///< the change since the start instead
  };
  explicit QuantityWatch(const Target& target) : target_(target) {}

  /// Whether it must be asked at every step, as what it says depends on the steps before.
  [[nodiscard]] bool has_memory() const;
  /// Its value now; none at the start for what belongs to a step. The start must be asked for.
  [[nodiscard]] std::optional<double> value(ObservedScene& scene, Simulation& now);

 private:
  [[nodiscard]] double scalar(const Observation& observation);

  Target target_;
  Unwrapped unwrap_;
  std::optional<referee::Vec3> start_vector_, last_vector_;
  std::optional<double> start_;
};

}  // namespace plumb::harness
