#include "convert/mjcf/mjcf_joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "convert/upright.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;

struct Dof {
  int joint;
  bool turns;
  double start;            ///< its coordinate there
  Vec3 direction, anchor;  ///< world
};

/// The most that motors of a joint give; infinite where one is not bounded, or none is there.
double effort_of(const mjModel& model, int joint) {
  double effort = 0;
  for (int i = 0; i < model.nu; ++i) {
    if (model.actuator_trntype[i] != mjTRN_JOINT || model.actuator_trnid[2 * i] != joint) continue;
    const auto most = [&](const mjtNum* range) { return std::max(std::abs(range[2 * i]), std::abs(range[2 * i + 1])); };
    const double gear = std::abs(model.actuator_gear[6 * i]);
    if (model.actuator_forcelimited[i] != 0)
      effort += gear * most(model.actuator_forcerange);
    else if (model.actuator_ctrllimited[i] != 0 && model.actuator_biastype[i] == mjBIAS_NONE)
      effort += gear * model.actuator_gainprm[mjNGAIN * i] * most(model.actuator_ctrlrange);
    else
      return std::numeric_limits<double>::infinity();
  }
  return effort > 0 ? effort : std::numeric_limits<double>::infinity();
}

/// sign: -1 where the scene's axis points the other way.
JointAxis axis_of(const mjModel& model, const Dof& dof, double sign, const std::string& name, Remarks& remarks) {
  const int at = model.jnt_dofadr[dof.joint];
  JointAxis axis;
  axis.direction = dof.direction;
  axis.friction = model.dof_frictionloss[at];
  axis.effort = effort_of(model, dof.joint);
  if (model.jnt_limited[dof.joint] != 0) {
    const double low = model.jnt_range[2 * dof.joint] - dof.start,
                 high = model.jnt_range[2 * dof.joint + 1] - dof.start;
    axis.limits = sign > 0 ? std::array{low, high} : std::array{-high, -low};
  }
  axis.damping = model.dof_damping[at];
  axis.stiffness = model.jnt_stiffness[dof.joint];
  axis.rest = sign * (model.qpos_spring[model.jnt_qposadr[dof.joint]] - dof.start);
  if (model.dof_armature[at] != 0) remarks.add("armature of joints is left out", name);
  return axis;
}

/// Directions of a frame, found one by one; which of them a direction is, and whether it points the other way.
class Frame {
 public:
  struct Place {
    std::size_t axis;
    double sign;
  };
  std::optional<Place> find_or_add(const Vec3& direction) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const double along = axes_[i].dot(direction);
      if (std::abs(along) > 1 - 1e-6) return Place{i, along > 0 ? 1.0 : -1.0};
      if (std::abs(along) > 1e-3) return std::nullopt;
    }
    if (axes_.size() == 3) return std::nullopt;
    axes_.push_back(direction);
    // The third closes a right-handed frame.
    if (axes_.size() == 3 && axes_[0].cross(axes_[1]).dot(direction) < 0) {
      axes_[2] = -direction;
      return Place{2, -1};
    }
    return Place{axes_.size() - 1, 1};
  }
  [[nodiscard]] Pose at(const Vec3& origin) const {
    return frame_of(origin, axes_[0], axes_.size() > 1 ? axes_[1] : Vec3::Zero());
  }

 private:
  std::vector<Vec3> axes_;
};

std::vector<Dof> dofs_of(const mjModel& model, const mjData& start, int body) {
  std::vector<Dof> dofs;
  for (int i = 0; i < model.body_jntnum[body]; ++i) {
    const int joint = model.body_jntadr[body] + i;
    dofs.push_back({joint, model.jnt_type[joint] == mjJNT_HINGE, start.qpos[model.jnt_qposadr[joint]],
                    (upright().rotation * vec_at(start.xaxis, joint)).normalized(),
                    upright() * vec_at(start.xanchor, joint)});
  }
  return dofs;
}

void add_ball(const mjModel& model, const Dof& dof, const MjcfEnds& ends, const std::string& name, Imported& imported) {
  if (model.jnt_limited[dof.joint] != 0) imported.remarks.add("limits of ball joints are left out", name);
  if (model.dof_damping[model.jnt_dofadr[dof.joint]] != 0)
    imported.remarks.add("damping of ball joints is left out", name);
  Pose frame;
  frame.position = dof.anchor;
  add_joint(imported, name, {PLUMB_JOINT_BALL, ends.parent, ends.child, frame}, {});
}

/// The second axis of two that turn is fixed in the child, as MuJoCo has it.
void add_two_hinges(const mjModel& model, const std::vector<Dof>& dofs, const MjcfEnds& ends, const std::string& name,
                    Imported& imported) {
  if (std::abs(dofs[0].direction.dot(dofs[1].direction)) > 1e-6)
    imported.remarks.add("two axes that are not square to each other are made so", name);
  const Pose frame = frame_of(dofs[0].anchor, dofs[0].direction, dofs[1].direction);
  add_joint(imported, name, {PLUMB_JOINT_UNIVERSAL, ends.parent, ends.child, frame},
            {axis_of(model, dofs[0], 1, name, imported.remarks), axis_of(model, dofs[1], 1, name, imported.remarks)});
}

/// Up to three ways to slide and three to turn along three directions.
void add_generic(const mjModel& model, const std::vector<Dof>& dofs, const MjcfEnds& ends, const std::string& name,
                 Imported& imported) {
  Frame frame;
  std::array<std::optional<JointAxis>, 6> axes;
  for (const Dof& dof : dofs) {
    const auto place = frame.find_or_add(dof.direction);
    const std::size_t axis = place ? place->axis + (dof.turns ? 3 : 0) : 0;
    if (!place || axes[axis])
      throw UsageError(
          fmt::format("body \"{}\" has joints about directions that are neither square to each other nor the same, "
                      "which scenes lack",
                      name));
    axes[axis] = axis_of(model, dof, place->sign, name, imported.remarks);
  }
  if (std::count_if(dofs.begin(), dofs.end(), [](const Dof& dof) { return dof.turns; }) > 1)
    imported.remarks.add("three ways to turn are one joint, whose angles are not those of three hinges in turn", name);
  add_joint(imported, name, {PLUMB_JOINT_GENERIC, ends.parent, ends.child, frame.at(dofs.front().anchor), 0}, {});
  SceneJoint& joint = imported.scene.joints.back();
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    joint.desc.axis_modes[axis] = PLUMB_AXIS_LOCKED;
    if (axes[axis]) {
      joint.desc.axis_modes[axis] = axes[axis]->limits ? PLUMB_AXIS_LIMITED : PLUMB_AXIS_FREE;
      set_axis(imported, axis, *axes[axis]);
    }
  }
}

}  // namespace

void add_joints(const mjModel& model, const mjData& start, int body, const MjcfEnds& ends, Imported& imported) {
  const std::vector<Dof> dofs = dofs_of(model, start, body);
  if (dofs.empty() || model.jnt_type[dofs.front().joint] == mjJNT_FREE) return;
  const std::string name = scene_name(name_of(model, mjOBJ_JOINT, dofs.front().joint, "joint"));
  const bool meet = std::all_of(dofs.begin(), dofs.end(), [&](const Dof& dof) {
    return !dof.turns || (dof.anchor - dofs.front().anchor).norm() < 1e-6 * (1 + dof.anchor.norm());
  });
  if (!meet) imported.remarks.add("axes of one body that do not meet are moved to the first one's anchor", name);
  const bool ball =
      std::any_of(dofs.begin(), dofs.end(), [&](const Dof& dof) { return model.jnt_type[dof.joint] == mjJNT_BALL; });
  if (ball && dofs.size() > 1)
    throw UsageError(fmt::format("body \"{}\" has a ball joint and others, which scenes lack", name));
  if (ball) {
    add_ball(model, dofs.front(), ends, name, imported);
  } else if (dofs.size() == 1) {
    const bool turns = dofs.front().turns;
    const PlumbJointType type = turns ? PLUMB_JOINT_HINGE : PLUMB_JOINT_SLIDER;
    add_joint(imported, name,
              {type, ends.parent, ends.child, frame_of(dofs.front().anchor, dofs.front().direction), turns ? 3U : 0U},
              {axis_of(model, dofs.front(), 1, name, imported.remarks)});
  } else if (dofs.size() == 2 && dofs[0].turns && dofs[1].turns) {
    add_two_hinges(model, dofs, ends, name, imported);
  } else {
    add_generic(model, dofs, ends, name, imported);
  }
}

void add_equalities(const mjModel& model, const std::vector<Pose>& poses,
                    const std::vector<std::optional<std::size_t>>& bodies, Imported& imported) {
  for (int i = 0; i < model.neq; ++i) {
    const std::string name = scene_name(name_of(model, mjOBJ_EQUALITY, i, "equality"));
    const bool connect = model.eq_type[i] == mjEQ_CONNECT;
    if (model.eq_active[i] == 0) continue;
    if (!connect && model.eq_type[i] != mjEQ_WELD) {
      imported.remarks.add("couplings of joints and tendons are left out", name);
      continue;
    }
    const int first = model.eq_obj1id[i], second = model.eq_obj2id[i];
    std::optional<std::size_t> a = bodies[static_cast<std::size_t>(first)],
                               b = bodies[static_cast<std::size_t>(second)];
    if (!b) std::swap(a, b);
    if (a == b || !b) continue;
    Pose frame;
    const Pose& pose = poses[static_cast<std::size_t>(first)];
    frame.position = connect ? pose * Vec3(vec_at(model.eq_data + mjNEQDATA * i, 0)) : pose.position;
    add_joint(imported, name, {connect ? PLUMB_JOINT_BALL : PLUMB_JOINT_FIXED, a, *b, frame}, {});
  }
}

}  // namespace plumb::harness
