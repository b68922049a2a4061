#include "plumb/helpers/worlds.hpp"

#include <algorithm>
#include <string>
#include <thread>

#include "common.hpp"
#include "thread_team.hpp"

namespace plumb::helpers {

namespace {

std::string world_number(std::size_t index) { return "world " + std::to_string(index) + ": "; }

/// check(), whose sentence begins with the world's number.
void check_world(const IPhysicsWorld& world, std::size_t index, PlumbResult result) {
  if (result < 0) throw Error(result, world_number(index) + world.error_text());
}

IJoints& joints_of(IPhysicsWorld& world) {
  return require_extension(world.joints(), "joints of worlds", "plumb.joints/1", "PLUMB_NEED_JOINTS");
}

/// A world's own part of an array over all worlds.
Rows rows_of_world(std::vector<double>& all, std::size_t world, std::size_t count, std::size_t columns) {
  return {reinterpret_cast<std::byte*>(all.data() + world * count * columns), count, columns * sizeof(double),
          PLUMB_F64};
}
ConstRows rows_of_world(std::span<const double> all, std::size_t world, std::size_t count, std::size_t columns) {
  return {reinterpret_cast<const std::byte*>(all.data() + world * count * columns), count, columns * sizeof(double),
          PLUMB_F64};
}

}  // namespace

StepTogether::StepTogether(std::uint32_t threads)
    : team_(std::make_unique<ThreadTeam>(threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency()))) {}
StepTogether::~StepTogether() = default;
StepTogether::StepTogether(StepTogether&&) noexcept = default;

std::uint32_t StepTogether::threads() const { return team_->threads(); }

void StepTogether::each(std::size_t n, const std::function<void(std::size_t)>& f) { team_->each(n, f); }

void StepTogether::step(std::span<IPhysicsWorld* const> worlds, double dt, std::span<PlumbStepReport> reports) {
  require(reports.size() == worlds.size(), "step together: " + std::to_string(reports.size()) + " reports for " +
                                               std::to_string(worlds.size()) + " worlds: give one for each");
  // What an engine enqueues elsewhere is under way in all worlds before the first is waited for; and a world that has
  // begun its step must be waited for, whatever became of others.
  std::vector<PlumbResult> begun(worlds.size(), PLUMB_OK);
  const auto begin = [&](std::size_t i) {
    begun[i] = worlds[i]->step(dt);
    check_world(*worlds[i], i, begun[i]);
  };
  const auto finish = [&](std::size_t i) {
    if (begun[i] < 0) return;
    reports[i] = {};
    reports[i].struct_size = sizeof(PlumbStepReport);
    check_world(*worlds[i], i, worlds[i]->wait(reports[i]));
  };
  std::exception_ptr failure;
  for (const std::function<void(std::size_t)>& phase : {std::function(begin), std::function(finish)}) try {
      each(worlds.size(), phase);
    } catch (...) {
      if (!failure) failure = std::current_exception();
    }
  if (failure) std::rethrow_exception(failure);
}

Worlds::Worlds(std::uint32_t count, const Make& make, std::uint32_t threads) : together_(threads) {
  for (std::uint32_t i = 0; i < count; ++i) {
    worlds_.push_back(make(i));
    require(worlds_.back() != nullptr, world_number(i) + "make gave none: return a world");
    pointers_.push_back(worlds_.back().get());
    const std::span<const PlumbBody> live = worlds_.back()->bodies();
    ids_.emplace_back(live.begin(), live.end());
    require(live.size() == ids_.front().size(), world_number(i) + std::to_string(live.size()) +
                                                    " bodies, and the first world has " +
                                                    std::to_string(ids_.front().size()) + ": make all alike");
  }
  bodies_ = count == 0 ? 0 : static_cast<std::uint32_t>(ids_.front().size());
  reports_.resize(count);
  if (count == 0) return;
  if (IWorlds* extension = worlds_.front()->worlds(); extension != nullptr)
    check(*worlds_.front(), extension->group(std::span(pointers_).subspan(1)));
}

void Worlds::step(double dt) { together_.step(pointers_, dt, reports_); }

void Worlds::mark() {
  std::vector<std::vector<std::byte>> marks(worlds_.size());
  together_.each(worlds_.size(), [&](std::size_t i) {
    ISnapshot& snapshots =
        require_extension(worlds_[i]->snapshot(), "reset of worlds", "plumb.snapshot/1", "PLUMB_NEED_SNAPSHOT");
    std::span<const std::byte> data;
    check_world(*worlds_[i], i, snapshots.save(data));
    marks[i].assign(data.begin(), data.end());
  });
  marks_ = std::move(marks);
}

void Worlds::reset(std::span<const std::uint8_t> mask) {
  require_mask(mask);
  require(marks_.size() == worlds_.size(), "reset of worlds: there is nothing to go back to: call mark() before");
  together_.each(worlds_.size(), [&](std::size_t i) {
    if (mask[i] != 0) check_world(*worlds_[i], i, worlds_[i]->snapshot()->restore(marks_[i]));
  });
}

void Worlds::reset() { reset(std::vector<std::uint8_t>(worlds_.size(), 1)); }

std::span<const double> Worlds::read(PlumbField field, std::span<const std::uint32_t> which) {
  require(field < PLUMB_FIELD_COUNT, "worlds: there is no field " + std::to_string(field));
  const Chosen bodies = choose(which);
  const std::size_t columns = columns_of(field);
  std::vector<double>& rows = rows_[field];
  rows.resize(worlds_.size() * bodies.count * columns);
  if (bodies.count == 0) return rows;
  together_.each(worlds_.size(), [&](std::size_t i) {
    check_world(*worlds_[i], i,
                worlds_[i]->read(field, ids_of(i, bodies), rows_of_world(rows, i, bodies.count, columns)));
  });
  return rows;
}

void Worlds::write(PlumbField field, std::span<const double> rows, std::span<const std::uint32_t> which,
                   std::span<const std::uint8_t> mask) {
  require(field < PLUMB_FIELD_COUNT, "worlds: there is no field " + std::to_string(field));
  if (!mask.empty()) require_mask(mask);
  const Chosen bodies = choose(which);
  const std::size_t columns = columns_of(field);
  require_rows(rows.size(), "bodies", bodies.count, columns);
  if (bodies.count == 0) return;
  together_.each(worlds_.size(), [&](std::size_t i) {
    if (!mask.empty() && mask[i] == 0) return;
    check_world(*worlds_[i], i,
                worlds_[i]->write(field, ids_of(i, bodies), rows_of_world(rows, i, bodies.count, columns)));
  });
}

std::span<const double> Worlds::read_joints(PlumbJointField field, std::span<const PlumbJoint> joints) {
  require(field < PLUMB_JOINT_FIELD_COUNT, "worlds: joints have no field " + std::to_string(field));
  const std::size_t columns = joint_columns_of(field);
  std::vector<double>& rows = joint_rows_[field];
  rows.resize(worlds_.size() * joints.size() * columns);
  if (joints.empty()) return rows;
  together_.each(worlds_.size(), [&](std::size_t i) {
    check_world(*worlds_[i], i,
                joints_of(*worlds_[i]).read_joints(field, joints, rows_of_world(rows, i, joints.size(), columns)));
  });
  return rows;
}

void Worlds::write_joints(PlumbJointField field, std::span<const double> rows, std::span<const PlumbJoint> joints,
                          std::span<const std::uint8_t> mask) {
  require(field < PLUMB_JOINT_FIELD_COUNT, "worlds: joints have no field " + std::to_string(field));
  if (!mask.empty()) require_mask(mask);
  const std::size_t columns = joint_columns_of(field);
  require_rows(rows.size(), "joints", joints.size(), columns);
  if (joints.empty()) return;
  together_.each(worlds_.size(), [&](std::size_t i) {
    if (!mask.empty() && mask[i] == 0) return;
    check_world(*worlds_[i], i,
                joints_of(*worlds_[i]).write_joints(field, joints, rows_of_world(rows, i, joints.size(), columns)));
  });
}

PlumbDLManagedTensor* Worlds::borrow(const PlumbStateRequest& request, PlumbFence* fence) {
  require(!worlds_.empty(), "worlds: there are none whose rows could be borrowed");
  IWorlds* extension = worlds_.front()->worlds();
  if (extension == nullptr)
    throw Error(PLUMB_E_UNSUPPORTED, "worlds: this backend has no plumb.worlds/1; read() its fields instead");
  PlumbDLManagedTensor* tensor = nullptr;
  check(*worlds_.front(), extension->borrow_all(request, tensor, fence));
  return tensor;
}

void Worlds::require_mask(std::span<const std::uint8_t> mask) const {
  require(mask.size() == worlds_.size(), "worlds: a mask of " + std::to_string(mask.size()) + " entries for " +
                                             std::to_string(worlds_.size()) + " worlds: give one for each");
}

void Worlds::require_rows(std::size_t numbers, const char* what, std::size_t count, std::size_t columns) const {
  require(numbers == worlds_.size() * count * columns,
          "worlds: " + std::to_string(numbers) + " numbers to write: give " + std::to_string(worlds_.size()) +
              " worlds x " + std::to_string(count) + " " + what + " x " + std::to_string(columns) + " columns");
}

Worlds::Chosen Worlds::choose(std::span<const std::uint32_t> which) const {
  Chosen chosen{which.empty() ? bodies_ : which.size(), {}};
  if (which.empty()) return chosen;
  for (const std::uint32_t body : which)
    if (body >= bodies_)
      throw Error(PLUMB_E_INVALID_ARGUMENT, "worlds: there is no body " + std::to_string(body) + ": each has " +
                                                std::to_string(bodies_) + ", counted from 0 in order of creation");
  chosen.ids.reserve(ids_.size() * which.size());
  for (const std::vector<PlumbBody>& all : ids_)
    for (const std::uint32_t body : which) chosen.ids.push_back(all[body]);
  return chosen;
}

std::span<const PlumbBody> Worlds::ids_of(std::size_t world, const Chosen& chosen) const {
  return chosen.ids.empty() ? std::span(ids_[world])
                            : std::span(chosen.ids).subspan(world * chosen.count, chosen.count);
}

}  // namespace plumb::helpers
