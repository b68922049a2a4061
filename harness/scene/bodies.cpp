// Bodies of a scene file.
#include <fmt/format.h>

#include "scene/build.hpp"
#include "scene/generators.hpp"

namespace plumb::harness {
namespace {

void read_mass(const Node& node, PlumbBodyDesc& desc) {
  const auto density = node.find("density");
  const auto mass = node.find("mass");
  const auto inertia = node.find("inertia");
  if (density && mass) density->fail("a body has either density or mass");
  if (inertia && !mass) inertia->fail("with inertia, mass must be given too");
  for (const char* key : {"centre_of_mass", "inertia_orientation"})
    if (const auto value = node.find(key); value && !inertia) value->fail(fmt::format("{} needs inertia", key));
  if (density) desc.density = density->number();
  if (!mass) return;
  desc.mass_mode = inertia ? PLUMB_MASS_EXPLICIT : PLUMB_MASS_FROM_TOTAL;
  desc.mass = mass->number();
  if (!inertia) return;
  desc.inertia = inertia->vector();
  desc.centre_of_mass = node.vector_or("centre_of_mass", {});
  desc.inertia_orientation = node.orientation_or("inertia_orientation", {0, 0, 0, 1});
}

PlumbFilter read_filter(const Node& node, PlumbFilter filter) {
  node.only(scene_keys().at("filter"));
  constexpr std::int64_t all = 0xffffffff;
  if (const auto category = node.find("category"))
    filter.category = static_cast<std::uint32_t>(category->integer(0, all));
  if (const auto mask = node.find("mask")) filter.mask = static_cast<std::uint32_t>(mask->integer(0, all));
  if (const auto group = node.find("group"))
    filter.group = static_cast<std::int32_t>(group->integer(-2147483648LL, 2147483647LL));
  return filter;
}

SceneBody read_body(const Node& node, const SceneBuilder& builder) {
  static const std::vector<std::string> motions{"static", "kinematic", "dynamic"};
  static const std::vector<std::string> flags{"sensor", "ccd", "no_rotation", "asleep", "never_sleeps"};
  static const std::vector<std::string> locks{"linear_x",  "linear_y",  "linear_z",
                                              "angular_x", "angular_y", "angular_z"};
  SceneBody body;
  body.name = node.at("name").name();
  if (body.name == "world") node.at("name").fail("\"world\" is what joints call the world; choose another name");
  PlumbMotion motion = PLUMB_DYNAMIC;
  if (const auto given = node.find("motion")) motion = static_cast<PlumbMotion>(given->word("motion", motions));
  body.desc = body_desc(motion);
  if (const auto shape = node.find("shape")) body.shape = find_name(*shape, "shape", builder.shape_index);
  PlumbBodyDesc& desc = body.desc;
  desc.pose = {node.vector_or("position", {}), node.orientation_or("orientation", {0, 0, 0, 1})};
  desc.linear_velocity = node.vector_or("linear_velocity", {});
  desc.angular_velocity = node.vector_or("angular_velocity", {});
  if (const auto set = node.find("flags")) desc.flags = static_cast<std::uint32_t>(set->bits("flag", flags));
  // What the scene does not need, its bodies do not have.
  const PlumbNeeds needs = builder.scene.needs;
  if (desc.motion == PLUMB_DYNAMIC && (needs & PLUMB_NEED_ROTATION) == 0) desc.flags |= PLUMB_BODY_NO_ROTATION;
  if ((needs & PLUMB_NEED_FRICTION) == 0) desc.material.friction = 0;
  if (const auto set = node.find("locks")) desc.locks = static_cast<std::uint32_t>(set->bits("lock", locks));
  read_mass(node, desc);
  desc.material.friction = node.number_or("friction", desc.material.friction);
  desc.material.restitution = node.number_or("restitution", desc.material.restitution);
  desc.material.surface_velocity = node.vector_or("surface_velocity", {});
  desc.gravity_scale = node.number_or("gravity_scale", desc.gravity_scale);
  desc.linear_damping = node.number_or("linear_damping", 0);
  desc.angular_damping = node.number_or("angular_damping", 0);
  desc.rolling_friction = node.number_or("rolling_friction", 0);
  desc.spinning_friction = node.number_or("spinning_friction", 0);
  if (const auto filter = node.find("filter")) desc.filter = read_filter(*filter, desc.filter);
  if (const auto data = node.find("user_data"))
    desc.user_data = static_cast<std::uint64_t>(data->integer(0, std::int64_t{1} << 53));
  return body;
}

void read_generator(const Node& node, SceneBuilder& builder) {
  node.only(scene_keys().at("generator"));
  const std::size_t generator = node.at("generate").word("generator", generator_words());
  const auto count = node.at("count").integer(1, largest_count(generator));
  Scene& scene = builder.scene;
  const std::size_t first_shape = scene.shapes.size();
  const std::size_t first_body = scene.bodies.size();
  std::uint32_t seed = 0;
  if (const auto given = node.find("seed")) seed = static_cast<std::uint32_t>(given->integer(0, largest_seed));
  const double friction = node.number_or("friction", 0.5);
  PlumbMaterial material{};
  material.friction = friction;
  check_values(node, material);
  generate(generator, count, seed, friction, scene.shapes, scene.bodies);
  for (std::size_t i = first_shape; i < scene.shapes.size(); ++i)
    add_name(node, "shape", scene.shapes[i].name, builder.shape_index, i);
  for (std::size_t i = first_body; i < scene.bodies.size(); ++i)
    add_name(node, "body", scene.bodies[i].name, builder.body_index, i);
}

void read_bodies_of(const Node& node, SceneBuilder& builder) {
  node.only(scene_keys().at("body"));
  for_each_repeat(node, [&] {
    SceneBody body = read_body(node, builder);
    check_values(node, body);
    add_name(node.at("name"), "body", body.name, builder.body_index, builder.scene.bodies.size());
    builder.scene.bodies.push_back(std::move(body));
  });
}

}  // namespace

void read_bodies(const Node& bodies, SceneBuilder& builder) {
  for (const Node& node : bodies.elements()) {
    if (node.find("generate"))
      read_generator(node, builder);
    else
      read_bodies_of(node, builder);
  }
}

}  // namespace plumb::harness
