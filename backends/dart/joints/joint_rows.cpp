#include "joints/joint_rows.hpp"

#include "plumb/backend/joint_coordinates.hpp"

namespace plumb::dart6 {
namespace {

constexpr std::uint32_t kTurnX = 0b001000, kTurnY = 0b010000, kTurnZ = 0b100000, kTurns = 0b111000;

/// The share of an error that is taken back, as a speed.
class Back {
 public:
  Back(const Settings& settings, double h)
      : rate_(settings.joint_reduction / h), most_(settings.joint_reduction_speed) {}
  [[nodiscard]] double operator()(double error) const { return std::clamp(-rate_ * error, -most_, most_); }

 private:
  double rate_, most_;
};

Row push_row(const PlumbVec3& along, const PlumbVec3& at, double speed) {
  Row row;
  row.force_b = eigen(along);
  row.at = eigen(at);
  row.speed = speed;
  return row;
}

Row turn_row(const PlumbVec3& about, double speed) {
  Row row;
  row.torque_b = eigen(about);
  row.speed = speed;
  return row;
}

// --- turns -----------------------------------------------------------------------------------------------------------

void lock_all_turns(const PlumbPose& a, const PlumbPose& b, const Back& back, std::vector<Row>& rows) {
  const PlumbVec3 error = backend::rotation_vector(multiply(b.orientation, backend::conjugate(a.orientation)));
  for (std::size_t k = 0; k < 3; ++k) rows.push_back(turn_row(unit(k), back(dot(error, unit(k)))));
}

/// One free turn: about the same axis of both frames, which stay on each other.
void lock_but_one(const PlumbPose& a, const PlumbPose& b, std::size_t axis, const Back& back, std::vector<Row>& rows) {
  const PlumbVec3 error = cross(rotate(a.orientation, unit(axis)), rotate(b.orientation, unit(axis)));
  for (const std::size_t k : {(axis + 1) % 3, (axis + 2) % 3}) {
    const PlumbVec3 about = rotate(a.orientation, unit(k));
    rows.push_back(turn_row(about, back(dot(error, about))));
  }
}

/// Two free turns of R = Rx Ry Rz: an axis of a stays square to one of b. Which, by the turn that is locked.
void lock_one(const PlumbPose& a, const PlumbPose& b, std::uint32_t locked, const Back& back, std::vector<Row>& rows) {
  const bool y_of_a = locked == kTurnX, y_of_b = locked == kTurnZ;
  const PlumbVec3 of_a = rotate(a.orientation, unit(y_of_a ? 1 : 0)),
                  of_b = rotate(b.orientation, unit(y_of_b ? 1 : 2));
  const PlumbVec3 about = cross(of_b, of_a);  // d(of_a . of_b)/dt = about . (spin of b - spin of a)
  rows.push_back(turn_row(about, back(dot(of_a, of_b))));
}

void lock_turns(const PlumbPose& a, const PlumbPose& b, std::uint32_t open, const Back& back, std::vector<Row>& rows) {
  switch (open & kTurns) {
    case 0: return lock_all_turns(a, b, back, rows);
    case kTurnX: return lock_but_one(a, b, 0, back, rows);
    case kTurnY: return lock_but_one(a, b, 1, back, rows);
    case kTurnZ: return lock_but_one(a, b, 2, back, rows);
    case kTurns: return;
    default: return lock_one(a, b, ~open & kTurns, back, rows);
  }
}

// --- rods ------------------------------------------------------------------------------------------------------------

/// A spring and damper as a row that yields: implicit, whatever the stiffness.
void add_spring(const Joint& joint, double stretch, double h, Row& row) {
  const auto [stiffness, damping] = stiffness_of(joint, 0);
  const double resistance = h * (h * stiffness + damping);
  if (resistance <= 0) {
    row.least = row.most = 0;
    return;
  }
  row.softness = 1 / resistance;
  row.speed = -stretch * h * stiffness / resistance;
}

/// Both ends of the limit as rows that push one way, each from a step before it is reached.
void add_limits(const PlumbLimit& limit, double now, double h, const Back& back, const Row& along,
                std::vector<Row>& rows) {
  const auto speed = [&](double beyond) { return beyond > 0 ? back(beyond) : -beyond / h; };
  Row longer = along, shorter = along;
  longer.speed = -speed(limit.lower - now);
  longer.least = 0;
  shorter.speed = speed(now - limit.upper);
  shorter.most = 0;
  rows.push_back(longer);
  rows.push_back(shorter);
}

std::vector<Row> rod_rows(const Joint& joint, const PlumbPose& a, const PlumbPose& b, const Back& back, double h) {
  const PlumbVec3 way = sub(b.position, a.position);
  const double now = length(way);
  const PlumbVec3 along = now > 1e-9 ? scale(1 / now, way) : unit(1);
  // Both ends are pushed along the line, so where on it is all the same.
  const Row row = push_row(along, b.position, 0);
  std::vector<Row> rows;
  if (joint.desc.springs[0].enabled != 0) {
    rows.push_back(row);
    add_spring(joint, now - joint.desc.rest_length, h, rows.back());
  }
  if (joint.desc.limits[0].enabled != 0) add_limits(joint.desc.limits[0], now, h, back, row, rows);
  if (rows.empty()) {
    rows.push_back(row);
    rows.back().speed = back(now - joint.desc.rest_length);
  }
  return rows;
}

}  // namespace

PlumbPose frame_in_world(const Body* body, const PlumbPose& frame) {
  return body == nullptr ? frame : compose(pose_of(body->node->getWorldTransform()), frame);
}

std::vector<Row> joint_rows(const Joint& joint, const Settings& settings, double h) {
  const PlumbPose a = frame_in_world(joint.a, joint.desc.frame_a), b = frame_in_world(joint.b, joint.desc.frame_b);
  const Back back(settings, h);
  if (joint.desc.type == PLUMB_JOINT_DISTANCE) return rod_rows(joint, a, b, back, h);
  std::vector<Row> rows;
  const std::uint32_t open = open_axes(joint.desc);
  const PlumbVec3 gap = sub(b.position, a.position);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if ((open >> axis & 1) != 0) continue;
    const PlumbVec3 along = rotate(a.orientation, unit(axis));
    rows.push_back(push_row(along, b.position, back(dot(gap, along))));
  }
  lock_turns(a, b, open, back, rows);
  return rows;
}

std::vector<Row> lock_rows(const Body& body) {
  std::vector<Row> rows;
  const PlumbVec3 centre = vec(body.node->getCOM());
  for (std::size_t k = 0; k < 3; ++k) {
    if ((body.desc.locks & PLUMB_LOCK_LINEAR_X << k) != 0) rows.push_back(push_row(unit(k), centre, 0));
    if (body.turns() && (body.desc.locks & PLUMB_LOCK_ANGULAR_X << k) != 0) rows.push_back(turn_row(unit(k), 0));
  }
  return rows;
}

}  // namespace plumb::dart6
