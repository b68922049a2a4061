// The tables of an honest backend, and the copy of them in which a lie replaces a function or two.
#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::lying {

struct Tables {
  PlumbBackendTable core;
  PlumbBackendInfo info;
  PlumbJointsTable joints;
  PlumbQueriesTable queries;
  PlumbSettingsTable settings;
  PlumbSnapshotTable snapshot;
  PlumbCollideTable collide;
  PlumbDebugTable debug;
};

inline Tables honest{}, liar{};

#define PLUMB_LIE(word, check) void word();
#include "lies.inl"
#undef PLUMB_LIE

template <class Desc>
std::vector<Desc> copied(const Desc* descs, std::size_t stride, std::uint32_t count) {
  std::vector<Desc> copies(count);
  for (std::uint32_t i = 0; i < count; ++i)
    std::memcpy(&copies[i], reinterpret_cast<const std::byte*>(descs) + i * stride, std::min(stride, sizeof(Desc)));
  return copies;
}

/// Calls change(row) for rows of numbers that were read as double; others stay true.
template <class Change>
void change_rows(PlumbDataType type, void* rows, std::size_t stride, std::uint32_t count, Change&& change) {
  if (type != PLUMB_F64) return;
  for (std::uint32_t i = 0; i < count; ++i)
    change(reinterpret_cast<double*>(static_cast<std::byte*>(rows) + i * stride));
}

}  // namespace plumb::lying
