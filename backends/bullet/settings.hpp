// Bullet's knobs by name, and their values in one world.
#pragma once

#include <span>

#include "dynamics_world.hpp"
#include "plumb/backend/settings_table.hpp"
#include "shapes.hpp"
#include "solvers.hpp"

namespace plumb::bullet {

class Settings {
 public:
  static std::span<const PlumbSettingInfo> infos();

  explicit Settings(const WorldInit& init) : values_(init.values) {}

  [[nodiscard]] const PlumbSettingValue& value(const char* name) const;
  [[nodiscard]] double number(const char* name) const { return value(name).number; }
  [[nodiscard]] bool is_on(const char* name) const { return value(name).number != 0; }
  void set(const char* name, const PlumbSettingValue& value);

  [[nodiscard]] CollisionOptions collision_options() const;
  [[nodiscard]] ShapeOptions shape_options() const;
  [[nodiscard]] SolverKind solver_kind() const;
  [[nodiscard]] int gyroscopic_flags() const;  ///< of btRigidBody

  /// Hands Bullet's world all that it keeps itself. conveyors: whether surface velocities may occur.
  void apply(DynamicsWorld& world, Dispatcher& dispatcher, bool conveyors) const;

 private:
  [[nodiscard]] std::size_t index_of(const char* name) const;
  [[nodiscard]] std::uint32_t word(const char* name) const;  ///< of a choice, its number
  [[nodiscard]] int solver_mode(bool conveyors) const;

  std::vector<PlumbSettingValue> values_;
};

}  // namespace plumb::bullet
