// The one list of calls is whole: every function of every table is in it, or is one of the questions that have no
// world.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "calls.hpp"
#include "ill_table.hpp"
#include "layer_slots.hpp"

namespace plumb::layers {
namespace {

// How many function pointers a table holds after its first 8 bytes of sizes and counts.
template <class Table>
constexpr std::size_t functions = (sizeof(Table) - 8) / sizeof(void (*)());

TEST(Calls, ListHoldsEveryFunctionOfEveryTable) {
  std::size_t core = 0, joints = 0, queries = 0, collide = 0, debug = 0, settings = 0, snapshot = 0, state = 0,
              exceptions = 0, modify = 0, manifolds = 0, closest = 0, cooking = 0;
  for_each_call([&]<Call call>() {
    using Table = CallTraits<call>::Table;
    core += std::is_same_v<Table, PlumbBackendTable>;
    joints += std::is_same_v<Table, PlumbJointsTable>;
    queries += std::is_same_v<Table, PlumbQueriesTable>;
    collide += std::is_same_v<Table, PlumbCollideTable>;
    debug += std::is_same_v<Table, PlumbDebugTable>;
    settings += std::is_same_v<Table, PlumbSettingsTable>;
    snapshot += std::is_same_v<Table, PlumbSnapshotTable>;
    state += std::is_same_v<Table, PlumbStateTable>;
    exceptions += std::is_same_v<Table, PlumbExceptionsTable>;
    modify += std::is_same_v<Table, PlumbModifyTable>;
    manifolds += std::is_same_v<Table, PlumbManifoldsTable>;
    closest += std::is_same_v<Table, PlumbClosestTable>;
    cooking += std::is_same_v<Table, PlumbCookingTable>;
  });
  EXPECT_EQ(core + 4, functions<PlumbBackendTable>) << "beside info, capability, extension and error_text";
  EXPECT_EQ(joints, functions<PlumbJointsTable>);
  EXPECT_EQ(queries, functions<PlumbQueriesTable>);
  EXPECT_EQ(collide, functions<PlumbCollideTable>);
  EXPECT_EQ(debug, functions<PlumbDebugTable>);
  EXPECT_EQ(settings + 1, functions<PlumbSettingsTable>) << "beside describe";
  EXPECT_EQ(snapshot, functions<PlumbSnapshotTable>);
  EXPECT_EQ(state, functions<PlumbStateTable>);
  EXPECT_EQ(exceptions, functions<PlumbExceptionsTable>);
  EXPECT_EQ(modify, functions<PlumbModifyTable>);
  EXPECT_EQ(manifolds, functions<PlumbManifoldsTable>);
  EXPECT_EQ(closest, functions<PlumbClosestTable>);
  EXPECT_EQ(cooking + 2, functions<PlumbCookingTable>) << "beside cook and release, which have no world";
}

TEST(Calls, NumbersAndNamesAreDistinct) {
  std::set<int> numbers;
  std::set<std::string> names;
  std::size_t count = 0;
  for_each_call([&]<Call call>() {
    ++count;
    numbers.insert(static_cast<int>(call));
    names.insert(std::string(name_of(call)));
    EXPECT_LT(static_cast<int>(call), 200) << "from there on are the records of a trace that are no calls";
  });
  EXPECT_EQ(numbers.size(), count);
  EXPECT_EQ(names.size(), count);
  EXPECT_EQ(name_of(Call::core_create_bodies), "create_bodies");
  EXPECT_EQ(name_of(Call::joints_create), "joints.create");
}

TEST(Calls, TablesThatAreTooShortLackAMember) {
  PlumbBackendTable table{};
  table.step = [](PlumbWorld*, const PlumbStepDesc*) -> PlumbResult { return PLUMB_OK; };
  table.struct_size = sizeof table;
  EXPECT_TRUE(has(table, &PlumbBackendTable::step));
  EXPECT_FALSE(has(table, &PlumbBackendTable::wait));
  table.struct_size = offsetof(PlumbBackendTable, step);
  EXPECT_FALSE(has(table, &PlumbBackendTable::step));
}

}  // namespace
}  // namespace plumb::layers
