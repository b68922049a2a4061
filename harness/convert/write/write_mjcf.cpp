#include "convert/write/write_mjcf.hpp"

#include <algorithm>

#include "convert/upright.hpp"
#include "convert/write/left_out.hpp"
#include "convert/write/mjcf_geoms.hpp"
#include "convert/write/start_of_joint.hpp"
#include "measure/instruments/mechanics.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;
using Attributes = std::vector<std::pair<const char*, std::string>>;

/// Axes of a joint along or about which it lets go, in the order from body a to body b.
std::vector<std::size_t> free_axes(const SceneJoint& joint) {
  switch (joint.desc.type) {
    case PLUMB_JOINT_HINGE: return {3};
    case PLUMB_JOINT_SLIDER: return {0};
    case PLUMB_JOINT_UNIVERSAL: return {3, 4};
    case PLUMB_JOINT_GENERIC: break;
    case PLUMB_JOINT_DISTANCE:
      throw UsageError(
          fmt::format("joint \"{}\" is a distance one, which MJCF lacks; make it a ball joint and a rod", joint.name));
    default: return {};
  }
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < 6; ++axis)
    if (joint.desc.axis_modes[axis] != PLUMB_AXIS_LOCKED) axes.push_back(axis);
  return axes;
}

/// A tree of bodies: each is within the one that it is joined to.
class MjcfWriter {
 public:
  MjcfWriter(const Scene& scene, Xml& xml, Remarks& remarks)
      : out_{scene, xml, remarks}, written_(scene.bodies.size()), used_(scene.joints.size()) {}

  void write_world() {
    const Xml::Element world(out_.xml, "worldbody");
    for (const PlumbMotion motion : {PLUMB_STATIC, PLUMB_KINEMATIC})
      for (std::size_t body = 0; body < written_.size(); ++body)
        if (desc_of(body).motion == motion) write_body(body, {}, std::nullopt);
    for (std::size_t joint = 0; joint < used_.size(); ++joint)  // to the world
      if (!out_.scene.joints[joint].body_a) write_branch(joint, out_.scene.joints[joint].body_b, {});
    for (std::size_t body = 0; body < written_.size(); ++body)
      if (!written_[body]) write_body(body, {}, std::nullopt);
  }

  /// Joints that are in no branch.
  void write_loops() {
    if (std::find(used_.begin(), used_.end(), false) == used_.end()) return;
    const Xml::Element equality(out_.xml, "equality");
    for (std::size_t joint = 0; joint < used_.size(); ++joint)
      if (!used_[joint]) write_loop(out_.scene.joints[joint]);
  }

  void write_exclusions() {
    const Xml::Element contact(out_.xml, "contact");
    for (const SceneJoint& joint : out_.scene.joints) {
      if (!joint.body_a || joint.desc.collide_connected != 0) continue;
      const Xml::Element exclude(out_.xml, "exclude",
                                 {{"body1", name_of(*joint.body_a)}, {"body2", name_of(joint.body_b)}});
    }
  }

 private:
  [[nodiscard]] const PlumbBodyDesc& desc_of(std::size_t body) const { return out_.scene.bodies[body].desc; }
  [[nodiscard]] const std::string& name_of(std::size_t body) const { return out_.scene.bodies[body].name; }
  [[nodiscard]] Pose pose_of(std::size_t body) const { return upright().inverse() * referee::pose(desc_of(body).pose); }

  /// A joint and the body behind it, unless something else holds that already.
  void write_branch(std::size_t joint, std::size_t body, const Pose& around) {
    if (used_[joint] || written_[body] || desc_of(body).motion != PLUMB_DYNAMIC) return;
    used_[joint] = true;
    write_body(body, around, joint);
  }

  /// around: the pose of the body around it; joint: by which that holds it.
  void write_body(std::size_t body, const Pose& around, std::optional<std::size_t> joint) {
    written_[body] = true;
    const PlumbBodyDesc& desc = desc_of(body);
    Attributes attributes = {{"name", name_of(body)}};
    for (auto& attribute : mjcf_pose(pose_of(body).seen_from(around))) attributes.push_back(std::move(attribute));
    if (desc.motion == PLUMB_KINEMATIC) attributes.emplace_back("mocap", "true");
    if (desc.gravity_scale == 0) out_.remarks.add("that gravity does not pull it is left out", name_of(body));
    const Xml::Element element(out_.xml, "body", attributes);
    if (joint) {
      write_joint(out_.scene.joints[*joint], out_.scene.joints[*joint].body_b == body);
    } else if (desc.motion == PLUMB_DYNAMIC) {
      const Xml::Element free(out_.xml, "freejoint");
    }
    if (desc.motion == PLUMB_DYNAMIC) write_inertial(mass_of_body(out_.scene, body));
    write_geoms(out_, out_.scene.bodies[body]);
    remark_body(out_.scene.bodies[body], out_.remarks);
    if (desc.motion == PLUMB_KINEMATIC) return;  // nothing hangs on a mocap body
    for (std::size_t next = 0; next < used_.size(); ++next) {
      const SceneJoint& other = out_.scene.joints[next];
      if (other.body_a == body) write_branch(next, other.body_b, pose_of(body));
      if (other.body_b == body && other.body_a) write_branch(next, *other.body_a, pose_of(body));
    }
  }

  void write_inertial(const referee::Mass& mass) {
    const auto& i = mass.inertia;
    const Xml::Element inertial(
        out_.xml, "inertial",
        {{"pos", numbers_text({mass.centre.x(), mass.centre.y(), mass.centre.z()})},
         {"mass", numbers_text({mass.mass})},
         {"fullinertia", numbers_text({i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)})}});
  }

  /// forward: within body a is body b. The other way round coordinates count from b's axes to a's, and backwards.
  void write_joint(const SceneJoint& joint, bool forward) {
    remark_joint(joint, out_.remarks);
    const PlumbPose& own = forward ? joint.desc.frame_b : joint.desc.frame_a;
    const std::string anchor = numbers_text({own.position.x, own.position.y, own.position.z});
    if (joint.desc.type == PLUMB_JOINT_BALL || joint.desc.type == PLUMB_JOINT_SWING_TWIST) {
      const Xml::Element ball(out_.xml, "joint", {{"name", joint.name}, {"type", "ball"}, {"pos", anchor}});
      return;
    }
    std::vector<std::size_t> axes = free_axes(joint);
    if (std::count_if(axes.begin(), axes.end(), [](std::size_t axis) { return axis >= 3; }) > 1 &&
        joint.desc.type == PLUMB_JOINT_GENERIC)
      out_.remarks.add("several ways to turn are hinges in turn, whose angles are others", joint.name);
    if (!forward) std::reverse(axes.begin(), axes.end());
    for (const std::size_t axis : axes) write_axis(joint, axis, forward, anchor, axes.size() > 1);
  }

  void write_axis(const SceneJoint& joint, std::size_t axis, bool forward, const std::string& anchor,
                  bool one_of_many) {
    // The second axis of a universal joint is b's; all others are a's, which at the start may be others than b's.
    const Pose frame = axis == 4 && joint.desc.type == PLUMB_JOINT_UNIVERSAL ? frame_on_b(out_.scene, joint)
                                                                             : frame_on_a(out_.scene, joint);
    const Pose body = referee::pose(desc_of(forward ? joint.body_b : *joint.body_a).pose);
    const Vec3 direction =
        (forward ? 1.0 : -1.0) * (body.rotation.transpose() * frame.rotation.col(static_cast<int>(axis % 3)));
    Attributes attributes = {{"name", one_of_many ? fmt::format("{}/{}", joint.name, axis) : joint.name},
                             {"type", axis < 3 ? "slide" : "hinge"},
                             {"pos", anchor},
                             {"axis", numbers_text({direction.x(), direction.y(), direction.z()})}};
    const double start = start_of_joint(out_.scene, joint, axis);
    if (const PlumbLimit& limit = joint.desc.limits[axis]; limit.enabled != 0) {
      attributes.emplace_back("limited", "true");
      attributes.emplace_back("range", numbers_text({limit.lower - start, limit.upper - start}));
    }
    if (brakes(joint.desc.motors[axis]))
      attributes.emplace_back("frictionloss", numbers_text({joint.desc.motors[axis].max_force}));
    if (const PlumbSpring& spring = joint.desc.springs[axis]; springs_by_stiffness(spring)) {
      attributes.emplace_back("stiffness", numbers_text({spring.frequency}));
      attributes.emplace_back("damping", numbers_text({spring.damping_ratio}));
      attributes.emplace_back("springref", numbers_text({spring.rest - start}));
    }
    remark_axis(joint, axis, out_.remarks);
    const Xml::Element element(out_.xml, "joint", attributes);
  }

  void write_loop(const SceneJoint& joint) {
    remark_joint(joint, out_.remarks);
    Attributes ends = {{"body1", name_of(joint.body_b)}};
    if (joint.body_a) ends.emplace_back("body2", name_of(*joint.body_a));
    const Pose frame = referee::pose(joint.desc.frame_b);
    const auto write_connect = [&](const Vec3& at) {
      Attributes attributes = ends;
      attributes.emplace_back("anchor", numbers_text({at.x(), at.y(), at.z()}));
      const Xml::Element connect(out_.xml, "connect", attributes);
    };
    switch (joint.desc.type) {
      case PLUMB_JOINT_BALL:
      case PLUMB_JOINT_SWING_TWIST: return write_connect(frame.position);
      case PLUMB_JOINT_HINGE: {
        constexpr double kApart = 0.1;  // m: two points of the axis
        remark_axis(joint, 3, out_.remarks);
        if (joint.desc.limits[3].enabled != 0)
          out_.remarks.add("limits of what closes a loop are left out", joint.name);
        write_connect(frame.position);
        return write_connect(frame.position + kApart * frame.rotation.col(0));
      }
      case PLUMB_JOINT_FIXED: {
        const Xml::Element weld(out_.xml, "weld", ends);
        return;
      }
      default:
        throw UsageError(
            fmt::format("joint \"{}\" closes a loop or holds a kinematic body, which in MJCF only ball, "
                        "hinge and fixed joints can",
                        joint.name));
    }
  }

  MjcfOutput out_;
  std::vector<bool> written_, used_;  // bodies; joints that are a branch of the tree
};

}  // namespace

std::string write_mjcf(const Scene& scene, const std::string& name, Remarks& remarks) {
  Xml xml;
  {
    const Xml::Element model(xml, "mujoco", {{"model", name}});
    { const Xml::Element compiler(xml, "compiler", {{"angle", "radian"}}); }
    const Vec3 gravity = upright().inverse() * referee::vec(scene.gravity);
    {
      const Xml::Element option(
          xml, "option",
          {{"timestep", numbers_text({scene.dt})}, {"gravity", numbers_text({gravity.x(), gravity.y(), gravity.z()})}});
    }
    MjcfOutput out{scene, xml, remarks};
    {
      const Xml::Element asset(xml, "asset");
      write_meshes(out);
    }
    MjcfWriter writer(scene, xml, remarks);
    writer.write_world();
    writer.write_loops();
    writer.write_exclusions();
  }
  remark_host(scene, remarks);
  remark_materials(scene, remarks);
  return xml.str();
}

}  // namespace plumb::harness
