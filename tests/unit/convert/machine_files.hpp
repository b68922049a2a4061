// Files as tests write them, and scenes as they look at them.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>

#include "convert/read.hpp"
#include "measure/instruments/mechanics.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness::testing {

/// A folder of the running test's own, empty.
inline std::filesystem::path own_folder() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto folder =
      std::filesystem::path(::testing::TempDir()) / "plumb-convert" / test->test_suite_name() / test->name();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::filesystem::path write_file(const std::string& name, const std::string& text) {
  const auto file = own_folder() / name;
  std::ofstream(file) << text;
  return file;
}

/// Puts in its place what gzip makes of it.
inline void pack(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  gzFile packed = gzopen((file.string() + ".gz").c_str(), "wb");
  gzwrite(packed, text.data(), static_cast<unsigned>(text.size()));
  gzclose(packed);
  std::filesystem::remove(file);
}

inline Imported read_text(const std::string& name, const std::string& text) {
  return read_machine({write_file(name, text), {}});
}

/// What reading the text fails with.
inline std::string failure_of(const std::string& name, const std::string& text) {
  try {
    (void)read_text(name, text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no failure";
}

/// A scene of the catalogue as its first variant has it.
inline Scene scene_of(const std::string& id) {
  const SceneFile file = find_scenes(id).at(0);
  return file.instantiate(file.variants.front());
}

inline referee::Pose pose_of(const Scene& scene, const std::string& body) {
  return referee::pose(scene.bodies[scene.body(body)].desc.pose);
}

/// Where a joint's frame on body b is in the world.
inline referee::Pose place_of(const Scene& scene, const SceneJoint& joint) {
  return referee::pose(scene.bodies[joint.body_b].desc.pose) * referee::pose(joint.desc.frame_b);
}

inline void expect_same(const referee::Pose& a, const referee::Pose& b, double tolerance, const std::string& what) {
  EXPECT_LT((a.position - b.position).norm(), tolerance) << what;
  EXPECT_LT((a.rotation - b.rotation).norm(), tolerance) << what;
}

inline void expect_same(const referee::Mass& a, const referee::Mass& b, double tolerance, const std::string& what) {
  EXPECT_NEAR(a.mass, b.mass, tolerance * b.mass) << what;
  EXPECT_LT((a.centre - b.centre).norm(), tolerance) << what;
  EXPECT_LT((a.inertia - b.inertia).norm(), tolerance * (1e-9 + b.inertia.norm())) << what;
}

inline bool has_line(const Remarks& remarks, const std::string& words) {
  for (const std::string& line : remarks.lines())
    if (line.find(words) != std::string::npos) return true;
  return false;
}

}  // namespace plumb::harness::testing
