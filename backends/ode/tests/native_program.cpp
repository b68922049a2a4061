#include "native_program.hpp"

namespace plumb::ode_test {

NativeProgram::NativeProgram(const Scene& scene) {
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  dRandSetSeed(0);
  world_ = dWorldCreate();
  space_ = dHashSpaceCreate(nullptr);
  contacts_ = dJointGroupCreate(0);
  dWorldSetGravity(world_, 0, -9.81, 0);
  std::vector<dBodyID> of_scene;
  for (const BoxBody& box : scene.bodies) {
    const PlumbVec3 &h = box.half_extents, &p = box.pose.position;
    const PlumbQuat& q = box.pose.orientation;
    const dQuaternion turn = {q.w, q.x, q.y, q.z};
    if (box.mass == 0) {
      const dGeomID geom = dCreateBox(space_, 2 * h.x, 2 * h.y, 2 * h.z);
      dGeomSetPosition(geom, p.x, p.y, p.z);
      of_scene.push_back(nullptr);
      continue;
    }
    const dBodyID body = dBodyCreate(world_);
    dMass mass;
    dMassSetParameters(&mass, box.mass, 0, 0, 0, box.inertia.x, box.inertia.y, box.inertia.z, 0, 0, 0);
    dBodySetMass(body, &mass);
    dGeomSetBody(dCreateBox(space_, 2 * h.x, 2 * h.y, 2 * h.z), body);
    dBodySetPosition(body, p.x, p.y, p.z);
    dBodySetQuaternion(body, turn);
    of_scene.push_back(body);
    bodies_.push_back(body);
  }
  for (const Link& link : scene.links) {
    const dBodyID b = of_scene[static_cast<std::size_t>(link.b)];
    const dBodyID a = link.a < 0 ? nullptr : of_scene[static_cast<std::size_t>(link.a)];
    if (link.type == PLUMB_JOINT_BALL) {
      const dJointID joint = dJointCreateBall(world_, nullptr);
      dJointAttach(joint, b, a);
      dJointSetBallAnchor(joint, link.anchor.x, link.anchor.y, link.anchor.z);
    } else {
      const dJointID joint = dJointCreateHinge(world_, nullptr);
      dJointAttach(joint, b, a);
      dJointSetHingeAnchor(joint, link.anchor.x, link.anchor.y, link.anchor.z);
      dJointSetHingeAxis(joint, 1, 0, 0);
    }
  }
}

NativeProgram::~NativeProgram() {
  dJointGroupDestroy(contacts_);
  dSpaceDestroy(space_);
  dWorldDestroy(world_);
}

void NativeProgram::near(void* self, dGeomID one, dGeomID two) {
  const auto& program = *static_cast<const NativeProgram*>(self);
  const dBodyID a = dGeomGetBody(one), b = dGeomGetBody(two);
  if (a == nullptr && b == nullptr) return;
  if (a != nullptr && b != nullptr && dAreConnectedExcluding(a, b, dJointTypeContact) != 0) return;
  dContact contacts[most_contacts];
  const int count = dCollide(one, two, most_contacts, &contacts[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    contacts[i].surface.mode = dContactApprox1;
    contacts[i].surface.mu = friction;
    dJointAttach(dJointCreateContact(program.world_, program.contacts_, &contacts[i]), a, b);
  }
}

void NativeProgram::step() {
  dSpaceCollide(space_, this, near);
  dWorldQuickStep(world_, dt);
  dJointGroupEmpty(contacts_);
}

void NativeProgram::read(StateRows& rows) const {
  rows.poses.resize(bodies_.size() * 7);
  rows.velocities.resize(bodies_.size() * 6);
  double* row = rows.poses.data();
  for (const dBodyID body : bodies_) {
    const dReal *p = dBodyGetPosition(body), *q = dBodyGetQuaternion(body);
    for (const double value : {p[0], p[1], p[2], q[1], q[2], q[3], q[0]}) *row++ = value;
  }
  row = rows.velocities.data();
  for (const dBodyID body : bodies_) {
    const dReal *v = dBodyGetLinearVel(body), *w = dBodyGetAngularVel(body);
    for (const double value : {v[0], v[1], v[2], w[0], w[1], w[2]}) *row++ = value;
  }
}

}  // namespace plumb::ode_test
