// What the guard knows of a shape, as far as its descriptor and the backend alone say it.
#pragma once

#include <optional>

#include "plumb/backend/check_descs.hpp"
#include "plumb/backend/mass_properties.hpp"
#include "plumb/backend/tables.hpp"

namespace plumb::backend {

struct ShapeRecord {
  PlumbShapeType type = 0;
  std::uint32_t uses = 0;
  std::vector<PlumbShape> children = {};
  std::optional<MassProperties> unit_mass = {};  ///< at density 1; none for shapes without a volume
  std::string no_mass_because = {};
  std::uint64_t content = 0;  ///< shape_content(), in worlds with snapshots
};

[[nodiscard]] inline PlumbDegree degree_of(const BackendFacts& facts, PlumbCapability kind, std::uint32_t a,
                                           std::uint32_t b, const char*& note) {
  note = "";
  return facts.capability(kind, a, b, note);
}

inline void require_capability(const BackendFacts& facts, PlumbCapability kind, std::uint32_t a, std::uint32_t b,
                               const std::string& what) {
  const char* note = "";
  if (degree_of(facts, kind, a, b, note) == PLUMB_NONE)
    refuse(PLUMB_E_UNSUPPORTED, std::string(facts.info->name) + " has no " + what + (*note == '\0' ? "" : ": ") + note);
}

/// Whether bodies of any motion may have shapes of the type.
[[nodiscard]] inline bool has_shape(const BackendFacts& facts, PlumbShapeType type) {
  const char* note = "";
  for (PlumbMotion motion = 0; motion < PLUMB_MOTION_COUNT; ++motion)
    if (degree_of(facts, PLUMB_CAP_SHAPE, type, motion, note) != PLUMB_NONE) return true;
  return false;
}

/// Refuses numbers out of range, and what the backend lacks.
inline void check_known_shape(const BackendFacts& facts, const Where& where, const PlumbShapeDesc& desc) {
  check_shape(where, desc);
  if (!has_shape(facts, desc.type))
    require_capability(facts, PLUMB_CAP_SHAPE, desc.type, PLUMB_STATIC, shape_name(desc.type));
  if (has_triangle_materials(desc))
    require_capability(facts, PLUMB_CAP_TRIANGLE_MATERIAL, desc.type, 0,
                       std::string("materials by triangle of a ") + shape_name(desc.type));
}

/// Finds the mass of the record. children: of a compound.
inline void weigh(const BackendFacts& facts, const Where& where, const PlumbShapeDesc& desc,
                  std::span<const MassProperties> children, ShapeRecord& record) {
  // Whether a mesh is closed takes as long to find as all the rest, and matters to bodies that forces move alone.
  const char* note = "";
  const bool has_mass = desc.type != PLUMB_TRIANGLE_MESH ||
                        degree_of(facts, PLUMB_CAP_SHAPE, desc.type, PLUMB_DYNAMIC, note) != PLUMB_NONE;
  if (!has_mass) return;
  try {
    record.unit_mass = unit_mass_properties(desc, children);
  } catch (const Error& error) {
    if (desc.type == PLUMB_CONVEX_HULL) refuse(error.code(), where.member("vertices") + ": " + error.what());
    record.no_mass_because = error.what();
  }
}

}  // namespace plumb::backend
