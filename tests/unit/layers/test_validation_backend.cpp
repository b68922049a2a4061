// The validation layer sees a backend's mistakes: one misbehaving function a test.
#include "ill_table.hpp"

namespace plumb::test {
namespace {

class ValidatedBackend : public Validated {
 protected:
  ValidatedBackend() : Validated(layers::FindingKind::backend_mistake) {}
};

TEST_F(ValidatedBackend, RowsBeyondTheCapacity) {
  ill().core.list_bodies = [](PlumbWorld*, PlumbBody* ids, std::uint32_t capacity,
                              std::uint32_t* count) -> PlumbResult {
    for (std::uint32_t i = 0; i <= capacity; ++i) ids[i] = 1;
    *count = capacity + 1;
    return PLUMB_TRUNCATED;
  };
  PlumbBody ids[4] = {0, 0, 0, 99};
  std::uint32_t count = 0;
  expect(PLUMB_E_INTERNAL, table->list_bodies(world, ids, 3, &count), "wrote more than 3 rows");
  EXPECT_EQ(ids[3], 99u) << "the host's memory is safe";
}

TEST_F(ValidatedBackend, RowsThatAreNotWritten) {
  ill().core.read = [](PlumbWorld*, PlumbField, PlumbDataType, const PlumbBody*, std::uint32_t, void* rows,
                       std::size_t) -> PlumbResult {
    std::fill_n(static_cast<double*>(rows), 7, 1.0);
    return PLUMB_OK;
  };
  double rows[14];
  expect(PLUMB_E_INTERNAL, table->read(world, PLUMB_FIELD_POSE, PLUMB_F64, nullptr, 2, rows, 56),
         "left row 1 unwritten");
}

TEST_F(ValidatedBackend, PaddingOfRows) {
  ill().core.read = [](PlumbWorld*, PlumbField, PlumbDataType, const PlumbBody*, std::uint32_t count, void* rows,
                       std::size_t stride) -> PlumbResult {
    std::memset(rows, 0, count * stride);
    return PLUMB_OK;
  };
  double rows[18];
  expect(PLUMB_E_INTERNAL, table->read(world, PLUMB_FIELD_POSE, PLUMB_F64, nullptr, 2, rows, 72),
         "wrote between the rows");
  EXPECT_EQ(table->read(world, PLUMB_FIELD_POSE, PLUMB_F64, nullptr, 2, rows, 56), PLUMB_OK);
}

TEST_F(ValidatedBackend, CountsThatContradictTheResult) {
  ill().core.contacts = [](PlumbWorld*, PlumbContact*, std::size_t, std::uint32_t,
                           std::uint32_t* count) -> PlumbResult {
    *count = 5;
    return PLUMB_OK;
  };
  std::uint32_t count = 0;
  expect(PLUMB_E_INTERNAL, table->contacts(world, nullptr, sizeof(PlumbContact), 0, &count),
         "a count of 5 for a capacity of 0");
  ill().core.contacts = [](PlumbWorld*, PlumbContact*, std::size_t, std::uint32_t,
                           std::uint32_t* found) -> PlumbResult {
    *found = 0;
    return PLUMB_TRUNCATED;
  };
  expect(PLUMB_E_INTERNAL, table->contacts(world, nullptr, sizeof(PlumbContact), 0, &count),
         "answered 1 and a count of 0");
}

TEST_F(ValidatedBackend, ResultsThatAreNone) {
  ill().core.set_gravity = [](PlumbWorld*, const PlumbVec3*) -> PlumbResult { return -77; };
  const PlumbVec3 gravity{0, 0, 0};
  expect(PLUMB_E_INTERNAL, table->set_gravity(world, &gravity), "answered -77");
  ill().core.set_gravity = [](PlumbWorld*, const PlumbVec3*) -> PlumbResult { return PLUMB_E_VERSION; };
  expect(PLUMB_E_INTERNAL, table->set_gravity(world, &gravity), "answered -8");
  ill().core.set_gravity = [](PlumbWorld*, const PlumbVec3*) -> PlumbResult { return PLUMB_TRUNCATED; };
  expect(PLUMB_E_INTERNAL, table->set_gravity(world, &gravity), "the remark 1, which is not this call's");
}

TEST_F(ValidatedBackend, FailuresThatChangeTheBodies) {
  ill().core.create_bodies = [](PlumbWorld* w, const PlumbBodyDesc* descs, std::size_t stride, std::uint32_t count,
                                PlumbBody* ids) -> PlumbResult {
    const PlumbBody nothing = 0;
    good().core.create_bodies(w, descs, stride, count, ids);
    return good().core.destroy_bodies(w, &nothing, 1);  // fails with a text
  };
  const PlumbBodyDesc desc = body();
  PlumbBody id = 0;
  expect(PLUMB_E_INTERNAL, table->create_bodies(world, &desc, sizeof desc, 1, &id),
         "has 3 bodies after the call has failed; it should be 2");
}

TEST_F(ValidatedBackend, SuccessThatDoesNothing) {
  ill().core.destroy_bodies = [](PlumbWorld*, const PlumbBody*, std::uint32_t) -> PlumbResult { return PLUMB_OK; };
  expect(PLUMB_E_INTERNAL, table->destroy_bodies(world, bodies.data(), 1),
         "has 2 bodies after the call is done; it should be 1");
}

TEST_F(ValidatedBackend, IdsThatAreNone) {
  ill().core.create_shapes = [](PlumbWorld*, const PlumbShapeDesc*, std::size_t, std::uint32_t count,
                                PlumbShape* ids) -> PlumbResult {
    std::fill_n(ids, count, 5);
    return PLUMB_OK;
  };
  PlumbShapeDesc descs[2] = {shape_desc(PLUMB_SPHERE), shape_desc(PLUMB_SPHERE)};
  PlumbShape ids[2] = {};
  expect(PLUMB_E_INTERNAL, table->create_shapes(world, descs, sizeof descs[0], 2, ids), "null or not distinct");
  ill().core.create_shapes = [](PlumbWorld*, const PlumbShapeDesc*, std::size_t, std::uint32_t,
                                PlumbShape*) -> PlumbResult { return PLUMB_OK; };
  expect(PLUMB_E_INTERNAL, table->create_shapes(world, descs, sizeof descs[0], 2, ids), "left ids[0] unwritten");
}

TEST_F(ValidatedBackend, ReportsThatAreWrong) {
  const PlumbStepDesc desc = {sizeof desc, 0, 0.01};
  PlumbStepReport report{};
  report.struct_size = sizeof report;
  ill().core.wait = [](PlumbWorld* w, PlumbStepReport* out) -> PlumbResult {
    const PlumbResult result = good().core.wait(w, out);
    out->bodies = 9;
    return result;
  };
  ASSERT_EQ(table->step(world, &desc), PLUMB_OK);
  expect(PLUMB_E_INTERNAL, table->wait(world, &report), "reports 9 bodies, 0 awake, where 2 live");
  ill().core.wait = [](PlumbWorld* w, PlumbStepReport* out) -> PlumbResult {
    const PlumbResult result = good().core.wait(w, out);
    std::memset(out + 1, 0, 8);
    return result;
  };
  ASSERT_EQ(table->step(world, &desc), PLUMB_OK);
  expect(PLUMB_E_INTERNAL, table->wait(world, &report), "beyond the report's struct_size");
}

TEST_F(ValidatedBackend, EventsOutOfOrder) {
  FakeWorld::last->event_rows = {{PLUMB_EVENT_SLEEP, 0, bodies[1], 0, 0}, {PLUMB_EVENT_SLEEP, 0, bodies[0], 0, 0}};
  PlumbEvent events[4];
  std::uint32_t count = 0;
  expect(PLUMB_E_INTERNAL, table->events(world, events, sizeof events[0], 4, &count), "row 1 breaks the order");
  FakeWorld::last->event_rows = {{PLUMB_EVENT_COUNT, 0, bodies[1], 0, 0}};
  expect(PLUMB_E_INTERNAL, table->events(world, events, sizeof events[0], 4, &count), "row 0 is of type 7");
  FakeWorld::last->event_rows = {{PLUMB_EVENT_SLEEP, 0, bodies[0], 0, 0}, {PLUMB_EVENT_SLEEP, 0, bodies[1], 0, 0}};
  EXPECT_EQ(table->events(world, events, sizeof events[0], 4, &count), PLUMB_OK);
  EXPECT_EQ(count, 2u);
}

TEST_F(ValidatedBackend, HitsThatCannotBe) {
  static PlumbHit answer;
  ill().queries.rays = [](PlumbWorld*, PlumbHitMode, const PlumbRay*, std::size_t, std::uint32_t, PlumbHit* hits,
                          std::uint32_t, std::uint32_t* count) -> PlumbResult {
    hits[0] = answer;
    *count = 1;
    return PLUMB_OK;
  };
  const PlumbRay ray{{0, 0, 0}, {1, 0, 0}, {1, 1, 0, 0}};
  PlumbHit hit;
  std::uint32_t count = 0;
  const auto cast = [&](PlumbHitMode mode, std::uint32_t rays) {
    const PlumbRay both[2] = {ray, ray};
    return extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES).rays(world, mode, both, sizeof ray, rays, &hit, 1, &count);
  };
  answer = {bodies[0], 0, 0, 1.5, {}, {}};
  expect(PLUMB_E_INTERNAL, cast(PLUMB_HIT_ALL, 1), "not in 0..1");
  answer = {bodies[0], 3, 0, 0.5, {}, {}};
  expect(PLUMB_E_INTERNAL, cast(PLUMB_HIT_ALL, 1), "of query 3");
  answer = {0, 0, 0, 0.5, {}, {}};
  expect(PLUMB_E_INTERNAL, cast(PLUMB_HIT_ALL, 1), "names no body");
  expect(PLUMB_E_INTERNAL, cast(PLUMB_HIT_CLOSEST, 2), "counts 1 closest hits for 2 queries");
  EXPECT_EQ(cast(PLUMB_HIT_CLOSEST, 1), PLUMB_OK) << "nothing hit is an answer";
  EXPECT_EQ(cast(7, 1), PLUMB_E_INVALID_ARGUMENT);
  expect_found(layers::FindingKind::host_mistake, "mode is 7");
}

TEST_F(ValidatedBackend, ClosestBodiesThatCannotBe) {
  static std::vector<PlumbClosest> answer;
  ill().closest.bodies = [](PlumbWorld*, PlumbHitMode, const PlumbProbe*, std::size_t, std::uint32_t, PlumbClosest* out,
                            std::uint32_t capacity, std::uint32_t* count) -> PlumbResult {
    std::copy(answer.begin(), answer.end(), out);
    *count = std::min(capacity, static_cast<std::uint32_t>(answer.size()));
    return PLUMB_OK;
  };
  const PlumbProbe probes[2] = {{shape, identity_pose(), 1, {1, 1, 0, 0}}, {shape, identity_pose(), 1, {1, 1, 0, 0}}};
  PlumbClosest rows[2];
  std::uint32_t count = 0;
  const auto ask = [&](PlumbHitMode mode, std::uint32_t asked = 1) {
    return extension<PlumbClosestTable>(PLUMB_EXT_CLOSEST)
        .bodies(world, mode, probes, sizeof probes[0], asked, rows, 2, &count);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto row = [&](PlumbBody body, std::uint32_t probe, double distance) {
    return PlumbClosest{body, probe, 0, distance, {}, {}, {distance == 0 ? nan : 1.0, 0, 0}};
  };
  answer = {row(bodies[0], 0, 0), row(bodies[1], 0, 0.5)};
  EXPECT_EQ(ask(PLUMB_HIT_ALL), PLUMB_OK) << table->error_text(world);
  EXPECT_EQ(count, 2u);
  answer = {row(bodies[0], 0, 0.5), row(bodies[1], 0, 0)};
  expect(PLUMB_E_INTERNAL, ask(PLUMB_HIT_ALL), "out[1] breaks the order of probe, distance, body");
  answer = {row(bodies[0], 0, -0.5)};
  expect(PLUMB_E_INTERNAL, ask(PLUMB_HIT_ALL), "out[0].distance is -0.5");
  answer = {row(bodies[0], 0, nan)};
  expect(PLUMB_E_INTERNAL, ask(PLUMB_HIT_ALL), "out[0].distance is");
  answer = {row(0, 0, 0.5)};
  expect(PLUMB_E_INTERNAL, ask(PLUMB_HIT_ALL), "out[0] names no body");
  EXPECT_EQ(ask(PLUMB_HIT_CLOSEST), PLUMB_OK) << "nothing near is an answer";
  answer = {row(bodies[0], 2, 0.5)};
  expect(PLUMB_E_INTERNAL, ask(PLUMB_HIT_ALL), "out[0] is of probe 2");
  answer = {row(bodies[0], 1, 0.5), row(bodies[0], 0, 0.5)};
  expect(PLUMB_E_INTERNAL, ask(PLUMB_HIT_CLOSEST, 2), "out[0] is of probe 1");
  answer = {row(bodies[0], 0, 0.5)};
  expect(PLUMB_E_INTERNAL, ask(PLUMB_HIT_CLOSEST, 2), "counts 1 closest bodies for 2 queries");
  answer[0].normal.x = nan;
  expect(PLUMB_E_INTERNAL, ask(PLUMB_HIT_ALL), "out[0].normal is NaN of what is apart");
  answer[0].distance = 0;
  answer[0].normal.x = 1;
  expect(PLUMB_E_INTERNAL, ask(PLUMB_HIT_ALL), "out[0].normal is told of what touches");
}

TEST_F(ValidatedBackend, PenetrationsThatCannotBe) {
  static std::vector<PlumbPenetration> answer;
  ill().queries.penetrations = [](PlumbWorld*, const PlumbOverlap*, std::size_t, std::uint32_t, PlumbPenetration* out,
                                  std::uint32_t, std::uint32_t* count) -> PlumbResult {
    std::copy(answer.begin(), answer.end(), out);
    *count = static_cast<std::uint32_t>(answer.size());
    return PLUMB_OK;
  };
  const PlumbOverlap overlap{shape, identity_pose(), {1, 1, 0, 0}};
  PlumbPenetration rows[2];
  std::uint32_t count = 0;
  const auto ask = [&] {
    return extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES)
        .penetrations(world, &overlap, sizeof overlap, 1, rows, 2, &count);
  };
  const auto row = [&](PlumbBody body, std::uint32_t query, double depth, double normal = 1) {
    return PlumbPenetration{body, query, 0, depth, {}, {0, normal, 0}};
  };
  answer = {row(bodies[1], 0, 0.5), row(bodies[0], 0, 0)};
  EXPECT_EQ(ask(), PLUMB_OK) << table->error_text(world);
  EXPECT_EQ(count, 2u);
  answer = {row(bodies[0], 0, 0), row(bodies[1], 0, 0.5)};
  expect(PLUMB_E_INTERNAL, ask(), "out[1] breaks the order of query, depth, body");
  answer = {row(bodies[0], 0, -0.5)};
  expect(PLUMB_E_INTERNAL, ask(), "out[0].depth is -0.5");
  answer = {row(0, 0, 0.5)};
  expect(PLUMB_E_INTERNAL, ask(), "out[0] names no body");
  answer = {row(bodies[0], 1, 0.5)};
  expect(PLUMB_E_INTERNAL, ask(), "out[0] is of query 1, which is none");
  answer = {row(bodies[0], 0, 0.5, 0)};
  expect(PLUMB_E_INTERNAL, ask(), "out[0].normal has length 0");
}

TEST_F(ValidatedBackend, HitsBeyondTheCapacityOrOutOfOrder) {
  static std::vector<PlumbHit> answer;
  static std::uint32_t counted;
  ill().queries.overlaps = [](PlumbWorld*, const PlumbOverlap*, std::size_t, std::uint32_t, PlumbHit* hits,
                              std::uint32_t, std::uint32_t* count) -> PlumbResult {
    std::copy(answer.begin(), answer.end(), hits);
    *count = counted;
    return PLUMB_OK;
  };
  const PlumbOverlap overlap[2] = {{shape, identity_pose(), {1, 1, 0, 0}}, {shape, identity_pose(), {1, 1, 0, 0}}};
  PlumbHit hits[2];
  std::uint32_t count = 0;
  const auto ask = [&] {
    counted = std::min<std::uint32_t>(static_cast<std::uint32_t>(answer.size()), 2);
    return extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES)
        .overlaps(world, overlap, sizeof overlap[0], 2, hits, 2, &count);
  };
  const PlumbHit first{bodies[0], 0, 0, 0, {}, {}}, second{bodies[0], 1, 0, 0, {}, {}};
  answer = {first, second};
  EXPECT_EQ(ask(), PLUMB_OK);
  answer = {second, first};
  expect(PLUMB_E_INTERNAL, ask(), "hits[1] breaks the order");
  answer = {first, second, second};
  expect(PLUMB_E_INTERNAL, ask(), "wrote more than 2 hits");
  ill().queries.overlaps = [](PlumbWorld*, const PlumbOverlap*, std::size_t, std::uint32_t, PlumbHit*, std::uint32_t,
                              std::uint32_t* found) -> PlumbResult {
    *found = 1;
    return PLUMB_OK;
  };
  expect(PLUMB_E_INTERNAL, ask(), "left hits[0] unwritten");
  ill().queries.rays = [](PlumbWorld*, PlumbHitMode, const PlumbRay*, std::size_t, std::uint32_t, PlumbHit* out,
                          std::uint32_t, std::uint32_t* found) -> PlumbResult {
    out[0] = {0, 1, 0, 0, {}, {}};
    out[1] = {0, 0, 0, 0, {}, {}};
    *found = 2;
    return PLUMB_OK;
  };
  const PlumbRay rays[2] = {};
  expect(PLUMB_E_INTERNAL,
         extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES)
             .rays(world, PLUMB_HIT_CLOSEST, rays, sizeof rays[0], 2, hits, 2, &count),
         "hits[0] is of query 1");
}

TEST_F(ValidatedBackend, PairsAndPointsThatCannotBe) {
  static std::uint32_t results_written, points_written, first;
  ill().collide.pairs = [](PlumbWorld*, const PlumbPosedPair*, std::size_t, std::uint32_t, PlumbPairResult* results,
                           PlumbPairPoint* points, std::uint32_t, std::uint32_t* count) -> PlumbResult {
    std::fill_n(results, results_written, PlumbPairResult{0, first, 1});
    std::fill_n(points, points_written, PlumbPairPoint{});
    *count = 1;
    return PLUMB_OK;
  };
  const PlumbPosedPair pair{shape, shape, identity_pose(), identity_pose()};
  PlumbPairResult result;
  PlumbPairPoint point;
  std::uint32_t count = 0;
  const auto ask = [&](std::uint32_t results, std::uint32_t points, std::uint32_t first_point) {
    results_written = results, points_written = points, first = first_point;
    return extension<PlumbCollideTable>(PLUMB_EXT_COLLIDE)
        .pairs(world, &pair, sizeof pair, 1, &result, &point, 1, &count);
  };
  EXPECT_EQ(ask(1, 1, 0), PLUMB_OK);
  expect(PLUMB_E_INTERNAL, ask(2, 1, 0), "wrote more than 1 results");
  expect(PLUMB_E_INTERNAL, ask(1, 2, 0), "wrote more than 1 points");
  expect(PLUMB_E_INTERNAL, ask(0, 1, 0), "left a result unwritten");
  expect(PLUMB_E_INTERNAL, ask(1, 1, 1), "names points beyond the 1 there are");
}

TEST_F(ValidatedBackend, RowsOfContactsAndStates) {
  static std::size_t bytes;
  ill().core.contacts = [](PlumbWorld*, PlumbContact* out, std::size_t, std::uint32_t,
                           std::uint32_t* count) -> PlumbResult {
    std::memset(static_cast<void*>(out), 0, bytes);
    *count = 2;
    return PLUMB_OK;
  };
  struct Longer {
    PlumbContact contact;
    double more;
  } rows[2];
  std::uint32_t count = 0;
  const auto ask = [&](std::size_t written) {
    bytes = written;
    return table->contacts(world, &rows[0].contact, sizeof rows[0], 2, &count);
  };
  expect(PLUMB_E_INTERNAL, ask(sizeof rows), "wrote between the rows");
  expect(PLUMB_E_INTERNAL, ask(sizeof rows[0].contact), "left row 1 unwritten");
  bytes = sizeof rows[0].contact;
  PlumbContact tight[2];
  bytes = sizeof tight + 8;
  expect(PLUMB_E_INTERNAL, table->contacts(world, tight, sizeof tight[0], 2, &count), "wrote more than 2 rows");
  bytes = sizeof tight;
  expect(PLUMB_E_INTERNAL, table->contacts(world, tight, sizeof tight[0], 2, &count), "row 0 names no body");

  ill().core.read = [](PlumbWorld*, PlumbField, PlumbDataType, const PlumbBody*, std::uint32_t, void* out,
                       std::size_t) -> PlumbResult {
    std::fill_n(static_cast<double*>(out), 8, 1.0);
    return PLUMB_OK;
  };
  double row[8];
  expect(PLUMB_E_INTERNAL, table->read(world, PLUMB_FIELD_POSE, PLUMB_F64, nullptr, 1, row, 56),
         "wrote more than 1 rows");

  ill().core.list_bodies = [](PlumbWorld*, PlumbBody* ids, std::uint32_t, std::uint32_t* found) -> PlumbResult {
    if (ids != nullptr && bytes != 0) ids[0] = 5;
    *found = 1;
    return PLUMB_OK;
  };
  PlumbBody id = 0;
  expect(PLUMB_E_INTERNAL, table->list_bodies(world, &id, 1, &count), "lists 1 bodies where 2 live");
  bytes = 0;
  expect(PLUMB_E_INTERNAL, table->list_bodies(world, &id, 1, &count), "left row 0 unwritten");

  ill().state.rows = [](PlumbWorld*, PlumbBody* ids, std::uint32_t, std::uint32_t* found,
                        std::uint64_t*) -> PlumbResult {
    ids[0] = ids[1] = 5;
    *found = 2;
    return PLUMB_TRUNCATED;
  };
  std::uint64_t generation = 0;
  expect(PLUMB_E_INTERNAL, extension<PlumbStateTable>(PLUMB_EXT_STATE).rows(world, &id, 1, &count, &generation),
         "wrote more than 1 ids");
}

TEST_F(ValidatedBackend, ExceptionsOutOfOrder) {
  static PlumbBodyPair answer[2];
  ill().exceptions.list = [](PlumbWorld*, PlumbBodyPair* out, std::uint32_t, std::uint32_t* found) -> PlumbResult {
    std::copy_n(answer, 2, out);
    return *found = 2, PLUMB_OK;
  };
  PlumbBodyPair pairs[2];
  std::uint32_t count = 0;
  const auto list = [&] { return extension<PlumbExceptionsTable>(PLUMB_EXT_EXCEPTIONS).list(world, pairs, 2, &count); };
  answer[0] = {5, 6}, answer[1] = {5, 7};
  EXPECT_EQ(list(), PLUMB_OK);
  answer[1] = {5, 6};
  expect(PLUMB_E_INTERNAL, list(), "row 1 breaks the order of body_a, body_b");
  answer[0] = {6, 5};
  expect(PLUMB_E_INTERNAL, list(), "row 0 breaks the order");
}

TEST_F(ValidatedBackend, ManifoldsWithoutBodiesOrWithTooManyPoints) {
  static PlumbManifold answer;
  ill().manifolds.read = [](PlumbWorld*, PlumbManifold* out, std::size_t, std::uint32_t, std::uint32_t* found) {
    *out = answer;
    return *found = 1, PlumbResult{PLUMB_OK};
  };
  PlumbManifold row;
  std::uint32_t count = 0;
  const PlumbStepDesc step = {sizeof step, 0, 0.01};
  ASSERT_EQ(table->step(world, &step), PLUMB_OK);
  const auto read = [&] {
    return extension<PlumbManifoldsTable>(PLUMB_EXT_MANIFOLDS).read(world, &row, sizeof row, 1, &count);
  };
  answer.body_a = 1, answer.body_b = 2, answer.point_count = 4;
  EXPECT_EQ(read(), PLUMB_OK);
  answer.point_count = 5;
  expect(PLUMB_E_INTERNAL, read(), "row 0 has 5 points");
  answer.point_count = 1, answer.body_b = 0;
  expect(PLUMB_E_INTERNAL, read(), "row 0 names no body");
  ASSERT_EQ(table->wait(world, nullptr), PLUMB_OK);
}

TEST_F(ValidatedBackend, MoreIdsThanWereAskedFor) {
  ill().core.create_shapes = [](PlumbWorld*, const PlumbShapeDesc*, std::size_t, std::uint32_t,
                                PlumbShape* ids) -> PlumbResult {
    ids[0] = 1, ids[1] = 2;
    return PLUMB_OK;
  };
  const PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
  PlumbShape id = 0;
  expect(PLUMB_E_INTERNAL, table->create_shapes(world, &desc, sizeof desc, 1, &id), "wrote more than 1 ids");
}

TEST_F(ValidatedBackend, StateThatIsNotLentAsAsked) {
  static PlumbDLManagedTensor tensor;
  static bool whole;
  ill().state.borrow = [](PlumbWorld*, const PlumbStateRequest*, PlumbDLManagedTensor** out,
                          PlumbFence*) -> PlumbResult {
    *out = &tensor;
    tensor.deleter = nullptr;
    if (whole) tensor.deleter = [](PlumbDLManagedTensor*) {};
    return PLUMB_COPIED;
  };
  PlumbStateRequest request{sizeof request, PLUMB_FIELD_POSE, 1, 0};
  PlumbDLManagedTensor* lent = nullptr;
  const auto ask = [&] { return extension<PlumbStateTable>(PLUMB_EXT_STATE).borrow(world, &request, &lent, nullptr); };
  whole = false;
  expect(PLUMB_E_INTERNAL, ask(), "without a deleter");
  whole = true;
  expect(PLUMB_E_INTERNAL, ask(), "copied where allow_copy is 0");
  request.allow_copy = 1;
  EXPECT_EQ(ask(), PLUMB_COPIED);
}

TEST_F(ValidatedBackend, SnapshotsThatAreCutOff) {
  ill().snapshot.save = [](PlumbWorld*, void* data, std::size_t capacity, std::size_t* size) -> PlumbResult {
    std::memset(data, 0, capacity);
    *size = 100;
    return PLUMB_TRUNCATED;
  };
  char data[8];
  std::size_t size = 0;
  expect(PLUMB_E_INTERNAL, extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT).save(world, data, sizeof data, &size),
         "a part of a snapshot");
  ill().snapshot.save = [](PlumbWorld*, void* out, std::size_t capacity, std::size_t* needed) -> PlumbResult {
    std::memset(out, 0, capacity + 1);
    *needed = capacity;
    return PLUMB_OK;
  };
  expect(PLUMB_E_INTERNAL, extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT).save(world, data, sizeof data, &size),
         "wrote more than 8 bytes");
  ill().snapshot.save = [](PlumbWorld*, void*, std::size_t, std::size_t* needed) -> PlumbResult {
    return *needed = 100, PLUMB_OK;
  };
  expect(PLUMB_E_INTERNAL, extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT).save(world, data, sizeof data, &size),
         "a count of 100 for a capacity of 8");
}

TEST_F(ValidatedBackend, SettingsWithoutAValue) {
  ill().settings.get = [](PlumbWorld*, const char*, PlumbSettingValue* value) -> PlumbResult {
    *value = {PLUMB_SETTING_CHOICE, 0, 0, nullptr};
    return PLUMB_OK;
  };
  PlumbSettingValue value{};
  expect(PLUMB_E_INTERNAL, extension<PlumbSettingsTable>(PLUMB_EXT_SETTINGS).get(world, "solver", &value),
         "without a choice");
}

TEST_F(ValidatedBackend, FailingWithoutAWord) {
  ill().core.set_gravity = [](PlumbWorld*, const PlumbVec3*) -> PlumbResult { return PLUMB_E_UNSUPPORTED; };
  const PlumbVec3 gravity{0, 0, 0};
  EXPECT_EQ(table->set_gravity(world, &gravity), PLUMB_E_UNSUPPORTED);
  expect_found("set_gravity: the backend failed without a word of why");
}

TEST_F(ValidatedBackend, LostWorldsAnswerNothingElse) {
  FakeWorld::last->on_step = [] { throw Error(PLUMB_E_WORLD_LOST, "the ground gave way"); };
  const PlumbStepDesc desc = {sizeof desc, 0, 0.01};
  EXPECT_EQ(table->step(world, &desc), PLUMB_E_WORLD_LOST);
  EXPECT_STREQ(table->error_text(world), "the ground gave way");
  static bool asked;
  asked = false;
  ill().core.list_bodies = [](PlumbWorld*, PlumbBody*, std::uint32_t, std::uint32_t*) -> PlumbResult {
    return asked = true, PLUMB_OK;
  };
  std::uint32_t count = 0;
  EXPECT_EQ(table->list_bodies(world, nullptr, 0, &count), PLUMB_E_WORLD_LOST);
  EXPECT_FALSE(asked);
  EXPECT_STREQ(table->error_text(world), "the ground gave way") << "the text of the loss stays";
  expect_found(layers::FindingKind::host_mistake, "only destroy_world and error_text are left");
}

TEST_F(ValidatedBackend, CapabilitiesThatAreNoDegree) {
  ill().core.capability = [](PlumbCapability, std::uint32_t, std::uint32_t, const char**) -> PlumbDegree { return 9; };
  const char* note = nullptr;
  EXPECT_EQ(table->capability(PLUMB_CAP_RESIDUAL, 0, 0, &note), PLUMB_NONE);
  EXPECT_STREQ(note, "");
  const std::vector<layers::Finding> found = layers::findings(table);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NE(found[0].text.find("note is null"), std::string::npos);
  EXPECT_NE(found[1].text.find("answered 9"), std::string::npos);
}

TEST_F(ValidatedBackend, WorldsThatAreNotMade) {
  ill().core.create_world = [](const PlumbWorldDesc*, PlumbWorld**) -> PlumbResult { return PLUMB_OK; };
  const PlumbWorldDesc desc = world_desc(0);
  PlumbWorld* none = nullptr;
  EXPECT_EQ(table->create_world(&desc, &none), PLUMB_E_INTERNAL);
  EXPECT_NE(std::string(table->error_text(nullptr)).find("made no world"), std::string::npos);
  ill().core.create_world = [](const PlumbWorldDesc*, PlumbWorld**) -> PlumbResult { return PLUMB_GROWN; };
  EXPECT_EQ(table->create_world(&desc, &none), PLUMB_E_INTERNAL);
  expect_found("create_world: the backend answered 2");
}

}  // namespace
}  // namespace plumb::test
