// Coordinates of a joint: b's frame seen from a's.
#include "plumb/backend/joint_coordinates.hpp"
#include "joints/joint.hpp"

namespace plumb::bullet {

void joint_coordinates(const Joint& joint, double* row) {
  const btTransform at_a = joint.a->getWorldTransform() * joint.frame_a;
  const btTransform at_b = joint.body_b->getWorldTransform() * joint.frame_b;
  const btTransform relative = at_a.inverseTimes(at_b);
  put_vector(relative.getOrigin(), row);
  if (joint.desc.type == PLUMB_JOINT_SWING_TWIST) {
    const btQuaternion turn = relative.getRotation();
    const PlumbVec3 turns = backend::swing_twist({turn.x(), turn.y(), turn.z(), turn.w()});
    row[3] = turns.x, row[4] = turns.y, row[5] = turns.z;
  } else {
    put_vector(angles_xyz(relative.getBasis()), row + 3);
  }
}

}  // namespace plumb::bullet
