// Shapes from bytes are those from descriptors: in steps, mass, queries, changes and snapshots (plumb.cooking/1).
#include <algorithm>
#include <cstring>
#include <thread>

#include "conform/probe.hpp"
#include "plumb/backend/modify.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::harness::conform {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::uint32_t kGroundPoints = 13;  // of a ground along a side, 1 m apart

/// A bumpy ground, and what falls on it.
struct Forms {
  Forms() {
    for (std::uint32_t row = 0; row < kGroundPoints; ++row)
      for (std::uint32_t column = 0; column < kGroundPoints; ++column) {
        heights.push_back(0.3 * std::sin(1.1 * column) * std::cos(0.9 * row));
        vertices.insert(vertices.end(), {column - 6.0, heights.back(), row - 6.0});
      }
    for (std::uint32_t row = 0; row + 1 < kGroundPoints; ++row)
      for (std::uint32_t column = 0; column + 1 < kGroundPoints; ++column) {
        const std::uint32_t a = row * kGroundPoints + column, b = a + kGroundPoints;
        indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
      }
    for (std::uint32_t t = 0; t < indices.size() / 3; ++t) rows.push_back(t % 3 == 2 ? PLUMB_BODY_MATERIAL : t % 3);
  }

  [[nodiscard]] PlumbShapeDesc desc(PlumbShapeType type) const {
    PlumbShapeDesc desc = shape_desc(type);
    desc.radius = 0.3;
    desc.half_height = 0.25;
    desc.half_extents = {0.4, 0.3, 0.35};
    desc.rows = desc.columns = kGroundPoints;
    desc.spacing = {1, 0, 1};
    desc.heights = heights.data();
    desc.vertices = type == PLUMB_CONVEX_HULL ? wedge : vertices.data();
    desc.vertex_count = type == PLUMB_CONVEX_HULL ? 6 : kGroundPoints * kGroundPoints;
    desc.indices = indices.data();
    desc.triangle_count = static_cast<std::uint32_t>(indices.size() / 3);
    return desc;
  }
  /// With materials by triangle.
  [[nodiscard]] PlumbShapeDesc mixed(PlumbShapeType type) const {
    PlumbShapeDesc mixed = desc(type);
    mixed.materials = materials;
    mixed.material_count = 2;
    mixed.triangle_materials = rows.data();
    return mixed;
  }

  double wedge[18] = {-0.4, -0.3, -0.3, 0.5, -0.3, -0.3, -0.4, 0.4, -0.3,
                      -0.4, -0.3, 0.3,  0.5, -0.3, 0.3,  -0.4, 0.4, 0.3};
  PlumbMaterial materials[2] = {{0, 0, {0, 0, 0}}, {0.9, 0, {0, 0, 0}}};
  std::vector<double> heights, vertices;
  std::vector<std::uint32_t> indices, rows;
};

bool cooks(Conformance& c, PlumbShapeType type) {
  return c.backend().capability(PLUMB_CAP_COOKING, type) != PLUMB_NONE;
}
/// Of those that lie still below others, what the backend cooks.
std::vector<PlumbShapeType> grounds(Conformance& c) {
  std::vector<PlumbShapeType> types;
  for (const PlumbShapeType type : {PLUMB_TRIANGLE_MESH, PLUMB_HEIGHT_FIELD, PLUMB_PLANE})
    if (cooks(c, type)) types.push_back(type);
  if (types.empty()) throw Skipped{"cooks no mesh, height field or plane"};
  return types;
}

PlumbResult try_bytes(Probe& probe, const Bytes& bytes, PlumbShape& shape) {
  const PlumbCookedShape cooked = cooked_shape(bytes);
  return probe.world().cooking()->create_cooked({&cooked, 1}, {&shape, 1});
}
PlumbShape from_bytes(Probe& probe, const Bytes& bytes) {
  PlumbShape shape = 0;
  check(probe.world(), try_bytes(probe, bytes, shape));
  return shape;
}
PlumbShape made(Conformance& c, Probe& probe, const PlumbShapeDesc& desc, bool cooked) {
  return cooked ? from_bytes(probe, c.backend().cook(desc)) : probe.shape(desc);
}

/// Everything that the backend cooks and moves falls on the ground; a compound of two that were cooked, too.
void pour(Conformance& c, Probe& probe, const Forms& forms, bool cooked) {
  std::vector<PlumbShape> shapes;
  for (const PlumbShapeType type : {PLUMB_SPHERE, PLUMB_BOX, PLUMB_CAPSULE, PLUMB_CYLINDER, PLUMB_CONVEX_HULL})
    if (cooks(c, type) && c.backend().capability(PLUMB_CAP_SHAPE, type, PLUMB_DYNAMIC) != PLUMB_NONE)
      shapes.push_back(made(c, probe, forms.desc(type), cooked));
  if (shapes.empty()) throw Skipped{"cooks nothing that moves"};
  if (c.backend().capability(PLUMB_CAP_SHAPE, PLUMB_COMPOUND, PLUMB_DYNAMIC) != PLUMB_NONE) {
    PlumbCompoundChild children[2] = {{shapes.front(), identity_pose(), 0, 0, {}},
                                      {shapes.back(), identity_pose(), 0, 0, {}}};
    children[1].pose.position.x = 0.6;
    PlumbShapeDesc compound = shape_desc(PLUMB_COMPOUND);
    compound.children = children;
    compound.child_count = 2;
    shapes.push_back(probe.shape(compound));
  }
  for (std::size_t i = 0; i < 24; ++i)
    probe.dynamic(shapes[i % shapes.size()], {1.3 * static_cast<double>(i % 5) - 2.6, 1 + 0.2 * static_cast<double>(i),
                                              1.1 * static_cast<double>(i % 3) - 1.2});
}

/// A world with a ground and what is poured on it.
std::uint64_t poured(Conformance& c, const PlumbShapeDesc& ground, const Forms& forms, bool cooked) {
  Probe probe(c, kPlainNeeds);
  probe.fixed(made(c, probe, ground, cooked), {0, 0, 0});
  pour(c, probe, forms, cooked);
  probe.step(150);
  return probe.hash();
}

void require_same_bits(Conformance& c) {
  if (c.backend().info().determinism == PLUMB_DETERMINISM_NONE) throw Skipped{"the same calls give other bits"};
}

void same_steps(Conformance& c) {
  c.require_needs(kPlainNeeds);
  require_same_bits(c);
  const Forms forms;
  for (const PlumbShapeType ground : grounds(c))
    c.expect(poured(c, forms.desc(ground), forms, true) == poured(c, forms.desc(ground), forms, false),
             "what falls on a cooked {} ends in other bits than on one from its descriptor",
             backend::shape_name(ground));
}

void same_materials(Conformance& c) {
  c.require_needs(kPlainNeeds);
  require_same_bits(c);
  const Forms forms;
  bool any = false;
  for (const PlumbShapeType ground : {PLUMB_TRIANGLE_MESH, PLUMB_HEIGHT_FIELD}) {
    if (!cooks(c, ground) || c.backend().capability(PLUMB_CAP_TRIANGLE_MATERIAL, ground) == PLUMB_NONE) continue;
    any = true;
    c.expect(poured(c, forms.mixed(ground), forms, true) == poured(c, forms.mixed(ground), forms, false),
             "what slides on a cooked {} of several materials ends in other bits", backend::shape_name(ground));
  }
  if (!any) throw Skipped{"no cooked shapes with materials by triangle"};
}

void same_mass(Conformance& c) {
  c.require_needs(PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION);
  Probe probe(c, PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION);
  const Forms forms;
  bool any = false;
  for (PlumbShapeType type = 0; type < PLUMB_COMPOUND; ++type) {
    if (!backend::is_convex(type) || !cooks(c, type)) continue;
    if (c.backend().capability(PLUMB_CAP_SHAPE, type, PLUMB_DYNAMIC) == PLUMB_NONE) continue;
    any = true;
    const auto mass = [&](bool cooked) {
      return probe.read(PLUMB_FIELD_MASS, probe.dynamic(made(c, probe, forms.desc(type), cooked), {0, 0, 0}));
    };
    const std::vector<double> from_desc = mass(false), from_cooked = mass(true);
    c.expect(from_desc == from_cooked, "a cooked {} has {} kg, and one from its descriptor {} kg, or another inertia",
             backend::shape_name(type), from_cooked[0], from_desc[0]);
  }
  if (!any) throw Skipped{"cooks nothing that moves"};
}

void same_rays(Conformance& c) {
  c.require_needs(kQueryNeeds);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_RAY, 0, "rays");
  const Forms forms;
  for (const PlumbShapeType type : grounds(c)) {
    const auto hits = [&](bool cooked) {
      Probe probe(c, kQueryNeeds);
      probe.fixed(made(c, probe, forms.desc(type), cooked), {0, 0, 0});
      probe.step();
      std::vector<PlumbRay> rays;
      for (int i = 0; i < 400; ++i)
        rays.push_back({{0.53 * (i % 20) - 5, 2, 0.49 * (i / 20) - 5}, {0.2 * (i % 3) - 0.2, -4, 0.1}, kSeesAll});
      const Hits found = probe.world().queries()->cast_rays(PLUMB_HIT_ALL, rays);
      check(probe.world(), found.result);
      return std::vector<PlumbHit>(found.hits.begin(), found.hits.end());
    };
    const std::vector<PlumbHit> of_desc = hits(false), of_bytes = hits(true);
    const bool same = std::equal(of_desc.begin(), of_desc.end(), of_bytes.begin(), of_bytes.end(),
                                 [](const PlumbHit& a, const PlumbHit& b) {
                                   return a.query == b.query && a.child == b.child && a.fraction == b.fraction &&
                                          vec(a.position) == vec(b.position) && vec(a.normal) == vec(b.normal);
                                 });
    c.expect(!of_desc.empty(), "of 400 rays none hits a {}", backend::shape_name(type));
    c.expect(same, "rays hit a cooked {} elsewhere than one from its descriptor", backend::shape_name(type));
  }
}

/// The ground is dug where it lies, and what lies on it falls.
void same_changes(Conformance& c) {
  c.require_needs(kPlainNeeds);
  require_same_bits(c);
  bool any = false;
  for (const PlumbShapeType type : {PLUMB_TRIANGLE_MESH, PLUMB_HEIGHT_FIELD}) {
    if (!cooks(c, type) || c.backend().capability(PLUMB_CAP_MODIFY, 2, type) == PLUMB_NONE) continue;
    any = true;
    const auto dug = [&](bool cooked) {
      Forms forms;
      Probe probe(c, kPlainNeeds);
      const PlumbShape shape = made(c, probe, forms.desc(type), cooked);
      probe.fixed(shape, {0, 0, 0});
      pour(c, probe, forms, cooked);
      probe.step(60);
      for (std::size_t i = 0; i < forms.heights.size(); i += 3) {
        forms.heights[i] -= 0.5;
        forms.vertices[3 * i + 1] -= 0.5;
      }
      const PlumbShapeDesc desc = forms.desc(type);
      check(probe.world(), probe.world().modify()->modify_shapes({&shape, 1}, {&desc, 1}));
      probe.step(90);
      return probe.hash();
    };
    c.expect(dug(true) == dug(false), "a cooked {} that is changed is another than one from its descriptor",
             backend::shape_name(type));
  }
  if (!any) throw Skipped{"no cooked shapes that can be changed"};
}

/// A world of shapes from descriptors comes back over one of shapes from bytes.
void same_snapshots(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SNAPSHOT;
  c.require_needs(needs);
  c.require(PLUMB_CAP_SNAPSHOT, 1, 0, "snapshots of the whole world");
  const Forms forms;
  for (const PlumbShapeType type : grounds(c)) {
    Probe of_descs(c, needs), of_bytes(c, needs);
    for (Probe* probe : {&of_descs, &of_bytes}) {
      probe->fixed(made(c, *probe, forms.desc(type), probe == &of_bytes), {0, 0, 0});
      pour(c, *probe, forms, probe == &of_bytes);
    }
    of_descs.step(40);
    std::span<const std::byte> saved;
    check(of_descs.world(), of_descs.world().snapshot()->save_world(saved));
    const PlumbResult result = of_bytes.world().snapshot()->restore(saved);
    c.expect(result >= 0, "a world does not come back over its cooked shapes: {}", of_bytes.world().error_text());
    if (result >= 0)
      c.expect(of_bytes.hash() == of_descs.hash(), "a world comes back over its cooked shapes in other bits");
  }
}

/// While worlds step, and all at once.
void same_bytes(Conformance& c) {
  c.require_needs(kPlainNeeds);
  const Forms forms;
  const std::vector<PlumbShapeType> types = grounds(c);
  std::vector<Bytes> alone;
  for (const PlumbShapeType type : types) alone.push_back(c.backend().cook(forms.desc(type)));
  Probe probe(c, kPlainNeeds);
  probe.fixed(from_bytes(probe, alone[0]), {0, 0, 0});
  pour(c, probe, forms, true);
  std::vector<std::vector<Bytes>> together(4);
  std::vector<std::string> failures(together.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < together.size(); ++i)
    threads.emplace_back([&, i] {
      try {
        for (int turn = 0; turn < 4; ++turn)
          for (const PlumbShapeType type : types) together[i].push_back(c.backend().cook(forms.desc(type)));
      } catch (const std::exception& error) {
        failures[i] = error.what();
      }
    });
  probe.step(30);
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < together.size(); ++i) {
    c.expect(failures[i].empty(), "in thread {}: {}", i, failures[i]);
    for (std::size_t k = 0; k < together[i].size(); ++k)
      c.expect(together[i][k] == alone[k % alone.size()], "in a thread beside others a {} is cooked into other bytes",
               backend::shape_name(types[k % types.size()]));
  }
}

void refuse_bytes(Conformance& c) {
  c.require_needs(kPlainNeeds);
  const Forms forms;
  for (const PlumbShapeType type : grounds(c)) {
    Probe probe(c, kPlainNeeds);
    const Bytes good = c.backend().cook(forms.desc(type));
    const PlumbShape ground = from_bytes(probe, good);
    probe.fixed(ground, {0, 0, 0});
    const auto refused = [&](const Bytes& bytes, const char* what) {
      PlumbShape shape = 77;
      const PlumbResult result = try_bytes(probe, bytes, shape);
      c.expect(result == PLUMB_E_CORRUPT, "{} of a {} are answered with {}", what, backend::shape_name(type), result);
      c.expect(shape == 77 || result >= 0, "{} have written a handle", what);
      c.expect(result >= 0 || !probe.world().error_text().empty(), "{} are refused without a word", what);
    };
    refused({}, "no bytes");
    for (const std::size_t part : {std::size_t{1}, good.size() / 3, good.size() - 1})
      refused(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(part)), "torn bytes");
    Bytes longer = good;
    longer.push_back(std::byte{0});
    refused(longer, "bytes with one more");
    for (std::size_t i = 0; i < 64; ++i) {
      Bytes changed = good;
      changed[i * (good.size() - 1) / 63] ^= std::byte{0x10};
      refused(changed, "changed bytes");
    }
    const PlumbShape again = from_bytes(probe, good);
    c.expect(slot_of(again) == slot_of(ground) + 1, "bytes that were refused have left shapes behind");
  }
  const auto not_cooked = [&](const PlumbShapeDesc& desc, PlumbResult code, const char* what) {
    try {
      (void)c.backend().cook(desc);
      c.expect(false, "{} is cooked", what);
    } catch (const Error& error) {
      c.expect(error.code() == code, "{} is answered with {}: {}", what, error.code(), error.what());
      c.expect(*error.what() != '\0', "{} is refused without a word", what);
    }
  };
  PlumbShapeDesc compound = shape_desc(PLUMB_COMPOUND);
  not_cooked(compound, PLUMB_E_UNSUPPORTED, "a compound");
  if (!cooks(c, PLUMB_SPHERE)) return;
  PlumbShapeDesc nothing = shape_desc(PLUMB_SPHERE);
  not_cooked(nothing, PLUMB_E_INVALID_ARGUMENT, "a ball of 0 m");
}

}  // namespace

std::span<const Check> cooking_checks() {
  static constexpr Check checks[] = {
      {"cooking.steps", "cooked shapes move and collide to the same bits", &same_steps},
      {"cooking.materials", "and so do those with materials by triangle", &same_materials},
      {"cooking.mass", "cooked shapes weigh the same to the last bit", &same_mass},
      {"cooking.rays", "rays hit cooked grounds in the same places", &same_rays},
      {"cooking.changes", "cooked grounds change as others do", &same_changes},
      {"cooking.snapshots", "a snapshot of a world knows its shapes when they are cooked", &same_snapshots},
      {"cooking.threads", "the same descriptor is the same bytes, in many threads beside a step", &same_bytes},
      {"cooking.refusals", "bytes that are torn, changed or none are refused, and leave nothing", &refuse_bytes},
  };
  return checks;
}

}  // namespace plumb::harness::conform
