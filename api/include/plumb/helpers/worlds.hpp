// Many worlds stepped together: the environments of a learner, the variants of a design, a game's rooms. What a world
// comes to does not depend on those beside it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

class ThreadTeam;

/// Steps any worlds together, each by one thread at a time; they may be of different backends.
class StepTogether {
 public:
  /// threads: over which worlds are spread, the caller's included; 0: as many as the machine has processors.
  explicit StepTogether(std::uint32_t threads = 0);
  ~StepTogether();
  StepTogether(StepTogether&&) noexcept;

  /// Takes each of the worlds through a step of dt, s, and writes its report. All are stepped, also where one fails;
  /// then throws Error with the number and the sentence of the first that did.
  void step(std::span<IPhysicsWorld* const> worlds, double dt, std::span<PlumbStepReport> reports);
  /// f(i) for every i < n, on the threads; throws what the first that failed threw, when all are done.
  void each(std::size_t n, const std::function<void(std::size_t)>& f);
  [[nodiscard]] std::uint32_t threads() const;

 private:
  std::unique_ptr<ThreadTeam> team_;
};

/// Worlds that hold the same bodies: their state as arrays over all worlds, and each taken back to its start by itself.
class Worlds {
 public:
  /// What mark() and reset() work by; who does not use them need not declare it.
  static constexpr PlumbNeeds needs = PLUMB_NEED_SNAPSHOT;
  /// Makes a world and what is in it. Called once for each index, one after the other.
  using Make = std::function<std::unique_ptr<IPhysicsWorld>(std::uint32_t index)>;

  /// threads: as of StepTogether. Throws Error where two worlds have different numbers of bodies.
  Worlds(std::uint32_t count, const Make& make, std::uint32_t threads = 0);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(worlds_.size()); }
  [[nodiscard]] std::uint32_t bodies() const { return bodies_; }  ///< in each world
  [[nodiscard]] IPhysicsWorld& operator[](std::uint32_t index) { return *worlds_.at(index); }

  /// A step of dt, s, of every world. Errors as of StepTogether.
  void step(double dt);
  [[nodiscard]] std::span<const PlumbStepReport> reports() const { return reports_; }  ///< of the last step, by world

  /// From now on reset() goes back to how the worlds are now. Throws Error without snapshots (needs).
  void mark();
  /// Takes each world whose entry is not 0 back to the last mark, to the bit where snapshots are native. mask: one
  /// entry for each world. The same bodies and joints must live in it as then.
  void reset(std::span<const std::uint8_t> mask);
  void reset();  ///< all

  /// Numbers of a field of bodies of all worlds: [world][body][column]. which: bodies by their place in the order of
  /// creation; empty: all. Stays until the next call for the same field.
  [[nodiscard]] std::span<const double> read(PlumbField field, std::span<const std::uint32_t> which = {});
  /// The same way round. A world whose entry of mask is 0 is left alone, whatever stands in its rows; an empty mask
  /// means all. Throws Error where a world refuses; others may have been written then.
  void write(PlumbField field, std::span<const double> rows, std::span<const std::uint32_t> which = {},
             std::span<const std::uint8_t> mask = {});

  /// Numbers of joints of all worlds: [world][joint][column]. joints: handles, the same in every world, as worlds that
  /// were made by the same calls have them. Stays until the next call for the same field. Throws Error where a world
  /// has no such joint.
  [[nodiscard]] std::span<const double> read_joints(PlumbJointField field, std::span<const PlumbJoint> joints);
  /// The same way round, of motors alone: target velocity and max force of axis 0, of axis 1 and so on, 12 numbers a
  /// joint. Mask as of write().
  void write_joints(PlumbJointField field, std::span<const double> rows, std::span<const PlumbJoint> joints,
                    std::span<const std::uint8_t> mask = {});

  /// Poses or velocities of all worlds where the engine keeps them, without a copy where it can: worlds x rows x
  /// columns (plumb.worlds/1 and plumb.state/1 say more). Throws Error where the backend has no plumb.worlds/1; read()
  /// then.
  [[nodiscard]] PlumbDLManagedTensor* borrow(const PlumbStateRequest& request, PlumbFence* fence = nullptr);

 private:
  void require_mask(std::span<const std::uint8_t> mask) const;
  void require_rows(std::size_t numbers, const char* what, std::size_t count, std::size_t columns) const;
  /// So many bodies of each world; their handles world by world, or none where all are meant.
  struct Chosen {
    std::size_t count;
    std::vector<PlumbBody> ids;
  };
  [[nodiscard]] Chosen choose(std::span<const std::uint32_t> which) const;
  [[nodiscard]] std::span<const PlumbBody> ids_of(std::size_t world, const Chosen& chosen) const;

  StepTogether together_;
  std::vector<std::unique_ptr<IPhysicsWorld>> worlds_;
  std::vector<IPhysicsWorld*> pointers_;
  std::vector<std::vector<PlumbBody>> ids_;
  std::uint32_t bodies_ = 0;
  std::vector<PlumbStepReport> reports_;
  std::vector<std::vector<std::byte>> marks_;  // by world; empty before the first
  std::vector<double> rows_[PLUMB_FIELD_COUNT], joint_rows_[PLUMB_JOINT_FIELD_COUNT];
};

}  // namespace plumb::helpers
