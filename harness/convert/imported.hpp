// Bodies and joints as other programs' files describe them, read into a Scene.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace plumb::harness {

/// What a file says that scenes have no word for, counted by kind: nothing is dropped in silence.
class Remarks {
 public:
  /// kind: "damping of joints is left out"; who: the joint's name.
  void add(const std::string& kind, const std::string& who) { who_[kind].push_back(who); }
  /// A line a kind, with its first few names: "damping of joints is left out: elbow, wrist and 12 more".
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  std::map<std::string, std::vector<std::string>> who_;
};

struct Imported {
  Scene scene;  ///< shapes, bodies, joints, gravity; y up. dt is 0 where the file says none
  /// Of each joint the largest force or torque of a motor on each of its axes, N or N m; infinite where none is said.
  std::vector<std::array<double, 6>> efforts;
  Remarks remarks;
};

/// Where meshes and included models are looked for: URIs model://NAME/... and package://NAME/... in these folders, then
/// in those above the file. Paths of a file are relative to it.
struct ModelFolders {
  std::filesystem::path file;                  ///< that is read
  std::vector<std::filesystem::path> folders;  ///< that the user named

  /// Throws UsageError that names the URI and where it was looked for.
  [[nodiscard]] std::filesystem::path find(const std::string& uri) const;
};

/// A name that scene files take: at most 200 characters, none of which controls a terminal or begins an expression.
[[nodiscard]] std::string scene_name(const std::string& name);

}  // namespace plumb::harness
