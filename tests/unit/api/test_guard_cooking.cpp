// The guard of plumb.cooking/1: bytes make the shape that their descriptor would have made, and bytes that do not are
// refused by their name, what is wrong with them and the remedy.
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <thread>

#include "cooked_frame.hpp"
#include "fake_world.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

using Bytes = std::vector<std::byte>;

/// A tetrahedron that is closed, hulls and meshes alike.
struct Tetrahedron {
  double vertices[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::uint32_t indices[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  PlumbMaterial materials[2] = {{0.5, 0, {0, 0, 0}}, {0, 0.25, {0, 0, 0}}};
  std::uint32_t triangle_materials[4] = {0, 1, PLUMB_BODY_MATERIAL, 1};
  double heights[6] = {0, 1, 2, 3, 4, 5};

  [[nodiscard]] PlumbShapeDesc desc(PlumbShapeType type) const {
    PlumbShapeDesc desc = shape_desc(type);
    desc.radius = 0.5;
    desc.half_height = 0.75;
    desc.half_extents = {1, 2, 3};
    desc.vertices = vertices;
    desc.vertex_count = 4;
    desc.indices = indices;
    desc.triangle_count = 4;
    desc.heights = heights;
    desc.rows = 2;
    desc.columns = 3;
    desc.spacing = {0.5, 0, 0.25};
    return desc;
  }
  [[nodiscard]] PlumbShapeDesc with_materials(PlumbShapeType type) const {
    PlumbShapeDesc given = desc(type);
    given.materials = materials;
    given.material_count = 2;
    given.triangle_materials = triangle_materials;
    return given;
  }
};

Bytes changed(Bytes bytes, std::size_t at, std::byte by = std::byte{1}) {
  bytes[at] ^= by;
  return bytes;
}
/// With a header of which the test has changed something, and the checksum made right again.
template <class Change>
Bytes forged(Bytes bytes, Change&& change) {
  backend::CookedHeader header;
  std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof header);
  change(header);
  header.hash = backend::cooked_hash(header, std::span<const std::byte>(bytes).subspan(sizeof header));
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

class GuardCooking : public ::testing::Test {
 protected:
  explicit GuardCooking(PlumbNeeds needs = PLUMB_NEED_ROTATION | PLUMB_NEED_FRICTION | PLUMB_NEED_RESTITUTION)
      : world(backend.create_world(world_desc(needs))) {}

  PlumbResult create(std::span<const Bytes> all) {
    std::vector<PlumbCookedShape> shapes;
    for (const Bytes& bytes : all) shapes.push_back(cooked_shape(bytes));
    ids.resize(all.size());
    return world->cooking()->create_cooked(shapes, ids);
  }
  PlumbResult create(const Bytes& bytes) { return create({&bytes, 1}); }

  /// As the second of two.
  void refused(PlumbResult code, const Bytes& bytes, const std::string& words) {
    const Bytes all[2] = {backend.cook(solid.desc(PLUMB_SPHERE)), bytes};
    const int calls = FakeWorld::last->calls;
    EXPECT_EQ(create(all), code) << words;
    const std::string text = world->error_text();
    EXPECT_NE(text.find(words), std::string::npos) << "\"" << text << "\" does not say \"" << words << "\"";
    EXPECT_EQ(FakeWorld::last->calls, calls) << "the class was called";
  }
  void not_cooked(PlumbResult code, const PlumbShapeDesc& desc, const std::string& words) const {
    try {
      static_cast<void>(backend.cook(desc));
      ADD_FAILURE() << "was cooked, and not refused with " << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  std::array<double, 11> mass_of(PlumbShape shape) {
    PlumbBodyDesc desc = body_desc();
    desc.shape = shape;
    PlumbBody body = 0;
    check(*world, world->create_bodies({&desc, 1}, {&body, 1}));
    std::array<double, 11> row;
    check(*world, world->read(PLUMB_FIELD_MASS, {&body, 1}, rows_over(std::span(&row, 1))));
    return row;
  }

  Backend backend{negotiate(&backend::open<FakeWorld>, "fake")};
  std::unique_ptr<IPhysicsWorld> world;
  Tetrahedron solid;
  std::vector<PlumbShape> ids;
};

TEST_F(GuardCooking, ADescriptorComesBackWhole) {
  PlumbShapeDesc got{};
  std::vector<double> numbers;
  FakeWorld::last->on_shapes = [&](std::span<const PlumbShapeDesc> descs) {
    ASSERT_EQ(descs.size(), 1U);
    got = descs[0];
    const double* first = got.type == PLUMB_HEIGHT_FIELD ? got.heights : got.vertices;
    numbers.assign(first, first + (got.type == PLUMB_HEIGHT_FIELD  ? got.rows * got.columns
                                   : got.type == PLUMB_CONVEX_HULL ? 3 * got.vertex_count
                                                                   : 0));
    if (!backend::has_triangle_materials(got)) return;
    EXPECT_EQ(got.materials[0].friction, 0.5);
    EXPECT_EQ(got.materials[1].restitution, 0.25);
    EXPECT_TRUE(std::equal(solid.triangle_materials, solid.triangle_materials + 4, got.triangle_materials));
  };
  const auto made = [&](const PlumbShapeDesc& desc) {
    got = {};
    EXPECT_EQ(create(backend.cook(desc)), PLUMB_OK) << world->error_text();
    EXPECT_EQ(got.type, desc.type);
    return got;
  };
  EXPECT_EQ(made(solid.desc(PLUMB_SPHERE)).radius, 0.5);
  EXPECT_EQ(made(solid.desc(PLUMB_BOX)).half_extents.z, 3);
  EXPECT_EQ(made(solid.desc(PLUMB_CAPSULE)).half_height, 0.75);
  made(solid.desc(PLUMB_PLANE));
  EXPECT_EQ(made(solid.desc(PLUMB_CONVEX_HULL)).vertex_count, 4U);
  EXPECT_EQ(numbers, std::vector<double>(solid.vertices, solid.vertices + 12));
  const PlumbShapeDesc field = made(solid.with_materials(PLUMB_HEIGHT_FIELD));
  EXPECT_EQ(field.rows, 2U);
  EXPECT_EQ(field.columns, 3U);
  EXPECT_EQ(field.spacing.x, 0.5);
  EXPECT_EQ(field.spacing.z, 0.25);
  EXPECT_EQ(field.material_count, 2U);
  EXPECT_EQ(numbers, std::vector<double>(solid.heights, solid.heights + 6));
}

TEST_F(GuardCooking, BytesOfTheClassComeBackToIt) {
  const Bytes all[4] = {backend.cook(solid.desc(PLUMB_BOX)), backend.cook(solid.with_materials(PLUMB_TRIANGLE_MESH)),
                        backend.cook(solid.desc(PLUMB_SPHERE)), backend.cook(solid.desc(PLUMB_TRIANGLE_MESH))};
  ASSERT_EQ(create(all), PLUMB_OK) << world->error_text();
  const auto& cooked = FakeWorld::last->cooked;
  ASSERT_EQ(cooked.size(), 2U);
  EXPECT_EQ(cooked[0].type, PLUMB_TRIANGLE_MESH);
  EXPECT_EQ(cooked[0].bytes, Bytes(4, std::byte{7}));
  EXPECT_EQ(cooked[0].id, ids[1]);
  EXPECT_EQ(cooked[1].id, ids[3]);
  EXPECT_EQ(FakeWorld::last->shapes.size(), 2U);
}

TEST_F(GuardCooking, WhatTheClassCannotMakeLeavesNothing) {
  const Bytes all[2] = {backend.cook(solid.desc(PLUMB_BOX)), backend.cook(solid.desc(PLUMB_TRIANGLE_MESH))};
  ASSERT_EQ(create({all, 1}), PLUMB_OK);
  const PlumbShape before = ids[0];
  FakeWorld::last->fails_to_make_cooked = true;
  const int calls = FakeWorld::last->calls;
  EXPECT_EQ(create(all), PLUMB_E_OUT_OF_MEMORY);
  EXPECT_EQ(FakeWorld::last->calls, calls + 2) << "the box was made, and destroyed again";
  FakeWorld::last->fails_to_make_cooked = false;
  ASSERT_EQ(create({all, 1}), PLUMB_OK);
  EXPECT_LE(slot_of(ids[0]), slot_of(before) + 2) << "slots are given again";
}

TEST_F(GuardCooking, MassIsThatOfTheDescriptor) {
  for (const PlumbShapeType type : {PLUMB_SPHERE, PLUMB_BOX, PLUMB_CAPSULE, PLUMB_CONVEX_HULL, PLUMB_TRIANGLE_MESH}) {
    const PlumbShapeDesc desc = solid.desc(type);
    PlumbShape shape = 0;
    check(*world, world->create_shapes({&desc, 1}, {&shape, 1}));
    ASSERT_EQ(create(backend.cook(desc)), PLUMB_OK) << world->error_text();
    EXPECT_EQ(mass_of(ids[0]), mass_of(shape)) << backend::shape_name(type);
  }
}

TEST_F(GuardCooking, WhyAShapeHasNoMassIsNotForgotten) {
  PlumbShapeDesc open = solid.desc(PLUMB_TRIANGLE_MESH);
  open.triangle_count = 3;
  ASSERT_EQ(create(backend.cook(open)), PLUMB_OK);
  PlumbBodyDesc desc = body_desc();
  desc.shape = ids[0];
  PlumbBody body = 0;
  EXPECT_EQ(world->create_bodies({&desc, 1}, {&body, 1}), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_NE(world->error_text().find("open at the edge between vertices 1 and 2"), std::string::npos)
      << world->error_text();
}

TEST_F(GuardCooking, TheSameDescriptorGivesTheSameBytesWhereverItLies) {
  for (PlumbShapeType type = 0; type < PLUMB_COMPOUND; ++type) {
    if (type == PLUMB_CYLINDER) continue;
    const Tetrahedron other;
    PlumbShapeDesc desc = other.with_materials(type);
    const Bytes bytes = backend.cook(solid.with_materials(type));
    desc.user_data = 77;
    if (type != PLUMB_CAPSULE && type != PLUMB_SPHERE) desc.radius = 9;
    if (type != PLUMB_HEIGHT_FIELD) desc.heights = nullptr;
    EXPECT_EQ(bytes, backend.cook(desc)) << backend::shape_name(type)
                                         << ": what its type does not read is in the bytes";
    std::vector<Bytes> cooked(3);
    std::vector<std::thread> threads;
    for (Bytes& each : cooked) threads.emplace_back([&] { each = backend.cook(solid.with_materials(type)); });
    for (std::thread& thread : threads) thread.join();
    for (const Bytes& each : cooked) EXPECT_EQ(each, bytes) << backend::shape_name(type);
  }
}

TEST_F(GuardCooking, BytesMayLieAtAnyAddress) {
  for (const PlumbShapeType type : {PLUMB_CONVEX_HULL, PLUMB_TRIANGLE_MESH, PLUMB_HEIGHT_FIELD}) {
    Bytes bytes = backend.cook(solid.desc(type));
    bytes.insert(bytes.begin(), std::byte{0});
    const PlumbCookedShape shape = cooked_shape(std::span<const std::byte>(bytes).subspan(1));
    PlumbShape id = 0;
    EXPECT_EQ(world->cooking()->create_cooked({&shape, 1}, {&id, 1}), PLUMB_OK) << world->error_text();
  }
}

TEST_F(GuardCooking, DescriptorsAreRefusedAsThoseOfShapes) {
  PlumbShapeDesc desc = solid.desc(PLUMB_SPHERE);
  desc.radius = -1;
  not_cooked(PLUMB_E_INVALID_ARGUMENT, desc, "desc[0].radius is -1; it must be finite and above 0");
  not_cooked(PLUMB_E_UNSUPPORTED, solid.desc(PLUMB_CYLINDER), "fake has no cylinder: no cylinders here");
  not_cooked(PLUMB_E_UNSUPPORTED, solid.desc(PLUMB_COMPOUND),
             "desc.type is PLUMB_COMPOUND, whose children are shapes of a world; cook the children");
  desc = solid.desc(PLUMB_CONVEX_HULL);
  desc.vertex_count = 3;
  not_cooked(PLUMB_E_INVALID_ARGUMENT, desc, "desc[0].vertex_count is 3");
  desc = solid.desc(PLUMB_SPHERE);
  desc.struct_size = 8;
  not_cooked(PLUMB_E_INVALID_ARGUMENT, desc, "desc[0].struct_size is 8");
  desc.struct_size = offsetof(PlumbShapeDesc, materials) + 4;
  not_cooked(PLUMB_E_INVALID_ARGUMENT, desc, "desc[0].struct_size is 140");
  const std::vector<std::uint32_t> many(3 * 101, 0);
  desc = solid.desc(PLUMB_TRIANGLE_MESH);
  desc.indices = many.data();
  desc.triangle_count = 101;
  not_cooked(PLUMB_E_OUT_OF_MEMORY, desc, "too many triangles to cook");
}

TEST_F(GuardCooking, AsksForMemoryToAnswerInto) {
  const auto& table = *static_cast<const PlumbCookingTable*>(backend.table().extension(PLUMB_EXT_COOKING));
  const PlumbShapeDesc desc = solid.desc(PLUMB_SPHERE);
  EXPECT_EQ(table.cook(&desc, nullptr), PLUMB_E_INVALID_ARGUMENT);
  PlumbCooked cooked{};
  cooked.struct_size = 8;
  EXPECT_EQ(table.cook(&desc, &cooked), PLUMB_E_INVALID_ARGUMENT);
  cooked.struct_size = sizeof cooked;
  cooked.data = &cooked;
  EXPECT_EQ(table.cook(nullptr, &cooked), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_STREQ(cooked.message, "desc is null; it must point to 1 rows");
  EXPECT_EQ(cooked.data, nullptr);
  table.release(nullptr);
  PlumbCookedShape null{sizeof null, 0, nullptr, 8};
  PlumbShape id = 0;
  EXPECT_EQ(world->cooking()->create_cooked({&null, 1}, {&id, 1}), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_NE(world->error_text().find("shapes[0].data is null"), std::string::npos) << world->error_text();
  EXPECT_EQ(world->cooking()->create_cooked({}, {}), PLUMB_OK);
}

TEST_F(GuardCooking, BytesThatAreNotOfThisBackend) {
  const Bytes good = backend.cook(solid.desc(PLUMB_TRIANGLE_MESH));
  const auto header = [&](const std::string& words, auto&& change) {
    refused(PLUMB_E_CORRUPT, forged(good, change), "shapes[1].data " + words);
  };
  using Header = backend::CookedHeader;
  refused(PLUMB_E_CORRUPT, Bytes(20),
          "shapes[1].data has 20 bytes, less than the header of a cooked shape, which has 208");
  refused(PLUMB_E_CORRUPT, {}, "shapes[1].data has 0 bytes");
  header("does not begin as a cooked shape does", [](Header& h) { h.magic[7] = 'X'; });
  header("was cooked on a machine of another byte order", [](Header& h) { h.byte_order = 0x04030201U; });
  header("has version 2 of the frame, and this library reads version 1", [](Header& h) { h.frame = 2; });
  header("was cooked by fake 4 in double, and this is fake 3 in double; cook the shape with this one",
         [](Header& h) { h.format_version = 4; });
  header("was cooked by fake 3 in float,", [](Header& h) { h.precision = PLUMB_F32; });
  header("was cooked by bake 3 in double,", [](Header& h) { h.format[0] = 'b'; });
  header("was cooked by", [](Header& h) { std::fill(std::begin(h.format), std::end(h.format), 'x'); });
  Bytes longer = good;
  longer.push_back({});
  refused(PLUMB_E_CORRUPT, longer, "has 213 bytes, but its header tells of another number");
  refused(PLUMB_E_CORRUPT, Bytes(good.begin(), good.end() - 1), "has 211 bytes, but its header tells");
  refused(PLUMB_E_CORRUPT, changed(good, good.size() - 1), "was changed since it was cooked: its checksum is another");
}

TEST_F(GuardCooking, ForgedBytesOfNoShape) {
  const Bytes mesh = backend.cook(solid.desc(PLUMB_TRIANGLE_MESH)), hull = backend.cook(solid.desc(PLUMB_CONVEX_HULL));
  using Header = backend::CookedHeader;
  const auto is_none = [&](const Bytes& bytes, auto&& change, const std::string& words) {
    refused(PLUMB_E_CORRUPT, forged(bytes, change), words);
  };
  const std::string none = "is of no shape that cook gives";
  is_none(
      mesh, [](Header& h) { h.type = PLUMB_COMPOUND; }, none);
  is_none(
      mesh, [](Header& h) { h.type = 77; }, none);
  is_none(
      hull, [](Header& h) { h.has_mass = 0; }, none);
  is_none(
      hull, [](Header& h) { h.has_mass = 2; }, none);
  is_none(
      hull, [](Header& h) { h.is_native = 2; }, none);
  is_none(
      hull, [](Header& h) { h.unit_mass.mass = -1; }, none);
  is_none(
      hull, [](Header& h) { h.unit_mass.inertia.y = std::numeric_limits<double>::infinity(); }, none);
  is_none(
      hull, [](Header& h) { h.is_native = 1; }, "is of a type that this backend does not cook");
  is_none(
      hull, [](Header& h) { h.type = PLUMB_HEIGHT_FIELD; }, "goes on behind its end");
  is_none(
      hull, [](Header& h) { h.type = PLUMB_SPHERE; }, "goes on behind its end");
  is_none(
      hull, [](Header& h) { h.reason_size = ~0ULL; }, "tells of another number");
  is_none(
      hull, [](Header& h) { h.payload_size = ~0ULL; }, "tells of another number");
  is_none(
      hull,
      [](Header& h) {  // their sum is right
        h.payload_size -= 1000;
        h.reason_size += 1000;
      },
      "tells of another number");
}

TEST_F(GuardCooking, ForgedDescriptorsAreHeldToWhatAllAre) {
  const auto with_word = [&](const Bytes& bytes, std::size_t at, std::uint32_t word) {
    Bytes other = bytes;
    backend::CookedHeader header;
    std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof header);
    std::memcpy(other.data() + sizeof header + header.reason_size + at, &word, sizeof word);
    return forged(other, [](backend::CookedHeader&) {});
  };
  const Bytes hull = backend.cook(solid.desc(PLUMB_CONVEX_HULL)), field = backend.cook(solid.desc(PLUMB_HEIGHT_FIELD));
  refused(PLUMB_E_CORRUPT, with_word(hull, 0, 0xffffffffU), "ends too early");
  refused(PLUMB_E_CORRUPT, with_word(field, 0, 0xffffffffU), "ends too early");
  refused(PLUMB_E_INVALID_ARGUMENT, with_word(hull, 12, 0x7ff80000U), "shapes[1].vertices[0] is nan");
}

/// Whatever one byte becomes, and whatever many become of which the checksum is right: an answer.
TEST_F(GuardCooking, NoBytesAreTooStrange) {
  std::mt19937 random(1);
  for (const PlumbShapeType type : {PLUMB_SPHERE, PLUMB_CONVEX_HULL, PLUMB_TRIANGLE_MESH, PLUMB_HEIGHT_FIELD}) {
    const Bytes good = backend.cook(solid.with_materials(type));
    for (std::size_t at = 0; at < good.size(); ++at)
      for (const unsigned bit : {0U, 7U})
        EXPECT_EQ(create(changed(good, at, std::byte{1} << bit)), PLUMB_E_CORRUPT) << at << ", bit " << bit;
    for (std::size_t size = 0; size < good.size(); ++size)
      EXPECT_EQ(create(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))), PLUMB_E_CORRUPT);
    for (int i = 0; i < 3000; ++i) {
      Bytes bytes = good;
      for (std::uint32_t k = 0; k <= random() % 3; ++k)
        bytes[48 + random() % (bytes.size() - 48)] = static_cast<std::byte>(random());
      static_cast<void>(create(forged(bytes, [](backend::CookedHeader&) {})));
    }
  }
}

class GuardCookingInPlainWorld : public GuardCooking {
 protected:
  GuardCookingInPlainWorld() : GuardCooking(PLUMB_NEED_RESTITUTION) {}
};
TEST_F(GuardCookingInPlainWorld, MaterialsAskForNeeds) {
  for (const PlumbShapeType type : {PLUMB_TRIANGLE_MESH, PLUMB_HEIGHT_FIELD})
    refused(PLUMB_E_NOT_DECLARED, backend.cook(solid.with_materials(type)),
            "shapes[1].data, by its materials of triangles, asks for PLUMB_NEED_FRICTION; declare it");
}

TEST(CookingCapability, IsNativeWhereTheClassCooks) {
  const Backend backend(negotiate(&backend::open<FakeWorld>, "fake"));
  const auto degree = [&](std::uint32_t type) { return backend.capability(PLUMB_CAP_COOKING, type); };
  EXPECT_EQ(degree(PLUMB_TRIANGLE_MESH), PLUMB_NATIVE);
  EXPECT_EQ(degree(PLUMB_CONVEX_HULL), PLUMB_EMULATED);
  EXPECT_EQ(degree(PLUMB_PLANE), PLUMB_EMULATED);
  EXPECT_EQ(degree(PLUMB_CYLINDER), PLUMB_NONE) << "it has none";
  EXPECT_EQ(degree(PLUMB_COMPOUND), PLUMB_NONE);
  EXPECT_EQ(backend.capability_note(PLUMB_CAP_COOKING, PLUMB_COMPOUND),
            "its children are shapes of a world: cook them, and create it from their handles");
  EXPECT_EQ(degree(PLUMB_SHAPE_TYPE_COUNT), PLUMB_NONE);
}

TEST(CookingCapability, OfAClassThatDoesNotCookIsEmulated) {
  backend::BackendFacts facts = backend::Tables<FakeWorld>::facts();
  facts.cook = nullptr;
  facts.cooked_format = nullptr;
  const char* note = nullptr;
  EXPECT_EQ(backend::answer_capability(facts, PLUMB_CAP_COOKING, PLUMB_TRIANGLE_MESH, 0, &note), PLUMB_EMULATED);
  EXPECT_STREQ(note, "the bytes hold the descriptor, and its mass: the engine builds the shape anew");
  EXPECT_STREQ(backend::format_of(facts).name, "fake");
}

}  // namespace
}  // namespace plumb::test
