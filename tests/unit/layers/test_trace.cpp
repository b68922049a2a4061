// A trace replays to the same bits, and a difference is found at the step, body and field where it is.
#include <filesystem>
#include <fstream>

#include "ill_table.hpp"

namespace plumb::test {
namespace {

const PlumbBackendTable& sample() {
  static const Backend backend = open_backend(SAMPLE_BACKEND);
  return backend.table();
}

class Trace : public ::testing::Test {
 protected:
  ~Trace() override { std::filesystem::remove(file); }

  /// Particles thrown about for some steps, with bodies that come and go.
  void record(const PlumbBackendTable& backend, const layers::TraceOptions& options = {1}, int steps = 20) {
    const PlumbBackendTable* traced = layers::trace(&backend, file, options);
    run(traced, steps);
    layers::end_trace(traced);
  }
  static void run(const PlumbBackendTable* table, int steps) {
    const auto world = Backend(table).create_world(world_desc(0));
    const PlumbShapeDesc sphere = [] {
      PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
      desc.radius = 0.5;
      return desc;
    }();
    PlumbShape shape = 0;
    check(*world, world->create_shapes({&sphere, 1}, {&shape, 1}));
    std::vector<PlumbBodyDesc> descs(5, body_desc());
    for (std::size_t i = 0; i < descs.size(); ++i) {
      descs[i].shape = shape;
      descs[i].flags = PLUMB_BODY_NO_ROTATION;
      descs[i].material.friction = 0;
      descs[i].linear_velocity = {1.0 + static_cast<double>(i), 2, 3};
      descs[i].user_data = 100 + i;
    }
    std::vector<PlumbBody> ids(descs.size());
    check(*world, world->create_bodies(descs, ids));
    PlumbStepReport report{};
    for (int step = 0; step < steps; ++step) {
      if (step == 5) check(*world, world->destroy_bodies({&ids[1], 1}));
      if (step == 6) check(*world, world->create_bodies({&descs[0], 1}, {&ids[1], 1}));
      if (step == 7) {
        EXPECT_EQ(world->destroy_shapes({&shape, 1}), PLUMB_E_IN_USE);
      }
      if (step == 8) {
        EXPECT_EQ(world->set_gravity({0, 0, -9.81}), PLUMB_OK);
      }
      check(*world, world->step(1.0 / 60));
      check(*world, world->wait(report));
      std::vector<PlumbPose> poses(world->bodies().size());
      check(*world, world->read(PLUMB_FIELD_POSE, {}, rows_over<PlumbPose>(poses)));
    }
  }
  void refused(const std::string& words) {
    try {
      static_cast<void>(layers::replay(file, &sample()));
      FAIL() << "a trace was replayed that should not be";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), PLUMB_E_CORRUPT);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  std::string bytes() const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  void write(const std::string& bytes) const { std::ofstream(file, std::ios::binary) << bytes; }

  std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      ("plumb-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".trace");
};

TEST_F(Trace, RoundTrip) {
  record(sample());
  const layers::ReplayReport report = layers::replay(file, &sample());
  EXPECT_TRUE(report.same()) << (report.result ? report.result->text : report.first_output.value_or(""));
  EXPECT_EQ(report.recorded.backend, "sample");
  EXPECT_EQ(report.recorded.build, "sample-1");
  EXPECT_EQ(report.recorded.rows_every, 1u);
  EXPECT_EQ(layers::trace_header(file).backend, "sample");
  EXPECT_EQ(report.worlds, 1u);
  EXPECT_EQ(report.steps, 20u);
  EXPECT_GT(report.calls, 60u);
}

/// Which part of a descriptor is recorded must not make of it one that is taken.
TEST_F(Trace, ABodyOfAWrongSizeIsRefusedAgain) {
  const PlumbBackendTable* traced = layers::trace(&sample(), file, {1});
  {
    const auto world = Backend(traced).create_world(world_desc(0));
    PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
    desc.material.friction = 0;
    desc.struct_size = 4096;
    PlumbBody id = 0;
    EXPECT_EQ(world->create_bodies({&desc, 1}, {&id, 1}), PLUMB_E_INVALID_ARGUMENT);
  }
  layers::end_trace(traced);
  EXPECT_TRUE(layers::replay(file, &sample()).same());
}

TEST_F(Trace, ReplaysUnderValidationWithoutAFinding) {
  record(sample());
  const PlumbBackendTable* validated = layers::validate(&sample());
  EXPECT_TRUE(layers::replay(file, validated).same());
  EXPECT_TRUE(layers::findings(validated).empty());
}

TEST_F(Trace, FindsTheStepTheBodyAndTheField) {
  record(sample());
  static int steps;
  steps = 0;
  static PlumbBackendTable nudged;
  nudged = sample();
  nudged.wait = [](PlumbWorld* world, PlumbStepReport* report) -> PlumbResult {
    const PlumbResult result = sample().wait(world, report);
    if (++steps == 13) {
      PlumbBody ids[5];
      std::uint32_t count = 0;
      EXPECT_EQ(sample().list_bodies(world, ids, 5, &count), PLUMB_OK);
      double row[7];
      EXPECT_EQ(sample().read(world, PLUMB_FIELD_POSE, PLUMB_F64, &ids[2], 1, row, sizeof row), PLUMB_OK);
      row[2] += 0.25;
      EXPECT_EQ(sample().write(world, PLUMB_FIELD_POSE, PLUMB_F64, &ids[2], 1, row, sizeof row), PLUMB_OK);
    }
    return result;
  };
  const layers::ReplayReport report = layers::replay(file, &nudged);
  EXPECT_EQ(report.results_differ, 0u);
  EXPECT_GT(report.outputs_differ, 0u) << "poses that were read differ from there on";
  ASSERT_TRUE(report.state);
  EXPECT_EQ(report.state->world, 1u);
  EXPECT_EQ(report.state->step, 13u);
  EXPECT_EQ(report.state->row_step, 13u);
  EXPECT_EQ(report.state->field, "position.z");
  EXPECT_EQ(report.state->body, 4u) << "the third that lives is the fourth that was made";
  EXPECT_EQ(report.state->bodies, 1u);
  EXPECT_DOUBLE_EQ(report.state->largest, 0.25);
  EXPECT_DOUBLE_EQ(report.state->replayed - report.state->recorded, 0.25);
}

TEST_F(Trace, RowsAreThereForEveryDifferenceHoweverSparse) {
  record(sample(), {8}, 13);
  static int steps;
  steps = 0;
  static PlumbBackendTable nudged;
  nudged = sample();
  nudged.step = [](PlumbWorld* world, const PlumbStepDesc* desc) -> PlumbResult {
    PlumbStepDesc other = *desc;
    if (++steps == 10) other.dt *= 2;
    return sample().step(world, &other);
  };
  const layers::ReplayReport report = layers::replay(file, &nudged);
  ASSERT_TRUE(report.state);
  EXPECT_EQ(report.state->step, 10u);
  EXPECT_EQ(report.state->row_step, 13u) << "the last step before the world went";
  EXPECT_EQ(report.state->bodies, 5u);
  EXPECT_GT(report.state->largest, 0);
}

TEST_F(Trace, ResultsThatDiffer) {
  record(sample());
  const PlumbBackendTable* failing = layers::inject(&sample(), {"set_gravity", 1, PLUMB_E_UNSUPPORTED});
  const layers::ReplayReport report = layers::replay(file, failing);
  EXPECT_EQ(report.results_differ, 1u);
  ASSERT_TRUE(report.result);
  EXPECT_EQ(report.result->name, "set_gravity");
  EXPECT_EQ(report.result->recorded, PLUMB_OK);
  EXPECT_EQ(report.result->replayed, PLUMB_E_UNSUPPORTED);
  EXPECT_EQ(report.result->text, "injected failure of call 1 of set_gravity");
  ASSERT_TRUE(report.state);
  EXPECT_EQ(report.state->step, 9u);
}

// Every kind of call, with what hangs on its pointers, goes through a file and comes to a backend as it was.
TEST_F(Trace, AllCallsOfABackendWithExtensions) {
  const PlumbBackendTable* traced = layers::trace(&good().core, file);
  {
    const PlumbSetting iterations{"iterations", {PLUMB_SETTING_INT, 0, 33, nullptr}};
    PlumbWorldDesc desc = world_desc(PLUMB_NEED_ALL & ~PLUMB_NEED_CCD);
    desc.settings = &iterations;
    desc.setting_count = 1;
    const auto world = Backend(traced).create_world(desc);
    const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::uint32_t triangles[] = {0, 2, 1, 0, 1, 3};
    const double heights[] = {0, 1, 2, 3, 4, 5};
    PlumbShapeDesc shapes[4] = {shape_desc(PLUMB_SPHERE), shape_desc(PLUMB_CONVEX_HULL),
                                shape_desc(PLUMB_TRIANGLE_MESH), shape_desc(PLUMB_HEIGHT_FIELD)};
    shapes[0].radius = 1;
    shapes[1].vertices = shapes[2].vertices = corners;
    shapes[1].vertex_count = shapes[2].vertex_count = 4;
    shapes[2].indices = triangles;
    shapes[2].triangle_count = 2;
    shapes[3].heights = heights;
    shapes[3].rows = 2;
    shapes[3].columns = 3;
    shapes[3].spacing = {1, 0, 1};
    const PlumbMaterial materials[] = {{0.1, 0, {}}, {0.9, 0.5, {}}};
    const std::uint32_t of[] = {1, 0, PLUMB_BODY_MATERIAL, 1};
    for (PlumbShapeDesc& surface : std::span(shapes).subspan(2)) {
      surface.materials = materials;
      surface.material_count = 2;
      surface.triangle_materials = of;
    }
    PlumbShape ids[4];
    check(*world, world->create_shapes(shapes, ids));
    const PlumbCompoundChild children[2] = {{ids[0], identity_pose(), 0, 0, {}}, {ids[1], identity_pose(), 0, 0, {}}};
    PlumbShapeDesc compound = shape_desc(PLUMB_COMPOUND);
    compound.children = children;
    compound.child_count = 2;
    PlumbShape compound_id = 0;
    check(*world, world->create_shapes({&compound, 1}, {&compound_id, 1}));
    PlumbBodyDesc bodies[2] = {body_desc(), body_desc()};
    bodies[0].shape = compound_id;
    bodies[1].shape = ids[0];
    PlumbBody body_ids[2];
    check(*world, world->create_bodies(bodies, body_ids));
    PlumbJointDesc joint = joint_desc(PLUMB_JOINT_BALL);
    joint.body_a = body_ids[0];
    joint.body_b = body_ids[1];
    PlumbJoint joint_id = 0;
    check(*world, world->joints()->create_joints({&joint, 1}, {&joint_id, 1}));
    const double motor[12] = {};
    check(*world,
          world->joints()->write_joints(PLUMB_JOINT_MOTOR, {&joint_id, 1},
                                        {reinterpret_cast<const std::byte*>(motor), 1, sizeof motor, PLUMB_F64}));
    const PlumbRay ray{{0, 0, 0}, {1, 0, 0}, {1, 1, 0, 0}};
    check(*world, world->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).result);
    check(*world, world->settings()->set_setting("iterations", {PLUMB_SETTING_INT, 0, 44, nullptr}));
    PlumbSettingValue value{};
    check(*world, world->settings()->get_setting("iterations", value));
    std::span<const std::byte> saved;
    check(*world, world->snapshot()->save(saved));
    const std::vector<std::byte> copy(saved.begin(), saved.end());
    FakeWorld::last->event_rows = {};
    check(*world, world->step(0.1));
    PlumbStepReport report{};
    check(*world, world->wait(report));
    check(*world, world->snapshot()->restore(copy));
    EXPECT_EQ(world->snapshot()->restore(std::span(copy).first(3)), PLUMB_E_CORRUPT);
    const PlumbBody stale = 77;
    EXPECT_EQ(world->destroy_bodies({&stale, 1}), PLUMB_E_STALE_HANDLE);
    static_cast<void>(world->events());
    static_cast<void>(world->contacts());
    check(*world, world->joints()->destroy_joints({&joint_id, 1}));
  }
  layers::end_trace(traced);
  const layers::ReplayReport report = layers::replay(file, &good().core);
  EXPECT_TRUE(report.same()) << (report.result ? report.result->name + ": " + report.result->text
                                               : report.first_output.value_or("state"));
  ASSERT_EQ(report.settings.size(), 3u);
  EXPECT_EQ(report.settings[0], std::make_pair(std::string("iterations"), std::string("33")));

  // On a backend with fewer extensions and shapes it goes on as far as it can, and says where the two part.
  const layers::ReplayReport other = layers::replay(file, &sample());
  ASSERT_TRUE(other.result);
  EXPECT_EQ(other.result->name, "create_world");
  EXPECT_FALSE(other.result->text.empty());
}

TEST_F(Trace, TornForeignAndDamagedFilesAreRefused) {
  write("a story of something else");
  refused("does not begin as a trace does");
  record(sample());
  const std::string whole = bytes();
  for (const std::size_t size :
       {std::size_t{4}, std::size_t{20}, whole.size() / 2, whole.size() - 1, whole.size() - 17}) {
    write(whole.substr(0, size));
    refused("is not a whole trace");
  }
  std::string damaged = whole;
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 1);
  write(damaged);
  refused("damaged");
  write(whole + "x");
  refused("follow after its end");
  damaged = whole;
  damaged[8] = 9;
  write(damaged);
  refused("its format is 9");
  std::filesystem::remove(file);
  EXPECT_THROW(static_cast<void>(layers::replay(file, &sample())), Error);
}

TEST_F(Trace, FilesThatCannotBeWritten) {
  EXPECT_THROW(static_cast<void>(layers::trace(&sample(), file / "no" / "folder")), Error);
  EXPECT_THROW(static_cast<void>(layers::trace(&sample(), file, {0})), Error);
  EXPECT_THROW(layers::end_trace(&sample()), Error);
  for (int i = 0; i < 40; ++i) layers::end_trace(layers::trace(&sample(), file));  // slots are given back
}

}  // namespace
}  // namespace plumb::test
