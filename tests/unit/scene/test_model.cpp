// Models of packages: what comes out of a file, and what a scene says where there is none.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "scene/model.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {
namespace {

namespace fs = std::filesystem;

/// A folder that goes with the test.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("plumb-model-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }

 private:
  fs::path path_;
};

/// A box of 2 x 4 x 6 with one corner at the origin, of six quadrilaterals whose corners each face has for itself.
std::string box_file(const Folder& folder) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += "v " + std::to_string(i & 1 ? 2 : 0) + " " + std::to_string(i & 2 ? 4 : 0) + " " +
            std::to_string(i & 4 ? 6 : 0) + "\n";
  text += "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n";
  return folder.write("box.obj", text);
}

TEST(Model, IsCentredScaledTurnedAndClosed) {
  const Folder folder;
  const double half = std::sqrt(.5);
  const auto model = load_model({box_file(folder), 3, {half, 0, 0, half}});  // y becomes z
  ASSERT_TRUE(model);
  EXPECT_EQ(model->vertices.size(), 8u * 3);
  EXPECT_EQ(model->indices.size(), 12u * 3);
  for (std::size_t i = 0; i < model->vertices.size(); i += 3) {
    EXPECT_NEAR(std::abs(model->vertices[i]), .5, 1e-6);
    EXPECT_NEAR(std::abs(model->vertices[i + 1]), 1.5, 1e-6);
    EXPECT_NEAR(std::abs(model->vertices[i + 2]), 1, 1e-6);
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t t = 0; t < model->indices.size(); t += 3)
    for (std::size_t e = 0; e < 3; ++e)
      EXPECT_TRUE(edges.emplace(model->indices[t + e], model->indices[t + (e + 1) % 3]).second);
  for (const auto& [from, to] : edges) EXPECT_TRUE(edges.contains({to, from}));
  double volume = 0;  // by tetrahedra with the origin: positive where the triangles look outwards
  const auto v = [&](std::size_t corner, std::size_t axis) {
    return model->vertices[3 * model->indices[corner] + axis];
  };
  for (std::size_t t = 0; t < model->indices.size(); t += 3)
    volume += (v(t, 0) * (v(t + 1, 1) * v(t + 2, 2) - v(t + 1, 2) * v(t + 2, 1)) -
               v(t, 1) * (v(t + 1, 0) * v(t + 2, 2) - v(t + 1, 2) * v(t + 2, 0)) +
               v(t, 2) * (v(t + 1, 0) * v(t + 2, 1) - v(t + 1, 1) * v(t + 2, 0))) /
              6;
  EXPECT_NEAR(volume, 1 * 2 * 3, 1e-5);
}

TEST(Model, ExtremePointsOfABoxAreItsCorners) {
  const Folder folder;
  const auto model = load_model({box_file(folder), 3, {0, 0, 0, 1}});
  ASSERT_TRUE(model);
  EXPECT_EQ(extreme_points(*model, 500).size(), 8u * 3);
  EXPECT_LE(extreme_points(*model, 5).size(), 5u * 3);
}

std::string scene_text(const std::string& file, const std::string& type, const std::string& more) {
  return R"({"id": "X1", "slug": "x", "title": "x", "doc": "x", "needs": [], "seconds": 1,
    "shapes": {"s": {"type": ")" +
         type + R"(", "model": {"file": ")" + file + R"(", "package": "shapes-of-all-kinds", "licence": "MIT")" + more +
         R"(}}},
    "bodies": [{"name": "b", "motion": "static", "shape": "s"}],
    "measure": {"kind": "crowd"}, "metrics": {}})";
}

TEST(Model, SceneWithoutItsFileNamesThePackage) {
  const Folder folder;
  const Scene scene =
      SceneFile::load(folder.write("X1-x.json", scene_text("/nowhere/box.obj", "triangle_mesh", ""))).instantiate({});
  EXPECT_EQ(scene.lacks, "the scene needs /nowhere/box.obj; install the package shapes-of-all-kinds");
}

TEST(Model, SceneWithItsFileHasTheShape) {
  const Folder folder;
  const std::string file = box_file(folder);
  const Scene mesh = SceneFile::load(folder.write("X1-x.json", scene_text(file, "triangle_mesh", ""))).instantiate({});
  EXPECT_EQ(mesh.lacks, "");
  EXPECT_EQ(mesh.shapes[0].desc.triangle_count, 12u);
  const Scene hull =
      SceneFile::load(folder.write("X1-y.json", scene_text(file, "convex_hull", ", \"corners\": 99"))).instantiate({});
  EXPECT_EQ(hull.shapes[0].desc.vertex_count, 8u);
}

TEST(Model, SaysWhatIsWrong) {
  const Folder folder;
  const auto refusal = [&](const std::string& file, const std::string& type, const std::string& more) -> std::string {
    try {
      (void)SceneFile::load(folder.write("X1-z.json", scene_text(file, type, more)));
    } catch (const UsageError& error) {
      return error.what();
    }
    return "none";
  };
  const std::string file = box_file(folder), junk = folder.write("junk.obj", "not a model\n");
  EXPECT_NE(refusal(file, "convex_hull", "").find("says its \"corners\""), std::string::npos);
  EXPECT_NE(refusal(file, "triangle_mesh", ", \"corners\": 9").find("has all its corners"), std::string::npos);
  EXPECT_NE(refusal(file, "triangle_mesh", ", \"size\": 0").find("above 0, not 0"), std::string::npos);
  EXPECT_NE(refusal(file, "triangle_mesh", ", \"scale\": 2").find("scale"), std::string::npos);
  EXPECT_NE(refusal(file, "sphere", "").find("a sphere has no model"), std::string::npos);
  EXPECT_NE(refusal(junk, "triangle_mesh", "").find("junk.obj"), std::string::npos);
}

}  // namespace
}  // namespace plumb::harness
