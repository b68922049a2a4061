// Checks of what comes over the wall: each failure names the argument, its value and what it must be.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::backend {

/// Names one element of an argument, "bodies[3]". Text is made only when a check fails.
struct Where {
  const char* array;
  std::size_t index;

  [[nodiscard]] std::string member(const char* name) const {
    return std::string(array) + "[" + std::to_string(index) + "]" + (*name == '\0' ? "" : ".") + name;
  }
};

[[nodiscard]] inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

[[noreturn]] inline void refuse(PlumbResult code, const std::string& text) { throw Error(code, text); }

[[noreturn]] inline void refuse_value(const Where& where, const char* member, double value, const char* remedy) {
  refuse(PLUMB_E_INVALID_ARGUMENT, where.member(member) + " is " + number_text(value) + "; it must be " + remedy);
}

inline void require_finite(const Where& where, const char* member, double value) {
  if (!std::isfinite(value)) refuse_value(where, member, value, "finite");
}

inline void require_finite(const Where& where, const char* member, const PlumbVec3& value) {
  const std::string name(member);
  if (!std::isfinite(value.x)) refuse_value(where, (name + ".x").c_str(), value.x, "finite");
  if (!std::isfinite(value.y)) refuse_value(where, (name + ".y").c_str(), value.y, "finite");
  if (!std::isfinite(value.z)) refuse_value(where, (name + ".z").c_str(), value.z, "finite");
}

inline void require_positive(const Where& where, const char* member, double value) {
  if (!(std::isfinite(value) && value > 0)) refuse_value(where, member, value, "finite and above 0");
}

inline void require_not_negative(const Where& where, const char* member, double value) {
  if (!(std::isfinite(value) && value >= 0)) refuse_value(where, member, value, "finite and not below 0");
}

inline void require_unit(const Where& where, const char* member, const PlumbQuat& q) {
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(std::abs(norm - 1) < 1e-3)) refuse_value(where, (std::string(member) + " (its length)").c_str(), norm, "1");
}

inline void require_pose(const Where& where, const char* member, const PlumbPose& pose) {
  require_finite(where, (std::string(member) + ".position").c_str(), pose.position);
  require_unit(where, (std::string(member) + ".orientation").c_str(), pose.orientation);
}

inline void require_pointer(const void* pointer, std::size_t count, const char* name) {
  if (pointer == nullptr && count != 0)
    refuse(PLUMB_E_INVALID_ARGUMENT,
           std::string(name) + " is null; it must point to " + std::to_string(count) + " rows");
}

inline void require_known_bits(const Where& where, const char* member, std::uint32_t value, std::uint32_t known) {
  if ((value & ~known) != 0) refuse_value(where, member, value, "made of the flags that plumb.h names");
}

/// The caller's descriptors as this side's struct: members that an older caller does not know become 0, those that a
/// newer caller knows beyond ours are not seen.
template <class Desc>
[[nodiscard]] std::vector<Desc> adopt_descs(const Desc* descs, std::size_t stride, std::uint32_t count,
                                            const char* name, std::size_t smallest = sizeof(Desc)) {
  require_pointer(descs, count, name);
  std::vector<Desc> adopted(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto* from = reinterpret_cast<const std::byte*>(descs) + std::size_t{i} * stride;
    std::uint32_t struct_size = 0;
    std::memcpy(&struct_size, from, sizeof struct_size);
    if (struct_size < smallest || struct_size > stride)
      refuse(PLUMB_E_INVALID_ARGUMENT, Where{name, i}.member("struct_size") + " is " + std::to_string(struct_size) +
                                           " with a stride of " + std::to_string(stride) +
                                           "; set both to the sizeof of the descriptor");
    std::memcpy(&adopted[i], from, std::min<std::size_t>(struct_size, sizeof(Desc)));
    adopted[i].struct_size = sizeof(Desc);
  }
  return adopted;
}

/// Plain rows (rays, casts) that carry no struct_size.
template <class Row>
[[nodiscard]] std::vector<Row> adopt_rows(const Row* rows, std::size_t stride, std::uint32_t count, const char* name) {
  require_pointer(rows, count, name);
  if (stride < sizeof(Row) && count != 0)
    refuse(PLUMB_E_INVALID_ARGUMENT, std::string("stride of ") + name + " is " + std::to_string(stride) +
                                         "; it must be at least " + std::to_string(sizeof(Row)));
  std::vector<Row> adopted(count);
  for (std::uint32_t i = 0; i < count; ++i)
    std::memcpy(&adopted[i], reinterpret_cast<const std::byte*>(rows) + std::size_t{i} * stride, sizeof(Row));
  return adopted;
}

/// Hands rows out into the caller's array of a possibly different row size.
template <class Row>
[[nodiscard]] PlumbResult hand_out(std::span<const Row> rows, Row* out, std::size_t stride, std::uint32_t capacity,
                                   std::uint32_t* count) {
  if (count == nullptr) refuse(PLUMB_E_INVALID_ARGUMENT, "count is null; it must point to a number");
  require_pointer(out, capacity, "out");
  *count = static_cast<std::uint32_t>(rows.size());
  const std::size_t written = std::min<std::size_t>(rows.size(), capacity);
  if (stride == sizeof(Row)) {
    std::copy_n(rows.begin(), written, out);
  } else {
    for (std::size_t i = 0; i < written; ++i)
      std::memcpy(reinterpret_cast<std::byte*>(out) + i * stride, &rows[i], std::min(stride, sizeof(Row)));
  }
  return written < rows.size() ? PLUMB_TRUNCATED : PLUMB_OK;
}

}  // namespace plumb::backend
