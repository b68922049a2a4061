#include "model.hpp"

#include <algorithm>
#include <cstring>

#include "model_text.hpp"

namespace plumb::mujoco {
namespace {

struct VfsFree {
  void operator()(mjVFS* vfs) const {
    mj_deleteVFS(vfs);
    delete vfs;
  }
};

std::unique_ptr<mjModel, ModelFree> compile(const std::string& text) {
  install_handlers();
  const std::unique_ptr<mjVFS, VfsFree> files(new mjVFS);
  mj_defaultVFS(files.get());
  const char* file = "world.xml";
  mj_makeEmptyFileVFS(files.get(), file, static_cast<int>(text.size()));
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), file)], text.data(), text.size());
  char why[1000] = "";
  std::unique_ptr<mjModel, ModelFree> model(mj_loadXML(file, files.get(), why, sizeof why));
  mj_freeLastXML();
  if (!model) throw Error(PLUMB_E_UNSUPPORTED, std::string("MuJoCo makes no model of this world: ") + why);
  return model;
}

void name_geoms(Model& made, Body& body) {
  if (body.shape == nullptr) return;
  if (body.shape->type != PLUMB_COMPOUND) {
    made.geoms.push_back({&body, body.shape, 0, identity_pose(), &body.desc.material});
    return;
  }
  std::uint32_t index = 0;
  for (const Shape::Child& child : body.shape->children)
    made.geoms.push_back(
        {&body, child.shape, index++, child.pose, child.has_material ? &child.material : &body.desc.material});
}

/// MuJoCo numbers bodies, their joints and their geoms in the order of the text.
void name_bodies(Model& made, const Tree& tree) {
  made.bodies = {nullptr};
  for (Body* body : tree.order) {
    body->id = static_cast<int>(made.bodies.size());
    body->root = made.model->body_rootid[body->id];
    body->first_joint = made.model->body_jntadr[body->id];
    body->joint_count = made.model->body_jntnum[body->id];
    made.bodies.push_back(body);
    name_geoms(made, *body);
    body->written = true;
  }
  if (made.model->nbody != static_cast<int>(made.bodies.size()) ||
      made.model->ngeom != static_cast<int>(made.geoms.size()))
    throw Error(PLUMB_E_INTERNAL, "MuJoCo's model has other bodies than its text");
}

void name_axes(const Body& body) {
  Joint& link = *body.link;
  link.axis_joint.fill(-1);
  const std::uint32_t open = open_axes(link.desc);
  if (is_plain_ball(link.desc)) return;
  int next = body.first_joint;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t axis = body.reversed ? 5 - i : i;
    if ((open >> axis & 1) != 0) link.axis_joint[axis] = next++;
  }
}

/// Where two bodies are held together, in the frame of each. at: in the joint's frames, which coincide.
void put_anchors(mjtNum* data, const Joint& joint, const PlumbVec3& at, bool weld) {
  const PlumbVec3 shift = joint.a == nullptr ? PlumbVec3{} : joint.a->shift;
  const PlumbVec3 in_a = sub(point_of(joint.desc.frame_a, at), shift);
  const PlumbVec3 in_b = sub(point_of(joint.desc.frame_b, at), joint.b->shift);
  put(weld ? in_b : in_a, data);
  put(weld ? in_a : in_b, data + 3);
}

void fill_equalities(Model& made, const std::vector<std::unique_ptr<Joint>>& joints) {
  int next = 0, rod = 0;
  for (const auto& joint : joints) {
    if (!joint) continue;
    const PlumbJointDesc& desc = joint->desc;
    joint->equality = joint->tendon = -1;
    if (desc.type == PLUMB_JOINT_DISTANCE) joint->tendon = rod++;
    if (!needs_equality(*joint)) continue;
    joint->equality = next;
    mjtNum* data = made.model->eq_data + mjNEQDATA * next++;
    if (joint->tendon >= 0) {
      data[0] = desc.rest_length - made.model->tendon_length0[joint->tendon];
      continue;
    }
    const bool weld = open_axes(desc) == 0;
    put_anchors(data, *joint, {0, 0, 0}, weld);
    if (weld) put(multiply(desc.frame_a.orientation, backend::conjugate(desc.frame_b.orientation)), data + 6);
    if (open_axes(desc) == 0b001000) put_anchors(made.model->eq_data + mjNEQDATA * next++, *joint, {1, 0, 0}, false);
  }
}

void fill_heights(const Model& made) {
  for (int i = 0; i < made.model->ngeom; ++i) {
    if (made.model->geom_type[i] != mjGEOM_HFIELD) continue;
    const std::vector<float>& heights = made.geoms[static_cast<std::size_t>(i)].shape->field.heights;
    std::copy(heights.begin(), heights.end(),
              made.model->hfield_data + made.model->hfield_adr[made.model->geom_dataid[i]]);
  }
}

void fill_inertia(const Model& made, const Body& body) {
  if (body.is(PLUMB_DYNAMIC) && (body.desc.flags & PLUMB_BODY_NO_ROTATION) == 0)
    put(body.desc.inertia, made.model->body_inertia + 3 * body.id);
}

/// Locked axes of free bodies weigh as much as what nothing moves. The turns are about the body's own axes, and only as
/// many as are locked all three are locked so.
void add_armature(const Model& made, const Body& body) {
  if (!body.is(PLUMB_DYNAMIC) || body.link != nullptr) return;
  constexpr std::uint32_t turns = PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Y | PLUMB_LOCK_ANGULAR_Z;
  std::uint32_t locks = body.desc.locks;
  if ((body.desc.flags & PLUMB_BODY_NO_ROTATION) != 0) locks |= turns;
  if ((locks & turns) != turns) locks &= ~turns;
  for (int i = 0; i < 6; ++i)
    if ((locks >> i & 1) != 0) made.model->dof_armature[made.first_dof(body) + i] = kHeavy;
}

/// By it MuJoCo scales the tolerance of its solvers: what must not move would make them stop at once.
double mean_inertia(const Tree& tree) {
  double sum = 0;
  int count = 0;
  for (const Body* body : tree.order)
    if (body->is(PLUMB_DYNAMIC)) sum += body->desc.mass, ++count;
  return count == 0 ? 1 : sum / count;
}

void make_data(Model& made) {
  const mjModel& m = *made.model;
  const auto rows = static_cast<double>(m.njmax), dofs = static_cast<double>(m.nv);
  const double bytes = 12 * rows * rows + 40 * rows * dofs + 8.0 * m.nstack;
  if (bytes > 2.1e9)
    throw Error(PLUMB_E_WORLD_LOST, "MuJoCo's data would take " + std::to_string(static_cast<int>(bytes / 1e6)) +
                                        " MB, of which it can have 2000; make the world smaller");
  made.data.reset();
  made.data.reset(mj_makeData(made.model.get()));
  if (!made.data) throw Error(PLUMB_E_OUT_OF_MEMORY, "MuJoCo has no memory for its data");
}

constexpr double kMostStack = 1.5e8;  // numbers

void make_stack(mjModel& m, double most) {
  const double dofs = m.nv, rows = m.njmax;
  const double stack = 3 * dofs * dofs + 3 * rows * dofs + 100 * (rows + dofs) + 1e5;
  m.nstack = static_cast<int>(std::min(stack, most));
}

/// What most worlds need. It is taken at once and whole, by the square of the rows, so that large worlds begin with
/// less than they might need and grow. Joints have rows for limits and dry friction; free bodies have none.
void make_first_room(mjModel& m, const Tree& tree, bool collides) {
  const auto is_free = [](const Body* body) { return !body->is(PLUMB_STATIC) && body->link == nullptr; };
  const int free_bodies = static_cast<int>(std::count_if(tree.order.begin(), tree.order.end(), is_free));
  m.nconmax = 32 + (collides ? std::min(6 * m.ngeom, 300) : 0);
  m.njmax = 4 * m.nconmax + 6 * m.neq + 3 * (m.nv - 6 * free_bodies);
  make_stack(m, 2e7);
}

}  // namespace

Model make_model(const Tree& tree, const std::vector<std::unique_ptr<Joint>>& joints, const Settings& settings,
                 PlumbNeeds needs) {
  const bool collides = (needs & (PLUMB_NEED_COLLISION | PLUMB_NEED_SENSORS)) != 0;
  Model made;
  made.model = compile(model_text(tree, joints, collides));
  mjModel& m = *made.model;
  name_bodies(made, tree);
  for (const Body* body : tree.order)
    if (body->link != nullptr) name_axes(*body);
  fill_equalities(made, joints);
  fill_heights(made);
  for (const Body* body : tree.order) {
    fill_inertia(made, *body);
    add_armature(made, *body);
  }
  apply_to_model(settings, (needs & PLUMB_NEED_ROLLING_FRICTION) != 0, m);
  for (const auto& joint : joints)
    if (joint && joint->is_link) apply_motors(made, *joint);
  make_first_room(m, tree, collides);
  make_data(made);
  mj_setConst(made.model.get(), made.data.get());
  m.stat.meaninertia = mean_inertia(tree);
  mj_resetData(made.model.get(), made.data.get());
  return made;
}

void apply_motors(Model& made, const Joint& joint) {
  for (std::size_t axis = 0; axis < 6; ++axis) {
    if (joint.axis_joint[axis] < 0) continue;
    const PlumbMotor& motor = joint.desc.motors[axis];
    made.model->dof_frictionloss[made.model->jnt_dofadr[joint.axis_joint[axis]]] =
        motor.enabled != 0 ? motor.max_force : 0;
  }
}

void grow_data(Model& made) {
  mjModel& m = *made.model;
  m.nconmax += m.nconmax / 2;
  m.njmax += m.njmax / 2;
  const int before = m.nstack;
  make_stack(m, kMostStack);
  m.nstack = std::max(m.nstack, before + before / 2);
  make_data(made);
}

}  // namespace plumb::mujoco
