// What is known of each call of calls.inl at compile time: its number, name, table, and the rules that hold for it.
#pragma once

#include <cstdint>
#include <string_view>

#include "plumb/plumb.h"

namespace plumb::layers {

enum class Thread { any_thread, one_caller, many_callers };
enum class Remarks { no_remark, may_grow, may_truncate, may_copy };
enum class Objects { no_handles, shapes, bodies, joints };

/// The tables of the wall by the word that calls.inl uses, with the name by which a host asks for them.
namespace tables {
using core = PlumbBackendTable;
using joints = PlumbJointsTable;
using queries = PlumbQueriesTable;
using collide = PlumbCollideTable;
using debug = PlumbDebugTable;
using settings = PlumbSettingsTable;
using snapshot = PlumbSnapshotTable;
using state = PlumbStateTable;
using exceptions = PlumbExceptionsTable;
using modify = PlumbModifyTable;
using manifolds = PlumbManifoldsTable;
using closest = PlumbClosestTable;
using cooking = PlumbCookingTable;
}  // namespace tables

enum class Call : std::uint8_t {
#define PLUMB_CALL(number, table, member, thread, remarks, objects) table##_##member = number,
#include "calls.inl"
#undef PLUMB_CALL
};

template <Call call>
struct CallTraits;
#define PLUMB_CALL(number, table, member, thread_tag, remark_set, object_kind)               \
  template <>                                                                                \
  struct CallTraits<Call::table##_##member> {                                                \
    using Table = tables::table;                                                             \
    static constexpr auto pointer = &tables::table::member;                                  \
    static constexpr std::string_view name =                                                 \
        std::string_view(#table) == "core" ? std::string_view(#member) : #table "." #member; \
    static constexpr Thread thread = Thread::thread_tag;                                     \
    static constexpr Remarks remarks = Remarks::remark_set;                                  \
    static constexpr Objects objects = Objects::object_kind;                                 \
  };
#include "calls.inl"
#undef PLUMB_CALL

/// "" for a number that is no call.
[[nodiscard]] constexpr std::string_view name_of(Call call) {
  switch (call) {
#define PLUMB_CALL(number, table, member, thread, remarks, objects) \
  case Call::table##_##member:                                      \
    return CallTraits<Call::table##_##member>::name;
#include "calls.inl"
#undef PLUMB_CALL
  }
  return "";
}

/// Calls visit.template operator()<call>() for every call, in the order of their numbers.
template <class Visit>
void for_each_call(Visit&& visit) {
#define PLUMB_CALL(number, table, member, thread, remarks, objects) visit.template operator()<Call::table##_##member>();
#include "calls.inl"
#undef PLUMB_CALL
}

/// The extensions whose tables the layers know, as for_each_extension(visit<Table>(name)).
template <class Visit>
void for_each_extension(Visit&& visit) {
  visit.template operator()<PlumbJointsTable>(PLUMB_EXT_JOINTS);
  visit.template operator()<PlumbQueriesTable>(PLUMB_EXT_QUERIES);
  visit.template operator()<PlumbCollideTable>(PLUMB_EXT_COLLIDE);
  visit.template operator()<PlumbDebugTable>(PLUMB_EXT_DEBUG);
  visit.template operator()<PlumbSettingsTable>(PLUMB_EXT_SETTINGS);
  visit.template operator()<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT);
  visit.template operator()<PlumbStateTable>(PLUMB_EXT_STATE);
  visit.template operator()<PlumbExceptionsTable>(PLUMB_EXT_EXCEPTIONS);
  visit.template operator()<PlumbModifyTable>(PLUMB_EXT_MODIFY);
  visit.template operator()<PlumbManifoldsTable>(PLUMB_EXT_MANIFOLDS);
  visit.template operator()<PlumbClosestTable>(PLUMB_EXT_CLOSEST);
  visit.template operator()<PlumbCookingTable>(PLUMB_EXT_COOKING);
}

}  // namespace plumb::layers
