// plumb.state/1: the engine's rows of poses and velocities, lent where they lie.
#include "plugin/rows/lent_rows.hpp"
#include "plugin/rows/own_memory.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

PlumbResult World::borrow(const PlumbStateRequest& request, PlumbDLManagedTensor*& tensor, PlumbFence* fence) {
  const bool own = asks_for_own_memory(request);
  const auto lend = [&]<class Row>(const std::shared_ptr<RowBlock<Row>>& block) {
    if (own) simulation_.executor().send(block->written);
    if (fence != nullptr && own) *fence = {simulation_.executor().stream_handle(), block->written.handle()};
    if (fence != nullptr && !own) *fence = {nullptr, nullptr};
    tensor = LentRows<Row>::lend(block, simulation_.bodies.count, own);
  };
  if (request.field == PLUMB_FIELD_POSE)
    lend(simulation_.pose_rows(!own));
  else
    lend(simulation_.velocity_rows(!own));
  return own ? PLUMB_OK : PLUMB_COPIED;
}

PlumbResult World::row_map(std::span<const PlumbBody>& ids, std::uint64_t& generation) {
  ids = rows_.ids;
  generation = rows_.generation;
  return PLUMB_OK;
}

}  // namespace plumb::impulse
