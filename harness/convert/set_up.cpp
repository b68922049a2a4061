#include "convert/set_up.hpp"

#include <algorithm>
#include <cmath>

#include "measure/instruments/mechanics.hpp"

namespace plumb::harness {
namespace {

bool moves(const SceneBody& body) { return body.desc.motion == PLUMB_DYNAMIC; }

void fix_base(Imported& imported) {
  Scene& scene = imported.scene;
  std::vector<bool> holds(scene.bodies.size()), is_held(scene.bodies.size());
  for (const SceneJoint& joint : scene.joints) {
    if (joint.body_a) holds[*joint.body_a] = true;
    is_held[joint.body_b] = true;
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!holds[i] || is_held[i] || !moves(scene.bodies[i])) continue;
    SceneBody& base = scene.bodies[i];
    PlumbBodyDesc fixed = body_desc(PLUMB_STATIC);
    fixed.pose = base.desc.pose;
    fixed.material = base.desc.material;
    fixed.filter = base.desc.filter;
    base.desc = fixed;
  }
}

struct Extent {
  double mass = 0;       ///< kg, of what moves
  referee::Aabb bounds;  ///< of it
};

Extent extent_of(const Scene& scene) {
  Extent all;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!moves(scene.bodies[i])) continue;
    const referee::Pose pose = referee::pose(scene.bodies[i].desc.pose);
    const referee::Mass mass = mass_of_body(scene, i);
    all.mass += mass.mass;
    all.bounds.include(pose * mass.centre);
    if (scene.bodies[i].shape) all.bounds.include(shape_of(scene, *scene.bodies[i].shape)->bounds(pose));
  }
  return all;
}

/// Axes that a joint leaves free, 0 to 5.
std::vector<std::size_t> free_axes(const PlumbJointDesc& desc) {
  switch (desc.type) {
    case PLUMB_JOINT_HINGE: return {3};
    case PLUMB_JOINT_SLIDER: return {0};
    case PLUMB_JOINT_UNIVERSAL: return {3, 4};
    case PLUMB_JOINT_BALL: return {3, 4, 5};
    case PLUMB_JOINT_GENERIC: {
      std::vector<std::size_t> axes;
      for (std::size_t axis = 0; axis < 6; ++axis)
        if (desc.axis_modes[axis] != PLUMB_AXIS_LOCKED) axes.push_back(axis);
      return axes;
    }
    default: return {};
  }
}

/// Where the file says no effort, ten times what it takes to hold everything at the end of everything.
void hold(Imported& imported) {
  const Extent extent = extent_of(imported.scene);
  const double weight = 10 * extent.mass * std::max(1.0, referee::vec(imported.scene.gravity).norm());
  const double lever = std::max(0.01, (extent.bounds.high - extent.bounds.low).norm());
  for (std::size_t i = 0; i < imported.scene.joints.size(); ++i) {
    PlumbJointDesc& desc = imported.scene.joints[i].desc;
    for (const std::size_t axis : free_axes(desc)) {
      const double strong = axis < 3 ? weight : weight * lever;
      const double effort = std::min(strong, imported.efforts[i][axis]);
      desc.motors[axis] = {0, std::max(effort, desc.motors[axis].max_force), 1, 0};
    }
  }
}

void add_ground(Imported& imported) {
  const Extent extent = extent_of(imported.scene);
  if (extent.mass == 0) throw UsageError("--ground: nothing in the file moves, so there is nothing to put on it");
  Scene& scene = imported.scene;
  SceneShape plane;
  plane.name = "ground";
  plane.desc = shape_desc(PLUMB_PLANE);
  const auto is_taken = [&](const std::string& name) {
    const auto is_it = [&](const auto& thing) { return thing.name == name; };
    return std::any_of(scene.shapes.begin(), scene.shapes.end(), is_it) ||
           std::any_of(scene.bodies.begin(), scene.bodies.end(), is_it);
  };
  while (is_taken(plane.name)) plane.name += "_";
  SceneBody body;
  body.name = plane.name;
  body.desc = body_desc(PLUMB_STATIC);
  body.desc.pose.position.y = extent.bounds.low.y();
  body.desc.material.friction = 1;
  body.shape = scene.shapes.size();
  scene.shapes.push_back(std::move(plane));
  scene.bodies.push_back(std::move(body));
}

bool has_speed(const PlumbMaterial& material) { return !referee::vec(material.surface_velocity).isZero(); }

PlumbNeeds needs_of(const Scene& scene) {
  PlumbNeeds needs = PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC;
  if (!scene.joints.empty()) needs |= PLUMB_NEED_JOINTS;
  const PlumbFilter open = body_desc(PLUMB_DYNAMIC).filter;
  for (const SceneBody& body : scene.bodies) {
    if (body.desc.motion == PLUMB_KINEMATIC) needs |= PLUMB_NEED_KINEMATIC;
    if (!body.shape) continue;
    needs |= PLUMB_NEED_COLLISION;
    if (body.desc.material.friction > 0) needs |= PLUMB_NEED_FRICTION;
    if (body.desc.material.restitution > 0) needs |= PLUMB_NEED_RESTITUTION;
    if (has_speed(body.desc.material)) needs |= PLUMB_NEED_SURFACE_VELOCITY;
    const PlumbFilter& filter = body.desc.filter;
    if (filter.category != open.category || filter.mask != open.mask || filter.group != open.group)
      needs |= PLUMB_NEED_FILTERS;
  }
  for (const SceneShape& shape : scene.shapes)
    for (const SceneShape::Child& child : shape.children) {
      if (child.material && child.material->restitution > 0) needs |= PLUMB_NEED_RESTITUTION;
      if (child.material && has_speed(*child.material)) needs |= PLUMB_NEED_SURFACE_VELOCITY;
    }
  return needs;
}

/// What can give or hide energy that bodies do not have at the start.
struct Sources {
  bool are_any = false;     ///< energy may come from nowhere that is looked at
  bool are_stores = false;  ///< springs without tension at the start: they give no more than they were given
};

Sources sources_of(const Scene& scene) {
  Sources sources;
  sources.are_any = !scene.host.empty();
  for (const SceneBody& body : scene.bodies)
    sources.are_any = sources.are_any || body.desc.motion == PLUMB_KINEMATIC || has_speed(body.desc.material);
  for (const SceneShape& shape : scene.shapes)
    for (const SceneShape::Child& child : shape.children)
      sources.are_any = sources.are_any || (child.material && has_speed(*child.material));
  for (const SceneJoint& joint : scene.joints)
    for (std::size_t axis = 0; axis < 6; ++axis) {
      const PlumbMotor& motor = joint.desc.motors[axis];
      const PlumbSpring& spring = joint.desc.springs[axis];
      if (motor.enabled != 0 && motor.target_velocity != 0 && motor.max_force > 0) sources.are_any = true;
      if (spring.enabled == 0 || spring.frequency == 0) continue;
      sources.are_stores = true;
      if (spring.rest != 0) sources.are_any = true;
    }
  return sources;
}

/// Whether a joint has a limit on one of three axes from that one on.
bool has_limits(const Scene& scene, std::size_t first) {
  const auto limited = [&](const SceneJoint& joint) {
    const auto* limits = joint.desc.limits + first;
    return std::any_of(limits, limits + 3, [](const PlumbLimit& limit) { return limit.enabled != 0; });
  };
  return std::any_of(scene.joints.begin(), scene.joints.end(), limited);
}

Json metric(const char* unit, const char* doc, double threshold, double gold) {
  return {{"unit", unit}, {"doc", doc}, {"threshold", threshold}, {"gold", gold}};
}

}  // namespace

void set_up(Imported& imported, const SetUp& wanted) {
  if (imported.scene.bodies.empty()) throw UsageError("the file describes no bodies");
  if (wanted.fix_base) fix_base(imported);
  if (wanted.hold) hold(imported);
  if (wanted.ground) add_ground(imported);
  imported.scene.needs = needs_of(imported.scene);
}

void add_metrics(Json& scene_json, const Scene& scene) {
  Json quantities = Json::object(), metrics = Json::object();
  if (!scene.joints.empty()) {
    quantities["gap"] = {{"quantity", "gap"}, {"take", "max"}, {"truth", 0}};
    metrics["gap"] = metric("m", "widest gap of any joint at any time", 0.005, 0.0005);
  }
  if ((scene.needs & PLUMB_NEED_COLLISION) != 0) {
    quantities["overlap"] = {{"quantity", "overlap"}, {"truth", 0}};
    metrics["overlap"] = metric("m", "deepest overlap at the end", 0.005, 0.0005);
  }
  const Extent extent = extent_of(scene);
  const double height = std::max(0.1, (extent.bounds.high - extent.bounds.low).norm());
  const double scale = extent.mass * std::max(1.0, referee::vec(scene.gravity).norm()) * height;
  if (extent.mass > 0) {
    const Sources sources = sources_of(scene);
    if (!sources.are_any) {
      Json& made = quantities["energy_made"];
      made = {{"quantity", "energy"}, {"truth", 0}, {"scale", scale}};
      made["take"] = sources.are_stores ? "max" : "rise";
      if (sources.are_stores) made["since_start"] = true;
      metrics["energy_made"] =
          metric("J",
                 sources.are_stores ? "most that the bodies' energy is above that of the start, over weight times size"
                                    : "largest rise of the energy, relative to the weight of all times the size of all",
                 0.01, 0.0001);
    }
    quantities["speed"] = {{"quantity", "speed"}, {"truth", 0}};
    metrics["speed"] = {{"unit", "m/s"}, {"doc", "of the fastest body at the end"}};
  }
  scene_json["measure"] = {{"kind", "quantities"}, {"quantities", quantities}};
  scene_json["metrics"] = metrics;
}

void add_joint_metrics(Json& scene_json, const Scene& scene) {
  const auto add = [&](const char* name, const char* quantity, const Json& metric) {
    scene_json["measure"]["quantities"][name] = {{"quantity", quantity}, {"take", "max"}, {"truth", 0}};
    scene_json["metrics"][name] = metric;
  };
  if (!scene.joints.empty())
    add("bent", "misalignment", metric("rad", "largest turn of any joint that it does not allow", 0.05, 0.005));
  if (has_limits(scene, 0))
    add("slid_beyond", "limit_position", metric("m", "farthest that any joint slid beyond a limit", 0.005, 0.0005));
  if (has_limits(scene, 3))
    add("turned_beyond", "limit_angle", metric("rad", "farthest that any joint turned beyond a limit", 0.05, 0.005));
}

}  // namespace plumb::harness
