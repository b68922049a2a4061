#include "convert/gltf/read_gltf.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "convert/gltf/gltf_joints.hpp"
#include "convert/gltf/gltf_shapes.hpp"
#include "convert/upright.hpp"

namespace plumb::harness {
namespace {

using nlohmann::json;
using referee::Pose;
using referee::Vec3;

/// Systems of collision filters as bits. A collider of no system has a bit of its own, which all but lists of those to
/// collide with let pass.
class Systems {
 public:
  explicit Systems(const json& rigid_bodies) : filters_(member(rigid_bodies, "collisionFilters", json::array())) {
    for (const json& filter : filters_)
      for (const char* key : {"collisionSystems", "collideWithSystems", "notCollideWithSystems"})
        for (const auto& word : member<std::vector<std::string>>(filter, key, {})) bit_of(word);
  }
  [[nodiscard]] PlumbFilter filter(const json& collider) {
    PlumbFilter filter = body_desc(PLUMB_DYNAMIC).filter;
    if (filters_.empty()) return filter;
    filter.category = nobody;
    filter.mask = ~0U;
    if (!collider.contains("collisionFilter")) return filter;
    const json& read = filters_.at(collider.at("collisionFilter").get<std::size_t>());
    if (read.contains("collisionSystems")) filter.category = bits_of(read, "collisionSystems");
    if (read.contains("collideWithSystems")) filter.mask = bits_of(read, "collideWithSystems");
    if (read.contains("notCollideWithSystems")) filter.mask = ~bits_of(read, "notCollideWithSystems");
    return filter;
  }

 private:
  static constexpr std::uint32_t nobody = 1U << 31;

  std::uint32_t bit_of(const std::string& word) {
    auto found = std::find(words_.begin(), words_.end(), word);
    if (found == words_.end()) found = words_.insert(words_.end(), word);
    if (words_.size() > 31) throw UsageError("more than 31 collision systems: scenes have 32 bits");
    return 1U << (found - words_.begin());
  }
  std::uint32_t bits_of(const json& filter, const char* key) {
    std::uint32_t bits = 0;
    for (const auto& word : filter.at(key).get<std::vector<std::string>>()) bits |= bit_of(word);
    return bits;
  }

  json filters_;
  std::vector<std::string> words_;
};

class GltfReader {
 public:
  explicit GltfReader(const GltfFile& file) : file_(file), systems_(file.rigid_bodies) {}

  Imported read() {
    for (const int node : file_.nodes) {
      const json& physics = file_.physics[static_cast<std::size_t>(node)];
      if (physics.contains("motion")) read_body(node, physics.at("motion"));
      if (physics.contains("collider") && !file_.body_of(node)) add(node, {node}, false);
      if (physics.contains("trigger")) imported_.remarks.add("triggers are left out", file_.name(node));
    }
    for (const int node : file_.nodes)
      if (file_.physics[static_cast<std::size_t>(node)].contains("joint"))
        add_gltf_joint(file_, node, bodies_, imported_);
    return std::move(imported_);
  }

 private:
  /// A body with the colliders of these nodes.
  std::size_t add(int node, const std::vector<int>& colliders, bool moves) {
    Link link;
    link.name = scene_name(file_.name(node));
    link.pose = file_.place[static_cast<std::size_t>(node)].pose;
    link.moves = moves;
    for (const int collider : colliders) {
      link.shapes.push_back(collider_shape(file_, collider, link.pose, moves, imported_.remarks));
      const PlumbFilter filter = systems_.filter(file_.physics[static_cast<std::size_t>(collider)].at("collider"));
      if (collider != colliders.front() && (filter.category != link.filter.category || filter.mask != link.filter.mask))
        imported_.remarks.add("of several collision filters of a body the first is taken", link.name);
      else
        link.filter = filter;
    }
    if (colliders.empty()) {
      link.filter = body_desc(PLUMB_DYNAMIC).filter;
      link.mass = {1, Vec3::Zero(), referee::Mat3::Identity()};
    }
    return add_link(imported_, link);
  }

  void read_body(int node, const json& motion) {
    std::vector<int> colliders;
    for (const int other : file_.nodes)
      if (file_.physics[static_cast<std::size_t>(other)].contains("collider") && file_.body_of(other) == node)
        colliders.push_back(other);
    const std::size_t index = add(node, colliders, true);
    bodies_[node] = index;
    PlumbBodyDesc& desc = imported_.scene.bodies[index].desc;
    set_mass(desc, motion, file_.name(node), colliders.empty());
    const referee::Mat3& turn = file_.place[static_cast<std::size_t>(node)].pose.rotation;
    desc.linear_velocity = referee::plain(turn * vector_member(motion, "linearVelocity", Vec3::Zero()));
    desc.angular_velocity = referee::plain(turn * vector_member(motion, "angularVelocity", Vec3::Zero()));
    desc.gravity_scale = member(motion, "gravityFactor", 1.0);
    if (!member(motion, "isKinematic", false) && member(motion, "mass", 1.0) != 0) return;
    PlumbBodyDesc kinematic = body_desc(PLUMB_KINEMATIC);
    kinematic.pose = desc.pose;
    kinematic.linear_velocity = desc.linear_velocity;
    kinematic.angular_velocity = desc.angular_velocity;
    kinematic.material = desc.material;
    kinematic.filter = desc.filter;
    desc = kinematic;
  }

  /// What is not said comes from the shapes; a moment of 0 is an infinite one.
  void set_mass(PlumbBodyDesc& desc, const json& motion, const std::string& name, bool bare) {
    const bool has_mass = motion.contains("mass"), has_inertia = motion.contains("inertiaDiagonal");
    const Vec3 moments = vector_member(motion, "inertiaDiagonal", Vec3::Ones());
    if (bare && !has_mass) imported_.remarks.add("bodies without a mass or shapes have 1 kg", name);
    if (has_mass) {
      desc.mass_mode = bare ? PLUMB_MASS_EXPLICIT : PLUMB_MASS_FROM_TOTAL;
      desc.mass = motion.at("mass").get<double>();
    }
    if (has_inertia && moments.isZero()) {
      desc.flags |= PLUMB_BODY_NO_ROTATION;
    } else if (has_inertia && moments.minCoeff() == 0) {
      imported_.remarks.add("infinite moments of inertia about some axes are those of the shapes", name);
    } else if (has_inertia && has_mass) {
      const auto q = member<std::vector<double>>(motion, "inertiaOrientation", {0, 0, 0, 1});
      desc.mass_mode = PLUMB_MASS_EXPLICIT;
      desc.inertia = referee::plain(moments);
      desc.centre_of_mass = referee::plain(vector_member(motion, "centerOfMass", Vec3::Zero()));
      if (q.size() == 4) desc.inertia_orientation = {q[0], q[1], q[2], q[3]};
    } else if (motion.contains("centerOfMass")) {
      imported_.remarks.add("a centre of mass without mass and inertia is that of the shapes", name);
    }
  }

  const GltfFile& file_;
  Systems systems_;
  std::map<int, std::size_t> bodies_;
  Imported imported_;
};

}  // namespace

Imported read_gltf(const ModelFolders& folders) {
  const GltfFile file(folders.file);
  if (file.rigid_bodies.is_null() &&
      std::all_of(file.physics.begin(), file.physics.end(), [](const json& physics) { return physics.is_null(); }))
    throw UsageError(folders.file.string() +
                     ": it says nothing of physics: there is no extension KHR_physics_rigid_bodies");
  try {
    return GltfReader(file).read();
  } catch (const std::exception& error) {
    throw UsageError(fmt::format("{}: {}", folders.file.string(), error.what()));
  }
}

}  // namespace plumb::harness
