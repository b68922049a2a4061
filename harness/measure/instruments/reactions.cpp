#include "measure/instruments/reactions.hpp"

#include <array>

namespace plumb::harness {

void ReactionAccount::add(Simulation& simulation) {
  IJoints* joints = simulation.world().joints();
  const PlumbJoint id = simulation.joint_handle(joint_);
  std::array<double, 6> row{};
  const Rows rows(reinterpret_cast<std::byte*>(row.data()), 1, sizeof(row), PLUMB_F64);
  check(simulation.world(), joints->read_joints(PLUMB_JOINT_REACTION, {&id, 1}, rows));
  force_ += referee::Vec3(row[0], row[1], row[2]);
  torque_ += referee::Vec3(row[3], row[4], row[5]);
  ++count_;
}

bool tells_reaction(MeasureContext& context, std::size_t joint) {
  const PlumbJointType type = context.scene().joints[joint].desc.type;
  return context.backend().capability(PLUMB_CAP_JOINT_FEATURE, type, PLUMB_JOINT_HAS_REACTION) != PLUMB_NONE;
}

}  // namespace plumb::harness
