#include "start.hpp"

#include <atomic>
#include <utility>

namespace plumb::px {
namespace {

thread_local std::string last_complaint;
std::atomic<std::uint32_t> lost{0};

struct Complaints final : PxErrorCallback {
  void reportError(PxErrorCode::Enum code, const char* message, const char*, int) override {
    if (code != PxErrorCode::eDEBUG_INFO) last_complaint = message;
    if (code == PxErrorCode::eINTERNAL_ERROR || code == PxErrorCode::eOUT_OF_MEMORY) ++lost;
  }
};

PxPhysics& start() {
  static PxDefaultAllocator allocator;
  static Complaints complaints;
  PxFoundation* foundation = PxCreateFoundation(PX_PHYSICS_VERSION, allocator, complaints);
  if (foundation == nullptr) throw Error(PLUMB_E_INTERNAL, "PhysX does not start" + because());
  PxPhysics* physics = PxCreatePhysics(PX_PHYSICS_VERSION, *foundation, PxTolerancesScale());
  if (physics == nullptr || !PxInitExtensions(*physics, nullptr))
    throw Error(PLUMB_E_INTERNAL, "PhysX does not start" + because());
  return *physics;
}

}  // namespace

PxPhysics& physics() {
  static PxPhysics& started = start();
  return started;
}

std::string complaint() {
  std::string said = std::exchange(last_complaint, {});
  while (!said.empty() && said.back() == '\n') said.pop_back();
  return said;
}

std::uint32_t losses() { return lost; }

std::string because() {
  const std::string why = complaint();
  return why.empty() ? "" : ": " + why;
}

}  // namespace plumb::px
