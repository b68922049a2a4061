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
  PlumbExceptionsTable exceptions;
  PlumbModifyTable modify;
  PlumbManifoldsTable manifolds;
  PlumbWorldsTable worlds;
  PlumbClosestTable closest;
  PlumbCookingTable cooking;
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

template <PlumbEventType type>
void hide_events() {
  liar.core.events = [](PlumbWorld* world, PlumbEvent* out, std::size_t stride, std::uint32_t capacity,
                        std::uint32_t* count) -> PlumbResult {
    std::vector<PlumbEvent> all(10000);
    const PlumbResult result =
        honest.core.events(world, all.data(), sizeof(PlumbEvent), static_cast<std::uint32_t>(all.size()), count);
    if (result != PLUMB_OK) return result;
    all.resize(*count);
    std::erase_if(all, [](const PlumbEvent& event) { return event.type == type; });
    *count = static_cast<std::uint32_t>(all.size());
    for (std::uint32_t i = 0; i < std::min(capacity, *count); ++i)
      std::memcpy(reinterpret_cast<std::byte*>(out) + i * stride, &all[i], sizeof all[i]);
    return *count > capacity ? PLUMB_TRUNCATED : PLUMB_OK;
  };
}

}  // namespace plumb::lying
