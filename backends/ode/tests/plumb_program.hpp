// The scene through plumb, and small helpers for tests of the loaded backend.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "plumb/loader.hpp"
#include "scenes.hpp"

namespace plumb::ode_test {

[[nodiscard]] const Backend& ode();

inline constexpr PlumbNeeds usual_needs =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_JOINTS;

[[nodiscard]] PlumbSetting setting(const char* name, double number, PlumbSettingType type = PLUMB_SETTING_FLOAT);
[[nodiscard]] PlumbSetting setting(const char* name, const char* choice);

/// A world and calls that throw on failure.
class TestWorld {
 public:
  explicit TestWorld(PlumbNeeds needs, std::vector<PlumbSetting> settings = {});

  [[nodiscard]] IPhysicsWorld& operator*() const { return *world_; }
  [[nodiscard]] IPhysicsWorld* operator->() const { return world_.get(); }

  PlumbShape shape(const PlumbShapeDesc& desc) const;
  PlumbShape box(double x, double y, double z) const;
  PlumbShape sphere(double radius) const;
  PlumbBody body(const PlumbBodyDesc& desc) const;
  PlumbBody fixed(PlumbShape shape, PlumbVec3 at = {0, 0, 0}) const;
  PlumbBody dynamic(PlumbShape shape, PlumbVec3 at) const;
  PlumbJoint joint(const PlumbJointDesc& desc) const;
  PlumbStepReport step(int count = 1, double h = dt) const;
  [[nodiscard]] std::vector<double> row(PlumbBody body, PlumbField field) const;
  [[nodiscard]] std::vector<double> row(PlumbJoint joint, PlumbJointField field, int columns) const;
  [[nodiscard]] PlumbVec3 position(PlumbBody body) const;
  [[nodiscard]] PlumbVec3 velocity(PlumbBody body) const;
  void write(PlumbBody body, PlumbField field, std::vector<double> row) const;

 private:
  std::unique_ptr<IPhysicsWorld> world_;
};

class PlumbProgram {
 public:
  explicit PlumbProgram(const Scene& scene, PlumbNeeds needs = usual_needs);
  void step() { world_.step(); }
  void read(StateRows& rows) const;

 private:
  TestWorld world_;
  std::vector<PlumbBody> moving_;
};

}  // namespace plumb::ode_test
