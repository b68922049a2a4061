#include "plugin/ranges.hpp"

#include <cstdio>
#include <string>

#include "math/real.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::impulse {

namespace {

[[noreturn]] void refuse_range(const std::string& what, double value, const char* unit) {
  char number[32];
  std::snprintf(number, sizeof number, "%g ", value);
  throw Error(PLUMB_E_INVALID_ARGUMENT, what + " " + number + unit + " is beyond what impulse computes with (" +
                                            (sizeof(Real) == 8 ? "double" : "float") +
                                            "): use a larger or smaller one");
}

/// Lengths are squared and masses inverted: both must be numbers of the engine's kind.
void require_length(const std::string& what, double metres) {
  const Real length = static_cast<Real>(metres), square = length * length;
  if (!(square > 0 && is_finite(square))) refuse_range(what, metres, "m");
}
/// Coordinates may be 0, and small beside others.
void require_coordinates(const std::string& name, const double* metres, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k)
    if (const Real x = static_cast<Real>(metres[k]); !is_finite(x * x))
      refuse_range(name + "[" + std::to_string(k) + "]", metres[k], "m");
}
void require_inertia(const std::string& what, double value, const char* unit) {
  const auto inverse = static_cast<Real>(1 / value);
  if (!(inverse > 0 && is_finite(inverse) && is_finite(static_cast<Real>(value)))) refuse_range(what, value, unit);
}

}  // namespace

void require_speed(const std::string& name, const PlumbVec3& speed) {
  for (const double along : {speed.x, speed.y, speed.z})
    if (const Real x = static_cast<Real>(along); !is_finite(x * x)) refuse_range(name, along, "m/s");
}

void require_rolling_friction(const std::string& name, double rolling, double spinning) {
  if (const Real x = static_cast<Real>(rolling); !is_finite(x * x))
    refuse_range(name + "rolling_friction", rolling, "m");
  if (const Real x = static_cast<Real>(spinning); !is_finite(x * x))
    refuse_range(name + "spinning_friction", spinning, "m");
}

void require_step(double dt) {
  constexpr double kMostParts = 4096;  // 256 sub-steps, and the step divided twice by four
  const Real least = static_cast<Real>(dt / kMostParts), most = static_cast<Real>(dt);
  if (!is_finite(1 / (least * least)) || !is_finite(most * most)) refuse_range("step.dt", dt, "s");
}

void require_range(const PlumbShapeDesc& desc, std::size_t i) {
  const std::string name = "descs[" + std::to_string(i) + "].";
  for (std::uint32_t k = 0; desc.type == PLUMB_COMPOUND && k < desc.child_count; ++k)
    require_speed(name + "children[" + std::to_string(k) + "].material.surface_velocity",
                  desc.children[k].material.surface_velocity);
  const bool round = desc.type == PLUMB_CAPSULE || desc.type == PLUMB_CYLINDER;
  if (desc.type == PLUMB_SPHERE || round) require_length(name + "radius", desc.radius);
  if (round && desc.half_height != 0) require_length(name + "half_height", desc.half_height);
  if (desc.type == PLUMB_CONVEX_HULL || desc.type == PLUMB_TRIANGLE_MESH)
    require_coordinates(name + "vertices", desc.vertices, std::size_t{3} * desc.vertex_count);
  if (desc.type == PLUMB_HEIGHT_FIELD) {
    require_coordinates(name + "heights", desc.heights, std::size_t{desc.rows} * desc.columns);
    require_length(name + "spacing", desc.spacing.x);
    require_length(name + "spacing", desc.spacing.z);
    require_length(name + "spacing", desc.spacing.x * desc.columns);
    require_length(name + "spacing", desc.spacing.z * desc.rows);
  }
  if (desc.type == PLUMB_BOX)
    for (const double half : {desc.half_extents.x, desc.half_extents.y, desc.half_extents.z})
      require_length(name + "half_extents", half);
}

void require_range(const PlumbBodyDesc& desc, std::size_t i) {
  const std::string name = "descs[" + std::to_string(i) + "].";
  require_speed(name + "material.surface_velocity", desc.material.surface_velocity);
  require_rolling_friction(name, desc.rolling_friction, desc.spinning_friction);
  if (desc.motion != PLUMB_DYNAMIC) return;
  require_inertia(name + "mass", desc.mass, "kg");
  for (const double moment : {desc.inertia.x, desc.inertia.y, desc.inertia.z})
    if (moment != 0) require_inertia(name + "inertia", moment, "kg m2");
}

}  // namespace plumb::impulse
