// Worlds whose steps are taken together, and the block in which the rows of all of them lie.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "bodies/state_rows.hpp"

namespace plumb::impulse {

class World;

struct WorldGroup {
  std::mutex mutex;                          // worlds go in any thread
  std::vector<World*> worlds;                // in their order; null: it is gone, or in another group
  std::uint32_t rows_each = 0;               // that the blocks have
  std::shared_ptr<RowBlock<PoseRow>> poses;  // null before somebody borrows them
  std::shared_ptr<RowBlock<VelocityRow>> velocities;
};

}  // namespace plumb::impulse
