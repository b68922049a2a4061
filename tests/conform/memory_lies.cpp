// Lies about the host's memory.
#include "honest.hpp"

namespace plumb::lying {

void worlds_are_never_destroyed() {
  liar.core.destroy_world = [](PlumbWorld*) {};
}
void bodies_without_memory_are_created() {
  liar.core.create_bodies = [](PlumbWorld* world, const PlumbBodyDesc* descs, std::size_t stride, std::uint32_t count,
                               PlumbBody* ids) -> PlumbResult {
    const PlumbResult result = honest.core.create_bodies(world, descs, stride, count, ids);
    return result == PLUMB_E_OUT_OF_MEMORY ? PLUMB_OK : result;
  };
}
void joints_without_memory_are_created() {
  liar.joints.create = [](PlumbWorld* world, const PlumbJointDesc* descs, std::size_t stride, std::uint32_t count,
                          PlumbJoint* ids) -> PlumbResult {
    const PlumbResult result = honest.joints.create(world, descs, stride, count, ids);
    return result == PLUMB_E_OUT_OF_MEMORY ? PLUMB_OK : result;
  };
}
void steps_without_memory_are_broken() {
  liar.core.step = [](PlumbWorld* world, const PlumbStepDesc* desc) -> PlumbResult {
    const PlumbResult result = honest.core.step(world, desc);
    return result == PLUMB_E_OUT_OF_MEMORY || result == PLUMB_E_WORLD_LOST ? PLUMB_E_INTERNAL : result;
  };
  liar.core.wait = [](PlumbWorld* world, PlumbStepReport* report) -> PlumbResult {
    const PlumbResult result = honest.core.wait(world, report);
    return result == PLUMB_E_OUT_OF_MEMORY || result == PLUMB_E_WORLD_LOST ? PLUMB_E_INTERNAL : result;
  };
}

}  // namespace plumb::lying
