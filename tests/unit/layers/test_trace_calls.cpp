// Every call of the one list goes into a trace and comes back out of it as it was.
#include <filesystem>
#include <fstream>
#include <set>

#include "calls.hpp"
#include "every_call.hpp"
#include "trace_format.hpp"

namespace plumb::test {
namespace {

TEST(TraceCalls, EveryCallOfTheListIsRecordedAndReplaysTheSame) {
  const auto file = std::filesystem::temp_directory_path() / "plumb-every-call.trace";
  const PlumbBackendTable* traced = layers::trace(&complete(), file);
  { const Everything everything(traced); }
  layers::end_trace(traced);

  std::ifstream in(file, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  layers::ByteReader reader(std::as_bytes(std::span(bytes)));
  reader.get_bytes(sizeof layers::trace_magic + 8);
  for (int i = 0; i < 4; ++i) static_cast<void>(reader.get_string());
  reader.get_bytes(8);
  std::set<std::uint8_t> seen;
  while (reader.left() > 0) {
    const auto size = reader.get<std::uint32_t>();
    static_cast<void>(reader.get<std::uint32_t>());
    seen.insert(static_cast<std::uint8_t>(reader.get_bytes(size)[0]));
  }
  layers::for_each_call([&]<layers::Call call>() {
    EXPECT_TRUE(seen.contains(static_cast<std::uint8_t>(call))) << layers::name_of(call) << " is not in the trace";
  });

  static std::vector<PlumbBodyDesc> heard;
  heard.clear();
  static PlumbBackendTable hearing;
  hearing = complete();
  hearing.create_bodies = [](PlumbWorld* world, const PlumbBodyDesc* descs, std::size_t stride, std::uint32_t count,
                             PlumbBody* ids) {
    EXPECT_EQ(stride, sizeof(PlumbBodyDesc));
    heard.assign(descs, descs + count);
    return complete().create_bodies(world, descs, stride, count, ids);
  };
  static std::vector<PlumbJointDesc> joined;
  joined.clear();
  static PlumbJointsTable joints;
  joints = *static_cast<const PlumbJointsTable*>(complete().extension(PLUMB_EXT_JOINTS));
  joints.create = [](PlumbWorld* world, const PlumbJointDesc* descs, std::size_t stride, std::uint32_t count,
                     PlumbJoint* ids) {
    EXPECT_EQ(stride, sizeof(PlumbJointDesc));
    joined.assign(descs, descs + count);
    return static_cast<const PlumbJointsTable*>(complete().extension(PLUMB_EXT_JOINTS))
        ->create(world, descs, stride, count, ids);
  };
  hearing.extension = [](const char* name) -> const void* {
    return std::string_view(name) == PLUMB_EXT_JOINTS ? &joints : complete().extension(name);
  };
  const layers::ReplayReport report = layers::replay(file, &hearing);
  EXPECT_TRUE(report.same()) << (report.result ? report.result->name + ": " + report.result->text
                                               : report.first_output.value_or("state"));
  EXPECT_EQ(report.steps, 2u);
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_EQ(heard[0].rolling_friction, 0);
  EXPECT_EQ(heard[1].rolling_friction, 0.25);
  ASSERT_EQ(joined.size(), 2U);
  EXPECT_EQ(joined[1].ratio, 3);
  EXPECT_EQ(joined[0].ratio, 0);
  EXPECT_EQ(joined[0].struct_size, sizeof(PlumbJointDesc));
  std::filesystem::remove(file);
}

TEST(TraceCalls, EveryCallPassesValidation) {
  const PlumbBackendTable* validated = layers::validate(&complete());
  { const Everything everything(validated); }
  for (const layers::Finding& finding : layers::findings(validated)) ADD_FAILURE() << finding.text;
}

TEST(TraceCalls, AStepThatFailsHasNotBegun) {
  const auto world = Backend(&good().core).create_world(world_desc(0));
  FakeWorld::last->on_step = [] { throw Error(PLUMB_E_UNSUPPORTED, "not today"); };
  EXPECT_EQ(world->step(0.1), PLUMB_E_UNSUPPORTED);
  FakeWorld::last->on_step = nullptr;
  EXPECT_EQ(world->step(0.1), PLUMB_OK) << world->error_text();
  PlumbStepReport report{};
  EXPECT_EQ(world->wait(report), PLUMB_OK);
}

}  // namespace
}  // namespace plumb::test
