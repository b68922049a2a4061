#include <algorithm>

#include "device.hpp"
#include "start.hpp"

namespace plumb::px {
namespace {

/// Lives as long as the process, as PhysX does; null: PhysX finds no GPU, or not the library with its kernels.
PxCudaContextManager* make_manager() {
  PxFoundation& foundation = physics().getFoundation();
  (void)complaint();
  PxCudaContextManager* made = PxCreateCudaContextManager(foundation, PxCudaContextManagerDesc());
  if (made == nullptr || made->contextIsValid()) return made;
  made->release();
  return nullptr;
}

struct Device {
  PxCudaContextManager* manager = make_manager();
  std::string why = because();
};

const Device& device() {
  static const Device found;
  return found;
}

}  // namespace

std::string missing_device() {
  if (device().manager != nullptr) return {};
  return "physx-cuda finds no CUDA device" + device().why +
         "; it needs an NVIDIA GPU, its driver, and libPhysXGpu_64.so beside the backend";
}

const char* device_name() { return device().manager == nullptr ? "cuda" : device().manager->getDeviceName(); }

/// What PhysX has no room for on the GPU it drops: its own room, or more where more bodies come.
void put_device(std::uint32_t bodies, std::uint32_t contacts, PxSceneDesc& desc) {
  PxGpuDynamicsMemoryConfig& room = desc.gpuDynamicsConfig;
  const std::uint32_t many = std::min(bodies, 1u << 22);
  room.maxRigidContactCount = std::max({room.maxRigidContactCount, 64 * many, contacts});
  room.maxRigidPatchCount = std::max(room.maxRigidPatchCount, 16 * many);
  room.foundLostPairsCapacity = std::max(room.foundLostPairsCapacity, 32 * many);
  room.collisionStackSize = std::max(room.collisionStackSize, 4096 * std::min(many, 1u << 19));
  room.tempBufferCapacity = std::max<PxU64>(room.tempBufferCapacity, PxU64{2048} * many);
  desc.cudaContextManager = device().manager;
  desc.flags |= PxSceneFlag::eENABLE_GPU_DYNAMICS;
}

}  // namespace plumb::px
