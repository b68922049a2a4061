// The step: MuJoCo's own, phase by phase, with our contacts' materials and motors' speeds put in between.
#include <cmath>

#include "world.hpp"

namespace plumb::mujoco {
namespace {

/// By a vector of axis times angle, world axes.
PlumbQuat turned(const PlumbQuat& q, const PlumbVec3& by) {
  const double angle = length(by), half = angle == 0 ? 0.5 : std::sin(angle / 2) / angle;
  return normalized(multiply({half * by.x, half * by.y, half * by.z, std::cos(angle / 2)}, q));
}

}  // namespace

World::World(const WorldInit& init)
    : needs_(init.desc.needs), settings_(settings_table().values(init)), gravity_(init.desc.gravity) {
  install_handlers();
}

PlumbResult World::set_gravity(const PlumbVec3& gravity) {
  gravity_ = gravity;
  if (model_.model) put(gravity, model_.model->opt.gravity);
  return PLUMB_OK;
}

PlumbResult World::step(double dt) {
  prepare();
  events_.clear();
  events_.swap(pending_events_);
  impulses_.clear();
  grew_ = false;
  forget_forces();
  const double h = dt / settings_.substeps;
  model_.model->opt.timestep = h;
  steer_kinematics(dt);
  for (sub_step_ = 0; sub_step_ < settings_.substeps; ++sub_step_) sub_step(h);
  settle_kinematics();
  read_state();
  finish_contacts();
  break_joints();
  finish_events();
  return PLUMB_OK;
}

void World::forget_forces() {
  for (const auto& joint : joints_)
    if (joint) joint->force = joint->torque = {};
}

void World::steer_kinematics(double dt) {
  for (Body* body : model_.bodies) {
    if (body == nullptr || !body->is(PLUMB_KINEMATIC)) continue;
    if (body->moving == Body::Moving::to_target) {
      const PlumbQuat turn = multiply(body->target.orientation, backend::conjugate(body->pose.orientation));
      body->velocity = scale(1 / dt, sub(body->target.position, body->pose.position));
      body->spin = scale(1 / dt, backend::rotation_vector(turn));
    } else if (body->moving == Body::Moving::arrived) {
      body->velocity = body->spin = {};
      body->moving = Body::Moving::as_told;
    }
  }
}

/// MuJoCo takes them for very heavy bodies; where they are, and how fast, is ours.
void World::move_kinematics(double h) {
  for (Body* body : model_.bodies) {
    if (body == nullptr || !body->is(PLUMB_KINEMATIC)) continue;
    body->pose = {add(body->pose.position, scale(h, body->velocity)),
                  turned(body->pose.orientation, scale(h, body->spin))};
    write_free(*body);
  }
}

void World::settle_kinematics() {
  for (Body* body : model_.bodies) {
    if (body == nullptr || body->moving != Body::Moving::to_target) continue;
    body->pose = body->target;
    body->moving = Body::Moving::arrived;
    write_free(*body);
  }
  for (const auto& body : bodies_)
    if (body) body->force = body->torque = {};
}

/// MuJoCo's gyroscopic torque is that of the sub-step's beginning, and a tumbling body gains by it: at half a radian an
/// eighth in every sub-step, without end. From there on it turns without that torque, and gains nothing.
bool World::is_fast(const Body& body, double h) const {
  if (body.link != nullptr || (body.desc.flags & PLUMB_BODY_NO_ROTATION) != 0) return false;
  constexpr double most = 0.5;  // rad
  return length(vec(model_.data->qvel + model_.first_dof(body) + 3)) * h > most;
}

/// The host's forces, gravity that is scaled, and damping, as a force that gives exp(-c h) whatever c is.
void World::apply_forces(double h) {
  mjData* d = model_.data.get();
  for (const Body* body : model_.bodies) {
    if (body == nullptr || body->is(PLUMB_STATIC)) continue;
    mjtNum* applied = d->xfrc_applied + 6 * body->id;
    if (body->is(PLUMB_KINEMATIC)) {
      put(scale(-model_.model->body_mass[body->id], gravity_), applied);
      continue;
    }
    const PlumbBodyDesc& desc = body->desc;
    PlumbVec3 force = add(body->force, scale((desc.gravity_scale - 1) * desc.mass, gravity_)), torque = body->torque;
    const bool damped = desc.linear_damping != 0 || desc.angular_damping != 0, fast = is_fast(*body, h);
    if (damped || fast) {
      mjtNum v[6];
      mj_objectVelocity(model_.model.get(), d, mjOBJ_BODY, body->id, v, 0);
      const PlumbQuat axes = multiply(quat(d->xquat + 4 * body->id), desc.inertia_orientation);
      const PlumbVec3 w = unrotate(axes, vec(v)), &i = desc.inertia, spin = {i.x * w.x, i.y * w.y, i.z * w.z};
      const auto rate = [h](double c) { return -(1 - std::exp(-c * h)) / h; };
      force = add(force, scale(rate(desc.linear_damping) * desc.mass, vec(v + 3)));
      torque = add(torque, rotate(axes, scale(rate(desc.angular_damping), spin)));
      if (fast) torque = add(torque, rotate(axes, cross(w, spin)));
    }
    put(force, applied);
    put(torque, applied + 3);
  }
}

/// Where MuJoCo has no room it is done again with more: all that the sub-step begins with is kept.
void World::sub_step(double h) {
  mjModel* m = model_.model.get();
  const auto copy = [](const mjtNum* from, int count) { return std::vector<mjtNum>(from, from + count); };
  const auto qpos = copy(model_.data->qpos, m->nq), qvel = copy(model_.data->qvel, m->nv),
             warm = copy(model_.data->qacc_warmstart, m->nv);
  for (;;) {
    mjData* d = model_.data.get();
    std::copy(qpos.begin(), qpos.end(), d->qpos);
    std::copy(qvel.begin(), qvel.end(), d->qvel);
    std::copy(warm.begin(), warm.end(), d->qacc_warmstart);
    bool room = true;
    try {
      solve_sub_step();
    } catch (const MujocoError& error) {
      if (std::string_view(error.what()).find("stack") == std::string_view::npos)
        throw Error(PLUMB_E_WORLD_LOST, std::string("MuJoCo: ") + error.what() + "; destroy the world");
      room = false;
    }
    if (room && d->warning[mjWARN_CONTACTFULL].number == 0 && d->warning[mjWARN_CNSTRFULL].number == 0) break;
    grow_data(model_);
    grew_ = true;
  }
  const std::span<const mjContact> found(model_.data->contact, static_cast<std::size_t>(model_.data->ncon));
  contact_count_ = static_cast<std::uint32_t>(
      std::count_if(found.begin(), found.end(), [](const mjContact& contact) { return contact.efc_address >= 0; }));
  if (needs(PLUMB_NEED_CONTACTS | PLUMB_NEED_EVENTS)) gather_impulses(h);
  gather_reactions(1.0 / settings_.substeps);
  mj_Euler(m, model_.data.get());
  hold_locks(h);
  move_kinematics(h);
}

/// One or two turns about the world's axes that are taken away: MuJoCo turns bodies about their own.
void World::hold_locks(double h) {
  constexpr std::uint32_t turns = PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Y | PLUMB_LOCK_ANGULAR_Z;
  mjData* d = model_.data.get();
  for (const Body* body : model_.bodies) {
    if (body == nullptr || !body->is(PLUMB_DYNAMIC) || (body->desc.flags & PLUMB_BODY_NO_ROTATION) != 0) continue;
    const std::uint32_t locks = body->desc.locks & turns;
    if (locks == 0 || locks == turns) continue;
    mjtNum* qpos = d->qpos + model_.model->jnt_qposadr[body->first_joint];
    mjtNum* qvel = d->qvel + model_.first_dof(*body);
    PlumbVec3 spin = rotate(quat(qpos + 3), vec(qvel + 3));
    if ((locks & PLUMB_LOCK_ANGULAR_X) != 0) spin.x = 0;
    if ((locks & PLUMB_LOCK_ANGULAR_Y) != 0) spin.y = 0;
    if ((locks & PLUMB_LOCK_ANGULAR_Z) != 0) spin.z = 0;
    const PlumbQuat now = turned(quat(d->xquat + 4 * body->id), scale(h, spin));  // from where the sub-step began
    put(now, qpos + 3);
    put(unrotate(now, spin), qvel + 3);
  }
}

/// As mj_forward, whose phases these are.
void World::solve_sub_step() {
  mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  const double h = m->opt.timestep;
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_tendon(m, d);
  mj_crb(m, d);
  mj_factorM(m, d);
  mj_collision(m, d);
  judge_contacts(h);
  mj_makeConstraint(m, d);
  mj_transmission(m, d);
  mj_projectConstraint(m, d);
  mj_fwdVelocity(m, d);
  apply_forces(h);
  drive_motors();
  drive_surfaces();
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  mj_fwdConstraint(m, d);
}

/// A motor is dry friction against a speed that is not 0: no more force than it may have.
void World::drive_motors() {
  const mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  for (const auto& joint : joints_) {
    if (!joint || !joint->is_link) continue;
    for (std::size_t axis = 0; axis < 6; ++axis) {
      if (joint->axis_joint[axis] < 0 || joint->desc.motors[axis].enabled == 0) continue;
      const int dof = m->jnt_dofadr[joint->axis_joint[axis]];
      for (int row = d->ne; row < d->ne + d->nf; ++row)
        if (d->efc_type[row] == mjCNSTR_FRICTION_DOF && d->efc_id[row] == dof)
          d->efc_aref[row] += d->efc_KBIP[4 * row + 1] * joint->desc.motors[axis].target_velocity;
    }
  }
}

PlumbResult World::wait(PlumbStepReport& report) {
  report.contacts = contact_count_;
  if (grew_) report.remarks |= PLUMB_REMARK_CAPACITY_GREW;
  for (const auto& body : bodies_) {
    if (!body || !body->is(PLUMB_DYNAMIC)) continue;
    ++report.awake;
    const PlumbPose& pose = body->pose;
    const PlumbVec3 sum = add(add(pose.position, body->velocity), body->spin);
    if (!std::isfinite(sum.x + sum.y + sum.z + pose.orientation.x + pose.orientation.w)) ++report.nonfinite;
  }
  return PLUMB_OK;
}

void World::break_joints() {
  for (const auto& joint : joints_) {
    if (!joint || !joint->may_break()) continue;
    const PlumbJointDesc& desc = joint->desc;
    const bool pulled = desc.break_force > 0 && length(joint->force) > desc.break_force;
    const bool bent = desc.break_torque > 0 && length(joint->torque) > desc.break_torque;
    if (pulled || bent) events_.push_back({PLUMB_EVENT_JOINT_BROKEN, 0, desc.body_a, desc.body_b, joint->handle});
  }
  for (const PlumbEvent& event : events_) {
    if (event.type != PLUMB_EVENT_JOINT_BROKEN) continue;
    joints_[slot_of(event.joint)].reset();
    stale_ = true;
  }
}

void World::finish_events() {
  touches_.finish_step(events_);
  backend::sort_events(events_);
}

PlumbResult World::get_setting(const char* name, PlumbSettingValue& value) {
  value = settings_table().get(settings_, name);
  return PLUMB_OK;
}

PlumbResult World::set_setting(const char* name, const PlumbSettingValue& value) {
  settings_table().set(settings_, name, value);
  if (model_.model) apply_to_model(settings_, needs(PLUMB_NEED_ROLLING_FRICTION), *model_.model);
  return PLUMB_OK;
}

}  // namespace plumb::mujoco
