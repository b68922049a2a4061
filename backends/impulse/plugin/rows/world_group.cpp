// plumb.worlds/1: worlds whose steps run as one, and whose rows are lent as one block.
#include "plugin/rows/world_group.hpp"

#include <algorithm>

#include "plugin/rows/lent_rows.hpp"
#include "plugin/rows/own_memory.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

World::~World() { leave_group(); }

/// What it has yet to do for the others, and they for it, is done before.
void World::leave_group() {
  if (lent_.group == nullptr) return;
  simulation_.executor().leave();
  simulation_.also_write(RowSlice<PoseRow>{});
  simulation_.also_write(RowSlice<VelocityRow>{});
  const std::scoped_lock lock(lent_.group->mutex);
  std::replace(lent_.group->worlds.begin(), lent_.group->worlds.end(), this, static_cast<World*>(nullptr));
  lent_.group.reset();
}

PlumbResult World::group(std::span<IPhysicsWorld* const> others) {
  leave_group();
  if (others.empty()) return PLUMB_OK;
  const auto group = std::make_shared<WorldGroup>();
  group->worlds.push_back(this);
  for (IPhysicsWorld* other : others) group->worlds.push_back(static_cast<World*>(other));
  const auto batch = std::make_shared<Batch>();
  for (World* world : group->worlds) {
    world->leave_group();
    world->lent_.group = group;
    world->simulation_.join(batch);
  }
  return PLUMB_OK;
}

/// Makes the block anew where it is not that of these worlds and bodies, and brings all rows up to date.
template <class Row>
void World::share_rows(std::shared_ptr<RowBlock<Row>>& block) {
  WorldGroup& group = *lent_.group;
  const std::uint32_t rows = group.rows_each;
  const bool is_new = block == nullptr || block->rows.size() != std::size_t{rows} * group.worlds.size();
  if (is_new) {
    block = std::make_shared<RowBlock<Row>>();
    block->rows.grow(std::size_t{rows} * group.worlds.size());
  }
  for (std::size_t k = 0; k < group.worlds.size(); ++k) {
    Simulation& simulation = group.worlds[k]->simulation_;
    if (is_new) simulation.also_write(RowSlice<Row>{block->rows.device() + k * rows, rows});
    if constexpr (std::is_same_v<Row, PoseRow>)
      (void)simulation.pose_rows(false);
    else
      (void)simulation.velocity_rows(false);
  }
}

PlumbResult World::borrow_all(const PlumbStateRequest& request, PlumbDLManagedTensor*& tensor, PlumbFence* fence) {
  const bool own = asks_for_own_memory(request);
  if (lent_.group == nullptr) {  // a group of one
    lent_.group = std::make_shared<WorldGroup>();
    lent_.group->worlds.push_back(this);
  }
  WorldGroup& group = *lent_.group;
  const std::scoped_lock lock(group.mutex);
  for (std::size_t k = 0; k < group.worlds.size(); ++k) {
    const std::string name = "world " + std::to_string(k) + " of the group ";
    if (group.worlds[k] == nullptr) throw Error(PLUMB_E_INVALID_ARGUMENT, name + "is gone; group those that are left");
    const std::uint32_t rows = group.worlds[k]->simulation_.bodies.count;
    if (k != 0 && rows != group.rows_each)
      throw Error(PLUMB_E_INVALID_ARGUMENT, name + "has " + std::to_string(rows) + " rows of bodies and the first " +
                                                std::to_string(group.rows_each) + "; make them alike");
    group.rows_each = rows;
  }
  const auto lend = [&]<class Row>(std::shared_ptr<RowBlock<Row>>& block) {
    share_rows(block);
    Executor& executor = simulation_.executor();
    if (own) {
      executor.send(block->written);
    } else {
      executor.to_host(block->rows, block->rows.size());
      executor.wait();
    }
    if (fence != nullptr) *fence = {nullptr, nullptr};
    if (fence != nullptr && own) *fence = {executor.stream_handle(), block->written.handle()};
    tensor = LentRows<Row>::lend(block, group.worlds.size(), group.rows_each, own);
  };
  if (request.field == PLUMB_FIELD_POSE)
    lend(group.poses);
  else
    lend(group.velocities);
  return own ? PLUMB_OK : PLUMB_COPIED;
}

}  // namespace plumb::impulse
