#include "bodies/state_rows.hpp"

namespace plumb::impulse {

namespace {

/// Where a row goes.
template <class Row>
struct Places {
  Row* rows;
  RowSlice<Row> slice;
  PLUMB_HD void put(std::uint32_t i, const Row& row) const {
    rows[i] = row;
    if (i < slice.count) slice.rows[i] = row;
  }
};

struct WritePoses {
  Bodies bodies;
  const BodyFrame* frames;
  Places<PoseRow> to;
  PLUMB_HD void operator()(std::uint32_t i) const {
    to.put(i, pose_row(frames[i], bodies.position[i], bodies.orientation[i]));
  }
};

struct WriteVelocities {
  const Velocity* velocities;
  Places<VelocityRow> to;
  PLUMB_HD void operator()(std::uint32_t i) const { to.put(i, velocity_row(velocities[i])); }
};

WritePoses writer(const Bodies& bodies, const BodyFrame* frames, const Places<PoseRow>& to) {
  return {bodies, frames, to};
}
WriteVelocities writer(const Bodies& bodies, const BodyFrame* /*frames*/, const Places<VelocityRow>& to) {
  return {bodies.velocity, to};
}

}  // namespace

template <class Row>
void FieldRows<Row>::write(Executor& executor, const Bodies& bodies, const BodyFrame* frames, std::uint32_t count) {
  executor.run(count, writer(bodies, frames, Places<Row>{block_->rows.device(), slice_}));
  if (to_host_) bring(executor, count);
}

template class FieldRows<PoseRow>;
template class FieldRows<VelocityRow>;

}  // namespace plumb::impulse
