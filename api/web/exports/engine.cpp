// The engine itself: memory, names, what it can, and its settings.
#include <cstdlib>

#include "shared.hpp"

namespace plumb::web {

std::string& last_error() {
  static std::string text;
  return text;
}

const Backend& backend() {
  static const Backend only(negotiate(&plumb_backend_open, "linked into this .wasm"));
  return only;
}

}  // namespace plumb::web

using plumb::web::backend;

PLUMB_WEB(void*, plumb_allocate)(std::uint32_t bytes) { return std::malloc(bytes); }
PLUMB_WEB(void, plumb_release)(void* memory) { std::free(memory); }
PLUMB_WEB(const char*, plumb_error)() { return plumb::web::last_error().c_str(); }

/// 0: the backend's name, 1: its version, 2: its build.
PLUMB_WEB(const char*, plumb_info)(std::uint32_t which) {
  const PlumbBackendInfo& info = backend().info();
  return which == 0 ? info.name : which == 1 ? info.version : info.build;
}

PLUMB_WEB(PlumbDegree, plumb_capability)(PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
  return backend().capability(kind, a, b);
}

/// What the shape is cooked into; the bytes live until the next call of this.
PLUMB_WEB(PlumbResult, plumb_cook)(const PlumbShapeDesc* desc, const std::byte** bytes, std::uint32_t* size) {
  static std::vector<std::byte> cooked;
  return plumb::web::guarded([&] {
    cooked = backend().cook(*desc);
    *bytes = cooked.data();
    *size = static_cast<std::uint32_t>(cooked.size());
    return PLUMB_OK;
  });
}

/// Null from the last on.
PLUMB_WEB(const PlumbSettingInfo*, plumb_setting)(std::uint32_t index) {
  static const auto all = backend().settings();
  return index < all.size() ? all[index] : nullptr;
}

/// Bytes of a struct, in the order of engine/layouts.mjs: whether it was written against this plumb.h. 0: no more.
PLUMB_WEB(std::uint32_t, plumb_struct_size)(std::uint32_t which) {
  constexpr std::uint32_t sizes[] = {
      sizeof(PlumbShapeDesc),   sizeof(PlumbMaterial),       sizeof(PlumbCompoundChild),
      sizeof(PlumbBodyDesc),    sizeof(PlumbJointDesc),      sizeof(PlumbWorldDesc),
      sizeof(PlumbSetting),     sizeof(PlumbSettingInfo),    sizeof(PlumbStepReport),
      sizeof(PlumbContact),     sizeof(PlumbEvent),          sizeof(PlumbRay),
      sizeof(PlumbCast),        sizeof(PlumbOverlap),        sizeof(PlumbHit),
      sizeof(PlumbBodyPair),    sizeof(PlumbBodyChange),     sizeof(PlumbJointChange),
      sizeof(PlumbPosedPair),   sizeof(PlumbPairResult),     sizeof(PlumbPairPoint),
      sizeof(PlumbManifold),    sizeof(PlumbManifoldChange), sizeof(PlumbPenetration),
      sizeof(PlumbCookedShape), sizeof(PlumbTurningCast),
  };
  return which < sizeof sizes / sizeof *sizes ? sizes[which] : 0;
}
