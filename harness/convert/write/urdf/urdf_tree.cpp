#include "convert/write/urdf/urdf_tree.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace plumb::harness {
namespace {

class UrdfTreeMaker {
 public:
  UrdfTreeMaker(const Scene& scene, Remarks& remarks)
      : scene_(scene), remarks_(remarks), in_tree_(scene.bodies.size()), used_(scene.joints.size()) {}

  UrdfTree make() {
    for (std::size_t joint = 0; joint < used_.size(); ++joint) look_at(joint);
    for (std::size_t joint = 0; joint < used_.size(); ++joint)
      if (!used_[joint]) plant(joint);
    if (!tree_.in_world) add({root(), {}, {}});
    for (std::size_t i = 0; i < tree_.links.size(); ++i) grow(tree_.links[i].body);
    for (std::size_t joint = 0; joint < used_.size(); ++joint)
      if (!used_[joint] && in_tree_[scene_.joints[joint].body_b]) refuse_loop(scene_.joints[joint]);
    look_at_the_rest();
    return std::move(tree_);
  }

 private:
  [[nodiscard]] PlumbMotion motion_of(std::optional<std::size_t> body) const {
    return body ? scene_.bodies[*body].desc.motion : PlumbMotion{PLUMB_STATIC};
  }
  [[nodiscard]] bool moves(std::size_t body) const { return motion_of(body) == PLUMB_DYNAMIC; }

  void add(const UrdfLink& link) {
    in_tree_[link.body] = true;
    tree_.links.push_back(link);
  }

  void look_at(std::size_t index) {
    const SceneJoint& joint = scene_.joints[index];
    const PlumbMotion a = motion_of(joint.body_a), b = motion_of(joint.body_b);
    if (a == PLUMB_KINEMATIC || b == PLUMB_KINEMATIC)
      throw UsageError(
          fmt::format("joint \"{}\" holds a kinematic body, which URDF lacks; make that one static", joint.name));
    used_[index] = a == PLUMB_STATIC && b == PLUMB_STATIC;
    if (used_[index]) remarks_.add("joints between what does not move are left out", joint.name);
  }

  /// What a joint ties to the world, and what stands that it ties.
  void plant(std::size_t index) {
    const SceneJoint& joint = scene_.joints[index];
    for (const std::optional<std::size_t> body : {joint.body_a, std::optional(joint.body_b)}) {
      if (motion_of(body) != PLUMB_STATIC) continue;
      tree_.in_world = true;
      if (body && !in_tree_[*body]) add({*body, {}, {}});
    }
    if (joint.body_a || in_tree_[joint.body_b]) return;
    used_[index] = true;
    add({joint.body_b, {}, index});
  }

  /// Of a robot that stands on nothing: a body that no joint hangs on another, as links of robots' files are named.
  [[nodiscard]] std::size_t root() const {
    std::vector<bool> hangs(in_tree_.size()), is_joined(in_tree_.size());
    for (const SceneJoint& joint : scene_.joints) {
      hangs[joint.body_b] = is_joined[joint.body_b] = true;
      if (joint.body_a) is_joined[*joint.body_a] = true;
    }
    std::optional<std::size_t> best;
    const auto rank = [&](std::size_t body) { return (is_joined[body] ? 2 : 0) + (hangs[body] ? 0 : 1); };
    for (std::size_t body = 0; body < in_tree_.size(); ++body)
      if (moves(body) && (!best || rank(body) > rank(*best))) best = body;
    if (!best) throw UsageError("nothing in the scene moves, so there is no robot for URDF in it");
    return *best;
  }

  void grow(std::size_t body) {
    for (std::size_t index = 0; index < used_.size(); ++index) {
      const SceneJoint& joint = scene_.joints[index];
      if (used_[index] || !joint.body_a || (*joint.body_a != body && joint.body_b != body)) continue;
      const bool forward = *joint.body_a == body;
      const std::size_t next = forward ? joint.body_b : *joint.body_a;
      if (in_tree_[next]) continue;
      used_[index] = true;
      add({next, body, index, forward});
    }
  }

  [[noreturn]] static void refuse_loop(const SceneJoint& joint) {
    throw UsageError(fmt::format(
        "joint \"{}\" closes a loop, and links of URDF are a tree; write a file of another kind, which ends "
        "with .sdf, .xml or .gltf",
        joint.name));
  }

  void look_at_the_rest() {
    std::vector<std::string> loose;
    for (std::size_t body = 0; body < in_tree_.size(); ++body) {
      const std::string& name = scene_.bodies[body].name;
      if (in_tree_[body]) continue;
      if (moves(body)) loose.push_back("\"" + name + "\"");
      if (motion_of(body) == PLUMB_STATIC) remarks_.add("what stands beside the robot is left out", name);
      if (motion_of(body) == PLUMB_KINEMATIC) remarks_.add("what moves by itself is left out", name);
    }
    if (loose.empty()) return;
    constexpr std::size_t shown = 3;
    const std::size_t count = loose.size();
    if (count > shown) loose.resize(shown);
    throw UsageError(fmt::format(
        "URDF describes one robot, and {} not joined to \"{}\": {}{}; join what is one robot, or write a file of "
        "another kind, which ends with .sdf, .xml or .gltf",
        count == 1 ? "one body is" : fmt::format("{} bodies are", count), scene_.bodies[tree_.links.front().body].name,
        fmt::join(loose, ", "), count > shown ? " and others" : ""));
  }

  const Scene& scene_;
  Remarks& remarks_;
  std::vector<bool> in_tree_, used_;  // bodies; joints
  UrdfTree tree_;
};

}  // namespace

UrdfTree urdf_tree(const Scene& scene, Remarks& remarks) { return UrdfTreeMaker(scene, remarks).make(); }

}  // namespace plumb::harness
