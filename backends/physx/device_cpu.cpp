#include "device.hpp"

namespace plumb::px {

std::string missing_device() { return {}; }
const char* device_name() { return "cpu"; }
void put_device(std::uint32_t /*bodies*/, std::uint32_t /*contacts*/, PxSceneDesc& /*desc*/) {}

}  // namespace plumb::px
