// What joints push with in a sub-step: links by MuJoCo's inverse dynamics, the others by the forces of their
// constraints.
#include "world.hpp"

namespace plumb::mujoco {
namespace {

struct Wrench {
  PlumbVec3 force{}, torque{};  ///< on b at frame b's origin
};

Wrench of_link(const Model& model, const Body& child) {
  const mjData* d = model.data.get();
  const mjtNum* told = d->cfrc_int + 6 * child.id;  // on the child, about the centre of mass of its tree
  const PlumbVec3 force = vec(told + 3), torque = vec(told);
  const Joint& link = *child.link;
  const Body& b = *link.b;
  const PlumbVec3 at = point_of(pose_in(*d, b), link.desc.frame_b.position);
  const double sign = child.reversed ? -1 : 1;
  const PlumbVec3 arm = sub(vec(d->subtree_com + 3 * child.root), at);
  return {scale(sign, force), scale(sign, add(torque, cross(arm, force)))};
}

/// The first row of a kind of constraint that belongs to the thing; -1: none.
int row_of(const mjData* d, int type, int id) {
  for (int row = 0; row < d->nefc; ++row)
    if (d->efc_type[row] == type && d->efc_id[row] == id) return row;
  return -1;
}

Wrench of_rod(const Model& model, const Joint& joint) {
  const mjModel* m = model.model.get();
  const mjData* d = model.data.get();
  const int t = joint.tendon;
  double push = 0;  // N that makes it longer
  if (const int row = joint.equality < 0 ? -1 : row_of(d, mjCNSTR_EQUALITY, joint.equality); row >= 0)
    push += d->efc_force[row];
  if (const int row = row_of(d, mjCNSTR_LIMIT_TENDON, t); row >= 0) {
    const bool at_upper = 2 * d->ten_length[t] > m->tendon_range[2 * t] + m->tendon_range[2 * t + 1];
    push += at_upper ? -d->efc_force[row] : d->efc_force[row];
  }
  push -= m->tendon_stiffness[t] * (d->ten_length[t] - m->tendon_lengthspring[2 * t]) +
          m->tendon_damping[t] * d->ten_velocity[t];
  const PlumbVec3 way = sub(joint.frame_b().position, joint.frame_a().position);
  return {length(way) > 0 ? scale(push / length(way), way) : PlumbVec3{}, {}};
}

/// A connect's three rows push its first body; that of a hinge has a second a metre along the axis.
Wrench of_loop(const Model& model, const Joint& joint) {
  const mjData* d = model.data.get();
  Wrench sum;
  for (int i = 0; i < (open_axes(joint.desc) == 0b001000 ? 2 : 1); ++i) {
    const int row = row_of(d, mjCNSTR_EQUALITY, joint.equality + i);
    if (row < 0) continue;
    const PlumbVec3 on_b = scale(-1, vec(d->efc_force + row));
    const PlumbVec3 arm = i == 0 ? PlumbVec3{} : rotate(joint.frame_b().orientation, {1, 0, 0});
    sum.force = add(sum.force, on_b);
    sum.torque = add(sum.torque, cross(arm, on_b));
  }
  return sum;
}

}  // namespace

void World::gather_reactions(double share) {
  bool wanted = needs(PLUMB_NEED_JOINT_REACTIONS);
  for (const auto& joint : joints_) wanted = wanted || (joint && joint->may_break());
  if (!wanted) return;
  mj_rnePostConstraint(model_.model.get(), model_.data.get());
  const auto take = [share](Joint& joint, const Wrench& wrench) {
    joint.force = add(joint.force, scale(share, wrench.force));
    joint.torque = add(joint.torque, scale(share, wrench.torque));
  };
  for (const Body* body : model_.bodies)
    if (body != nullptr && body->link != nullptr) take(*body->link, of_link(model_, *body));
  for (const auto& joint : joints_) {
    if (!joint || joint->is_link) continue;
    if (joint->tendon >= 0)
      take(*joint, of_rod(model_, *joint));
    else if (joint->equality >= 0)
      take(*joint, of_loop(model_, *joint));
  }
}

}  // namespace plumb::mujoco
