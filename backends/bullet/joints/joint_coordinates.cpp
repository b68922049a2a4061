// Coordinates of a joint: b's frame seen from a's.
#include "joints/joint.hpp"

namespace plumb::bullet {

void joint_coordinates(const Joint& joint, double* row) {
  const btTransform at_a = joint.a->getWorldTransform() * joint.frame_a;
  const btTransform at_b = joint.body_b->getWorldTransform() * joint.frame_b;
  const btTransform relative = at_a.inverseTimes(at_b);
  put_vector(relative.getOrigin(), row);
  put_vector(angles_xyz(relative.getBasis()), row + 3);
}

}  // namespace plumb::bullet
