// A table that ends before what a later minor version appended: the host and the layers do not look beyond its end.
#include <cstddef>

#include "ill_table.hpp"

namespace plumb::test {
namespace {

/// The complete backend with the debug table of 1.0: what lies beyond its end is called by nobody.
const PlumbBackendTable& old_backend() {
  static PlumbDebugTable debug = table_named<PlumbDebugTable>(PLUMB_EXT_DEBUG);
  debug.struct_size = offsetof(PlumbDebugTable, bodies);
  static PlumbBackendTable core = complete();
  core.extension = [](const char* name) -> const void* {
    return std::string_view(name) == PLUMB_EXT_DEBUG ? &debug : complete().extension(name);
  };
  return core;
}

void expect_old(const PlumbBackendTable* table) {
  const auto world = Backend(table).create_world(world_desc(PLUMB_NEED_ALL & ~PLUMB_NEED_CCD));
  ASSERT_NE(world->debug(), nullptr);
  std::span<const PlumbDebugAxis> axes;
  std::span<const PlumbDebugBody> bodies;
  std::span<const PlumbDebugConstraint> constraints;
  EXPECT_EQ(world->debug()->separating_axes(axes), PLUMB_OK);
  EXPECT_EQ(axes.size(), 1u);
  EXPECT_EQ(world->debug()->body_states(bodies), PLUMB_E_UNSUPPORTED);
  EXPECT_EQ(world->debug()->solved_constraints(constraints), PLUMB_E_UNSUPPORTED);
}

TEST(ShortTables, LackWhatIsAppended) {
  expect_old(&old_backend());
  expect_old(layers::validate(&old_backend()));
}

TEST(ShortTables, WholeOnesHaveIt) {
  const auto world = Backend(layers::validate(&complete())).create_world(world_desc(0));
  std::span<const PlumbDebugBody> bodies;
  std::span<const PlumbDebugConstraint> constraints;
  EXPECT_EQ(world->debug()->body_states(bodies), PLUMB_OK);
  EXPECT_EQ(bodies.size(), 1u);
  EXPECT_EQ(world->debug()->solved_constraints(constraints), PLUMB_OK);
  EXPECT_EQ(constraints.size(), 1u);
}

}  // namespace
}  // namespace plumb::test
