#include "convert/write/urdf/write_urdf.hpp"

#include <limits>

#include "convert/upright.hpp"
#include "convert/write/left_out.hpp"
#include "convert/write/sdf_name.hpp"
#include "convert/write/start_of_joint.hpp"
#include "convert/write/urdf/urdf_collisions.hpp"
#include "convert/write/urdf/urdf_joints.hpp"
#include "convert/write/urdf/urdf_tree.hpp"
#include "measure/instruments/mechanics.hpp"

namespace plumb::harness {
namespace {

using referee::Mass;
using referee::Pose;

constexpr const char* world_link = "world";

class UrdfWriter {
 public:
  UrdfWriter(const Imported& imported, UrdfOutput& out) : imported_(imported), out_(out) {}

  void write() {
    const UrdfTree tree = urdf_tree(out_.scene, out_.remarks);
    const Xml::Element robot(out_.xml, "robot", {{"name", out_.name}});
    if (tree.in_world) {
      const Xml::Element world(out_.xml, "link", {{"name", world_link}});
    }
    frames_.resize(out_.scene.bodies.size());
    for (const UrdfLink& link : tree.links) {
      frames_[link.body] = frame_of_link(link, tree.in_world);
      write_link(link.body);
    }
    for (const UrdfLink& link : tree.links)
      if (link.joint || tree.in_world) write_joint(link);
  }

 private:
  [[nodiscard]] std::string name_of(std::size_t body) const { return sdf_name(out_.scene.bodies[body].name); }

  /// In the world, whose z is up.
  [[nodiscard]] Pose frame_of_link(const UrdfLink& link, bool in_world) const {
    if (!link.joint && !in_world) return {};
    if (!link.joint) return upright().inverse() * referee::pose(out_.scene.bodies[link.body].desc.pose);
    const SceneJoint& joint = out_.scene.joints[*link.joint];
    return upright().inverse() * (link.forward ? frame_on_b(out_.scene, joint) : frame_on_a(out_.scene, joint));
  }

  void write_link(std::size_t index) {
    const SceneBody& body = out_.scene.bodies[index];
    const Xml::Element link(out_.xml, "link", {{"name", name_of(index)}});
    const Pose pose = (upright().inverse() * referee::pose(body.desc.pose)).seen_from(frames_[index]);
    // What the world holds does not move whatever its mass is, but readers drop links without one.
    const bool stands = body.desc.motion == PLUMB_STATIC;
    const Mass mass = stands ? Mass{1, {0, 0, 0}, referee::Mat3::Identity()} : mass_of_body(out_.scene, index);
    if (!(mass.inertia.diagonal().minCoeff() > 0))
      throw UsageError(fmt::format(
          "body \"{}\" has no moments of inertia, and URDF's links have; give it some, or a shape of which they follow",
          body.name));
    write_inertial(mass, pose);
    write_urdf_collisions(out_, body, pose);
    remark(body);
  }

  void write_inertial(const Mass& mass, const Pose& pose) {
    const Xml::Element inertial(out_.xml, "inertial");
    write_origin(out_.xml, {pose.rotation, pose * mass.centre});
    { const Xml::Element element(out_.xml, "mass", {{"value", numbers_text({mass.mass})}}); }
    const auto moment = [&](int row, int column) { return numbers_text({mass.inertia(row, column)}); };
    const Xml::Element inertia(out_.xml, "inertia",
                               {{"ixx", moment(0, 0)},
                                {"ixy", moment(0, 1)},
                                {"ixz", moment(0, 2)},
                                {"iyy", moment(1, 1)},
                                {"iyz", moment(1, 2)},
                                {"izz", moment(2, 2)}});
  }

  void remark(const SceneBody& body) {
    Remarks& remarks = out_.remarks;
    const PlumbFilter &filter = body.desc.filter, open = body_desc(PLUMB_DYNAMIC).filter;
    remark_body(body, remarks);
    if (body.desc.gravity_scale == 0) remarks.add("that gravity does not pull it is left out", body.name);
    if (body.shape) remarks.add("friction and restitution are left out", body.name);
    if (filter.category != open.category || filter.mask != open.mask || filter.group != 0)
      remarks.add("categories, masks and groups are left out", body.name);
  }

  /// By which the link hangs on its parent or, what stands, on the world.
  void write_joint(const UrdfLink& link) {
    const SceneJoint* const joint = link.joint ? &out_.scene.joints[*link.joint] : nullptr;
    const UrdfKind kind = joint != nullptr ? urdf_kind(*joint) : UrdfKind{"fixed", {}};
    const std::string name = joint != nullptr ? sdf_name(joint->name) : name_of(link.body) + "/fixed";
    {
      const Xml::Element element(out_.xml, "joint", {{"name", name}, {"type", kind.word}});
      write_origin(out_.xml, frames_[link.body].seen_from(link.parent ? frames_[*link.parent] : Pose{}));
      { const Xml::Element parent(out_.xml, "parent", {{"link", link.parent ? name_of(*link.parent) : world_link}}); }
      { const Xml::Element child(out_.xml, "child", {{"link", name_of(link.body)}}); }
      if (kind.axis) write_urdf_axis(out_, *joint, link.forward, effort_of(*link.joint, *kind.axis));
    }
    if (joint != nullptr) remark_joint(*joint, out_.remarks);
    if (!kind.axis) keep_fixed(name);
  }

  /// libsdformat makes one link of two that a fixed joint holds together, unless it is told otherwise.
  void keep_fixed(const std::string& joint) {
    const Xml::Element gazebo(out_.xml, "gazebo", {{"reference", joint}});
    out_.xml.text("preserveFixedJoint", "true");
  }

  [[nodiscard]] double effort_of(std::size_t joint, std::size_t axis) const {
    return joint < imported_.efforts.size() ? imported_.efforts[joint][axis] : std::numeric_limits<double>::infinity();
  }

  const Imported& imported_;
  UrdfOutput& out_;
  std::vector<Pose> frames_;  ///< of links, in the world; by body
};

}  // namespace

UrdfFiles write_urdf(Imported& imported, const std::string& name) {
  UrdfOutput out{imported.scene, name, imported.remarks};
  UrdfWriter(imported, out).write();
  remark_gravity(imported.scene, imported.remarks);
  remark_host(imported.scene, imported.remarks);
  remark_materials(imported.scene, imported.remarks);
  return {out.xml.str(), std::move(out.meshes)};
}

}  // namespace plumb::harness
