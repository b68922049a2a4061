// What moves, between bodies and MuJoCo's coordinates: of free bodies as they are, of those in trees along the free
// axes of their joints.
#include <cmath>

#include "plumb/backend/joint_coordinates.hpp"
#include "world.hpp"

namespace plumb::mujoco {
namespace {

/// x that brings J x nearest to r; columns of J: 6 numbers each. By the normal equations, of which the diagonal is
/// raised a little where columns coincide.
std::vector<double> least_squares(const std::vector<std::array<double, 6>>& columns, const std::array<double, 6>& r) {
  const std::size_t n = columns.size();
  const auto product = [](const std::array<double, 6>& a, const std::array<double, 6>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < 6; ++k) sum += a[k] * b[k];
    return sum;
  };
  std::vector<std::vector<double>> a(n, std::vector<double>(n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) a[i][k] = product(columns[i], columns[k]);
    a[i][i] *= 1 + 1e-12;
    a[i][n] = product(columns[i], r);
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      if (k == i || a[i][i] == 0) continue;
      const double share = a[k][i] / a[i][i];
      for (std::size_t c = i; c <= n; ++c) a[k][c] -= share * a[i][c];
    }
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = a[i][i] == 0 ? 0 : a[i][n] / a[i][i];
  return x;
}

}  // namespace

PlumbPose pose_in(const mjData& data, const Body& body) {
  const PlumbQuat turn = quat(data.xquat + 4 * body.id);
  return {sub(vec(data.xpos + 3 * body.id), rotate(turn, body.shift)), turn};
}

void World::prepare() {
  if (stale_) {
    const Tree tree = grow_tree(bodies_, joints_);
    model_ = {};
    model_ = make_model(tree, joints_, settings_, needs_);
    put(gravity_, model_.model->opt.gravity);
    apart_.clear();
    for (const auto& joint : joints_)
      if (joint && joint->a != nullptr && joint->desc.collide_connected == 0)
        apart_.insert(in_order(*joint->a, *joint->b));
    stale_ = false;
  }
  write_state();
}

void World::write_state() {
  mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  std::set<int> touched;  // roots of the trees in which something was written
  for (const Body* body : model_.bodies)
    if (body != nullptr && body->written) touched.insert(body->root);
  if (touched.empty()) return;
  const auto each = [&](auto&& act) {
    for (Body* body : model_.bodies)
      if (body != nullptr && touched.contains(body->root)) act(*body);
  };
  each([&](Body& body) {
    if (body.is(PLUMB_STATIC)) {
      put(body.pose.position, m->body_pos + 3 * body.id);
      put(body.pose.orientation, m->body_quat + 4 * body.id);
    } else if (body.link == nullptr) {
      write_free(body);
    } else {
      write_coordinates(body);
    }
  });
  mj_kinematics(m, d);
  mj_comPos(m, d);
  each([&](Body& body) {
    if (body.link != nullptr) write_rates(body);
    body.written = false;
  });
}

void World::write_free(const Body& body) {
  mjData* d = model_.data.get();
  mjtNum* qpos = d->qpos + model_.model->jnt_qposadr[body.first_joint];
  mjtNum* qvel = d->qvel + model_.first_dof(body);
  const auto [velocity, spin] = body.free_velocity();
  put(point_of(body.pose, body.shift), qpos);
  put(body.pose.orientation, qpos + 3);
  put(velocity, qvel);
  put(unrotate(body.pose.orientation, spin), qvel + 3);
}

void World::write_coordinates(const Body& body) {
  mjData* d = model_.data.get();
  const Joint& link = *body.link;
  const PlumbPose a = link.frame_a(), b = link.frame_b();
  double row[6];
  backend::joint_coordinates(link.desc.type, a, b, row);
  for (std::size_t axis = 0; axis < 6; ++axis)
    if (link.axis_joint[axis] >= 0) d->qpos[model_.model->jnt_qposadr[link.axis_joint[axis]]] = row[axis];
  if (is_plain_ball(link.desc)) {
    // In the child's own axes: its turn from where it is when the frames lie on each other.
    const int last = body.first_joint + (body.reversed ? 0 : body.joint_count - 1);
    const PlumbQuat seen = multiply(backend::conjugate(a.orientation), b.orientation);
    const PlumbQuat& own = body.reversed ? link.desc.frame_a.orientation : link.desc.frame_b.orientation;
    const PlumbQuat turn = body.reversed ? backend::conjugate(seen) : seen;
    put(multiply(multiply(own, turn), backend::conjugate(own)), d->qpos + model_.model->jnt_qposadr[last]);
  }
}

/// Parents come first: what of the body's velocity is not theirs is that of its own joints.
void World::write_rates(const Body& body) {
  mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  const int first = model_.first_dof(body), count = m->body_dofnum[body.id];
  if (count == 0) return;
  const auto dofs = static_cast<std::size_t>(m->nv);
  std::vector<mjtNum> jacobian(6 * dofs);
  mj_jacBodyCom(m, d, jacobian.data(), jacobian.data() + 3 * dofs, body.id);
  for (int i = 0; i < count; ++i) d->qvel[first + i] = 0;
  std::array<double, 6> left = {body.velocity.x, body.velocity.y, body.velocity.z,
                                body.spin.x,     body.spin.y,     body.spin.z};
  std::vector<std::array<double, 6>> columns(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < 6; ++k) {
    left[k] -= mju_dot(jacobian.data() + k * dofs, d->qvel, m->nv);
    for (std::size_t i = 0; i < columns.size(); ++i)
      columns[i][k] = jacobian[k * dofs + static_cast<std::size_t>(first) + i];
  }
  const std::vector<double> rates = least_squares(columns, left);
  std::copy(rates.begin(), rates.end(), d->qvel + first);
}

void World::read_state() {
  mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_comVel(m, d);
  for (Body* body : model_.bodies) {
    if (body == nullptr || !body->is(PLUMB_DYNAMIC)) continue;
    body->pose = pose_in(*d, *body);
    mjtNum velocity[6];
    mj_objectVelocity(m, d, mjOBJ_BODY, body->id, velocity, 0);
    body->spin = vec(velocity);
    body->velocity = vec(velocity + 3);
  }
}

/// J^T p = M dv, of the tree as it stands.
void World::push_tree(const Body& body, const PlumbVec3& impulse, const PlumbVec3& twist) {
  mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_crb(m, d);
  mj_factorM(m, d);
  std::vector<mjtNum> push(static_cast<std::size_t>(m->nv)), change(push.size());
  const mjtNum linear[3] = {impulse.x, impulse.y, impulse.z}, angular[3] = {twist.x, twist.y, twist.z};
  mj_applyFT(m, d, linear, angular, d->xipos + 3 * body.id, body.id, push.data());
  mj_solveM(m, d, change.data(), push.data(), 1);
  mju_addTo(d->qvel, change.data(), m->nv);
  read_state();
}

}  // namespace plumb::mujoco
