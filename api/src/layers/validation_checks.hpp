// Checks of arguments and answers that the validation layer makes: each failure is a sentence with the remedy.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include "plumb/physics_world.hpp"

namespace plumb::layers {

/// A host's mistake: the call is not forwarded.
struct HostError {
  PlumbResult code;
  std::string text;
};
/// A backend's mistake, seen after the call.
struct BackendError {
  std::string text;
};

[[noreturn]] inline void refuse_argument(const std::string& text) { throw HostError{PLUMB_E_INVALID_ARGUMENT, text}; }

inline void require_memory(const void* pointer, std::size_t count, const char* name) {
  if (pointer == nullptr && count != 0)
    refuse_argument(std::string(name) + " is null; it must point to " + std::to_string(count) + " of them");
}

/// For arrays of structs: room for one, and each where its type may stand.
template <class Row>
void require_stride(std::size_t stride, std::uint32_t count, const char* name) {
  if (count == 0) return;
  if (stride < sizeof(Row))
    refuse_argument("stride of " + std::string(name) + " is " + std::to_string(stride) + "; one takes " +
                    std::to_string(sizeof(Row)) + " bytes");
  if (stride % alignof(Row) != 0)
    refuse_argument("stride of " + std::string(name) + " is " + std::to_string(stride) + "; it must be a multiple of " +
                    std::to_string(alignof(Row)));
}

template <class Desc>
void require_struct_size(const Desc& desc, std::size_t room, const std::string& name) {
  if (desc.struct_size < sizeof(Desc) || desc.struct_size > room)
    refuse_argument(name + ".struct_size is " + std::to_string(desc.struct_size) + "; set it to the sizeof, " +
                    std::to_string(sizeof(Desc)));
}

template <class Desc>
void require_descs(const Desc* descs, std::size_t stride, std::uint32_t count) {
  require_memory(descs, count, "descs");
  require_stride<Desc>(stride, count, "descs");
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto* at = reinterpret_cast<const std::byte*>(descs) + i * stride;
    require_struct_size(*reinterpret_cast<const Desc*>(at), stride, "descs[" + std::to_string(i) + "]");
  }
}

/// The size of a row of numbers; refuses fields and types that are none, and strides that are too short for it.
inline std::size_t require_rows(std::uint32_t columns, PlumbDataType type, const void* rows, std::uint32_t count,
                                std::size_t stride) {
  if (columns == 0) refuse_argument("field is none that plumb.h names");
  if (type != PLUMB_F32 && type != PLUMB_F64)
    refuse_argument("type is " + std::to_string(type) + "; it must be PLUMB_F32 or PLUMB_F64");
  const std::size_t size = columns * (type == PLUMB_F64 ? sizeof(double) : sizeof(float));
  require_memory(rows, count, "rows");
  if (count != 0 && stride < size)
    refuse_argument("stride of rows is " + std::to_string(stride) + "; one takes " + std::to_string(size) + " bytes");
  return size;
}

/// The rule of every call that lists: OK means that all fitted, TRUNCATED that they did not.
inline void require_count(PlumbResult result, std::size_t capacity, std::size_t count) {
  if (result == PLUMB_TRUNCATED ? count <= capacity : result >= 0 && count > capacity)
    throw BackendError{"answered " + std::to_string(result) + " and a count of " + std::to_string(count) +
                       " for a capacity of " + std::to_string(capacity)};
}

}  // namespace plumb::layers
