#include "model_text.hpp"

#include <charconv>
#include <numbers>
#include <set>

namespace plumb::mujoco {
namespace {

/// Text of numbers as they are, whatever the process's locale.
class Writer {
 public:
  Writer& operator<<(std::string_view text) {
    out_ += text;
    return *this;
  }
  Writer& operator<<(double number) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, number);
    out_.append(digits, end.ptr);
    out_ += ' ';
    return *this;
  }
  Writer& operator<<(const PlumbVec3& v) { return *this << v.x << v.y << v.z; }
  Writer& operator<<(const PlumbQuat& q) { return *this << q.w << q.x << q.y << q.z; }
  Writer& operator<<(const PlumbPose& pose) {
    return *this << " pos=\"" << pose.position << "\" quat=\"" << normalized(pose.orientation) << "\"";
  }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

std::string name(char kind, std::uint64_t handle) { return kind + std::to_string(slot_of(handle)); }
std::string body_name(const Body* body) { return body == nullptr ? "world" : name('b', body->handle); }

// --- shapes ----------------------------------------------------------------------------------------------------------

void write_asset(Writer& out, const Shape& shape) {
  if (shape.type == PLUMB_CONVEX_HULL) {
    out << "<mesh name=\"" << asset_name(shape) << "\" vertex=\"";
    for (const PlumbVec3& vertex : shape.hull.vertices) out << vertex;
    out << "\"/>\n";
  } else {
    const Shape::Field& field = shape.field;
    out << "<hfield name=\"" << asset_name(shape) << "\" nrow=\"" << std::to_string(field.rows) << "\" ncol=\""
        << std::to_string(field.columns) << "\" size=\"" << field.half_x << field.half_z << field.span << 1 << "\"/>\n";
  }
}

void collect_assets(const Shape* shape, std::set<const Shape*>& found) {
  if (shape == nullptr) return;
  if (shape->type == PLUMB_CONVEX_HULL || shape->type == PLUMB_HEIGHT_FIELD) found.insert(shape);
  for (const Shape::Child& child : shape->children) collect_assets(child.shape, found);
}

void write_assets(Writer& out, const Tree& tree) {
  std::set<const Shape*> found;
  for (const Body* body : tree.order) collect_assets(body->shape, found);
  out << "<asset>\n";
  for (const Shape* shape : found) write_asset(out, *shape);
  out << "</asset>\n";
}

void write_geom(Writer& out, const Shape& shape, const PlumbPose& at) {
  out << "<geom" << compose(at, geom_frame(shape));
  switch (shape.type) {
    case PLUMB_SPHERE: out << " type=\"sphere\" size=\"" << shape.radius << "\"/>\n"; break;
    case PLUMB_BOX: out << " type=\"box\" size=\"" << shape.half_extents << "\"/>\n"; break;
    case PLUMB_CAPSULE:  // one without a length would be refused
      out << " type=\"capsule\" size=\"" << shape.radius << std::max(shape.half_height, 1e-9) << "\"/>\n";
      break;
    case PLUMB_CYLINDER: out << " type=\"cylinder\" size=\"" << shape.radius << shape.half_height << "\"/>\n"; break;
    case PLUMB_PLANE: out << " type=\"plane\" size=\"0 0 1\"/>\n"; break;
    case PLUMB_CONVEX_HULL: out << " type=\"mesh\" mesh=\"" << asset_name(shape) << "\"/>\n"; break;
    default: out << " type=\"hfield\" hfield=\"" << asset_name(shape) << "\"/>\n";
  }
}

// --- bodies ----------------------------------------------------------------------------------------------------------

/// The moments are put into the model afterwards: in a text MuJoCo refuses those that no solid body has.
void write_inertial(Writer& out, const Body& body) {
  if (body.is(PLUMB_STATIC)) return;
  if (body.is(PLUMB_KINEMATIC)) {
    out << "<inertial pos=\"0 0 0\" mass=\"" << kHeavy << "\" diaginertia=\"" << kHeavy << kHeavy << kHeavy << "\"/>\n";
    return;
  }
  const PlumbBodyDesc& desc = body.desc;
  out << "<inertial" << body.shifted({desc.centre_of_mass, desc.inertia_orientation}) << " mass=\"" << desc.mass
      << "\" diaginertia=\"" << desc.mass << desc.mass << desc.mass << "\"/>\n";
}

void write_stiffness(Writer& out, const Joint& joint, std::size_t axis) {
  const PlumbSpring& spring = joint.desc.springs[axis];
  double stiffness = spring.frequency, damping = spring.damping_ratio;
  if (spring.mode == PLUMB_SPRING_FREQUENCY) {
    const double mass = effective_mass(joint, axis), rate = 2 * std::numbers::pi * spring.frequency;
    stiffness = mass * rate * rate;
    damping = 2 * spring.damping_ratio * mass * rate;
  }
  out << " stiffness=\"" << stiffness << "\" damping=\"" << damping << "\"";
}

void write_scalar_joint(Writer& out, const Body& body, std::size_t axis, const PlumbPose& frame) {
  const Joint& link = *body.link;
  const double sign = body.reversed ? -1 : 1;
  const PlumbVec3 along = scale(sign, rotate(frame.orientation, unit(axis % 3)));
  out << "<joint type=\"" << (axis < 3 ? "slide" : "hinge") << "\" pos=\"" << frame.position << "\" axis=\"" << along
      << "\"";
  if (is_limited(link.desc, axis)) {
    const PlumbLimit& limit = link.desc.limits[axis];
    out << " limited=\"true\" range=\"" << limit.lower << std::max(limit.upper, limit.lower + 1e-9) << "\"";
  }
  if (const PlumbSpring& spring = link.desc.springs[axis]; spring.enabled != 0) {
    write_stiffness(out, link, axis);
    out << " springref=\"" << spring.rest << "\"";
  }
  out << "/>\n";
}

/// Translations first, seen from the joint's frame a; from b to a everything goes the other way round.
void write_joints(Writer& out, const Body& body) {
  if (body.is(PLUMB_STATIC)) return;
  if (body.link == nullptr) {
    out << "<freejoint/>\n";
    return;
  }
  const PlumbJointDesc& desc = body.link->desc;
  const PlumbPose& frame = body.reversed ? desc.frame_a : desc.frame_b;
  const bool ball = is_plain_ball(desc);
  const std::uint32_t open = open_axes(desc);
  const auto write = [&](std::size_t axis) {
    if ((open >> axis & 1) == 0) return;
    if (axis < 3 || !ball) return write_scalar_joint(out, body, axis, frame);
    if (axis == 3) out << "<joint type=\"ball\" pos=\"" << frame.position << "\"/>\n";
  };
  for (std::size_t i = 0; i < 6; ++i) write(body.reversed ? 5 - i : i);
}

/// Where a child is when all of its joint's coordinates are 0.
PlumbPose place(const Body& body) {
  if (body.link == nullptr) return compose(body.pose, {body.shift, {0, 0, 0, 1}});
  const PlumbJointDesc& desc = body.link->desc;
  const PlumbPose at =
      body.reversed ? compose(desc.frame_b, inverse(desc.frame_a)) : compose(desc.frame_a, inverse(desc.frame_b));
  return body.parent == nullptr ? at : body.parent->shifted(at);
}

void write_site(Writer& out, const std::string& name, const Body* body, const PlumbPose& frame) {
  const PlumbPose at = body == nullptr ? frame : body->shifted(frame);
  out << "<site name=\"" << name << "\" pos=\"" << at.position << "\"/>\n";
}

void write_sites(Writer& out, const Body* body, const std::vector<std::unique_ptr<Joint>>& joints) {
  for (const auto& joint : joints) {
    if (!joint || joint->desc.type != PLUMB_JOINT_DISTANCE) continue;
    if (joint->a == body) write_site(out, name('p', joint->handle), body, joint->desc.frame_a);
    if (joint->b == body) write_site(out, name('q', joint->handle), body, joint->desc.frame_b);
  }
}

void write_body(Writer& out, const Body& body, const Tree& tree, const std::vector<std::unique_ptr<Joint>>& joints) {
  out << "<body name=\"" << body_name(&body) << "\"" << place(body) << ">\n";
  write_inertial(out, body);
  write_joints(out, body);
  if (body.shape != nullptr && body.shape->type != PLUMB_COMPOUND)
    write_geom(out, *body.shape, body.shifted(identity_pose()));
  if (body.shape != nullptr)
    for (const Shape::Child& child : body.shape->children) write_geom(out, *child.shape, body.shifted(child.pose));
  write_sites(out, &body, joints);
  for (const Body* child : tree.children[slot_of(body.handle)]) write_body(out, *child, tree, joints);
  out << "</body>\n";
}

// --- constraints -----------------------------------------------------------------------------------------------------

void write_rod(Writer& out, const Joint& joint) {
  const PlumbLimit& limit = joint.desc.limits[0];
  out << "<spatial name=\"" << name('t', joint.handle) << "\"";
  if (limit.enabled != 0)
    out << " limited=\"true\" range=\"" << limit.lower << std::max(limit.upper, limit.lower + 1e-9) << "\"";
  if (joint.desc.springs[0].enabled != 0) {
    write_stiffness(out, joint, 0);
    out << " springlength=\"" << joint.desc.rest_length << "\"";
  }
  out << "><site site=\"" << name('p', joint.handle) << "\"/><site site=\"" << name('q', joint.handle)
      << "\"/></spatial>\n";
}

/// What they hold is written into the model afterwards.
void write_equality(Writer& out, const Joint& joint) {
  const std::string ends = " body1=\"" + body_name(joint.a) + "\" body2=\"" + body_name(joint.b) + "\"";
  const std::uint32_t open = open_axes(joint.desc);
  if (joint.desc.type == PLUMB_JOINT_DISTANCE)
    out << "<tendon tendon1=\"" << name('t', joint.handle) << "\"/>\n";
  else if (open == 0)
    out << "<weld" << ends << "/>\n";
  else
    for (int i = 0; i < (open == 0b001000 ? 2 : 1); ++i) out << "<connect" << ends << " anchor=\"0 0 0\"/>\n";
}

}  // namespace

bool needs_equality(const Joint& joint) {
  if (joint.desc.type == PLUMB_JOINT_DISTANCE)
    return joint.desc.limits[0].enabled == 0 && joint.desc.springs[0].enabled == 0;
  const auto moves = [](const Body* body) { return body != nullptr && body->is(PLUMB_DYNAMIC); };
  return !joint.is_link && (moves(joint.a) || moves(joint.b));
}

std::string model_text(const Tree& tree, const std::vector<std::unique_ptr<Joint>>& joints, bool collides) {
  Writer out;
  out << "<mujoco>\n<compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n";
  write_assets(out, tree);
  if (!collides) out << "<default><geom contype=\"0\" conaffinity=\"0\"/></default>\n";
  out << "<worldbody>\n";
  write_sites(out, nullptr, joints);
  for (const Body* root : tree.roots) write_body(out, *root, tree, joints);
  out << "</worldbody>\n<tendon>\n";
  for (const auto& joint : joints)
    if (joint && joint->desc.type == PLUMB_JOINT_DISTANCE) write_rod(out, *joint);
  out << "</tendon>\n<equality>\n";
  for (const auto& joint : joints)
    if (joint && needs_equality(*joint)) write_equality(out, *joint);
  out << "</equality>\n</mujoco>\n";
  return out.take();
}

}  // namespace plumb::mujoco
