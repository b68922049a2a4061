// Making and unmaking: the world, shapes, bodies and their rows, joints.
#include "world.hpp"

#include <algorithm>
#include <string>

namespace plumb::ode {
namespace {

/// Geoms that never move are not asked about each other.
constexpr unsigned long still_bit = 1, moving_bit = 2;

template <class Pointer, class Object>
void erase(std::vector<Pointer>& list, const Object* object) {
  list.erase(std::remove(list.begin(), list.end(), object), list.end());
}

template <class Object>
void put(std::vector<std::unique_ptr<Object>>& slots, std::uint64_t handle, std::unique_ptr<Object> object) {
  const std::uint32_t slot = slot_of(handle);
  if (slot >= slots.size()) slots.resize(slot + 1);
  slots[slot] = std::move(object);
}

PlumbPose pose_of(const double* row) { return {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}}; }

void put_vec(const PlumbVec3& v, double* row) {
  row[0] = v.x;
  row[1] = v.y;
  row[2] = v.z;
}

void put_pose(const PlumbVec3& position, const PlumbQuat& q, double* row) {
  put_vec(position, row);
  row[3] = q.x;
  row[4] = q.y;
  row[5] = q.z;
  row[6] = q.w;
}

dWorldID create_ode_world() {
  ensure_ode();
  return dWorldCreate();
}

}  // namespace

World::World(const WorldInit& init)
    : init_(init),
      settings_(init),
      gravity_(init.desc.gravity),
      world_(create_ode_world()),
      contacts_(init_, world_),
      seed_(static_cast<unsigned long>(settings_.random_seed)) {
  inside_ode([&] {
    dWorldSetGravity(world_, gravity_.x, gravity_.y, gravity_.z);
    apply_to_world(settings_, world_);
    contacts_.configure(settings_);
    if (init_.needs(PLUMB_NEED_COLLISION) || init_.needs(PLUMB_NEED_SENSORS) || init_.needs(PLUMB_NEED_QUERIES))
      space_ = make_space(settings_);
    if (settings_.threads > 1) {
      const auto threads = static_cast<unsigned>(settings_.threads);
      threading_ = dThreadingAllocateMultiThreadedImplementation();
      pool_ = dThreadingAllocateThreadPool(threads, 0, static_cast<unsigned>(dAllocateFlagBasicData), nullptr);
      dThreadingThreadPoolServeMultiThreadedImplementation(pool_, threading_);
      dWorldSetStepIslandsProcessingMaxThreadCount(world_, threads);
      dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_), threading_);
    }
  });
}

World::~World() {
  if (!usable_) {
    // ODE was left in the middle of something; taking it apart would only find that out with an abort.
    for (auto& shape : shapes_) (void)shape.release();
    return;
  }
  const ErrorScope scope(init_);
  if (threading_ != nullptr) {
    dThreadingImplementationShutdownProcessing(threading_);
    dThreadingFreeThreadPool(pool_);
    dWorldSetStepThreadingImplementation(world_, nullptr, nullptr);
    dThreadingFreeImplementation(threading_);
  }
  contacts_.destroy();
  if (space_ != nullptr) dSpaceDestroy(space_);  // and its geoms
  dWorldDestroy(world_);                         // and its bodies and joints
}

PlumbResult World::set_gravity(const PlumbVec3& gravity) {
  gravity_ = gravity;
  dWorldSetGravity(world_, gravity.x, gravity.y, gravity.z);
  return PLUMB_OK;
}

// --- shapes ----------------------------------------------------------------------------------------------------------

PlumbResult World::create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) {
  return inside_ode([&] {
    std::vector<std::unique_ptr<Shape>> made;
    for (const PlumbShapeDesc& desc : descs) {
      std::vector<const Shape*> children;
      for (std::uint32_t i = 0; desc.type == PLUMB_COMPOUND && i < desc.child_count; ++i)
        children.push_back(shapes_[slot_of(desc.children[i].shape)].get());
      made.push_back(make_shape(desc, std::move(children)));
    }
    for (std::size_t i = 0; i < made.size(); ++i) put(shapes_, ids[i], std::move(made[i]));
    return PLUMB_OK;
  });
}

PlumbResult World::destroy_shapes(std::span<const PlumbShape> ids) {
  for (const PlumbShape id : ids) shapes_[slot_of(id)].reset();
  return PLUMB_OK;
}

// --- bodies ----------------------------------------------------------------------------------------------------------

PlumbResult World::create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) {
  return inside_ode([&] {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      put(bodies_, ids[i], make_body(descs[i], ids[i]));
      enlist(body(ids[i]));
    }
    return PLUMB_OK;
  });
}

PlumbResult World::destroy_bodies(std::span<const PlumbBody> ids) {
  return inside_ode([&] {
    for (const PlumbBody id : ids) {
      strike_off(body(id));
      dismantle(body(id));
      bodies_[slot_of(id)].reset();
    }
    return PLUMB_OK;
  });
}

std::unique_ptr<Body> World::make_body(const PlumbBodyDesc& desc, PlumbBody handle) {
  auto body = std::make_unique<Body>();
  body->handle = handle;
  body->motion = desc.motion;
  body->sensor = (desc.flags & PLUMB_BODY_SENSOR) != 0;
  body->shape = desc.shape == 0 ? nullptr : shapes_[slot_of(desc.shape)].get();
  body->material = desc.material;
  body->filter = desc.filter;
  body->gravity_scale = desc.gravity_scale;
  if (desc.motion != PLUMB_STATIC) body->body = dBodyCreate(world_);
  if (desc.motion == PLUMB_KINEMATIC) {
    dBodySetKinematic(body->body);
    dBodySetGravityMode(body->body, 0);
    dBodySetFiniteRotationMode(body->body, 1);
  }
  if (desc.motion == PLUMB_DYNAMIC) {
    set_mass(*body, desc);
    body->linear_damping = desc.linear_damping;
    body->angular_damping = desc.angular_damping;
    body->locks = desc.locks;
  }
  make_body_geoms(*body);
  body->set_frame(desc.pose);
  body->set_velocity(desc.linear_velocity, desc.angular_velocity);
  if (desc.motion != PLUMB_DYNAMIC) return body;
  apply_body_settings(*body);
  body->wake();
  if (substep_ != 0 && (body->linear_damping != 0 || body->angular_damping != 0)) set_damping(*body, substep_);
  if (body->locks != 0) make_locks(*body, world_);
  const bool sleeps = init_.needs(PLUMB_NEED_SLEEPING) && (desc.flags & PLUMB_BODY_NEVER_SLEEPS) == 0;
  dBodySetAutoDisableFlag(body->body, sleeps ? 1 : 0);
  if ((desc.flags & PLUMB_BODY_ASLEEP) != 0) dBodyDisable(body->body);
  body->was_awake = !body->asleep();
  return body;
}

void World::make_body_geoms(Body& body) {
  if (space_ == nullptr || body.shape == nullptr) return;
  std::vector<PlacedGeom> placed;
  make_geoms(*body.shape, space_, placed);
  for (const PlacedGeom& geom : placed) {
    body.geoms.push_back(std::make_unique<GeomTag>());
    GeomTag& tag = *body.geoms.back();
    tag.placed = geom;
    if (geom.material != nullptr) tag.own_material = *geom.material;
    dGeomSetData(geom.geom, &tag);
    dGeomSetCategoryBits(geom.geom, body.body == nullptr ? still_bit : moving_bit);
    dGeomSetCollideBits(geom.geom, body.body == nullptr ? moving_bit : still_bit | moving_bit);
    if (body.body == nullptr) continue;
    dGeomSetBody(geom.geom, body.body);
    offset_geom(geom, body.centre_of_mass);
  }
  refresh_tags(body);
}

void World::apply_body_settings(Body& body) {
  if (body.turns) {
    dBodySetGyroscopicMode(body.body, settings_.gyroscopic && init_.needs(PLUMB_NEED_GYROSCOPIC) ? 1 : 0);
    dBodySetFiniteRotationMode(body.body, settings_.finite_rotation ? 1 : 0);
  }
  dBodySetAutoDisableLinearThreshold(body.body, settings_.sleep_linear);
  dBodySetAutoDisableAngularThreshold(body.body, settings_.sleep_angular);
  dBodySetAutoDisableSteps(body.body, settings_.sleep_steps);
  dBodySetAutoDisableTime(body.body, settings_.sleep_time);
}

void World::enlist(Body& body) {
  order_.push_back(&body);
  plain_.resize(bodies_.size());
  const bool plain = is_zero(body.centre_of_mass) && (body.turns || body.motion == PLUMB_KINEMATIC);
  plain_[slot_of(body.handle)] = plain ? body.body : nullptr;
  if (body.motion == PLUMB_KINEMATIC) kinematic_.push_back(&body);
  if (!body.dynamic()) return;
  dynamic_.push_back(&body);
  dynamic_ids_.push_back(body.body);
  if (body.locks != 0) locked_.push_back(&body);
  if (body.linear_damping != 0 || body.angular_damping != 0) damped_.push_back(&body);
  set_gravity_scale(body, body.gravity_scale);
}

void World::strike_off(const Body& body) {
  for (auto* list : {&order_, &dynamic_, &kinematic_, &damped_, &locked_, &weighed_, &pushed_}) erase(*list, &body);
  erase(dynamic_ids_, body.body);
}

void World::dismantle(Body& body) {
  wake_neighbours(body);
  for (const auto& geom : body.geoms) dGeomDestroy(geom->placed.geom);
  if (body.linear_lock != nullptr) dJointDestroy(body.linear_lock);
  if (body.angular_lock != nullptr) dJointDestroy(body.angular_lock);
  if (body.body != nullptr) dBodyDestroy(body.body);
}

void World::set_gravity_scale(Body& body, double scale) {
  body.gravity_scale = scale;
  erase(weighed_, &body);
  if (scale != 0 && scale != 1) weighed_.push_back(&body);
  dBodySetGravityMode(body.body, scale == 1 ? 1 : 0);
}

// --- rows ------------------------------------------------------------------------------------------------------------

PlumbResult World::read_poses(std::span<const PlumbBody> ids, const Rows& rows) {
  double row[7];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (const dBodyID plain = plain_[slot_of(ids[i])]; plain != nullptr) {
      put_pose(vec(dBodyGetPosition(plain)), quat(dBodyGetQuaternion(plain)), row);
    } else {
      const PlumbPose pose = body(ids[i]).frame();
      put_pose(pose.position, pose.orientation, row);
    }
    rows.put(i, row, 7);
  }
  return PLUMB_OK;
}

PlumbResult World::read_velocities(std::span<const PlumbBody> ids, const Rows& rows) {
  double row[6];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (const dBodyID plain = plain_[slot_of(ids[i])]; plain != nullptr) {
      put_vec(vec(dBodyGetLinearVel(plain)), row);
      put_vec(vec(dBodyGetAngularVel(plain)), row + 3);
    } else {
      put_vec(body(ids[i]).linear_velocity(), row);
      put_vec(body(ids[i]).angular_velocity(), row + 3);
    }
    rows.put(i, row, 6);
  }
  return PLUMB_OK;
}

PlumbResult World::read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) {
  const auto each = [&]<std::size_t Columns>(void (*read_row)(const Body&, double(&)[Columns])) {
    double row[Columns];
    for (std::size_t i = 0; i < ids.size(); ++i) {
      read_row(body(ids[i]), row);
      rows.put(i, row, Columns);
    }
    return PLUMB_OK;
  };
  switch (field) {
    case PLUMB_FIELD_POSE: return read_poses(ids, rows);
    case PLUMB_FIELD_VELOCITY: return read_velocities(ids, rows);
    case PLUMB_FIELD_AWAKE:
      return each(+[](const Body& body, double(&row)[1]) { row[0] = body.dynamic() && body.asleep() ? 0 : 1; });
    case PLUMB_FIELD_MATERIAL:
      return each(+[](const Body& body, double(&row)[2]) {
        row[0] = body.material.friction;
        row[1] = body.material.restitution;
      });
    case PLUMB_FIELD_GRAVITY_SCALE:
      return each(+[](const Body& body, double(&row)[1]) { row[0] = body.gravity_scale; });
    case PLUMB_FIELD_DAMPING:
      return each(+[](const Body& body, double(&row)[2]) {
        row[0] = body.linear_damping;
        row[1] = body.angular_damping;
      });
    case PLUMB_FIELD_SURFACE_VELOCITY:
      return each(+[](const Body& body, double(&row)[3]) { put_vec(body.material.surface_velocity, row); });
    case PLUMB_FIELD_FILTER:
      return each(+[](const Body& body, double(&row)[3]) {
        row[0] = body.filter.category;
        row[1] = body.filter.mask;
        row[2] = body.filter.group;
      });
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be read");
  }
}

PlumbResult World::write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) {
  return inside_ode([&] {
    const std::uint32_t columns = columns_of(field);
    double row[16];
    for (std::size_t i = 0; i < ids.size(); ++i) {
      rows.get(i, row, columns);
      write_row(field, body(ids[i]), row);
    }
    return PLUMB_OK;
  });
}

void World::write_row(PlumbField field, Body& body, const double* row) {
  const PlumbVec3 v{row[0], row[1], row[2]};
  const auto wake = [&] { body.wake(); };
  const auto push = [&](const PlumbVec3& force, const PlumbVec3& torque) {
    if (!body.pushed) pushed_.push_back(&body);
    body.pushed = true;
    body.force = add(body.force, force);
    body.torque = add(body.torque, torque);
    wake();
  };
  const auto arm = [&] { return sub({row[3], row[4], row[5]}, body.centre()); };
  switch (field) {
    case PLUMB_FIELD_POSE:
      wake_neighbours(body);
      body.set_frame(pose_of(row));
      body.moving = Body::Moving::as_told;
      wake_neighbours(body);
      return wake();
    case PLUMB_FIELD_VELOCITY:
      body.set_velocity(v, {row[3], row[4], row[5]});
      body.moving = Body::Moving::as_told;
      return wake();
    case PLUMB_FIELD_FORCE: return push(v, {});
    case PLUMB_FIELD_TORQUE: return push({}, v);
    case PLUMB_FIELD_FORCE_AT_POINT: return push(v, cross(arm(), v));
    case PLUMB_FIELD_IMPULSE: body.add_impulse(v, {}); return wake();
    case PLUMB_FIELD_ANGULAR_IMPULSE: body.add_impulse({}, v); return wake();
    case PLUMB_FIELD_IMPULSE_AT_POINT: body.add_impulse(v, cross(arm(), v)); return wake();
    case PLUMB_FIELD_AWAKE:
      if (row[0] != 0) return wake();
      body.set_velocity({}, {});
      return dBodyDisable(body.body);
    case PLUMB_FIELD_KINEMATIC_TARGET:
      body.target = pose_of(row);
      body.moving = Body::Moving::to_target;
      return;
    case PLUMB_FIELD_MATERIAL:
      body.material.friction = row[0];
      body.material.restitution = row[1];
      return refresh_tags(body);
    case PLUMB_FIELD_GRAVITY_SCALE: set_gravity_scale(body, row[0]); return wake();
    case PLUMB_FIELD_DAMPING:
      body.linear_damping = row[0];
      body.angular_damping = row[1];
      erase(damped_, &body);
      damped_.push_back(&body);
      return set_damping(body, substep_);
    case PLUMB_FIELD_SURFACE_VELOCITY: body.material.surface_velocity = v; return refresh_tags(body);
    case PLUMB_FIELD_FILTER:
      body.filter.category = static_cast<std::uint32_t>(row[0]);
      body.filter.mask = static_cast<std::uint32_t>(row[1]);
      body.filter.group = static_cast<std::int32_t>(row[2]);
      return;
    default: throw Error(PLUMB_E_UNSUPPORTED, "field " + std::to_string(field) + " cannot be written");
  }
}

/// Whatever sleeps against a body must notice that it goes or comes.
void World::wake_neighbours(const Body& body) {
  if (space_ == nullptr || !init_.needs(PLUMB_NEED_SLEEPING)) return;
  const auto wake = [](void* self, dGeomID one, dGeomID two) {
    for (const dGeomID geom : {one, two}) {
      Body& met = *static_cast<const GeomTag*>(dGeomGetData(geom))->body;
      if (&met != self && met.asleep()) met.wake();
    }
  };
  for (const auto& geom : body.geoms)
    dSpaceCollide2(geom->placed.geom, reinterpret_cast<dGeomID>(space_), const_cast<Body*>(&body), wake);
}

// --- joints ----------------------------------------------------------------------------------------------------------

PlumbResult World::create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) {
  for (const PlumbJointDesc& desc : descs) check_joint(desc);
  return inside_ode([&] {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      const PlumbJointDesc& desc = descs[i];
      auto joint = std::make_unique<Joint>();
      joint->handle = ids[i];
      joint->desc = desc;
      joint->a = desc.body_a == 0 ? nullptr : &body(desc.body_a);
      joint->b = &body(desc.body_b);
      joint->watched = init_.needs(PLUMB_NEED_JOINT_REACTIONS) || desc.break_force > 0 || desc.break_torque > 0;
      attach(*joint, world_);
      if (substep_ != 0) set_parameters(*joint, settings_, substep_);
      if (joint->a != nullptr && desc.collide_connected == 0) {
        joint->a->untouchable.push_back(joint->b);
        joint->b->untouchable.push_back(joint->a);
        refresh_tags(*joint->a);
        refresh_tags(*joint->b);
      }
      joint_order_.push_back(joint.get());
      if (joint->watched || joint->has_distance_limits()) busy_joints_.push_back(joint.get());
      put(joints_, ids[i], std::move(joint));
    }
    return PLUMB_OK;
  });
}

PlumbResult World::destroy_joints(std::span<const PlumbJoint> ids) {
  return inside_ode([&] {
    for (const PlumbJoint id : ids) remove_joint(joint(id));
    return PLUMB_OK;
  });
}

void World::remove_joint(Joint& joint) {
  const auto forget_one = [](std::vector<const Body*>& list, const Body* other) {
    if (const auto at = std::find(list.begin(), list.end(), other); at != list.end()) list.erase(at);
  };
  if (joint.a != nullptr && joint.desc.collide_connected == 0) {
    forget_one(joint.a->untouchable, joint.b);
    forget_one(joint.b->untouchable, joint.a);
    refresh_tags(*joint.a);
    refresh_tags(*joint.b);
  }
  for (Body* body : {joint.a, joint.b})
    if (body != nullptr) body->wake();
  dJointDestroy(joint.id);
  erase(joint_order_, &joint);
  erase(busy_joints_, &joint);
  joints_[slot_of(joint.handle)].reset();
}

PlumbResult World::read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) {
  double row[12];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Joint& read = joint(ids[i]);
    if (field == PLUMB_JOINT_COORDINATES) read_coordinates(read, row);
    if (field == PLUMB_JOINT_REACTION) {
      const double reaction[6] = {read.force.x, read.force.y, read.force.z, read.torque.x, read.torque.y, read.torque.z};
      std::copy(std::begin(reaction), std::end(reaction), row);
    }
    for (std::size_t axis = 0; field == PLUMB_JOINT_MOTOR && axis < 6; ++axis) {
      const PlumbMotor& motor = read.desc.motors[axis];
      row[2 * axis] = motor.target_velocity;
      row[2 * axis + 1] = motor.enabled != 0 ? motor.max_force : 0;
    }
    rows.put(i, row, joint_columns_of(field));
  }
  return PLUMB_OK;
}

PlumbResult World::write_joints(PlumbJointField, std::span<const PlumbJoint> ids, ConstRows rows) {
  std::vector<PlumbJointDesc> changed;
  double row[12];
  for (std::size_t i = 0; i < ids.size(); ++i) {
    rows.get(i, row, 12);
    changed.push_back(joint(ids[i]).desc);
    for (std::size_t axis = 0; axis < 6; ++axis) {
      const bool enabled = row[2 * axis + 1] != 0;
      changed.back().motors[axis] = {row[2 * axis], row[2 * axis + 1], enabled ? 1u : 0u, 0};
    }
    check_joint(changed.back());
  }
  return inside_ode([&] {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      Joint& written = joint(ids[i]);
      written.desc = changed[i];
      if (substep_ != 0) set_parameters(written, settings_, substep_);
      for (Body* body : {written.a, written.b})
        if (body != nullptr) body->wake();
    }
    return PLUMB_OK;
  });
}

// --- settings --------------------------------------------------------------------------------------------------------

PlumbResult World::get_setting(const char* name, PlumbSettingValue& value) {
  value = setting_value(settings_, name);
  return PLUMB_OK;
}

PlumbResult World::set_setting(const char* name, const PlumbSettingValue& value) {
  return inside_ode([&] {
    assign_setting(settings_, name, value);
    apply_to_world(settings_, world_);
    contacts_.configure(settings_);
    for (Body* body : dynamic_) apply_body_settings(*body);
    for (Joint* joint : joint_order_)
      if (substep_ != 0) set_parameters(*joint, settings_, substep_);
    return PLUMB_OK;
  });
}

}  // namespace plumb::ode
