// The guard of plumb.worlds/1: worlds of one backend, different ones, none within a step.
#pragma once

#include <algorithm>

#include "guarded_manifolds.hpp"

namespace plumb::backend {

class GuardedWorlds final : public GuardedManifolds {
 public:
  using GuardedManifolds::GuardedManifolds;

  PlumbResult group(PlumbWorld* const* others, std::uint32_t count) {
    IWorlds& extension = require_extension(world_->worlds(), PLUMB_EXT_WORLDS);
    require_pointer(others, count, "others");
    require_no_step("world");
    std::vector<const GuardedWorlds*> seen = {this};
    std::vector<IPhysicsWorld*> worlds;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::string name = Where{"others", i}.member("");
      const auto* other = reinterpret_cast<const GuardedWorlds*>(others[i]);
      if (other == nullptr) refuse(PLUMB_E_INVALID_ARGUMENT, name + " is null; give a world");
      if (&other->facts_ != &facts_)
        refuse(PLUMB_E_INVALID_ARGUMENT, name + " is of another backend; group worlds of one");
      other->require_no_step(name);
      seen.push_back(other);
      worlds.push_back(other->world_.get());
    }
    std::sort(seen.begin(), seen.end());
    if (std::adjacent_find(seen.begin(), seen.end()) != seen.end())
      refuse(PLUMB_E_INVALID_ARGUMENT,
             "others has a world twice, or the one that they are grouped with; name each once");
    return done(extension.group(worlds));
  }

  PlumbResult borrow_all(const PlumbStateRequest* request, PlumbDLManagedTensor** tensor, PlumbFence* fence) {
    IWorlds& extension = require_extension(world_->worlds(), PLUMB_EXT_WORLDS);
    require_state_request(request, tensor);
    return extension.borrow_all(*request, *tensor, fence);
  }

 private:
  void require_no_step(const std::string& name) const {
    if (stepping_) refuse(PLUMB_E_WRONG_PHASE, name + " is within a step; wait for it first");
  }
};

}  // namespace plumb::backend
