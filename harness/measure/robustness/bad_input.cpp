// Bad input of every kind through the host's interface. Each call must fail with a text that names the argument, and
// nothing else in the world may notice: its bodies keep the same bits as those of a twin that was never asked.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "measure/robustness/robustness.hpp"

namespace plumb::harness {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// What bad calls are made of: a world with a healthy body and shape in it.
struct Victim {
  IPhysicsWorld& world;
  PlumbBody body;
  PlumbShape box = 0;
};

struct BadCall {
  std::string what;
  std::string named;  ///< the word that the error text must hold
  std::function<PlumbResult(Victim&)> call;
};

/// A shape that an engine did take by mistake is taken away again, so that one mistake is counted once.
PlumbResult try_shape(Victim& victim, const PlumbShapeDesc& desc) {
  PlumbShape id = 0;
  const PlumbResult result = victim.world.create_shapes({&desc, 1}, {&id, 1});
  if (result >= 0) victim.world.destroy_shapes({&id, 1});
  return result;
}

PlumbResult try_body(Victim& victim, const PlumbBodyDesc& desc) {
  PlumbBody id = 0;
  const PlumbResult result = victim.world.create_bodies({&desc, 1}, {&id, 1});
  if (result >= 0) victim.world.destroy_bodies({&id, 1});
  return result;
}

PlumbResult try_joint(Victim& victim, const PlumbJointDesc& desc) {
  PlumbJoint id = 0;
  const PlumbResult result = victim.world.joints()->create_joints({&desc, 1}, {&id, 1});
  if (result >= 0) victim.world.joints()->destroy_joints({&id, 1});
  return result;
}

void add_shapes(std::vector<BadCall>& calls) {
  const auto add = [&](std::string what, std::string named, PlumbShapeType type, auto change) {
    calls.push_back({std::move(what), std::move(named), [type, change](Victim& victim) {
                       PlumbShapeDesc desc = shape_desc(type);
                       desc.radius = desc.half_height = 0.5;
                       desc.half_extents = {0.5, 0.5, 0.5};
                       change(desc);
                       return try_shape(victim, desc);
                     }});
  };
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    const std::string value = fmt::format(" {}", bad);
    for (const PlumbShapeType type : {PLUMB_SPHERE, PLUMB_CAPSULE, PLUMB_CYLINDER})
      add("radius" + value, "radius", type, [bad](PlumbShapeDesc& desc) { desc.radius = bad; });
    add("half extent" + value, "half_extents.y", PLUMB_BOX, [bad](PlumbShapeDesc& desc) { desc.half_extents.y = bad; });
    add("cylinder height" + value, "half_height", PLUMB_CYLINDER,
        [bad](PlumbShapeDesc& desc) { desc.half_height = bad; });
  }
  add("negative capsule height", "half_height", PLUMB_CAPSULE, [](PlumbShapeDesc& desc) { desc.half_height = -1; });
  add("shape of no type", "type", 77, [](PlumbShapeDesc&) {});
  add("descriptor without a size", "struct_size", PLUMB_BOX, [](PlumbShapeDesc& desc) { desc.struct_size = 0; });

  static const std::array<double, 12> flat{0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1};
  static const std::array<double, 12> line{0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0};
  static const std::array<double, 12> one{1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3};
  static const std::array<double, 12> with_nan{0, 0, 0, 1, 0, 0, 0, nan, 1, 1, 1, 1};
  const auto hull = [&](std::string what, std::string named, const std::array<double, 12>& points,
                        std::uint32_t count) {
    add(std::move(what), std::move(named), PLUMB_CONVEX_HULL, [&points, count](PlumbShapeDesc& desc) {
      desc.vertices = points.data();
      desc.vertex_count = count;
    });
  };
  hull("hull in one plane", "plane", flat, 4);
  hull("hull on one line", "line", line, 4);
  hull("hull of one point, four times", "point", one, 4);
  hull("hull of three points", "vertex_count", flat, 3);
  hull("hull with a NaN", "vertices[7]", with_nan, 4);
  add("hull without vertices", "vertices", PLUMB_CONVEX_HULL, [](PlumbShapeDesc& desc) { desc.vertex_count = 8; });

  static const std::array<std::uint32_t, 3> beyond{0, 1, 9};
  add("mesh index beyond the vertices", "indices[2]", PLUMB_TRIANGLE_MESH, [](PlumbShapeDesc& desc) {
    desc.vertices = flat.data();
    desc.vertex_count = 4;
    desc.indices = beyond.data();
    desc.triangle_count = 1;
  });
  add("height field of one row", "rows", PLUMB_HEIGHT_FIELD, [](PlumbShapeDesc& desc) {
    desc.heights = flat.data();
    desc.rows = 1;
    desc.columns = 4;
    desc.spacing = {1, 0, 1};
  });
  add("height field without spacing", "spacing.x", PLUMB_HEIGHT_FIELD, [](PlumbShapeDesc& desc) {
    desc.heights = flat.data();
    desc.rows = desc.columns = 2;
  });
  add("compound without children", "child_count", PLUMB_COMPOUND, [](PlumbShapeDesc&) {});
}

void add_bodies(std::vector<BadCall>& calls) {
  const auto add = [&](std::string what, std::string named, auto change) {
    calls.push_back({std::move(what), std::move(named), [change](Victim& victim) {
                       PlumbBodyDesc desc = body_desc();
                       desc.shape = victim.box;
                       desc.pose.position = {100, 100, 100};
                       change(desc);
                       return try_body(victim, desc);
                     }});
  };
  for (const double bad : {nan, infinity}) {
    const std::string value = fmt::format(" {}", bad);
    add("position" + value, "pose.position.x", [bad](PlumbBodyDesc& desc) { desc.pose.position.x = bad; });
    add("orientation" + value, "pose.orientation", [bad](PlumbBodyDesc& desc) { desc.pose.orientation.w = bad; });
    add("velocity" + value, "linear_velocity.y", [bad](PlumbBodyDesc& desc) { desc.linear_velocity.y = bad; });
    add("spin" + value, "angular_velocity.z", [bad](PlumbBodyDesc& desc) { desc.angular_velocity.z = bad; });
    add("gravity scale" + value, "gravity_scale", [bad](PlumbBodyDesc& desc) { desc.gravity_scale = bad; });
  }
  add("orientation 0", "pose.orientation", [](PlumbBodyDesc& desc) { desc.pose.orientation = {0, 0, 0, 0}; });
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    const std::string value = fmt::format(" {}", bad);
    add("density" + value, "density", [bad](PlumbBodyDesc& desc) { desc.density = bad; });
    add("mass" + value, "mass", [bad](PlumbBodyDesc& desc) {
      desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
      desc.mass = bad;
    });
    add("inertia" + value, "inertia.y", [bad](PlumbBodyDesc& desc) {
      desc.mass_mode = PLUMB_MASS_EXPLICIT;
      desc.mass = 1;
      desc.inertia = {1, bad, 1};
    });
  }
  for (const double bad : {-1.0, nan}) {
    const std::string value = fmt::format(" {}", bad);
    add("friction" + value, "friction", [bad](PlumbBodyDesc& desc) { desc.material.friction = bad; });
    add("restitution" + value, "restitution", [bad](PlumbBodyDesc& desc) { desc.material.restitution = bad; });
    add("damping" + value, "linear_damping", [bad](PlumbBodyDesc& desc) { desc.linear_damping = bad; });
  }
  add("restitution 2", "restitution", [](PlumbBodyDesc& desc) { desc.material.restitution = 2; });
  add("motion of no kind", "motion", [](PlumbBodyDesc& desc) { desc.motion = 9; });
  add("mass mode of no kind", "mass_mode", [](PlumbBodyDesc& desc) { desc.mass_mode = 9; });
  add("flags that are none", "flags", [](PlumbBodyDesc& desc) { desc.flags = 1u << 30; });
  add("shape that never was", "shape", [](PlumbBodyDesc& desc) { desc.shape = 0x7700000123; });
}

void add_joints(std::vector<BadCall>& calls) {
  const auto add = [&](std::string what, std::string named, auto change) {
    calls.push_back({std::move(what), std::move(named), [change](Victim& victim) {
                       PlumbJointDesc desc = joint_desc(PLUMB_JOINT_HINGE);
                       desc.body_b = victim.body;
                       change(desc);
                       return try_joint(victim, desc);
                     }});
  };
  add("joint of no type", "type", [](PlumbJointDesc& desc) { desc.type = 99; });
  add("joint of no body", "body_b", [](PlumbJointDesc& desc) { desc.body_b = 0; });
  add("joint to a body that never was", "body_a", [](PlumbJointDesc& desc) { desc.body_a = 0x7700000123; });
  add("frame NaN", "frame_a.position.y", [](PlumbJointDesc& desc) { desc.frame_a.position.y = nan; });
  add("limits the wrong way round", "limits[3].lower", [](PlumbJointDesc& desc) { desc.limits[3] = {1, -1, 1, 0}; });
  add("motor of negative force", "motors[3].max_force", [](PlumbJointDesc& desc) { desc.motors[3] = {1, -1, 1, 0}; });
  add("spring of frequency 0", "springs[3].frequency", [](PlumbJointDesc& desc) { desc.springs[3] = {0, 0, 1, 1, 0}; });
  add("negative length", "rest_length", [](PlumbJointDesc& desc) {
    desc.type = PLUMB_JOINT_DISTANCE;
    desc.rest_length = -1;
  });
}

void add_calls(std::vector<BadCall>& calls) {
  const auto write = [&](std::string what, std::string named, PlumbField field, std::vector<double> row,
                         std::optional<PlumbBody> other = std::nullopt) {
    calls.push_back({std::move(what), std::move(named), [field, row, other](Victim& victim) {
                       const PlumbBody id = other.value_or(victim.body);
                       const ConstRows rows(reinterpret_cast<const std::byte*>(row.data()), 1,
                                            row.size() * sizeof(double), PLUMB_F64);
                       return victim.world.write(field, {&id, 1}, rows);
                     }});
  };
  write("pose with a NaN", "pose", PLUMB_FIELD_POSE, {0, nan, 0, 0, 0, 0, 1});
  write("pose that turns nowhere", "orientation", PLUMB_FIELD_POSE, {0, 5, 0, 0, 0, 0, 0});
  write("velocity without end", "velocity", PLUMB_FIELD_VELOCITY, {infinity, 0, 0, 0, 0, 0});
  write("force NaN", "force", PLUMB_FIELD_FORCE, {nan, 0, 0});
  write("field that is none", "field", 99, {0, 0, 0, 0, 0, 0, 0});
  write("row that is too short", "stride", PLUMB_FIELD_VELOCITY, {0, 0, 0});
  write("body that never was", "ids", PLUMB_FIELD_VELOCITY, {0, 0, 0, 0, 0, 0}, PlumbBody{0x7700000123});
  calls.push_back({"gravity NaN", "gravity", [](Victim& victim) { return victim.world.set_gravity({0, nan, 0}); }});
  for (const double bad : {0.0, -1.0, nan, infinity})
    calls.push_back({fmt::format("step of {}", bad), "dt", [bad](Victim& victim) { return victim.world.step(bad); }});
  calls.push_back({"destroying a body that never was", "bodies[0]", [](Victim& victim) {
                     const PlumbBody id = 0x7700000123;
                     return victim.world.destroy_bodies({&id, 1});
                   }});
  calls.push_back({"destroying a shape in use", "shape", [](Victim& victim) {
                     return victim.world.destroy_shapes({&victim.box, 1});
                   }});
}

}  // namespace

void measure_bad_input(MeasureContext& context) {
  const Scene& scene = context.scene();
  std::vector<BadCall> calls;
  add_shapes(calls);
  add_bodies(calls);
  add_joints(calls);
  add_calls(calls);

  Simulation simulation = context.simulate(scene), twin = context.simulate(scene);
  // One more body each, which the bad calls are aimed at; its shape is the one that they use.
  const auto add_victim = [](Simulation& world) {
    PlumbShapeDesc box = shape_desc(PLUMB_BOX);
    box.half_extents = {0.5, 0.5, 0.5};
    Victim victim{world.world(), 0};
    check(victim.world, victim.world.create_shapes({&box, 1}, {&victim.box, 1}));
    PlumbBodyDesc body = body_desc();
    body.shape = victim.box;
    body.pose.position = {50, 20, 0};
    check(victim.world, victim.world.create_bodies({&body, 1}, {&victim.body, 1}));
    return victim;
  };
  Victim victim = add_victim(simulation);
  static_cast<void>(add_victim(twin));

  std::size_t next = 0;
  double accepted = 0, unnamed = 0;
  std::string first_accepted, first_unnamed;
  bool unharmed = true;
  const std::size_t steps = static_cast<std::size_t>(std::ceil(scene.seconds / scene.dt - 1e-6));
  const std::size_t batch = (calls.size() + steps - 1) / steps;
  while (true) {
    for (std::size_t i = 0; i < batch && next < calls.size(); ++i, ++next) {
      const BadCall& bad = calls[next];
      if (bad.call(victim) >= 0) {
        ++accepted;
        if (first_accepted.empty()) first_accepted = "taken: " + bad.what;
      } else if (const std::string text = victim.world.error_text(); text.find(bad.named) == std::string::npos) {
        ++unnamed;
        if (first_unnamed.empty()) first_unnamed = bad.what + ": " + text;
      }
    }
    if (!simulation.advance() || !twin.advance()) break;
    unharmed = unharmed && simulation.state_hash() == twin.state_hash();
  }
  context.add({"calls", static_cast<double>(next), std::nullopt, 0, std::nullopt, ""});
  context.deviation("accepted", accepted, first_accepted);
  context.deviation("unnamed", unnamed, first_unnamed);
  context.expect("unharmed", unharmed, true);
}

}  // namespace plumb::harness
