#include "convert/write/gltf/write_gltf.hpp"

#include "convert/principal.hpp"
#include "convert/upright.hpp"
#include "convert/write/gltf/gltf_colliders.hpp"
#include "convert/write/gltf/gltf_draft.hpp"
#include "convert/write/gltf/gltf_limits.hpp"
#include "convert/write/left_out.hpp"
#include "measure/instruments/mechanics.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;

Json vector_json(const Vec3& v) { return Json::array({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}); }

/// A moment of 0 is an infinite one in glTF.
void add_mass(Json& motion, const referee::Mass& mass, bool turns) {
  motion["mass"] = mass.mass;
  if (!mass.centre.isZero(0)) motion["centerOfMass"] = vector_json(mass.centre);
  const auto [moments, axes] = principal_of(mass.inertia);
  motion["inertiaDiagonal"] = vector_json(turns ? moments : Vec3::Zero());
  if (!turns || axes.isIdentity(0)) return;
  const PlumbQuat q = plain(Pose{axes, Vec3::Zero()}).orientation;
  motion["inertiaOrientation"] = {q.x, q.y, q.z, q.w};
}

Json motion_of(const Scene& scene, std::size_t body) {
  const PlumbBodyDesc& desc = scene.bodies[body].desc;
  Json motion = Json::object();
  if (desc.motion == PLUMB_KINEMATIC)
    motion["isKinematic"] = true;
  else
    add_mass(motion, mass_of_body(scene, body), (desc.flags & PLUMB_BODY_NO_ROTATION) == 0);
  const referee::Mat3 turn = referee::pose(desc.pose).rotation.transpose();
  for (const auto& [key, velocity] :
       {std::pair("linearVelocity", desc.linear_velocity), {"angularVelocity", desc.angular_velocity}})
    if (const Vec3 v = referee::vec(velocity); !v.isZero(0)) motion[key] = vector_json(turn * v);
  if (desc.gravity_scale != 1) motion["gravityFactor"] = desc.gravity_scale;
  return motion;
}

void write_joint(GltfDraft& draft, const SceneJoint& joint, Remarks& remarks) {
  // The nodes of bodies are the first ones, in their order.
  const std::size_t from = draft.add_node(joint.name, joint.desc.frame_a, joint.body_a);
  const std::size_t to = draft.add_node(joint.name + "/end", joint.desc.frame_b, joint.body_b);
  Json& entry = draft.physics(from)["joint"];
  entry["connectedNode"] = to;
  entry["joint"] = draft.add("physicsJoints", joint_description(joint, remarks));
  if (joint.desc.collide_connected != 0) entry["enableCollision"] = true;
}

}  // namespace

std::string write_gltf(const Scene& scene, bool binary, Remarks& remarks) {
  GltfDraft draft;
  const Vocabulary known{true, true, true, PLUMB_BODY_NO_ROTATION | PLUMB_BODY_SENSOR};
  for (const SceneBody& body : scene.bodies) draft.add_node(body.name, body.desc.pose);
  GltfColliders colliders(scene, draft);
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    if (scene.bodies[body].desc.motion != PLUMB_STATIC) draft.physics(body)["motion"] = motion_of(scene, body);
    colliders.write(body, body);
    remark_body(scene.bodies[body], remarks, known);
  }
  for (const SceneJoint& joint : scene.joints) {
    write_joint(draft, joint, remarks);
    remark_joint(joint, remarks, known);
  }
  remark_gravity(scene, remarks);
  remark_host(scene, remarks);
  remark_materials(scene, remarks);
  return binary ? draft.binary() : draft.text();
}

}  // namespace plumb::harness
