// Checks of field rows before a backend sees them.
#pragma once

#include "check_needs.hpp"
#include "plumb/backend/checks.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::backend {

/// The memory of a bulk call: columns of the type must fit in the stride.
inline void check_row_memory(const char* what, std::uint32_t columns, PlumbDataType type, std::uint32_t count,
                             const void* rows, std::size_t stride) {
  if (type != PLUMB_F32 && type != PLUMB_F64)
    refuse(PLUMB_E_INVALID_ARGUMENT, "type is " + std::to_string(type) + "; it must be PLUMB_F32 or PLUMB_F64");
  const std::size_t row_size = columns * (type == PLUMB_F64 ? sizeof(double) : sizeof(float));
  if (stride < row_size && count != 0)
    refuse(PLUMB_E_INVALID_ARGUMENT, "stride is " + std::to_string(stride) + "; a row of " + what + " takes " +
                                         std::to_string(row_size) + " bytes");
  require_pointer(rows, count, "rows");
}

/// Numbers of one row that is to be written.
inline void check_row(PlumbField field, const Where& where, const double* row, std::uint32_t columns) {
  for (std::uint32_t i = 0; i < columns; ++i)
    if (!std::isfinite(row[i]))
      refuse_value(where, (std::string(field_name(field)) + " column " + std::to_string(i)).c_str(), row[i], "finite");
  switch (field) {
    case PLUMB_FIELD_POSE:
    case PLUMB_FIELD_KINEMATIC_TARGET: return require_unit(where, "orientation", {row[3], row[4], row[5], row[6]});
    case PLUMB_FIELD_AWAKE:
      if (row[0] != 0 && row[0] != 1) refuse_value(where, "awake", row[0], "0 or 1");
      return;
    case PLUMB_FIELD_MATERIAL:
      require_not_negative(where, "friction", row[0]);
      if (!(row[1] >= 0 && row[1] <= 1)) refuse_value(where, "restitution", row[1], "from 0 to 1");
      return;
    case PLUMB_FIELD_DAMPING:
      require_not_negative(where, "linear damping", row[0]);
      return require_not_negative(where, "angular damping", row[1]);
    case PLUMB_FIELD_FILTER:
      for (std::uint32_t i = 0; i < 2; ++i)
        if (row[i] < 0 || row[i] > 4294967295.0 || row[i] != std::floor(row[i]))
          refuse_value(where, i == 0 ? "category" : "mask", row[i], "a whole number from 0 to 4294967295");
      if (std::abs(row[2]) > 2147483647.0 || row[2] != std::floor(row[2]))
        refuse_value(where, "group", row[2], "a whole number within 32 bits");
      return;
    default: return;
  }
}

/// Which motions a field may be written for.
inline void check_writable(PlumbField field, const Where& where, PlumbMotion motion) {
  const bool acts = field >= PLUMB_FIELD_FORCE && field <= PLUMB_FIELD_IMPULSE_AT_POINT;
  if ((acts || field == PLUMB_FIELD_AWAKE || field == PLUMB_FIELD_GRAVITY_SCALE || field == PLUMB_FIELD_DAMPING) &&
      motion != PLUMB_DYNAMIC)
    refuse(PLUMB_E_INVALID_ARGUMENT,
           where.member("") + " is not dynamic; its " + field_name(field) + " cannot be written");
  if (field == PLUMB_FIELD_VELOCITY && motion == PLUMB_STATIC)
    refuse(PLUMB_E_INVALID_ARGUMENT, where.member("") + " is static; it has no velocity");
  if (field == PLUMB_FIELD_KINEMATIC_TARGET && motion != PLUMB_KINEMATIC)
    refuse(PLUMB_E_INVALID_ARGUMENT, where.member("") + " is not kinematic; write its pose or velocity instead");
}

}  // namespace plumb::backend
