// The guard of plumb.cooking/1 in a world: bytes are known to be whole and of this backend, and then are shapes as
// those from descriptors are.
#pragma once

#include "cooked_frame.hpp"
#include "described_shape.hpp"
#include "guarded_modify.hpp"

namespace plumb::backend {

class GuardedCooking : public GuardedModify {
 public:
  using GuardedModify::GuardedModify;

  PlumbResult create_cooked(const PlumbCookedShape* shapes, std::size_t stride, std::uint32_t count, PlumbShape* ids) {
    const std::vector<PlumbCookedShape> adopted = adopt_descs(shapes, stride, count, "shapes");
    require_pointer(ids, count, "ids");
    Opened opened;
    std::vector<ShapeRecord> records;
    for (std::uint32_t i = 0; i < count; ++i) records.push_back(open({"shapes", i}, adopted[i], opened));
    return create(shapes_, std::move(records), {ids, count},
                  [&](std::span<const std::uint64_t> handles) { return make(opened, handles); });
  }

 private:
  /// Bytes that were looked into: those of the class, and descriptors, each with its place among all.
  struct Opened {
    std::vector<CookedPayload> payloads;
    std::vector<DescribedShape> described;
    std::vector<std::size_t> payload_at, described_at;
  };

  ShapeRecord open(const Where& where, const PlumbCookedShape& shape, Opened& opened) const {
    const std::string name = where.member("data");
    require_pointer(shape.data, static_cast<std::size_t>(shape.size), name.c_str());
    CookedContents cooked =
        unframe_cooked(facts_, name, {static_cast<const std::byte*>(shape.data), static_cast<std::size_t>(shape.size)});
    const PlumbShapeType type = cooked.record.type;
    if (!has_shape(facts_, type)) require_capability(PLUMB_CAP_SHAPE, type, PLUMB_STATIC, shape_name(type));
    for (std::uint32_t bit = 0; bit < 64; ++bit)
      if ((cooked.needs >> bit & 1) != 0)
        require_need(init_.desc.needs, PlumbNeeds{1} << bit, true, name + ", by its materials of triangles,");
    if (cooked.is_native) {
      const char* note = "";
      if (answer_capability(facts_, PLUMB_CAP_COOKING, type, 0, &note) != PLUMB_NATIVE)
        CookedReader::corrupt("is of a type that this backend does not cook");
      opened.payload_at.push_back(opened.payload_at.size() + opened.described_at.size());
      opened.payloads.push_back({type, cooked.payload});
    } else {
      opened.described_at.push_back(opened.payload_at.size() + opened.described_at.size());
      opened.described.emplace_back(type, cooked.payload);
      check_known_shape(facts_, where, opened.described.back().desc());
    }
    return std::move(cooked.record);
  }

  PlumbResult make(const Opened& opened, std::span<const std::uint64_t> handles) {
    const auto handles_at = [&](const std::vector<std::size_t>& places) {
      std::vector<PlumbShape> some;
      for (const std::size_t place : places) some.push_back(handles[place]);
      return some;
    };
    PlumbResult result = PLUMB_OK;
    std::vector<PlumbShape> of_descs = handles_at(opened.described_at);
    std::vector<PlumbShapeDesc> descs;
    for (const DescribedShape& described : opened.described) descs.push_back(described.desc());
    if (!descs.empty()) result = done(world_->create_shapes(descs, of_descs));
    if (opened.payloads.empty()) return result;
    try {
      return std::max(result, done(dynamic_cast<ICookedShapes&>(*world_).create_cooked(opened.payloads,
                                                                                       handles_at(opened.payload_at))));
    } catch (...) {
      if (!descs.empty()) static_cast<void>(world_->destroy_shapes(of_descs));
      throw;
    }
  }
};

}  // namespace plumb::backend
