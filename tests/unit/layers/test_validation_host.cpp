// The validation layer refuses a host's mistakes in words, before the backend hears of them.
#include <thread>

#include "ill_table.hpp"

namespace plumb::test {
namespace {

class ValidatedHost : public Validated {
 protected:
  ValidatedHost() : Validated(layers::FindingKind::host_mistake) {}

  /// Refused with these words, and the backend's class was not called.
  template <class Call>
  void refused(PlumbResult code, const std::string& words, Call&& call) {
    const int before = FakeWorld::last->calls;
    expect(code, call(), words);
    EXPECT_EQ(FakeWorld::last->calls, before);
  }
  PlumbResult step() {
    const PlumbStepDesc desc = {sizeof desc, 0, 0.01};
    return table->step(world, &desc);
  }
};

TEST_F(ValidatedHost, WellBehavedCallsPass) {
  EXPECT_EQ(step(), PLUMB_OK);
  PlumbStepReport report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(table->wait(world, &report), PLUMB_OK) << table->error_text(world);
  EXPECT_EQ(report.bodies, 2u);
  std::uint32_t count = 0;
  EXPECT_EQ(table->list_bodies(world, nullptr, 0, &count), PLUMB_TRUNCATED);
  EXPECT_EQ(count, 2u);
  double rows[2][9] = {{}, {7, 7, 7, 7, 7, 7, 7, 42, 43}};
  EXPECT_EQ(table->read(world, PLUMB_FIELD_POSE, PLUMB_F64, nullptr, 2, rows, sizeof rows[0]), PLUMB_OK);
  EXPECT_EQ(rows[1][0], 1) << "slot of the second body";
  EXPECT_EQ(rows[1][7], 42) << "padding is the host's";
  EXPECT_EQ(table->destroy_bodies(world, bodies.data(), 1), PLUMB_OK) << table->error_text(world);
  PlumbSettingValue value{};
  EXPECT_EQ(extension<PlumbSettingsTable>(PLUMB_EXT_SETTINGS).get(world, "iterations", &value), PLUMB_OK);
  EXPECT_EQ(value.number, 10);
  EXPECT_TRUE(layers::findings(table).empty());
}

/// Who lives after a restore is none of the host's making, and no mistake of the backend's.
TEST_F(ValidatedHost, RestoredWorldsHaveTheBodiesThatTheyHad) {
  const auto& snapshot = extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT);
  std::size_t size = 0;
  ASSERT_EQ(snapshot.save_world(world, nullptr, 0, &size), PLUMB_TRUNCATED);
  std::vector<std::byte> saved(size);
  ASSERT_EQ(snapshot.save_world(world, saved.data(), size, &size), PLUMB_OK) << table->error_text(world);
  EXPECT_EQ(table->destroy_bodies(world, bodies.data(), 1), PLUMB_OK) << table->error_text(world);
  EXPECT_EQ(snapshot.restore(world, saved.data(), size), PLUMB_OK) << table->error_text(world);
  std::uint32_t count = 0;
  EXPECT_EQ(table->list_bodies(world, nullptr, 0, &count), PLUMB_TRUNCATED);
  EXPECT_EQ(count, 2U);
  EXPECT_EQ(table->destroy_bodies(world, bodies.data(), 1), PLUMB_OK) << table->error_text(world);
  EXPECT_TRUE(layers::findings(table).empty());
}

TEST_F(ValidatedHost, PhasesOfAStep) {
  refused(PLUMB_E_WRONG_PHASE, "without a step", [&] { return table->wait(world, nullptr); });
  ASSERT_EQ(step(), PLUMB_OK);
  refused(PLUMB_E_WRONG_PHASE, "between step and wait", [&] { return step(); });
  double row[7];
  refused(PLUMB_E_WRONG_PHASE, "between step and wait",
          [&] { return table->read(world, PLUMB_FIELD_POSE, PLUMB_F64, nullptr, 1, row, sizeof row); });
  const PlumbRay ray{{0, 0, 0}, {1, 0, 0}, {1, 1, 0, 0}};
  PlumbHit hit;
  std::uint32_t count = 0;
  refused(PLUMB_E_WRONG_PHASE, "queries.rays", [&] {
    return extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES)
        .rays(world, PLUMB_HIT_CLOSEST, &ray, sizeof ray, 1, &hit, 1, &count);
  });
  EXPECT_EQ(table->wait(world, nullptr), PLUMB_OK);
  EXPECT_EQ(table->read(world, PLUMB_FIELD_POSE, PLUMB_F64, nullptr, 1, row, sizeof row), PLUMB_OK);
}

TEST_F(ValidatedHost, AWorldThatIsDestroyedWhileItStepsIsWaitedFor) {
  ASSERT_EQ(step(), PLUMB_OK);
  const int before = FakeWorld::last->calls;
  static int seen = 0;
  ill().core.destroy_world = [](PlumbWorld* gone) {
    seen = FakeWorld::last->calls;
    good().core.destroy_world(gone);
  };
  table->destroy_world(world);
  EXPECT_EQ(seen, before + 1) << "wait came first";
  expect_found("destroy_world: called between step and wait");
  world = nullptr;
}

TEST_F(ValidatedHost, OneCallerAtATime) {
  static PlumbResult other, text_asked;
  static const PlumbBackendTable* shared;
  static PlumbWorld* inside;
  shared = table;
  inside = world;
  FakeWorld::last->on_step = [] {
    std::thread([] {
      std::uint32_t count = 0;
      other = shared->list_bodies(inside, nullptr, 0, &count);
      text_asked = std::string(shared->error_text(inside)).empty() ? -1 : 0;
    }).join();
  };
  EXPECT_EQ(step(), PLUMB_OK);
  EXPECT_EQ(other, PLUMB_E_WRONG_THREAD);
  EXPECT_EQ(text_asked, 0) << "error_text may be asked at any time";
  expect_found("another thread");
  EXPECT_EQ(table->wait(world, nullptr), PLUMB_OK);
}

TEST_F(ValidatedHost, AWorldThatSomebodyIsInIsNotDestroyed) {
  static const PlumbBackendTable* shared;
  static PlumbWorld* inside;
  shared = table;
  inside = world;
  FakeWorld::last->on_step = [] { std::thread([] { shared->destroy_world(inside); }).join(); };
  EXPECT_EQ(step(), PLUMB_OK);
  expect_found("destroy_world: another thread is in this world");
  EXPECT_EQ(table->wait(world, nullptr), PLUMB_OK);
}

TEST_F(ValidatedHost, QueriesMayOverlap) {
  static PlumbResult query, change;
  static const PlumbBackendTable* shared;
  static bool outer;
  shared = table;
  outer = true;
  ill().queries.rays = [](PlumbWorld* w, PlumbHitMode mode, const PlumbRay* rays, std::size_t stride,
                          std::uint32_t count, PlumbHit* hits, std::uint32_t capacity,
                          std::uint32_t* found) -> PlumbResult {
    if (std::exchange(outer, false)) {
      std::thread([=] {
        PlumbHit hit;
        std::uint32_t number = 0;
        const auto* queries = static_cast<const PlumbQueriesTable*>(shared->extension(PLUMB_EXT_QUERIES));
        query = queries->rays(w, mode, rays, stride, count, &hit, 1, &number);
        const PlumbVec3 gravity{0, 0, 0};
        change = shared->set_gravity(w, &gravity);
      }).join();
    }
    return good().queries.rays(w, mode, rays, stride, count, hits, capacity, found);
  };
  const PlumbRay ray{{0, 0, 0}, {1, 0, 0}, {1, 1, 0, 0}};
  PlumbHit hit;
  std::uint32_t count = 0;
  EXPECT_EQ(extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES)
                .rays(world, PLUMB_HIT_CLOSEST, &ray, sizeof ray, 1, &hit, 1, &count),
            PLUMB_OK);
  EXPECT_EQ(query, PLUMB_OK);
  EXPECT_EQ(change, PLUMB_E_WRONG_THREAD);
}

TEST_F(ValidatedHost, SizesAndPointers) {
  PlumbBodyDesc desc = body();
  PlumbBody id = 0;
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of descs is 8",
          [&] { return table->create_bodies(world, &desc, 8, 1, &id); });
  refused(PLUMB_E_INVALID_ARGUMENT, "multiple of 8",
          [&] { return table->create_bodies(world, &desc, sizeof desc + 4, 1, &id); });
  refused(PLUMB_E_INVALID_ARGUMENT, "ids is null",
          [&] { return table->create_bodies(world, &desc, sizeof desc, 1, nullptr); });
  refused(PLUMB_E_INVALID_ARGUMENT, "descs is null",
          [&] { return table->create_bodies(world, nullptr, sizeof desc, 1, &id); });
  desc.struct_size = 0;
  refused(PLUMB_E_INVALID_ARGUMENT, "descs[0].struct_size is 0",
          [&] { return table->create_bodies(world, &desc, sizeof desc, 1, &id); });
  EXPECT_EQ(id, 0u);
  refused(PLUMB_E_INVALID_ARGUMENT, "ids is null", [&] { return table->destroy_bodies(world, nullptr, 1); });
  double row[7];
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of rows is 55",
          [&] { return table->read(world, PLUMB_FIELD_POSE, PLUMB_F64, nullptr, 1, row, 55); });
  refused(PLUMB_E_INVALID_ARGUMENT, "type is 9",
          [&] { return table->read(world, PLUMB_FIELD_POSE, 9, nullptr, 1, row, 56); });
  refused(PLUMB_E_INVALID_ARGUMENT, "field",
          [&] { return table->read(world, PLUMB_FIELD_COUNT, PLUMB_F64, nullptr, 1, row, 56); });
  refused(PLUMB_E_INVALID_ARGUMENT, "rows is null",
          [&] { return table->write(world, PLUMB_FIELD_POSE, PLUMB_F64, nullptr, 1, nullptr, 56); });
  PlumbEvent event;
  std::uint32_t count = 0;
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of out is 16", [&] { return table->events(world, &event, 16, 1, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "count is null", [&] { return table->list_bodies(world, nullptr, 0, nullptr); });
  refused(PLUMB_E_INVALID_ARGUMENT, "out is null",
          [&] { return table->contacts(world, nullptr, sizeof(PlumbContact), 3, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "gravity is null", [&] { return table->set_gravity(world, nullptr); });
  const PlumbStepDesc unset = {0, 0, 0.01};
  refused(PLUMB_E_INVALID_ARGUMENT, "desc.struct_size is 0", [&] { return table->step(world, &unset); });
  ASSERT_EQ(step(), PLUMB_OK);
  PlumbStepReport report{};
  refused(PLUMB_E_INVALID_ARGUMENT, "report.struct_size is 0", [&] { return table->wait(world, &report); });
  EXPECT_EQ(table->wait(world, nullptr), PLUMB_OK) << "a refused wait has not ended the step";
  refused(PLUMB_E_INVALID_ARGUMENT, "out is null", [&] { return table->list_bodies(world, nullptr, 2, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "count is null",
          [&] { return table->events(world, &event, sizeof event, 1, nullptr); });
  refused(PLUMB_E_INVALID_ARGUMENT, "user_data is null", [&] { return table->user_data(world, bodies[0], nullptr); });
  refused(PLUMB_E_INVALID_ARGUMENT, "desc is null", [&] { return table->step(world, nullptr); });
  refused(PLUMB_E_INVALID_ARGUMENT, "data is null",
          [&] { return extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT).restore(world, nullptr, 4); });
  refused(PLUMB_E_INVALID_ARGUMENT, "name is null", [&] {
    PlumbSettingValue value{};
    return extension<PlumbSettingsTable>(PLUMB_EXT_SETTINGS).get(world, nullptr, &value);
  });
}

TEST_F(ValidatedHost, SizesAndPointersOfExtensions) {
  const auto& queries = extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES);
  const PlumbRay ray{{0, 0, 0}, {1, 0, 0}, {1, 1, 0, 0}};
  const PlumbOverlap overlap{shape, identity_pose(), {1, 1, 0, 0}};
  PlumbHit hit;
  std::uint32_t count = 0;
  const auto rays = [&](const PlumbRay* in, std::size_t stride, PlumbHit* hits, std::uint32_t* found) {
    return queries.rays(world, PLUMB_HIT_ALL, in, stride, 1, hits, 1, found);
  };
  refused(PLUMB_E_INVALID_ARGUMENT, "queries is null", [&] { return rays(nullptr, sizeof ray, &hit, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of queries is 8", [&] { return rays(&ray, 8, &hit, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "hits is null", [&] { return rays(&ray, sizeof ray, nullptr, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "hit_count is null", [&] { return rays(&ray, sizeof ray, &hit, nullptr); });
  refused(PLUMB_E_INVALID_ARGUMENT, "overlaps is null",
          [&] { return queries.overlaps(world, nullptr, sizeof overlap, 1, &hit, 1, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of overlaps is 8",
          [&] { return queries.overlaps(world, &overlap, 8, 1, &hit, 1, &count); });
  PlumbPenetration deep;
  refused(PLUMB_E_INVALID_ARGUMENT, "overlaps is null",
          [&] { return queries.penetrations(world, nullptr, sizeof overlap, 1, &deep, 1, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of overlaps is 8",
          [&] { return queries.penetrations(world, &overlap, 8, 1, &deep, 1, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "out is null",
          [&] { return queries.penetrations(world, &overlap, sizeof overlap, 1, nullptr, 1, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "out_count is null",
          [&] { return queries.penetrations(world, &overlap, sizeof overlap, 1, &deep, 1, nullptr); });
  const PlumbTurningCast turning{shape, identity_pose(), {1, 0, 0}, {0, 1, 0}, {1, 1, 0, 0}};
  refused(PLUMB_E_INVALID_ARGUMENT, "queries is null",
          [&] { return queries.turning_casts(world, PLUMB_HIT_ALL, nullptr, sizeof turning, 1, &hit, 1, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of queries is 8",
          [&] { return queries.turning_casts(world, PLUMB_HIT_ALL, &turning, 8, 1, &hit, 1, &count); });
  const auto& closest = extension<PlumbClosestTable>(PLUMB_EXT_CLOSEST);
  const PlumbProbe probe{shape, identity_pose(), 1, {1, 1, 0, 0}};
  PlumbClosest row;
  const auto look = [&](const PlumbProbe* in, std::size_t stride, PlumbClosest* out, std::uint32_t* found) {
    return closest.bodies(world, PLUMB_HIT_ALL, in, stride, 1, out, 1, found);
  };
  refused(PLUMB_E_INVALID_ARGUMENT, "probes is null", [&] { return look(nullptr, sizeof probe, &row, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of probes is 8", [&] { return look(&probe, 8, &row, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "out is null", [&] { return look(&probe, sizeof probe, nullptr, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "out_count is null", [&] { return look(&probe, sizeof probe, &row, nullptr); });
  refused(PLUMB_E_INVALID_ARGUMENT, "mode is 7",
          [&] { return closest.bodies(world, 7, &probe, sizeof probe, 1, &row, 1, &count); });
  const auto& collide = extension<PlumbCollideTable>(PLUMB_EXT_COLLIDE);
  const PlumbPosedPair pair{shape, shape, identity_pose(), identity_pose()};
  PlumbPairResult result;
  PlumbPairPoint point;
  refused(PLUMB_E_INVALID_ARGUMENT, "pairs is null",
          [&] { return collide.pairs(world, nullptr, sizeof pair, 1, &result, &point, 1, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of pairs is 8",
          [&] { return collide.pairs(world, &pair, 8, 1, &result, &point, 1, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "results is null",
          [&] { return collide.pairs(world, &pair, sizeof pair, 1, nullptr, &point, 1, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "points is null",
          [&] { return collide.pairs(world, &pair, sizeof pair, 1, &result, nullptr, 1, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "point_count is null",
          [&] { return collide.pairs(world, &pair, sizeof pair, 1, &result, &point, 1, nullptr); });
  const auto& exceptions = extension<PlumbExceptionsTable>(PLUMB_EXT_EXCEPTIONS);
  const PlumbBodyPair apart{bodies[0], bodies[1]};
  refused(PLUMB_E_INVALID_ARGUMENT, "pairs is null",
          [&] { return exceptions.set(world, nullptr, sizeof apart, 1, 0); });
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of pairs is 8", [&] { return exceptions.set(world, &apart, 8, 1, 0); });
  refused(PLUMB_E_INVALID_ARGUMENT, "touch is 2", [&] { return exceptions.set(world, &apart, sizeof apart, 1, 2); });
  refused(PLUMB_E_INVALID_ARGUMENT, "out is null", [&] { return exceptions.list(world, nullptr, 1, &count); });
  refused(PLUMB_E_INVALID_ARGUMENT, "count is null", [&] { return exceptions.list(world, nullptr, 0, nullptr); });
  const auto& modify = extension<PlumbModifyTable>(PLUMB_EXT_MODIFY);
  const PlumbBodyChange body_changed = body_change(bodies[0]);
  const PlumbJointChange joint_changed = joint_change(1);
  refused(PLUMB_E_INVALID_ARGUMENT, "changes is null", [&] { return modify.bodies(world, nullptr, 136, 1); });
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of changes is 8",
          [&] { return modify.bodies(world, &body_changed, 8, 1); });
  refused(PLUMB_E_INVALID_ARGUMENT, "changes is null", [&] { return modify.joints(world, nullptr, 664, 1); });
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of changes is 8",
          [&] { return modify.joints(world, &joint_changed, 8, 1); });
  const auto& manifolds = extension<PlumbManifoldsTable>(PLUMB_EXT_MANIFOLDS);
  const PlumbManifoldChange manifold_changed = manifold_change(0);
  refused(PLUMB_E_WRONG_PHASE, "outside of a step", [&] { return manifolds.modify(world, nullptr, 48, 1); });
  const PlumbStepDesc step = {sizeof step, 0, 0.01};
  ASSERT_EQ(table->step(world, &step), PLUMB_OK);
  refused(PLUMB_E_INVALID_ARGUMENT, "changes is null", [&] { return manifolds.modify(world, nullptr, 48, 1); });
  refused(PLUMB_E_INVALID_ARGUMENT, "stride of changes is 8",
          [&] { return manifolds.modify(world, &manifold_changed, 8, 1); });
  refused(PLUMB_E_INVALID_ARGUMENT, "out is null", [&] { return manifolds.read(world, nullptr, 248, 1, &count); });
  ASSERT_EQ(table->wait(world, nullptr), PLUMB_OK);
  const auto& settings = extension<PlumbSettingsTable>(PLUMB_EXT_SETTINGS);
  const PlumbSettingValue value{PLUMB_SETTING_INT, 0, 5, nullptr};
  refused(PLUMB_E_INVALID_ARGUMENT, "value is null", [&] { return settings.get(world, "iterations", nullptr); });
  refused(PLUMB_E_INVALID_ARGUMENT, "name is null", [&] { return settings.set(world, nullptr, &value); });
  refused(PLUMB_E_INVALID_ARGUMENT, "value is null", [&] { return settings.set(world, "iterations", nullptr); });
  const auto& snapshot = extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT);
  std::size_t size = 0;
  char data[4];
  refused(PLUMB_E_INVALID_ARGUMENT, "data is null", [&] { return snapshot.save(world, nullptr, 4, &size); });
  refused(PLUMB_E_INVALID_ARGUMENT, "size is null", [&] { return snapshot.save(world, data, 4, nullptr); });
  refused(PLUMB_E_INVALID_ARGUMENT, "hash is null", [&] { return snapshot.hash(world, nullptr); });
  const auto& state = extension<PlumbStateTable>(PLUMB_EXT_STATE);
  PlumbStateRequest request{sizeof request, PLUMB_FIELD_POSE, 1, 1};
  PlumbDLManagedTensor* tensor = nullptr;
  std::uint64_t generation = 0;
  refused(PLUMB_E_INVALID_ARGUMENT, "request is null", [&] { return state.borrow(world, nullptr, &tensor, nullptr); });
  refused(PLUMB_E_INVALID_ARGUMENT, "tensor is null", [&] { return state.borrow(world, &request, nullptr, nullptr); });
  request.struct_size = 4;
  refused(PLUMB_E_INVALID_ARGUMENT, "request.struct_size is 4",
          [&] { return state.borrow(world, &request, &tensor, nullptr); });
  refused(PLUMB_E_INVALID_ARGUMENT, "ids is null", [&] { return state.rows(world, nullptr, 1, &count, &generation); });
  refused(PLUMB_E_INVALID_ARGUMENT, "count is null",
          [&] { return state.rows(world, nullptr, 0, nullptr, &generation); });
  refused(PLUMB_E_INVALID_ARGUMENT, "generation is null",
          [&] { return state.rows(world, nullptr, 0, &count, nullptr); });
}

TEST_F(ValidatedHost, WorldsThatAreNone) {
  int nothing = 0;
  auto* foreign = reinterpret_cast<PlumbWorld*>(&nothing);
  std::uint32_t count = 0;
  EXPECT_EQ(table->list_bodies(foreign, nullptr, 0, &count), PLUMB_E_INVALID_ARGUMENT);
  expect_found("none that this backend made");
  EXPECT_EQ(table->list_bodies(nullptr, nullptr, 0, &count), PLUMB_E_INVALID_ARGUMENT);
  expect_found("world is null");
  table->destroy_world(foreign);
  expect_found("destroy_world: world is none");
  table->destroy_world(nullptr);
  EXPECT_TRUE(layers::findings(table).empty()) << "destroying null is allowed";
  PlumbWorld* gone = std::exchange(world, nullptr);
  table->destroy_world(gone);
  EXPECT_TRUE(layers::findings(table).empty());
  table->destroy_world(gone);
  expect_found("destroyed before");
  EXPECT_EQ(table->list_bodies(gone, nullptr, 0, &count), PLUMB_E_INVALID_ARGUMENT);
  expect_found("has been destroyed");
}

TEST_F(ValidatedHost, WorldsThatAreAskedForWrongly) {
  PlumbWorld* none = nullptr;
  const auto asked = [&](const std::string& words, const PlumbWorldDesc* desc, PlumbWorld** made) {
    static bool forwarded;
    forwarded = false;
    ill().core.create_world = [](const PlumbWorldDesc*, PlumbWorld**) -> PlumbResult {
      return forwarded = true, PLUMB_E_INTERNAL;
    };
    EXPECT_EQ(table->create_world(desc, made), PLUMB_E_INVALID_ARGUMENT);
    EXPECT_FALSE(forwarded);
    EXPECT_NE(std::string(table->error_text(nullptr)).find("create_world: " + words), std::string::npos)
        << table->error_text(nullptr);
    expect_found("create_world: " + words);
  };
  PlumbWorldDesc desc = world_desc(0);
  asked("desc is null", nullptr, &none);
  asked("world is null", &desc, nullptr);
  desc.setting_count = 1;
  asked("desc.settings is null", &desc, &none);
  const PlumbSetting nameless{};
  desc.settings = &nameless;
  asked("desc.settings.name is null", &desc, &none);
  desc.struct_size = 1;
  asked("desc.struct_size is 1", &desc, &none);
}

TEST_F(ValidatedHost, TheBackendsOwnFailuresKeepTheirText) {
  const PlumbBody stale = 12345;
  EXPECT_EQ(table->destroy_bodies(world, &stale, 1), PLUMB_E_STALE_HANDLE);
  EXPECT_NE(std::string(table->error_text(world)).find("12345"), std::string::npos) << table->error_text(world);
  EXPECT_TRUE(layers::findings(table).empty()) << "a refusal by the backend is not a broken rule";
  PlumbWorldDesc desc = world_desc(PLUMB_NEED_CCD);
  PlumbWorld* none = nullptr;
  EXPECT_EQ(table->create_world(&desc, &none), PLUMB_E_UNSUPPORTED);
  EXPECT_NE(std::string(table->error_text(nullptr)).find("no continuous collision"), std::string::npos);
}

TEST_F(ValidatedHost, LayersAreMadeOnce) {
  EXPECT_EQ(layers::validate(&ill().core), table);
  EXPECT_EQ(layers::validate(table), table);
  EXPECT_EQ(table->info(), good().core.info());
  EXPECT_EQ(table->extension("test.unknown/1"), &unknown_table);
  EXPECT_EQ(table->extension(PLUMB_EXT_DEBUG), nullptr) << "what the backend lacks, the layer lacks";
  EXPECT_TRUE(layers::findings(&good().core).empty());
}

}  // namespace
}  // namespace plumb::test
