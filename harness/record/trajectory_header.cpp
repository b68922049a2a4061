#include "record/trajectory_header.hpp"

#include "plumb/backend/convex_hull.hpp"
#include "record/joint_layer.hpp"
#include "simulation/names.hpp"
#include "simulation/simulation.hpp"

namespace plumb::harness {

namespace {

Json triple(const PlumbVec3& v) { return {v.x, v.y, v.z}; }

template <class Number>
Json triples(const std::vector<Number>& numbers) {
  Json rows = Json::array();
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) rows.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return rows;
}

Json hull(const SceneShape& shape) {
  const backend::ConvexHull made = backend::convex_hull(shape.descriptor());
  Json json{{"type", "hull"}, {"vertices", Json::array()}, {"faces", Json::array()}};
  for (const PlumbVec3& vertex : made.vertices) json["vertices"].push_back(triple(vertex));
  for (const backend::HullFace& face : made.faces) json["faces"].push_back(face.loop);
  return json;
}

}  // namespace

Json replay_shape(const SceneShape& shape) {
  const PlumbShapeDesc& desc = shape.desc;
  switch (desc.type) {
    case PLUMB_SPHERE: return {{"type", "sphere"}, {"radius", desc.radius}};
    case PLUMB_BOX: return {{"type", "box"}, {"half_extents", triple(desc.half_extents)}};
    case PLUMB_CAPSULE: return {{"type", "capsule"}, {"radius", desc.radius}, {"half_height", desc.half_height}};
    case PLUMB_CYLINDER: return {{"type", "cylinder"}, {"radius", desc.radius}, {"half_height", desc.half_height}};
    case PLUMB_CONVEX_HULL: return hull(shape);
    case PLUMB_TRIANGLE_MESH:
      return {{"type", "mesh"}, {"vertices", triples(shape.vertices)}, {"triangles", triples(shape.indices)}};
    case PLUMB_PLANE: return {{"type", "plane"}, {"normal", {0, 1, 0}}, {"offset", 0}};
    case PLUMB_HEIGHT_FIELD:
      return {{"type", "height_field"},
              {"rows", desc.rows},
              {"columns", desc.columns},
              {"spacing", {desc.spacing.x, desc.spacing.z}},
              {"heights", shape.heights}};
    default: break;
  }
  Json json{{"type", "compound"}, {"children", Json::array()}};
  for (const SceneShape::Child& child : shape.children) {
    const auto& [p, q] = child.pose;
    json["children"].push_back(
        {{"shape", child.shape}, {"position", triple(p)}, {"orientation", {q.x, q.y, q.z, q.w}}});
  }
  return json;
}

Json replay_header(const Scene& scene, std::span<const PoseRow> poses) {
  Json header{{"kind", "scene"},          {"scene", scene.id},         {"dt", scene.dt},
              {"seconds", scene.seconds}, {"shapes", Json::array()},   {"bodies", Json::array()},
              {"moving", Json::array()},  {"joints", joints_of(scene)}};
  for (const SceneShape& shape : scene.shapes) header["shapes"].push_back(replay_shape(shape));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    const auto& [p, q] = poses[i];
    header["bodies"].push_back({{"name", body.name},
                                {"shape", body.shape ? Json(*body.shape) : Json(nullptr)},
                                {"motion", word_of(motion_words(), body.desc.motion)},
                                {"start", {p.x, p.y, p.z, q.x, q.y, q.z, q.w}}});
    if (body.desc.motion != PLUMB_STATIC) header["moving"].push_back(i);
  }
  return header;
}

}  // namespace plumb::harness
