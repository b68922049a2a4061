// A small scene for hash tests, made in code with nothing that differs between machines: no libm, own random numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "plumb/loader.hpp"

namespace plumb::impulse::test {

/// Gravity in most tests, m/s2.
inline constexpr PlumbVec3 kDown = {0, -9.81, 0};

/// SplitMix64 (Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }  ///< in [0, 1)
  double between(double low, double high) { return low + (high - low) * uniform(); }
  PlumbQuat turn();  ///< uniform over all turns

 private:
  std::uint64_t state_;
};

/// A setting that is not at its default: one of its choices. No name: all are.
struct Choice {
  const char* setting = nullptr;
  const char* choice = nullptr;
};

/// A world and what is put into it. Materials, filters and the like are set in `body` before a call of add.
class Scene {
 public:
  Scene(const Backend& backend, PlumbNeeds needs, const PlumbVec3& gravity, std::uint32_t threads,
        const Choice& choice = {});

  PlumbBodyDesc body = body_desc();

  PlumbShape sphere(double radius);
  PlumbShape box(const PlumbVec3& half_extents);
  PlumbShape capsule(double radius, double half_height);
  PlumbShape hull(const std::vector<PlumbVec3>& points);
  /// Any other; the arrays are copied.
  PlumbShape make(const PlumbShapeDesc& desc);
  PlumbBody add(PlumbShape shape, const PlumbVec3& position, const PlumbQuat& orientation = {0, 0, 0, 1});
  PlumbBody add_static(PlumbShape shape, const PlumbVec3& position, const PlumbQuat& orientation = {0, 0, 0, 1});
  PlumbBody add_kinematic(PlumbShape shape, const PlumbVec3& position);
  /// 100 x 1 x 100 m, its top at y = 0, centred at x, z.
  void ground(double x = 0, double z = 0);
  /// Four walls about the square of that half width, and the ground.
  void container(double half_width, double height);
  /// From a place in the world to the centre of a body.
  void rod(const PlumbVec3& hook, PlumbBody bob, double length);
  void ball_joint(PlumbBody a, const PlumbVec3& in_a, PlumbBody b, const PlumbVec3& in_b);

  /// Says what becomes of what a step has found, where the world modifies contacts.
  std::function<void(std::span<const PlumbManifold>, std::vector<PlumbManifoldChange>&)> modify_contacts;
  /// Called before each step with the number of steps done.
  std::function<void(Scene&, int)> before_step;
  void target(PlumbBody body, const PlumbVec3& position, const PlumbQuat& orientation = {0, 0, 0, 1});
  /// A row of the field, of as many numbers as it has.
  void write(PlumbField field, PlumbBody body, const std::vector<double>& row);
  void remove(PlumbBody body);
  PlumbJoint join(const PlumbJointDesc& desc);
  /// What cannot be, as for a body that never had a mass, is passed over.
  void modify(const PlumbBodyChange& change);
  void modify(const PlumbJointChange& change);

  /// Steps of 1/60 s.
  void run(int steps);
  [[nodiscard]] std::uint64_t hash();
  [[nodiscard]] std::vector<PlumbPose> poses();
  /// Linear and angular, m/s and rad/s: six numbers.
  [[nodiscard]] std::vector<double> velocity(PlumbBody body);
  [[nodiscard]] IPhysicsWorld& world() { return *world_; }

 private:
  void solve_as_modified();
  PlumbBody put(PlumbMotion motion, PlumbShape shape, const PlumbVec3& position, const PlumbQuat& orientation);

  std::unique_ptr<IPhysicsWorld> world_;
  int steps_ = 0;
};

/// The scenes by name.
struct NamedScene {
  const char* name;
  Choice choice;
  PlumbNeeds needs;
  PlumbVec3 gravity;
  void (*build)(Scene&);
};
[[nodiscard]] const std::vector<NamedScene>& named_scenes();

/// What the backend lacks for the scene, or "".
[[nodiscard]] std::string missing(const Backend& backend, const NamedScene& scene);
[[nodiscard]] std::unique_ptr<Scene> build(const Backend& backend, const NamedScene& scene, std::uint32_t threads);

}  // namespace plumb::impulse::test
