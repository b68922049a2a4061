// plumb.cooking/1 without a world: a descriptor becomes bytes.
#include <cstdio>
#include <cstdlib>

#include "caught.hpp"
#include "cooked_frame.hpp"
#include "described_shape.hpp"
#include "shape_content.hpp"

namespace plumb::backend {

namespace {

/// What materials by triangle ask a world for.
PlumbNeeds needs_of_materials(const PlumbShapeDesc& desc) {
  PlumbNeeds needs = 0;
  for (std::uint32_t i = 0; has_triangle_materials(desc) && i < desc.material_count; ++i) {
    if (desc.materials[i].friction != 0) needs |= PLUMB_NEED_FRICTION;
    if (desc.materials[i].restitution != 0) needs |= PLUMB_NEED_RESTITUTION;
  }
  return needs;
}

std::vector<std::byte> cooked(const BackendFacts& facts, const PlumbShapeDesc& given) {
  const PlumbShapeDesc desc = adopt_descs(&given, given.struct_size, 1, "desc", kShapeDesc10).front();
  const Where where{"desc", 0};
  if (desc.type == PLUMB_COMPOUND)
    refuse(PLUMB_E_UNSUPPORTED,
           "desc.type is PLUMB_COMPOUND, whose children are shapes of a world; cook the children, and create the "
           "compound from their handles");
  check_known_shape(facts, where, desc);
  CookedContents contents{{}, needs_of_materials(desc), false, {}};
  contents.record.type = desc.type;
  contents.record.content = shape_content(desc, {});
  weigh(facts, where, desc, {}, contents.record);
  const char* note = "";
  contents.is_native = answer_capability(facts, PLUMB_CAP_COOKING, desc.type, 0, &note) == PLUMB_NATIVE;
  const std::vector<std::byte> payload = contents.is_native ? facts.cook(desc) : describe(desc);
  contents.payload = payload;
  return frame_cooked(facts, contents);
}

}  // namespace

PlumbResult cook_shape(const BackendFacts& facts, const PlumbShapeDesc* desc, PlumbCooked* out) noexcept {
  if (out == nullptr || out->struct_size < sizeof(PlumbCooked)) return PLUMB_E_INVALID_ARGUMENT;
  out->data = nullptr;
  out->size = 0;
  out->message[0] = '\0';
  const auto failed = [&](PlumbResult code, const char* text) {
    std::snprintf(out->message, sizeof out->message, "%s", text);
    return code;
  };
  try {
    require_pointer(desc, 1, "desc");
    const std::vector<std::byte> bytes = cooked(facts, *desc);
    void* lent = std::malloc(bytes.size());
    if (lent == nullptr) throw std::bad_alloc();
    std::memcpy(lent, bytes.data(), bytes.size());
    out->data = lent;
    out->size = bytes.size();
    return PLUMB_OK;
  } catch (...) {
    return caught(failed);
  }
}

void release_cooked(const void* data) noexcept { std::free(const_cast<void*>(data)); }

}  // namespace plumb::backend
