// What a world declared that it needs, against what is asked of it.
#pragma once

#include "plumb/backend/checks.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::backend {

/// Refuses what `used` says is asked for when `need` (one bit) was not declared.
inline void require_need(PlumbNeeds declared, PlumbNeeds need, bool used, const std::string& what) {
  if (!used || (declared & need) != 0) return;
  std::uint32_t index = 0;
  while ((need >> index) != 1) ++index;
  refuse(PLUMB_E_NOT_DECLARED, what + " asks for " + need_name(index) + "; declare it in PlumbWorldDesc.needs");
}

[[nodiscard]] inline bool is_zero(const PlumbVec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

inline void check_material_needs(PlumbNeeds declared, const std::string& what, const PlumbMaterial& material) {
  require_need(declared, PLUMB_NEED_FRICTION, material.friction != 0, what + ".friction above 0");
  require_need(declared, PLUMB_NEED_RESTITUTION, material.restitution != 0, what + ".restitution above 0");
  require_need(declared, PLUMB_NEED_SURFACE_VELOCITY, !is_zero(material.surface_velocity), what + ".surface_velocity");
}

inline void check_filter_needs(PlumbNeeds declared, const std::string& what, const PlumbFilter& filter) {
  const bool plain = filter.category != 0 && filter.mask == 0xffffffffu && filter.group == 0;
  require_need(declared, PLUMB_NEED_FILTERS, !plain, what);
}

inline void check_body_needs(PlumbNeeds declared, const Where& where, const PlumbBodyDesc& desc) {
  const auto need = [&](PlumbNeeds bit, bool used, const char* member) {
    if (used) require_need(declared, bit, true, where.member(member));
  };
  const auto flag = [&](std::uint32_t bit) { return (desc.flags & bit) != 0; };
  need(PLUMB_NEED_ROTATION, desc.motion == PLUMB_DYNAMIC && !flag(PLUMB_BODY_NO_ROTATION),
       "flags without PLUMB_BODY_NO_ROTATION");
  need(PLUMB_NEED_KINEMATIC, desc.motion == PLUMB_KINEMATIC, "motion");
  need(PLUMB_NEED_SENSORS, flag(PLUMB_BODY_SENSOR), "flags");
  need(PLUMB_NEED_CCD, flag(PLUMB_BODY_CCD), "flags");
  need(PLUMB_NEED_SLEEPING, flag(PLUMB_BODY_ASLEEP), "flags");
  need(PLUMB_NEED_AXIS_LOCKS, desc.locks != 0, "locks");
  need(PLUMB_NEED_DAMPING, desc.linear_damping != 0, "linear_damping");
  need(PLUMB_NEED_DAMPING, desc.angular_damping != 0, "angular_damping");
  check_material_needs(declared, where.member("material"), desc.material);
  check_filter_needs(declared, where.member("filter"), desc.filter);
}

/// The need of writing (or reading) a field; 0 when it needs none.
[[nodiscard]] constexpr PlumbNeeds need_of_field(PlumbField field) {
  switch (field) {
    case PLUMB_FIELD_FORCE:
    case PLUMB_FIELD_TORQUE:
    case PLUMB_FIELD_IMPULSE:
    case PLUMB_FIELD_ANGULAR_IMPULSE:
    case PLUMB_FIELD_FORCE_AT_POINT:
    case PLUMB_FIELD_IMPULSE_AT_POINT: return PLUMB_NEED_FORCES;
    case PLUMB_FIELD_KINEMATIC_TARGET: return PLUMB_NEED_KINEMATIC;
    case PLUMB_FIELD_DAMPING: return PLUMB_NEED_DAMPING;
    case PLUMB_FIELD_SURFACE_VELOCITY: return PLUMB_NEED_SURFACE_VELOCITY;
    case PLUMB_FIELD_FILTER: return PLUMB_NEED_FILTERS;
    default: return 0;
  }
}

}  // namespace plumb::backend
