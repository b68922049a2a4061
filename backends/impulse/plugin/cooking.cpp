// plumb.cooking/1: meshes and hulls cooked ahead. The bytes are the rows that kernels read, the same ones on the CPU
// and on a GPU.
#include "plugin/ranges.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

backend::CookedFormat World::cooked_format() { return {"impulse", 1}; }

std::vector<std::byte> World::cook(const PlumbShapeDesc& desc) {
  require_range(desc, 0);
  if (desc.type == PLUMB_TRIANGLE_MESH) {
    Executor executor(nullptr, 1);
    return SurfacePool::cook_mesh(executor, desc);
  }
  backend::CookedWriter bytes;
  HullRows({reinterpret_cast<const PlumbVec3*>(desc.vertices), desc.vertex_count}).cook(bytes);
  return bytes.take();
}

}  // namespace plumb::impulse
