#include "replay/gltf.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "replay/bytes.hpp"
#include "replay/fineness.hpp"
#include "replay/mesh.hpp"

namespace plumb::harness {

namespace {

constexpr int type_float = 5126, type_u32 = 5125;         // accessor.componentType
constexpr int for_vertices = 34962, for_indices = 34963;  // bufferView.target
constexpr double share_of_anchor = 1.0 / 6;  // of a small body's radius: of the balls that stand for anchors
constexpr double anchor_alone = 0.02;        // m: where no body has a shape
constexpr std::size_t colour_of_anchors = 6;
constexpr std::uint32_t chunk_json = 0x4e4f534a, chunk_binary = 0x004e4942;

// Colours that people with any colour vision tell apart (Okabe and Ito 2008), the first for what does not move.
constexpr std::array<std::array<double, 3>, 7> colours{{{0.6, 0.6, 0.6},
                                                        {0.0, 0.447, 0.698},
                                                        {0.902, 0.624, 0.0},
                                                        {0.0, 0.62, 0.451},
                                                        {0.8, 0.475, 0.655},
                                                        {0.337, 0.706, 0.914},
                                                        {0.835, 0.369, 0.0}}};

bool is_finite(const PoseRow& row) {
  const auto& [p, q] = row;
  return std::isfinite(p.x + p.y + p.z + q.x + q.y + q.z + q.w);
}

class GltfMaker {
 public:
  explicit GltfMaker(const Trajectory& trajectory) : from_(trajectory) {}

  std::string make() {
    gltf_ = {{"asset", {{"version", "2.0"}, {"generator", "plumb"}}},
             {"scene", 0},
             {"scenes", Json::array()},
             {"nodes", Json::array()}};
    add_materials();
    const Json& bodies = from_.header.at("bodies");
    std::vector<bool> moves(bodies.size(), false);
    for (const std::size_t body : from_.moving) moves.at(body) = true;
    Json roots = Json::array();
    for (std::size_t i = 0; i < bodies.size(); ++i) roots.push_back(add_body(bodies[i], colour_of(i, moves[i])));
    Json scene{{"name", from_.header.value("scene", "")}};
    add_joints(roots);
    if (!roots.empty()) scene["nodes"] = roots;  // glTF has no empty lists
    gltf_["scenes"].push_back(scene);
    add_animation();
    return packed();
  }

 private:
  static std::size_t colour_of(std::size_t body, bool moves) { return moves ? 1 + body % (colours.size() - 1) : 0; }

  void add_materials() {
    for (const auto& [r, g, b] : colours) {
      gltf_["materials"].push_back(
          {{"pbrMetallicRoughness",
            {{"baseColorFactor", {r, g, b, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.8}}}});
    }
  }

  // Returns the accessor's number.
  std::size_t add_accessor(const std::string& bytes, int component, const char* type, std::size_t count, int target) {
    Json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    gltf_["bufferViews"].push_back(view);
    binary_ += bytes;
    gltf_["accessors"].push_back({{"bufferView", gltf_["bufferViews"].size() - 1},
                                  {"componentType", component},
                                  {"count", count},
                                  {"type", type}});
    return gltf_["accessors"].size() - 1;
  }

  std::size_t add_points(const std::vector<std::array<float, 3>>& points, bool with_bounds) {
    std::string bytes;
    std::array<float, 3> low{}, high{};
    low.fill(INFINITY);
    high.fill(-INFINITY);
    for (const auto& point : points) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        put(bytes, point[axis]);
        low[axis] = std::min(low[axis], point[axis]);
        high[axis] = std::max(high[axis], point[axis]);
      }
    }
    const std::size_t accessor = add_accessor(bytes, type_float, "VEC3", points.size(), for_vertices);
    if (with_bounds) {
      gltf_["accessors"][accessor]["min"] = low;
      gltf_["accessors"][accessor]["max"] = high;
    }
    return accessor;
  }

  // The number of the mesh of a shape (-1: of a body without one) in a colour.
  std::size_t mesh_of(std::int64_t shape, std::size_t colour) {
    const auto [found, is_new] = meshes_.try_emplace({shape, colour}, 0);
    if (!is_new) return found->second;
    const auto [geometry, is_new_shape] = geometry_.try_emplace(shape, Json());
    if (is_new_shape)
      geometry->second =
          add_geometry(drawn_mesh(shape < 0 ? Json() : from_.header.at("shapes").at(static_cast<std::size_t>(shape))));
    return found->second = add_mesh(geometry->second, colour);
  }

  /// Returns a primitive without material.
  Json add_geometry(const DrawnMesh& mesh) {
    std::string indices;
    for (const std::uint32_t index : mesh.indices) put(indices, index);
    const std::size_t positions = add_points(mesh.positions, true), normals = add_points(mesh.normals, false);
    return {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
            {"indices", add_accessor(indices, type_u32, "SCALAR", mesh.indices.size(), for_indices)}};
  }

  std::size_t add_mesh(Json primitive, std::size_t colour) {
    primitive["material"] = colour;
    gltf_["meshes"].push_back({{"primitives", {std::move(primitive)}}});
    return gltf_["meshes"].size() - 1;
  }

  std::size_t add_body(const Json& body, std::size_t colour) {
    Json node{{"name", body.value("name", "")}};
    const auto number = [&](std::size_t i) {
      return body.at("start").at(i).is_number() ? body["start"][i].get<double>() : (i == 6 ? 1.0 : 0.0);
    };
    node["translation"] = {number(0), number(1), number(2)};
    node["rotation"] = {number(3), number(4), number(5), number(6)};
    const std::int64_t shape = body.at("shape").is_null() ? -1 : body["shape"].get<std::int64_t>();
    const Json none;
    const Json& description = shape < 0 ? none : from_.header.at("shapes").at(static_cast<std::size_t>(shape));
    if (description.is_object() && description.at("type") == "compound") {
      for (const Json& child : description.at("children")) {
        gltf_["nodes"].push_back({{"mesh", mesh_of(child.at("shape"), colour)},
                                  {"translation", child.at("position")},
                                  {"rotation", child.at("orientation")}});
        node["children"].push_back(gltf_["nodes"].size() - 1);
      }
    } else {
      node["mesh"] = mesh_of(shape, colour);
    }
    gltf_["nodes"].push_back(node);
    body_nodes_.push_back(gltf_["nodes"].size() - 1);
    return body_nodes_.back();
  }

  void add_joints(Json& roots) {
    const Json joints = from_.header.value("joints", Json::array());
    if (joints.empty()) return;
    const std::vector<double> gaps = largest_gaps(joints.size());
    const double radius = radius_of_small_bodies(from_), size = radius > 0 ? radius * share_of_anchor : anchor_alone;
    const DrawnMesh ball = drawn_mesh({{"type", "sphere"}, {"radius", size}});
    const std::size_t mesh = add_mesh(add_geometry(ball), colour_of_anchors);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      for (const char side : {'a', 'b'}) {
        const Json& body = joints[i].at(std::string("body_") + side);
        const auto frame = joints[i].at(std::string("frame_") + side).get<std::array<double, 7>>();
        Json node{{"name", joints[i].value("name", "") + " " + side},
                  {"mesh", mesh},
                  {"translation", {frame[0], frame[1], frame[2]}},
                  {"rotation", {frame[3], frame[4], frame[5], frame[6]}},
                  {"extras", {{"type", joints[i].at("type")}}}};
        if (std::isfinite(gaps[i])) node["extras"]["largest_gap"] = gaps[i];
        gltf_["nodes"].push_back(std::move(node));
        const std::size_t number = gltf_["nodes"].size() - 1;
        if (body.is_null())
          roots.push_back(number);
        else
          gltf_["nodes"][body_nodes_.at(body.get<std::size_t>())]["children"].push_back(number);
      }
    }
  }

  /// By joint; NaN for one that holds no distance.
  [[nodiscard]] std::vector<double> largest_gaps(std::size_t joints) const {
    std::vector<double> gaps(joints, NAN);
    for (std::size_t layer = 0; layer < from_.layers.size(); ++layer) {
      if (from_.layers[layer].name != "joints") continue;
      for (const TrajectoryFrame& frame : from_.frames) {
        const auto& rows = frame.layers[layer];
        for (std::size_t row = 0; rows && row < rows->rows; ++row) {
          double& gap = gaps.at(rows->get<std::uint32_t>(0, row));
          gap = std::fmax(gap, static_cast<double>(rows->get<float>(1, row)));
        }
      }
    }
    return gaps;
  }

  void add_animation() {
    if (from_.moving.empty() || from_.frames.empty()) return;
    std::string times;
    const double dt = from_.header.value("dt", 1.0);
    for (const TrajectoryFrame& frame : from_.frames) put(times, static_cast<float>(frame.step * dt));
    const std::size_t count = from_.frames.size();
    const std::size_t input = add_accessor(times, type_float, "SCALAR", count, 0);
    gltf_["accessors"][input]["min"] = {static_cast<float>(from_.frames.front().step * dt)};
    gltf_["accessors"][input]["max"] = {static_cast<float>(from_.frames.back().step * dt)};
    Json samplers = Json::array(), channels = Json::array();
    for (std::size_t i = 0; i < from_.moving.size(); ++i) {
      const auto [translations, rotations] = motion_of(i);
      for (const bool turns : {false, true}) {
        const std::size_t output = turns ? add_accessor(rotations, type_float, "VEC4", count, 0)
                                         : add_accessor(translations, type_float, "VEC3", count, 0);
        samplers.push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
        channels.push_back(
            {{"sampler", samplers.size() - 1},
             {"target", {{"node", body_nodes_.at(from_.moving[i])}, {"path", turns ? "rotation" : "translation"}}}});
      }
    }
    gltf_["animations"].push_back(
        {{"name", from_.header.value("scene", "")}, {"samplers", samplers}, {"channels", channels}});
  }

  // A quaternion and its negative are one orientation: of the two, the one nearer to the last, for those who
  // interpolate without a look.
  [[nodiscard]] std::pair<std::string, std::string> motion_of(std::size_t moving) const {
    std::string translations, rotations;
    PoseRow last{{0, 0, 0}, {0, 0, 0, 1}};
    for (const TrajectoryFrame& frame : from_.frames) {
      PoseRow row = frame.poses[moving];
      if (!is_finite(row)) row = last;
      auto& [p, q] = row;
      const PlumbQuat& before = last.orientation;
      const double sign = q.x * before.x + q.y * before.y + q.z * before.z + q.w * before.w < 0 ? -1 : 1;
      q = {sign * q.x, sign * q.y, sign * q.z, sign * q.w};
      for (const double x : {p.x, p.y, p.z}) put(translations, static_cast<float>(x));
      for (const double x : {q.x, q.y, q.z, q.w}) put(rotations, static_cast<float>(x));
      last = row;
    }
    return {translations, rotations};
  }

  std::string packed() {
    if (!binary_.empty()) gltf_["buffers"].push_back({{"byteLength", binary_.size()}});
    std::string text = line_of(gltf_);
    while (text.size() % 4 != 0) text += ' ';
    const std::size_t binary_size = (binary_.size() + 3) / 4 * 4;
    std::string bytes = "glTF";
    put(bytes, std::uint32_t{2});
    put(bytes, static_cast<std::uint32_t>(12 + 8 + text.size() + (binary_.empty() ? 0 : 8 + binary_size)));
    put(bytes, static_cast<std::uint32_t>(text.size()));
    put(bytes, chunk_json);
    bytes += text;
    if (binary_.empty()) return bytes;
    put(bytes, static_cast<std::uint32_t>(binary_size));
    put(bytes, chunk_binary);
    bytes += binary_;
    bytes.append(binary_size - binary_.size(), '\0');
    return bytes;
  }

  const Trajectory& from_;
  Json gltf_;
  std::string binary_;
  std::map<std::pair<std::int64_t, std::size_t>, std::size_t> meshes_;  ///< by shape and colour
  std::map<std::int64_t, Json> geometry_;                               ///< primitives without material, by shape
  std::vector<std::size_t> body_nodes_;
};

}  // namespace

std::string binary_gltf(const Trajectory& trajectory) { return GltfMaker(trajectory).make(); }

}  // namespace plumb::harness
