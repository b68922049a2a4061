// Which of the two backends this is: PhysX on the CPU, or with its rigid bodies on a GPU.
#pragma once

#include <string>

#include "physx_math.hpp"

namespace plumb::px {

#ifdef PLUMB_PHYSX_CUDA
inline constexpr bool kOnGpu = true;
#else
inline constexpr bool kOnGpu = false;
#endif

/// Why there is no GPU that PhysX can use, in a sentence, or "". Of the CPU always "".
[[nodiscard]] std::string missing_device();
/// "cpu", or the GPU's name.
[[nodiscard]] const char* device_name();

/// Has a scene simulated there. bodies, contacts: how many there may be; 0: not known.
void put_device(std::uint32_t bodies, std::uint32_t contacts, PxSceneDesc& desc);

}  // namespace plumb::px
