// The parts of a scene file, read into a Scene whose parameters have values. Used by scene_file.cpp and by tests.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/node.hpp"

namespace plumb::harness {

/// What is being read, and where names lie in it.
struct SceneBuilder {
  Scene scene;
  std::size_t vertices = 0;  ///< of all shapes so far, and heights

  /// Before so many more are made. Fails beyond most_vertices.
  void add_vertices(const Node& place, std::size_t count);
  std::unordered_map<std::string, std::size_t> shape_index, body_index, joint_index;
};

void read_shapes(const Node& shapes, SceneBuilder& builder);
void read_bodies(const Node& bodies, SceneBuilder& builder);
void read_joints(const Node& joints, SceneBuilder& builder);
void read_host(const Node& host, SceneBuilder& builder);

/// Calls each(axis index, value) for the members of an object keyed by axis.
void for_each_axis(const Node& node, const std::function<void(std::size_t, const Node&)>& each);

/// The indices of an entry's repeat, known to its expressions as long as this lives.
struct RepeatIndices {
  explicit RepeatIndices(const Node& entry);
  ~RepeatIndices();
  RepeatIndices(const RepeatIndices&) = delete;
  RepeatIndices& operator=(const RepeatIndices&) = delete;

  std::vector<std::pair<std::string, Node>> list;  ///< name and count, outermost first

 private:
  Expressions& expressions_;
};

/// Calls `each` for every combination of the indices of entry's repeat for which its `when` holds (once without).
void for_each_repeat(const Node& entry, const std::function<void()>& each);

/// Fail where a number is none that an engine may be given; node is the object that was read.
void check_values(const Node& node, const SceneShape& shape);
void check_values(const Node& node, const PlumbMaterial& material);
void check_values(const Node& node, const SceneBody& body);
void check_values(const Node& node, const SceneJoint& joint);

/// Adds a name to an index; fails when it is taken. what: "body".
void add_name(const Node& place, const std::string& what, const std::string& name,
              std::unordered_map<std::string, std::size_t>& index, std::size_t value);
/// Looks a name up; fails with the nearest.
[[nodiscard]] std::size_t find_name(const Node& place, const std::string& what,
                                    const std::unordered_map<std::string, std::size_t>& index);

/// Keys that the reader knows, by the schema's definition that lists them ("" is the root).
[[nodiscard]] const std::map<std::string, std::vector<std::string>>& scene_keys();
[[nodiscard]] const std::vector<std::string>& need_words();  ///< by bit
[[nodiscard]] const std::vector<std::string>& shape_words();
[[nodiscard]] const std::vector<std::string>& joint_words();

}  // namespace plumb::harness
