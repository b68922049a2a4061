// State as a user reads it: rows of poses and velocities by body slot, worked out where kernels run.
//
// Rows of a field are made when somebody first asks for them; from then on each step brings them with it, to the host
// too where they were asked for there. Whoever borrows a block of rows keeps it alive, also after the world is gone.
#pragma once

#include <memory>

#include "bodies/body_state.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"

namespace plumb::impulse {

/// Position and orientation x y z w of the body's own frame: double, since positions are.
struct PoseRow {
  double numbers[7];
};
/// Linear velocity of the centre of mass, angular velocity, world axes.
struct VelocityRow {
  Real numbers[6];
};

PLUMB_HD inline PoseRow pose_row(const BodyFrame& frame, const Position& position, const Quat& orientation) {
  Quat4<double> q = {static_cast<double>(orientation.x), static_cast<double>(orientation.y),
                     static_cast<double>(orientation.z), static_cast<double>(orientation.w)};
  const Quat4<double>& axes = frame.principal;
  if (!(axes.x == 0 && axes.y == 0 && axes.z == 0)) q = q * conjugate(axes);
  const Position at = position - rotate(q, frame.centre_of_mass);
  return {{at.x, at.y, at.z, q.x, q.y, q.z, q.w}};
}

PLUMB_HD inline VelocityRow velocity_row(const Velocity& v) {
  return {{v.linear.x, v.linear.y, v.linear.z, v.angular.x, v.angular.y, v.angular.z}};
}

/// Rows that live as long as anybody has them, and the signal that tells when they were written.
template <class Row>
struct RowBlock {
  Mirror<Row> rows;
  Signal written;
};

/// A part of somebody's block; none where rows is null.
template <class Row>
struct RowSlice {
  Row* rows = nullptr;  ///< kernels' memory
  std::uint32_t count = 0;
};

/// The rows of one field.
template <class Row>
class FieldRows {
 public:
  /// From now on what is written stands there, too; whoever records steps has to do it anew.
  void also_write(const RowSlice<Row>& slice) {
    slice_ = slice;
    version_ = 0;
  }
  /// Whether the steps to come bring rows, and whether to the host too.
  [[nodiscard]] bool in_step() const { return wanted_; }
  /// Asks for it. Returns whether that is news.
  bool want(bool on_host) {
    const bool news = !wanted_ || (on_host && !to_host_);
    wanted_ = true;
    to_host_ = to_host_ || on_host;
    return news;
  }
  /// Whether the rows are those of this version of the state, there where they are asked for.
  [[nodiscard]] bool fresh(std::uint64_t version, bool on_host) const {
    return version_ == version && (!on_host || on_host_);
  }
  /// Makes a block where there is none of that size, or where it may not be written. Returns whether it did.
  bool reserve(std::size_t size, bool keep_what_is_lent) {
    if (block_ != nullptr && block_->rows.size() >= size && !(keep_what_is_lent && block_.use_count() > 1))
      return false;
    block_ = std::make_shared<RowBlock<Row>>();
    block_->rows.grow(size);
    return true;
  }
  /// Enqueues the writing of `count` rows, and their way to the host where they are wanted there.
  void write(Executor& executor, const Bodies& bodies, const BodyFrame* frames, std::uint32_t count);
  /// Enqueues the way to the host alone.
  void bring(Executor& executor, std::uint32_t count) { executor.to_host(block_->rows, count); }
  /// What write() enqueued, then or in a recording, is of this version of the state.
  void written(std::uint64_t version) {
    version_ = version;
    on_host_ = to_host_;
  }
  [[nodiscard]] const std::shared_ptr<RowBlock<Row>>& block() const { return block_; }

 private:
  bool wanted_ = false, to_host_ = false, on_host_ = false;
  std::uint64_t version_ = 0;  // of which the rows are; that of no state where they are to be written anew
  std::shared_ptr<RowBlock<Row>> block_;
  RowSlice<Row> slice_;
};

}  // namespace plumb::impulse
