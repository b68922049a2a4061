// Forged shapes: words of cooked bytes become others, and the checksum is made right again. Each is refused with a
// text, or is a shape that worlds step and search without harm.
//
// usage: fuzz_cooked BACKEND COUNT [SEED]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "cooked_frame.hpp"
#include "plumb/loader.hpp"

namespace {

using Bytes = std::vector<std::byte>;

/// A bumpy ground of 72 triangles, as a mesh or a height field, and a hull.
struct Forms {
  Forms() {
    for (std::uint32_t i = 0; i < 49; ++i) {
      heights.push_back(0.3 * std::sin(1.7 * i));
      vertices.insert(vertices.end(), {i % 7 - 3.0, heights.back(), i / 7 - 3.0});
      if (i % 7 != 6 && i < 42) indices.insert(indices.end(), {i, i + 7, i + 1, i + 1, i + 7, i + 8});
    }
    for (std::uint32_t t = 0; t < 72; ++t) materials_of.push_back(t % 3 == 0 ? PLUMB_BODY_MATERIAL : t % 2);
  }
  [[nodiscard]] PlumbShapeDesc desc(PlumbShapeType type, bool has_materials) const {
    PlumbShapeDesc desc = plumb::shape_desc(type);
    desc.radius = desc.half_height = 0.5;
    desc.half_extents = {0.5, 0.5, 0.5};
    desc.vertices = vertices.data();
    desc.vertex_count = 49;
    desc.indices = indices.data();
    desc.triangle_count = 72;
    desc.heights = heights.data();
    desc.rows = desc.columns = 7;
    desc.spacing = {1, 0, 1};
    desc.materials = materials;
    desc.triangle_materials = materials_of.data();
    desc.material_count = has_materials ? 2 : 0;
    return desc;
  }
  std::vector<double> vertices, heights;
  std::vector<std::uint32_t> indices, materials_of;
  PlumbMaterial materials[2] = {{0.5, 0, {0, 0, 0}}, {0.1, 0, {0, 0, 0}}};
};

Bytes forged(Bytes bytes, std::mt19937& random) {
  using plumb::backend::CookedHeader;
  CookedHeader header;
  const auto some = [&] { return static_cast<std::uint32_t>(random()); };
  for (std::uint32_t k = 0; k <= some() % 3; ++k) {
    // Of the header what names the shape, and all that follows: the rest is looked at first.
    std::byte* at = bytes.data() + 56 + some() % ((bytes.size() - 56) / 4) * 4;
    std::uint32_t word = 0;
    std::memcpy(&word, at, 4);
    const std::uint32_t others[] = {word + 1, word - 1, word ^ 1U << some() % 32, some(), 0, ~0U, 0x3f800000U};
    std::memcpy(at, &others[some() % 7], 4);
  }
  std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof header);
  header.hash = plumb::backend::cooked_hash(header, std::span<const std::byte>(bytes).subspan(sizeof header));
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

/// A world with the shape, and what falls on it. Calls may fail; what they answer is looked at elsewhere.
bool use(const plumb::Backend& backend, const Bytes& bytes) {
  using namespace plumb;
  PlumbWorldDesc desc = world_desc(
      backend.offered(PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_QUERIES));
  const std::unique_ptr<IPhysicsWorld> world = backend.create_world(desc);
  const PlumbCookedShape cooked = cooked_shape(bytes);
  PlumbShape shape = 0, ball = 0;
  if (world->cooking()->create_cooked({&cooked, 1}, {&shape, 1}) < 0) {
    if (world->error_text().empty()) throw Error(PLUMB_E_INTERNAL, "a forged shape is refused without a word");
    return false;
  }
  PlumbShapeDesc sphere = shape_desc(PLUMB_SPHERE);
  sphere.radius = 0.5;
  static_cast<void>(world->create_shapes({&sphere, 1}, {&ball, 1}));
  PlumbBodyDesc bodies[] = {body_desc(PLUMB_STATIC), body_desc(), body_desc()};
  bodies[0].shape = bodies[1].shape = shape;
  bodies[1].pose.position.y = 8;
  bodies[2].shape = ball;
  bodies[2].pose.position.y = 0.4;
  for (const PlumbBodyDesc& body : bodies) {
    PlumbBody id = 0;
    static_cast<void>(world->create_bodies({&body, 1}, {&id, 1}));
  }
  for (int i = 0; i < 3; ++i) {
    PlumbStepReport report{};
    if (world->step(1.0 / 60) < 0 || world->wait(report) < 0) return true;
  }
  const PlumbRay rays[] = {{{0.2, 50, 0.3}, {0, -100, 0}, {1, ~0U, 0, 0}},
                           {{-50, 0, 0}, {100, 0.1, 1}, {1, ~0U, 0, 0}}};
  if (world->queries() != nullptr) static_cast<void>(world->queries()->cast_rays(PLUMB_HIT_ALL, rays));
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: fuzz_cooked BACKEND COUNT [SEED]\n");
    return 2;
  }
  try {
    const plumb::Backend backend = plumb::open_backend(argv[1]);
    std::mt19937 random(argc > 3 ? static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10)) : 1);
    const Forms forms;
    std::vector<Bytes> all;
    for (PlumbShapeType type = 0; type < PLUMB_COMPOUND; ++type)
      for (const bool has_materials : {false, true}) {
        if (has_materials && backend.capability(PLUMB_CAP_TRIANGLE_MATERIAL, type) == PLUMB_NONE) continue;
        if (backend.capability(PLUMB_CAP_COOKING, type) != PLUMB_NONE)
          all.push_back(backend.cook(forms.desc(type, has_materials)));
      }
    unsigned long long used = 0, refused = 0;
    for (std::uint64_t i = 0; !all.empty() && i < std::strtoull(argv[2], nullptr, 10); ++i)
      ++(use(backend, forged(all[i % all.size()], random)) ? used : refused);
    std::printf("%llu forged shapes used, %llu refused\n", used, refused);
    return 0;
  } catch (const plumb::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
