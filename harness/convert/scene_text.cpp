#include "convert/scene_text.hpp"

#include <fmt/format.h>

#include <array>
#include <regex>

#include "base/format.hpp"
#include "plumb/backend/names.hpp"
#include "scene/build.hpp"

namespace plumb::harness {
namespace {

Json json_of(const PlumbVec3& v) { return Json::array({v.x, v.y, v.z}); }
Json json_of(const PlumbQuat& q) { return Json::array({q.x, q.y, q.z, q.w}); }
bool is_zero(const PlumbVec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }
bool is_identity(const PlumbQuat& q) { return q.x == 0 && q.y == 0 && q.z == 0; }

void add_pose(Json& json, const PlumbPose& pose) {
  if (!is_zero(pose.position)) json["position"] = json_of(pose.position);
  if (!is_identity(pose.orientation)) json["orientation"] = json_of(pose.orientation);
}

Json words_of(std::uint64_t bits, const std::vector<std::string>& words) {
  Json list = Json::array();
  for (std::size_t i = 0; i < words.size(); ++i)
    if ((bits >> i & 1) != 0) list.push_back(words[i]);
  return list;
}

Json rows_of(const std::vector<double>& numbers, std::size_t columns) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < numbers.size(); i += columns)
    rows.push_back(std::vector<double>(numbers.begin() + static_cast<std::ptrdiff_t>(i),
                                       numbers.begin() + static_cast<std::ptrdiff_t>(i + columns)));
  return rows;
}

Json json_of(const SceneShape::Child& child, const Scene& scene) {
  Json json{{"shape", scene.shapes[child.shape].name}};
  add_pose(json, child.pose);
  if (!child.material) return json;
  json["friction"] = child.material->friction;
  if (child.material->restitution != 0) json["restitution"] = child.material->restitution;
  if (!is_zero(child.material->surface_velocity)) json["surface_velocity"] = json_of(child.material->surface_velocity);
  return json;
}

Json json_of(const SceneShape& shape, const Scene& scene) {
  const PlumbShapeDesc& desc = shape.desc;
  Json json{{"type", shape_words()[desc.type]}};
  switch (desc.type) {
    case PLUMB_BOX: json["half_extents"] = json_of(desc.half_extents); break;
    case PLUMB_SPHERE: json["radius"] = desc.radius; break;
    case PLUMB_CAPSULE:
    case PLUMB_CYLINDER:
      json["radius"] = desc.radius;
      json["half_height"] = desc.half_height;
      break;
    case PLUMB_TRIANGLE_MESH:
    case PLUMB_CONVEX_HULL:
      json["vertices"] = rows_of(shape.vertices, 3);
      for (std::size_t i = 0; i < shape.indices.size(); i += 3)
        json["indices"].push_back(Json::array({shape.indices[i], shape.indices[i + 1], shape.indices[i + 2]}));
      break;
    case PLUMB_HEIGHT_FIELD:
      json["heights"] = rows_of(shape.heights, desc.columns);
      json["spacing"] = json_of(desc.spacing);
      break;
    case PLUMB_COMPOUND:
      for (const SceneShape::Child& child : shape.children) json["children"].push_back(json_of(child, scene));
      break;
    default:  // a plane is a plane
      break;
  }
  for (const PlumbMaterial& material : shape.materials)
    json["materials"].push_back({{"friction", material.friction}, {"restitution", material.restitution}});
  for (const std::uint32_t row : shape.triangle_materials)
    json["triangle_materials"].push_back(static_cast<std::int32_t>(row));
  return json;
}

void add_mass(Json& json, const PlumbBodyDesc& desc) {
  if (desc.motion != PLUMB_DYNAMIC) return;
  if (desc.mass_mode == PLUMB_MASS_FROM_DENSITY) {
    if (desc.density != 1000) json["density"] = desc.density;
    return;
  }
  json["mass"] = desc.mass;
  if (desc.mass_mode != PLUMB_MASS_EXPLICIT) return;
  json["inertia"] = json_of(desc.inertia);
  if (!is_zero(desc.centre_of_mass)) json["centre_of_mass"] = json_of(desc.centre_of_mass);
  if (!is_identity(desc.inertia_orientation)) json["inertia_orientation"] = json_of(desc.inertia_orientation);
}

Json json_of(const SceneBody& body, const Scene& scene) {
  static const std::vector<std::string> motions{"static", "kinematic", "dynamic"};
  static const std::vector<std::string> flags{"sensor", "ccd", "no_rotation", "asleep", "never_sleeps"};
  static const std::vector<std::string> locks{"linear_x",  "linear_y",  "linear_z",
                                              "angular_x", "angular_y", "angular_z"};
  const PlumbBodyDesc& desc = body.desc;
  const PlumbBodyDesc usual = body_desc(desc.motion);
  Json json{{"name", body.name}};
  if (desc.motion != PLUMB_DYNAMIC) json["motion"] = motions[desc.motion];
  if (body.shape) json["shape"] = scene.shapes[*body.shape].name;
  add_pose(json, desc.pose);
  if (!is_zero(desc.linear_velocity)) json["linear_velocity"] = json_of(desc.linear_velocity);
  if (!is_zero(desc.angular_velocity)) json["angular_velocity"] = json_of(desc.angular_velocity);
  if (desc.flags != 0) json["flags"] = words_of(desc.flags, flags);
  if (desc.locks != 0) json["locks"] = words_of(desc.locks, locks);
  add_mass(json, desc);
  if (desc.material.friction != usual.material.friction) json["friction"] = desc.material.friction;
  if (desc.material.restitution != 0) json["restitution"] = desc.material.restitution;
  if (!is_zero(desc.material.surface_velocity)) json["surface_velocity"] = json_of(desc.material.surface_velocity);
  if (desc.gravity_scale != 1) json["gravity_scale"] = desc.gravity_scale;
  if (desc.linear_damping != 0) json["linear_damping"] = desc.linear_damping;
  if (desc.angular_damping != 0) json["angular_damping"] = desc.angular_damping;
  if (desc.rolling_friction != 0) json["rolling_friction"] = desc.rolling_friction;
  if (desc.spinning_friction != 0) json["spinning_friction"] = desc.spinning_friction;
  const PlumbFilter &filter = desc.filter, &open = usual.filter;
  if (filter.category != open.category) json["filter"]["category"] = filter.category;
  if (filter.mask != open.mask) json["filter"]["mask"] = filter.mask;
  if (filter.group != open.group) json["filter"]["group"] = filter.group;
  if (desc.user_data != 0) json["user_data"] = desc.user_data;
  return json;
}

Json frame_json(const PlumbPose& pose) {
  Json json = Json::object();
  add_pose(json, pose);
  return json;
}

constexpr std::array axis_words{"x", "y", "z", "rx", "ry", "rz"};

void add_axes(Json& json, const PlumbJointDesc& desc) {
  static constexpr auto& words = axis_words;
  static constexpr std::array modes{"free", "locked", "limited"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const PlumbLimit& limit = desc.limits[i];
    const PlumbMotor& motor = desc.motors[i];
    const PlumbSpring& spring = desc.springs[i];
    if (desc.type == PLUMB_JOINT_GENERIC && desc.axis_modes[i] != PLUMB_AXIS_LOCKED)
      json["axis_modes"][words[i]] = modes[desc.axis_modes[i]];
    if (limit.enabled != 0) json["limits"][words[i]] = {{"lower", limit.lower}, {"upper", limit.upper}};
    if (motor.enabled != 0)
      json["motors"][words[i]] = {{"target_velocity", motor.target_velocity}, {"max_force", motor.max_force}};
    if (spring.enabled != 0 && spring.mode == PLUMB_SPRING_FREQUENCY)
      json["springs"][words[i]] = {
          {"rest", spring.rest}, {"frequency", spring.frequency}, {"damping_ratio", spring.damping_ratio}};
    if (spring.enabled != 0 && spring.mode == PLUMB_SPRING_STIFFNESS)
      json["springs"][words[i]] = {
          {"rest", spring.rest}, {"stiffness", spring.frequency}, {"damping", spring.damping_ratio}};
  }
}

Json json_of(const SceneJoint& joint, const Scene& scene) {
  const PlumbJointDesc& desc = joint.desc;
  Json json{{"name", joint.name}, {"type", joint_words()[desc.type]}};
  if (joint.body_a) json["body_a"] = scene.bodies[*joint.body_a].name;
  json["body_b"] = scene.bodies[joint.body_b].name;
  json["frame_a"] = frame_json(desc.frame_a);
  json["frame_b"] = frame_json(desc.frame_b);
  if (desc.collide_connected != 0) json["collide_connected"] = true;
  add_axes(json, desc);
  if (desc.type == PLUMB_JOINT_DISTANCE) json["rest_length"] = desc.rest_length;
  if (backend::is_meshing(desc.type)) json["ratio"] = desc.ratio;
  if (desc.break_force != 0) json["break_force"] = desc.break_force;
  if (desc.break_torque != 0) json["break_torque"] = desc.break_torque;
  if (joint.cut != std::numeric_limits<double>::infinity()) json["cut"] = joint.cut;
  return json;
}

/// An expression in which the time alone is left of names; what is called is a function and no name.
std::string with_numbers_for_names(const SceneAction& action, const std::string& text) {
  static const std::regex word("[A-Za-z_][A-Za-z_0-9]*");
  std::string plain;
  auto from = text.begin();
  for (std::sregex_iterator at(text.begin(), text.end(), word), end; at != end; ++at) {
    plain.append(from, text.begin() + at->position());
    from = text.begin() + at->position() + at->length();
    const auto known = action.names.find(at->str());
    plain += known == action.names.end() ? at->str() : fmt::format("({})", shortest_number(known->second));
  }
  return plain.append(from, text.end());
}

Json json_of(const SceneAction& action, const Scene& scene) {
  const auto number = [&](std::size_t i) {
    const SceneAction::Number& one = action.numbers[i];
    return one.text.empty() ? Json(one.constant) : Json(with_numbers_for_names(action, one.text));
  };
  const auto vector = [&](std::size_t first) {
    return Json::array({number(first), number(first + 1), number(first + 2)});
  };
  Json json{{action.is_of_joint() ? "joint" : "body", action.name}};
  switch (action.kind) {
    case SceneAction::path:
      json["position"] = vector(0);
      if (!action.numbers[3].text.empty()) json["turn"] = {{"axis", json_of(action.axis)}, {"radians", number(3)}};
      break;
    case SceneAction::force:
      json["force"] = vector(0);
      json["torque"] = vector(3);
      break;
    case SceneAction::impulse:
      json["impulse"] = vector(0);
      json["angular_impulse"] = vector(3);
      json["at"] = action.begin;
      break;
    case SceneAction::motors:
      for (std::size_t axis = 0; axis < axis_words.size(); ++axis)
        if (scene.joints[action.target].desc.motors[axis].enabled != 0)
          json["motors"][axis_words[axis]] = {{"target_velocity", number(2 * axis)},
                                              {"max_force", number(2 * axis + 1)}};
      break;
    case SceneAction::targets: {
      const PlumbJointDesc& desc = scene.joints[action.target].desc;
      for (std::size_t axis = 0; axis < axis_words.size(); ++axis)
        if (desc.springs[axis].enabled != 0 || (axis == 0 && desc.type == PLUMB_JOINT_DISTANCE))
          json["targets"][axis_words[axis]] = number(axis);
      break;
    }
  }
  const bool lasts = action.kind == SceneAction::force || action.is_of_joint();
  if (lasts && (action.begin != 0 || action.end != scene.seconds)) json["over"] = {action.begin, action.end};
  return json;
}

void write(const Json& json, std::size_t indent, std::size_t used, std::string& text) {
  constexpr std::size_t width = 120;
  const std::string line = line_of(json);
  if (!json.is_structured() || json.empty() || indent + used + line.size() <= width) {
    text += line;
    return;
  }
  const std::string margin(indent + 2, ' ');
  text += json.is_array() ? "[" : "{";
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    text += first ? "\n" : ",\n";
    first = false;
    text += margin;
    std::string name;
    if (json.is_object()) name = line_of(key) + ": ";
    text += name;
    write(value, indent + 2, name.size() + 1, text);
  }
  text += "\n" + std::string(indent, ' ') + (json.is_array() ? "]" : "}");
}

}  // namespace

Json scene_json(const Scene& scene, const SceneTitle& title) {
  Json json{{"id", title.id}, {"slug", title.slug}, {"title", title.title}, {"doc", title.doc}};
  json["needs"] = words_of(scene.needs, need_words());
  json["gravity"] = json_of(scene.gravity);
  json["dt"] = scene.dt;
  json["seconds"] = scene.seconds;
  for (const SceneShape& shape : scene.shapes) json["shapes"][shape.name] = json_of(shape, scene);
  json["bodies"] = Json::array();
  for (const SceneBody& body : scene.bodies) json["bodies"].push_back(json_of(body, scene));
  for (const SceneJoint& joint : scene.joints) json["joints"].push_back(json_of(joint, scene));
  for (const SceneAction& action : scene.host) json["host"].push_back(json_of(action, scene));
  return json;
}

std::string scene_text(const Json& scene) {
  std::string text;
  write(scene, 0, 0, text);
  return text + "\n";
}

}  // namespace plumb::harness
