#include "replay/live_world.hpp"

#include <array>
#include <cctype>
#include <cmath>

#include "measure/instruments/referee_view.hpp"
#include "record/trajectory_header.hpp"
#include "scene/build.hpp"
#include "simulation/names.hpp"
#include "simulation/scene_nature.hpp"

namespace plumb::harness {

namespace {

// As api/web has them (engine/words.mjs).
const std::array<const char*, 9> form_words{"sphere", "box",         "capsule", "cylinder", "hull",
                                            "mesh",   "heightField", "plane",   "compound"};
static_assert(form_words.size() == PLUMB_SHAPE_TYPE_COUNT);
const std::array<const char*, 6> flag_words{"sensor", "ccd", "noRotation", "asleep", "neverSleeps", "modifyContacts"};
const std::array<const char*, 6> axis_words{"x", "y", "z", "angularX", "angularY", "angularZ"};
const std::array<const char*, 6> lock_words{"linearX", "linearY", "linearZ", "angularX", "angularY", "angularZ"};
const std::array<const char*, 3> mode_words{"free", "locked", "limited"};
const std::array<const char*, 5> action_words{"path", "force", "impulse", "motors", "targets"};

Json triple(const PlumbVec3& v) { return {v.x, v.y, v.z}; }
Json quadruple(const PlumbQuat& q) { return {q.x, q.y, q.z, q.w}; }
Json frame(const PlumbPose& pose) {
  return {{"position", triple(pose.position)}, {"orientation", quadruple(pose.orientation)}};
}

/// "contact_impulses" as api/web has it: "contactImpulses".
std::string camel(const std::string& word) {
  std::string out;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const bool joins = word[i] == '_' && i + 1 < word.size();
    out += joins ? static_cast<char>(std::toupper(word[++i])) : word[i];
  }
  return out;
}

template <class Words>
Json words_of(std::uint64_t bits, const Words& words) {
  Json list = Json::array();
  for (std::size_t i = 0; i < words.size(); ++i)
    if ((bits >> i & 1) != 0) list.push_back(camel(words[i]));
  return list;
}

Json material(const PlumbMaterial& material) {
  return {{"friction", material.friction},
          {"restitution", material.restitution},
          {"surfaceVelocity", triple(material.surface_velocity)}};
}

Json shape_of(const SceneShape& shape) {
  const PlumbShapeDesc& desc = shape.desc;
  Json json{{"type", form_words.at(desc.type)}};
  switch (desc.type) {
    case PLUMB_SPHERE: json["radius"] = desc.radius; break;
    case PLUMB_BOX: json["halfExtents"] = triple(desc.half_extents); break;
    case PLUMB_CAPSULE:
    case PLUMB_CYLINDER:
      json["radius"] = desc.radius;
      json["halfHeight"] = desc.half_height;
      break;
    case PLUMB_CONVEX_HULL: json["vertices"] = shape.vertices; break;
    case PLUMB_HEIGHT_FIELD:
      json["rows"] = desc.rows;
      json["columns"] = desc.columns;
      json["spacing"] = {desc.spacing.x, desc.spacing.z};
      break;
    case PLUMB_COMPOUND:
      json["children"] = Json::array();
      for (const SceneShape::Child& child : shape.children) {
        Json entry = frame(child.pose);
        entry["shape"] = child.shape;
        if (child.material) entry["material"] = material(*child.material);
        json["children"].push_back(std::move(entry));
      }
      break;
    default: break;
  }
  if (!shape.materials.empty()) {
    json["materials"] = Json::array();
    for (const PlumbMaterial& part : shape.materials) json["materials"].push_back(material(part));
    json["triangleMaterials"] = shape.triangle_materials;
  }
  return json;
}

Json body_of(const SceneBody& body) {
  const PlumbBodyDesc& desc = body.desc;
  Json json = frame(desc.pose);
  json.update(material(desc.material));
  if (body.shape) json["shape"] = *body.shape;
  json["motion"] = word_of(motion_words(), desc.motion);
  json["flags"] = words_of(desc.flags, flag_words);
  json["locks"] = words_of(desc.locks, lock_words);
  json["linearVelocity"] = triple(desc.linear_velocity);
  json["angularVelocity"] = triple(desc.angular_velocity);
  if (desc.mass_mode == PLUMB_MASS_FROM_DENSITY) json["density"] = desc.density;
  if (desc.mass_mode != PLUMB_MASS_FROM_DENSITY) json["mass"] = desc.mass;
  if (desc.mass_mode == PLUMB_MASS_EXPLICIT) {
    json["centreOfMass"] = triple(desc.centre_of_mass);
    json["inertia"] = triple(desc.inertia);
    json["inertiaOrientation"] = quadruple(desc.inertia_orientation);
  }
  json["gravityScale"] = desc.gravity_scale;
  json["linearDamping"] = desc.linear_damping;
  json["angularDamping"] = desc.angular_damping;
  json["rollingFriction"] = desc.rolling_friction;
  json["spinningFriction"] = desc.spinning_friction;
  json["filter"] = {{"category", desc.filter.category}, {"mask", desc.filter.mask}, {"group", desc.filter.group}};
  return json;
}

Json spring_of(const PlumbSpring& spring) {
  const bool stiff = spring.mode == PLUMB_SPRING_STIFFNESS;
  return {{"rest", spring.rest},
          {stiff ? "stiffness" : "frequency", spring.frequency},
          {stiff ? "damping" : "dampingRatio", spring.damping_ratio}};
}

Json joint_of(const SceneJoint& joint) {
  const PlumbJointDesc& desc = joint.desc;
  Json json{{"type", word_of(joint_words(), desc.type)},
            {"b", joint.body_b},
            {"frameA", frame(desc.frame_a)},
            {"frameB", frame(desc.frame_b)},
            {"collideConnected", desc.collide_connected != 0},
            {"restLength", desc.rest_length},
            {"breakForce", desc.break_force},
            {"breakTorque", desc.break_torque},
            {"ratio", desc.ratio}};
  if (joint.body_a) json["a"] = *joint.body_a;
  for (const char* of_axes : {"axes", "limits", "motors", "springs"}) json[of_axes] = Json::object();
  for (std::size_t i = 0; i < axis_words.size(); ++i) {
    const char* axis = axis_words[i];
    const auto& [lower, upper, limited, ignored] = desc.limits[i];
    const PlumbMotor& motor = desc.motors[i];
    const bool generic = desc.type == PLUMB_JOINT_GENERIC;
    if (generic) json["axes"][axis] = mode_words.at(desc.axis_modes[i]);
    if (limited != 0 || (generic && desc.axis_modes[i] == PLUMB_AXIS_LIMITED)) json["limits"][axis] = {lower, upper};
    if (motor.enabled != 0)
      json["motors"][axis] = {{"targetVelocity", motor.target_velocity}, {"maxForce", motor.max_force}};
    if (desc.springs[i].enabled != 0) json["springs"][axis] = spring_of(desc.springs[i]);
  }
  return json;
}

Json action_of(const SceneAction& action) {
  Json numbers = Json::array();
  for (const SceneAction::Number& number : action.numbers)
    numbers.push_back(number.text.empty() ? Json(number.constant) : Json(number.text));
  return {{"kind", action_words.at(action.kind)},
          {"target", action.target},
          {"axis", triple(action.axis)},
          {"begin", action.begin},
          {"end", action.end},
          {"numbers", numbers},
          {"names", action.names}};
}

Json mass_of(const referee::Mass& mass) {
  const auto& [kilograms, c, i] = mass;
  return {kilograms, c.x(), c.y(), c.z(), i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)};
}

PlumbNeeds needs_of(const PlumbMaterial& material) {
  PlumbNeeds needs = 0;
  if (material.friction > 0) needs |= PLUMB_NEED_FRICTION;
  if (material.restitution > 0) needs |= PLUMB_NEED_RESTITUTION;
  if (!referee::vec(material.surface_velocity).isZero()) needs |= PLUMB_NEED_SURFACE_VELOCITY;
  return needs;
}

PlumbNeeds needs_of(const PlumbBodyDesc& body) {
  PlumbNeeds needs = needs_of(body.material);
  const auto flag = [&](std::uint32_t bit) { return (body.flags & bit) != 0; };
  if (body.motion == PLUMB_DYNAMIC && !flag(PLUMB_BODY_NO_ROTATION)) needs |= PLUMB_NEED_ROTATION;
  if (body.motion == PLUMB_KINEMATIC) needs |= PLUMB_NEED_KINEMATIC;
  if (flag(PLUMB_BODY_CCD)) needs |= PLUMB_NEED_CCD;
  return needs;
}

/// The scene's, and where a measure declares more by itself, what its bodies and joints take.
PlumbNeeds needs_of(const Scene& scene) {
  PlumbNeeds needs = scene.joints.empty() ? 0 : PLUMB_NEED_JOINTS;
  for (const SceneBody& body : scene.bodies) needs |= needs_of(body.desc);
  for (const SceneShape& shape : scene.shapes) {
    for (const PlumbMaterial& part : shape.materials) needs |= needs_of(part);
    for (const SceneShape::Child& child : shape.children)
      if (child.material) needs |= needs_of(*child.material);
  }
  if ((needs & (PLUMB_NEED_FRICTION | PLUMB_NEED_RESTITUTION)) != 0) needs |= PLUMB_NEED_COLLISION;
  return scene.needs | needs;
}

}  // namespace

Json live_world(const Scene& scene) {
  std::vector<PoseRow> poses;
  for (const SceneBody& body : scene.bodies) poses.push_back({body.desc.pose.position, body.desc.pose.orientation});
  const SceneNature nature = nature_of(scene);
  const RefereeView view(scene);
  Json world{{"header", replay_header(scene, poses)},
             {"needs", words_of(needs_of(scene), need_words())},
             {"gravity", triple(scene.gravity)},
             {"settings", Json::object()}};
  world["header"]["driven"] = nature.driven || nature.stores;
  for (const char* list : {"shapes", "bodies", "joints", "masses", "host", "cuts"}) world[list] = Json::array();
  for (const SceneShape& shape : scene.shapes) world["shapes"].push_back(shape_of(shape));
  for (const SceneBody& body : scene.bodies) world["bodies"].push_back(body_of(body));
  for (const referee::Mass& mass : view.masses()) world["masses"].push_back(mass_of(mass));
  for (const SceneAction& action : scene.host) world["host"].push_back(action_of(action));
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    world["joints"].push_back(joint_of(scene.joints[i]));
    if (std::isfinite(scene.joints[i].cut)) world["cuts"].push_back({i, scene.joints[i].cut});
  }
  return world;
}

}  // namespace plumb::harness
