// A scene: what a scene file says, and what it becomes once its parameters have values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/usage_error.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::harness {

/// Values of a scene's parameters. Words are parameters that choose; numbers are all others.
using ParameterValue = std::variant<double, std::string>;
using Parameters = std::map<std::string, ParameterValue>;

struct ParameterSpec {
  std::string name, unit, doc;
  ParameterValue default_value;
  std::vector<std::string> choices;        ///< of a word; empty for a number
  std::optional<double> minimum, maximum;  ///< of a number, both allowed
  bool integer = false;
};

/// A number that the scene measures, and what it is held against. error <= threshold is a pass, <= gold is gold.
struct MetricSpec {
  std::string name, unit, doc;
  std::optional<double> threshold, gold;
  bool optional = false;  ///< not measured where the engine lacks what it takes; else that is a miss
};

/// A shape with the arrays that its descriptor points to.
struct SceneShape {
  struct Child {
    std::size_t shape;  ///< index into Scene::shapes, smaller than this shape's own
    PlumbPose pose;
    std::optional<PlumbMaterial> material;
  };
  std::string name;
  PlumbShapeDesc desc{};  ///< array pointers unset: see descriptor()
  std::vector<double> vertices, heights;
  std::vector<std::uint32_t> indices, triangle_materials;
  std::vector<PlumbMaterial> materials;  ///< by triangle_materials; none: the body's
  std::vector<Child> children;

  /// desc with its array pointers set into this object; children are left to the caller, who knows their handles.
  [[nodiscard]] PlumbShapeDesc descriptor() const;
};

struct SceneBody {
  std::string name;
  std::optional<std::size_t> shape;  ///< index into Scene::shapes
  PlumbBodyDesc desc{};              ///< shape handle unset
};

struct SceneJoint {
  std::string name;
  std::optional<std::size_t> body_a;  ///< index into Scene::bodies; none: the world
  std::size_t body_b = 0;
  PlumbJointDesc desc{};                                 ///< body handles unset
  double cut = std::numeric_limits<double>::infinity();  ///< s; the host takes the joint away
};

/// What the host does to a body or a joint while the scene runs.
struct SceneAction {
  /// What its numbers are: a path's position and the angle about `axis`; force and torque; impulse and angular impulse;
  /// target velocity and largest force of each of six motors; where each of six springs rests.
  enum Kind { path, force, impulse, motors, targets };
  struct Number {
    double constant = 0;
    std::string text;  ///< an expression over the time t; "" where it is the constant
  };
  [[nodiscard]] bool is_of_joint() const { return kind == motors || kind == targets; }

  Kind kind = path;
  std::size_t target = 0;     ///< index into Scene::bodies, of motors and targets into Scene::joints
  std::string name;           ///< of the target
  PlumbVec3 axis{};           ///< a unit, world; about which a path turns the body from its start
  double begin = 0, end = 0;  ///< s; of an impulse both are its time
  std::vector<Number> numbers;
  std::map<std::string, double> names;  ///< what expressions may use besides t
};

/// A scene whose parameters have values: plain numbers, ready to be built in a world or transformed.
struct Scene {
  std::string id, slug, group;
  Parameters parameters;
  PlumbNeeds needs = 0;
  PlumbVec3 gravity{0, -9.81, 0};
  double dt = 1.0 / 60;
  double seconds = 10;
  std::vector<SceneShape> shapes;
  std::vector<SceneBody> bodies;
  std::vector<SceneJoint> joints;
  std::vector<SceneAction> host;
  std::string measure;          ///< name of the measure (measure/measure.hpp)
  nlohmann::json measure_args;  ///< its arguments, expressions resolved to numbers
  std::vector<MetricSpec> metrics;
  std::string lacks;  ///< what this machine has not and the scene needs, with the remedy; "" when nothing: else it
                      ///< cannot be built

  /// Whether parts of shapes have other materials than the bodies that have them.
  [[nodiscard]] bool has_part_materials() const;
  /// Index of a body by name; throws UsageError with the nearest name.
  [[nodiscard]] std::size_t body(const std::string& name) const;
  [[nodiscard]] std::size_t joint(const std::string& name) const;
  /// The value of a parameter; throws std::logic_error when the scene has none of that name or kind.
  [[nodiscard]] double number(const std::string& parameter) const;
  [[nodiscard]] const std::string& word(const std::string& parameter) const;
};

/// Times that a user asks for in place of the file's; whatever the file works out from them sees these.
struct Times {
  std::optional<double> dt, seconds;
};

/// A scene file, parsed and checked, its parameters still open.
class SceneFile {
 public:
  /// Throws UsageError that names file, line and the nearest known key.
  static SceneFile load(const std::filesystem::path& path);

  std::string id, slug, group;  ///< "D1", "tower", "stacking" (the folder)
  std::string title, doc;
  bool core = false;
  std::filesystem::path path;
  std::uint64_t hash = 0;  ///< of the file's text
  std::vector<ParameterSpec> parameters;
  std::vector<Parameters> variants;  ///< the cells that `plumb run ID` makes when no parameter is given; at least one
  std::vector<MetricSpec> metrics;
  PlumbNeeds needs = 0;
  nlohmann::json json;  ///< the whole file
  std::string text;     ///< likewise, in which errors find their line

  /// The scene for these values (missing ones take their default). Throws UsageError for unknown names, values out of
  /// range, expressions that fail, numbers that no engine may be given, and sizes beyond limits.hpp, which are judged
  /// before anything is made.
  [[nodiscard]] Scene instantiate(const Parameters& given, const Times& times = {}) const;
  /// The scene without its shapes, bodies and joints, in which nothing is wrong. One of many_objects is not made for
  /// that: whoever makes it finds what is wrong.
  [[nodiscard]] Scene outline(const Parameters& given, const Times& times = {}) const;
};

}  // namespace plumb::harness
