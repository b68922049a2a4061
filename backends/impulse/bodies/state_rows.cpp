#include "bodies/state_rows.hpp"

namespace plumb::impulse {

namespace {

struct WritePoses {
  Bodies bodies;
  const BodyFrame* frames;
  PoseRow* rows;
  PLUMB_HD void operator()(std::uint32_t i) const {
    rows[i] = pose_row(frames[i], bodies.position[i], bodies.orientation[i]);
  }
};

struct WriteVelocities {
  const Velocity* velocities;
  VelocityRow* rows;
  PLUMB_HD void operator()(std::uint32_t i) const { rows[i] = velocity_row(velocities[i]); }
};

WritePoses writer(const Bodies& bodies, const BodyFrame* frames, PoseRow* rows) { return {bodies, frames, rows}; }
WriteVelocities writer(const Bodies& bodies, const BodyFrame* /*frames*/, VelocityRow* rows) {
  return {bodies.velocity, rows};
}

}  // namespace

template <class Row>
void FieldRows<Row>::write(Executor& executor, const Bodies& bodies, const BodyFrame* frames, std::uint32_t count) {
  executor.run(count, writer(bodies, frames, block_->rows.device()));
  if (to_host_) bring(executor, count);
}

template class FieldRows<PoseRow>;
template class FieldRows<VelocityRow>;

}  // namespace plumb::impulse
