// What the glTF says fits together: sizes, bounds, references, and times that rise.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "replay/gltf.hpp"
#include "replay/mesh.hpp"

namespace plumb::harness {
namespace {

Json one_of_each() {
  return {{{"type", "sphere"}, {"radius", 0.5}},
          {{"type", "box"}, {"half_extents", {1, 2, 3}}},
          {{"type", "capsule"}, {"radius", 0.5}, {"half_height", 1}},
          {{"type", "cylinder"}, {"radius", 0.5}, {"half_height", 1}},
          {{"type", "hull"},
           {"vertices", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
           {"faces", {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}},
          {{"type", "mesh"}, {"vertices", {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}}, {"triangles", {{0, 1, 2}}}},
          {{"type", "height_field"}, {"rows", 2}, {"columns", 3}, {"spacing", {1, 2}}, {"heights", {0, 0, 0, 0, 1, 0}}},
          {{"type", "plane"}, {"normal", {0, 1, 0}}, {"offset", 0}},
          {{"type", "compound"},
           {"children",
            {{{"shape", 0}, {"position", {1, 0, 0}}, {"orientation", {0, 0, 0, 1}}},
             {{"shape", 1}, {"position", {0, 1, 0}}, {"orientation", {0, 0, 0, 1}}}}}}};
}

/// A body of every shape and one without; all but the first and last move, and one is lost on the way.
Trajectory made() {
  Trajectory trajectory;
  trajectory.header = {{"scene", "T1"}, {"dt", 0.5}, {"shapes", one_of_each()}, {"bodies", Json::array()}};
  for (std::size_t i = 0; i < 10; ++i) {
    trajectory.header["bodies"].push_back({{"name", "body" + std::to_string(i)},
                                           {"shape", i < 9 ? Json(i) : Json()},
                                           {"motion", i == 0 || i == 9 ? "static" : "dynamic"},
                                           {"start", {i, 0, 0, 0, 0, 0, 1}}});
    if (i != 0 && i != 9) trajectory.moving.push_back(i);
  }
  for (std::uint32_t f = 0; f < 7; ++f) {
    TrajectoryFrame frame{3 * f, {}, {}};
    for (std::size_t i = 0; i < trajectory.moving.size(); ++i) {
      const double angle = 0.9 * f, sign = f % 2 == 0 ? 1 : -1;
      frame.poses.push_back(
          {{static_cast<double>(i), 0.1 * f, 0}, {0, sign * std::sin(angle), 0, sign * std::cos(angle)}});
    }
    if (f > 3) frame.poses[0].position.y = NAN;
    trajectory.frames.push_back(std::move(frame));
  }
  return trajectory;
}

struct Glb {
  Json json;
  std::string binary;
};

template <class Number>
Number at(const std::string& bytes, std::size_t offset) {
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

Glb parsed(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(at<std::uint32_t>(bytes, 4), 2u);
  EXPECT_EQ(at<std::uint32_t>(bytes, 8), bytes.size());
  const std::uint32_t size = at<std::uint32_t>(bytes, 12);
  EXPECT_EQ(size % 4, 0u);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  Glb glb{Json::parse(bytes.substr(20, size)), {}};
  EXPECT_EQ(at<std::uint32_t>(bytes, 20 + size) + 28 + size, bytes.size()) << "the binary chunk is the rest";
  EXPECT_EQ(bytes.substr(24 + size, 4), std::string("BIN\0", 4));
  glb.binary = bytes.substr(28 + size);
  return glb;
}

std::vector<float> floats_of(const Glb& glb, std::size_t accessor) {
  const Json& entry = glb.json["accessors"].at(accessor);
  const Json& view = glb.json["bufferViews"].at(entry["bufferView"].get<std::size_t>());
  std::vector<float> values(view["byteLength"].get<std::size_t>() / sizeof(float));
  std::memcpy(values.data(), glb.binary.data() + view["byteOffset"].get<std::size_t>(), values.size() * sizeof(float));
  return values;
}

TEST(Gltf, SizesAndBoundsAreTrue) {
  const Glb glb = parsed(binary_gltf(made()));
  const std::map<std::string, std::size_t> widths{{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
  const std::size_t size = glb.json["buffers"].at(0)["byteLength"];
  EXPECT_EQ(glb.json["buffers"].size(), 1u);
  EXPECT_LE(size, glb.binary.size());
  EXPECT_LT(glb.binary.size() - size, 4u);
  for (std::size_t i = 0; i < glb.json["accessors"].size(); ++i) {
    const Json& accessor = glb.json["accessors"][i];
    const Json& view = glb.json["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    const std::size_t width = widths.at(accessor["type"]), offset = view["byteOffset"], length = view["byteLength"];
    EXPECT_EQ(length, 4 * width * accessor["count"].get<std::size_t>());
    EXPECT_EQ(offset % 4, 0u);
    EXPECT_LE(offset + length, size);
    EXPECT_GT(length, 0u);
    if (!accessor.contains("min")) continue;
    const std::vector<float> values = floats_of(glb, i);
    for (std::size_t axis = 0; axis < width; ++axis) {
      float low = values[axis], high = low;
      for (std::size_t k = axis; k < values.size(); k += width) {
        low = std::min(low, values[k]);
        high = std::max(high, values[k]);
      }
      EXPECT_EQ(accessor["min"][axis].get<float>(), low);
      EXPECT_EQ(accessor["max"][axis].get<float>(), high);
    }
  }
}

TEST(Gltf, BodiesAreNodesAndCompoundsHaveChildren) {
  const Glb glb = parsed(binary_gltf(made()));
  const Json& roots = glb.json["scenes"].at(0)["nodes"];
  ASSERT_EQ(roots.size(), 10u);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const Json& node = glb.json["nodes"].at(roots[i].get<std::size_t>());
    EXPECT_EQ(node["name"], "body" + std::to_string(i));
    if (i == 8) {
      EXPECT_EQ(node["children"].size(), 2u);
      continue;
    }
    const Json& primitive = glb.json["meshes"].at(node["mesh"].get<std::size_t>())["primitives"].at(0);
    EXPECT_EQ(primitive["material"] == 0, i == 0 || i == 9) << "what does not move is grey";
    const std::size_t vertices =
        glb.json["accessors"].at(primitive["attributes"]["POSITION"].get<std::size_t>())["count"];
    EXPECT_EQ(glb.json["accessors"].at(primitive["attributes"]["NORMAL"].get<std::size_t>())["count"], vertices);
    const Json& indices = glb.json["accessors"].at(primitive["indices"].get<std::size_t>());
    EXPECT_EQ(indices["count"].get<std::size_t>() % 3, 0u);
    const std::size_t offset = glb.json["bufferViews"].at(indices["bufferView"].get<std::size_t>())["byteOffset"];
    for (std::size_t k = 0; k < indices["count"].get<std::size_t>(); ++k)
      ASSERT_LT(at<std::uint32_t>(glb.binary, offset + 4 * k), vertices);
  }
}

TEST(Gltf, TheAnimationMovesWhatMoves) {
  const Glb glb = parsed(binary_gltf(made()));
  const Json& animation = glb.json["animations"].at(0);
  EXPECT_EQ(animation["channels"].size(), 16u) << "eight bodies, two paths each";
  for (const Json& channel : animation["channels"]) {
    const Json& sampler = animation["samplers"].at(channel["sampler"].get<std::size_t>());
    const std::vector<float> times = floats_of(glb, sampler["input"]);
    ASSERT_EQ(times.size(), 7u);
    for (std::size_t f = 0; f < times.size(); ++f) EXPECT_FLOAT_EQ(times[f], 1.5f * static_cast<float>(f));
    const std::vector<float> values = floats_of(glb, sampler["output"]);
    for (const float value : values) EXPECT_TRUE(std::isfinite(value));
    if (channel["target"]["path"] != "rotation") continue;
    for (std::size_t f = 0; f < 7; ++f) {
      float length = 0, dot = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        length += values[4 * f + k] * values[4 * f + k];
        if (f > 0) dot += values[4 * f + k] * values[4 * f - 4 + k];
      }
      EXPECT_NEAR(length, 1, 1e-5);
      EXPECT_GE(dot, 0) << "the short way round";
    }
  }
}

TEST(Gltf, AnchorsHangOnTheirBodies) {
  Trajectory trajectory = made();
  trajectory.header["joints"] = {{{"name", "top"},
                                  {"type", "ball"},
                                  {"body_a", nullptr},
                                  {"body_b", 1},
                                  {"frame_a", {1, 2, 3, 0, 0, 0, 1}},
                                  {"frame_b", {0, 4, 0, 0, 0, 0, 1}}},
                                 {{"name", "link"},
                                  {"type", "hinge"},
                                  {"body_a", 1},
                                  {"body_b", 8},
                                  {"frame_a", {0, -4, 0, 0, 0, 0, 1}},
                                  {"frame_b", {0, 0, 5, 0, 0, 0, 1}}}};
  const LayerSpec joints{"joints", LayerRows::list, {{"joint", "u32"}, {"gap", "f32"}, {"angle", "f32"}}};
  trajectory.layers.push_back(joints);
  for (std::size_t f = 0; f < trajectory.frames.size(); ++f) {
    LayerData& rows = trajectory.frames[f].layers.emplace_back().emplace(joints);
    rows.put(0, 1u);
    rows.put(1, f == 2 ? 0.5f : 0.25f);
    rows.put(2, 0.0f);
    rows.rows = 1;
  }
  const Glb glb = parsed(binary_gltf(trajectory));
  const auto node = [&](const Json& number) { return glb.json["nodes"].at(number.get<std::size_t>()); };
  const Json& roots = glb.json["scenes"].at(0)["nodes"];
  ASSERT_EQ(roots.size(), 11u) << "ten bodies, and an anchor in the world";
  EXPECT_EQ(node(roots[10])["name"], "top a");
  EXPECT_EQ(node(roots[10])["translation"], Json({1.0, 2.0, 3.0}));
  const Json children = node(roots[1])["children"];
  ASSERT_EQ(children.size(), 2u);
  EXPECT_EQ(node(children[0])["name"], "top b");
  EXPECT_EQ(node(children[1])["translation"], Json({0.0, -4.0, 0.0}));
  EXPECT_EQ(node(children[1])["extras"], Json({{"type", "hinge"}, {"largest_gap", 0.5}}));
  EXPECT_EQ(node(node(roots[8])["children"].back())["name"], "link b") << "beside the children of a compound";
}

/// Six times the volume inside, which is above zero only where all triangles look outward.
double volume6(const DrawnMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto &a = mesh.positions[mesh.indices[i]], &b = mesh.positions[mesh.indices[i + 1]],
               &c = mesh.positions[mesh.indices[i + 2]];
    const auto x = [](float value) { return static_cast<double>(value); };
    sum += x(a[0]) * (x(b[1]) * x(c[2]) - x(b[2]) * x(c[1])) + x(a[1]) * (x(b[2]) * x(c[0]) - x(b[0]) * x(c[2])) +
           x(a[2]) * (x(b[0]) * x(c[1]) - x(b[1]) * x(c[0]));
  }
  return sum;
}

TEST(DrawnMeshes, EncloseTheirVolume) {
  const Json shapes = one_of_each();
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(volume6(drawn_mesh(shapes[0])) / 6, 4 * pi / 3 / 8, 0.02);
  EXPECT_NEAR(volume6(drawn_mesh(shapes[1])) / 6, 48, 1e-5);
  EXPECT_NEAR(volume6(drawn_mesh(shapes[2])) / 6, 4 * pi / 3 / 8 + pi / 2, 0.06);
  EXPECT_NEAR(volume6(drawn_mesh(shapes[3])) / 6, pi / 2, 0.03);
  EXPECT_NEAR(volume6(drawn_mesh(shapes[4])) / 6, 1.0 / 6, 1e-6);
}

TEST(DrawnMeshes, GroundLooksUp) {
  const Json shapes = one_of_each();
  for (const std::size_t ground : {5u, 6u, 7u})
    for (const auto& normal : drawn_mesh(shapes[ground]).normals) EXPECT_GT(normal[1], 0.1f);
}

}  // namespace
}  // namespace plumb::harness
