// plumb.state/1: the engine's rows of poses and velocities, lent where they lie.
#include <string>

#include "plugin/rows/lent_rows.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

namespace {

constexpr std::int32_t kHost = 1;

/// Whether the request is for the memory in which the engine works; the other one is the host's twin of it.
bool asks_for_own_memory(const PlumbStateRequest& request) {
  if (request.device_type == Executor::device_type()) return true;
  const std::string place = Executor::device_type() == kHost ? "the host" : "the device";
  const std::string type = std::to_string(Executor::device_type());
  const std::string here = PLUMB_IMPULSE_NAME " keeps its state on " + place + "; ask for device_type " + type;
  if (request.device_type != kHost)
    throw Error(PLUMB_E_UNSUPPORTED, here + " instead of " + std::to_string(request.device_type));
  if (request.allow_copy == 0) throw Error(PLUMB_E_UNSUPPORTED, here + ", or set allow_copy");
  return false;
}

}  // namespace

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
