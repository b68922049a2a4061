// Handles, adding and removing while running, and bad input of every kind through a loaded backend.
#include <functional>
#include <limits>
#include <random>

#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace {

void stale_handles(Conformance& c) {
  Probe probe(c, c.available(kPlainNeeds));
  const PlumbShape ball = probe.lump(0.5);
  std::vector<PlumbBody> dead;
  for (int round = 0; round < 20; ++round) {
    const PlumbBody body = probe.dynamic(ball, {0, 1.0 * round, 0});
    probe.step();
    probe.destroy(body);
    dead.push_back(body);
  }
  const PlumbBody alive = probe.dynamic(ball, {0, 5, 0});
  double row[7] = {0, 0, 0, 0, 0, 0, 1};
  const Rows rows(reinterpret_cast<std::byte*>(row), 1, sizeof row, PLUMB_F64);
  const ConstRows const_rows(reinterpret_cast<const std::byte*>(row), 1, sizeof row, PLUMB_F64);
  for (PlumbBody body : {dead[0], dead[19], PlumbBody{0}, PlumbBody{1} << 40, ~PlumbBody{0}}) {
    IPhysicsWorld& world = probe.world();
    c.expect(world.read(PLUMB_FIELD_POSE, {&body, 1}, rows) == PLUMB_E_STALE_HANDLE, "reading handle {} is not refused",
             body);
    c.expect(world.write(PLUMB_FIELD_POSE, {&body, 1}, const_rows) == PLUMB_E_STALE_HANDLE,
             "writing handle {} is not refused", body);
    c.expect(world.destroy_bodies({&body, 1}) == PLUMB_E_STALE_HANDLE, "destroying handle {} is not refused", body);
    const PlumbBody both[2] = {alive, body};
    c.expect(world.destroy_bodies(both) == PLUMB_E_STALE_HANDLE && world.bodies().size() == 1,
             "a half valid destroy must do nothing");
  }
  PlumbShape shape = ball;
  c.expect(probe.world().destroy_shapes({&shape, 1}) == PLUMB_E_IN_USE, "a shape in use can be destroyed");
  probe.destroy(alive);
  c.expect(probe.world().destroy_shapes({&shape, 1}) == PLUMB_OK, "an unused shape cannot be destroyed");
  const PlumbBodyDesc desc = probe.declared(dynamic_desc(ball, {0, 0, 0}));
  PlumbBody id = 0;
  c.expect(probe.world().create_bodies({&desc, 1}, {&id, 1}) == PLUMB_E_STALE_HANDLE,
           "a destroyed shape can still be used");
}

/// Bodies come and go in a busy heap; those alive must be in order, finite, and above ground.
void churn(Conformance& c) {
  Probe probe(c, c.available(kPlainNeeds));
  const PlumbShape shapes[2] = {probe.lump(0.3), probe.sphere(0.3)};
  const PlumbBody floor = probe.ground();
  std::mt19937 random(7);
  std::vector<PlumbBody> alive = {floor};
  for (int step = 0; step < 400; ++step) {
    for (int i = 0; i < 2; ++i) {
      const auto tenths = [&] { return 0.1 * static_cast<double>(random() % 40); };
      const Vec position(tenths(), 2 + tenths(), tenths());
      alive.push_back(probe.dynamic(shapes[random() % 2], position));
    }
    while (alive.size() > 60) {
      const std::size_t victim = 1 + random() % (alive.size() - 1);
      probe.destroy(alive[victim]);
      alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(victim));
    }
    const PlumbStepReport report = probe.step();
    c.expect(report.bodies == alive.size() && report.nonfinite == 0, "step {}: {} bodies, {} not finite; {} expected",
             step, report.bodies, report.nonfinite, alive.size());
    const auto listed = probe.world().bodies();
    c.expect(std::equal(listed.begin(), listed.end(), alive.begin(), alive.end()),
             "step {}: bodies are not listed in order of creation", step);
  }
  for (std::size_t i = 1; i < alive.size() && probe.declares(PLUMB_NEED_COLLISION); ++i)
    c.expect(probe.position(alive[i]).y() > -0.2, "a body fell through the floor to {:.3f} m",
             probe.position(alive[i]).y());
}

/// Each bad call is refused with a text, and the neighbours end up with the same bits as in a world that was never
/// asked.
void bad_input(Conformance& c) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  struct World {
    Probe probe;
    PlumbShape cube;
    PlumbBody body;
    explicit World(Conformance& conformance)
        : probe(conformance, conformance.available(kPlainNeeds)), cube(probe.lump(0.5)), body(0) {
      probe.ground();
      for (int i = 0; i < 3; ++i) body = probe.dynamic(cube, {0.1 * i, 0.6 + 1.05 * i, 0});
    }
  };
  World asked(c), quiet(c);
  IPhysicsWorld& world = asked.probe.world();
  const auto body = [&](const std::function<void(PlumbBodyDesc&)>& spoil) {
    PlumbBodyDesc desc = dynamic_desc(asked.cube, {0, 0.5, 0});
    spoil(desc);
    PlumbBody id = 0;
    return world.create_bodies({&desc, 1}, {&id, 1});
  };
  const auto shape = [&](PlumbShapeType type, const std::function<void(PlumbShapeDesc&)>& spoil) {
    PlumbShapeDesc desc = shape_desc(type);
    desc.radius = desc.half_height = 0.5;
    desc.half_extents = {0.5, 0.5, 0.5};
    spoil(desc);
    PlumbShape id = 0;
    return world.create_shapes({&desc, 1}, {&id, 1});
  };
  const auto write = [&](PlumbField field, std::vector<double> row) {
    return world.write(field, {&asked.body, 1},
                       ConstRows(reinterpret_cast<const std::byte*>(row.data()), 1, row.size() * 8, PLUMB_F64));
  };
  const double flat[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, same[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  const std::pair<const char*, std::function<PlumbResult()>> calls[] = {
      {"position NaN", [&] { return body([&](auto& d) { d.pose.position.x = nan; }); }},
      {"position infinite", [&] { return body([&](auto& d) { d.pose.position.z = infinity; }); }},
      {"quaternion 0", [&] { return body([&](auto& d) {
                               d.pose.orientation = {0, 0, 0, 0};
                             }); }},
      {"velocity NaN", [&] { return body([&](auto& d) { d.linear_velocity.y = nan; }); }},
      {"density 0", [&] { return body([&](auto& d) { d.density = 0; }); }},
      {"density negative", [&] { return body([&](auto& d) { d.density = -1000; }); }},
      {"mass NaN", [&] { return body([&](auto& d) { d.mass_mode = PLUMB_MASS_FROM_TOTAL, d.mass = nan; }); }},
      {"inertia negative",
       [&] { return body([&](auto& d) {
               d.mass_mode = PLUMB_MASS_EXPLICIT, d.mass = 1, d.inertia = {1, -1, 1};
             }); }},
      {"friction negative", [&] { return body([&](auto& d) { d.material.friction = -1; }); }},
      {"motion unknown", [&] { return body([&](auto& d) { d.motion = 17; }); }},
      {"struct_size 0", [&] { return body([&](auto& d) { d.struct_size = 0; }); }},
      {"shape unknown", [&] { return body([&](auto& d) { d.shape = 999; }); }},
      {"radius 0", [&] { return shape(PLUMB_SPHERE, [&](auto& d) { d.radius = 0; }); }},
      {"radius NaN", [&] { return shape(PLUMB_SPHERE, [&](auto& d) { d.radius = nan; }); }},
      {"half extent negative", [&] { return shape(PLUMB_BOX, [&](auto& d) { d.half_extents.y = -1; }); }},
      {"hull coplanar",
       [&] { return shape(PLUMB_CONVEX_HULL, [&](auto& d) { d.vertices = flat, d.vertex_count = 4; }); }},
      {"hull of one point",
       [&] { return shape(PLUMB_CONVEX_HULL, [&](auto& d) { d.vertices = same, d.vertex_count = 4; }); }},
      {"hull without points", [&] { return shape(PLUMB_CONVEX_HULL, [&](auto& d) { d.vertex_count = 4; }); }},
      {"shape type unknown", [&] { return shape(99, [](auto&) {}); }},
      {"dt 0", [&] { return world.step(0); }},
      {"dt negative", [&] { return world.step(-1); }},
      {"dt NaN", [&] { return world.step(nan); }},
      {"gravity NaN",
       [&] {
         return world.set_gravity({0, nan, 0});
       }},
      {"written pose NaN",
       [&] {
         return write(PLUMB_FIELD_POSE, {nan, 0, 0, 0, 0, 0, 1});
       }},
      {"written velocity infinite",
       [&] {
         return write(PLUMB_FIELD_VELOCITY, {infinity, 0, 0, 0, 0, 0});
       }},
      {"field unknown",
       [&] {
         return write(1000, {0, 0, 0, 0, 0, 0, 0});
       }},
      {"force undeclared",
       [&] {
         return write(PLUMB_FIELD_FORCE, {1, 0, 0});
       }},
  };
  for (const auto& [what, call] : calls) {
    const PlumbResult result = call();
    c.expect(result < 0, "{}: answered {}", what, result);
    c.expect(!world.error_text().empty(), "{}: no error text", what);
    asked.probe.step();
    quiet.probe.step();
    c.expect(asked.probe.hash() == quiet.probe.hash(), "{}: the refused call changed the world", what);
  }
}

void world_life(Conformance& c) {
  for (int i = 0; i < 50; ++i) {
    Probe probe(c, c.available(kPlainNeeds));
    probe.ground();
    probe.dynamic(probe.lump(0.5), {0, 0.5, 0});
    probe.step(2);
  }
  Probe empty(c, c.available(kPlainNeeds));
  const PlumbStepReport report = empty.step(3);
  c.expect(report.bodies == 0 && report.contacts == 0 && report.step == 3,
           "an empty world reports {} bodies, {} contacts, step {}", report.bodies, report.contacts, report.step);
}

}  // namespace

std::span<const Check> handle_checks() {
  static constexpr Check checks[] = {
      {"handles.stale", "handles of the dead are refused for ever", &stale_handles},
      {"handles.churn", "bodies added and removed while running", &churn},
      {"input.bad", "bad input is refused in words and harms nobody", &bad_input},
      {"world.life", "worlds made and destroyed; an empty world steps", &world_life},
  };
  return checks;
}

}  // namespace plumb::harness::conform
