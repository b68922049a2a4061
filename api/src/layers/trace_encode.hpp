// How each call's inputs and outputs are written to a trace, by the shape of its signature. replay_calls.hpp reads
// them.
#pragma once

#include <map>

#include "layer_slots.hpp"
#include "plumb/backend/check_descs.hpp"
#include "trace_format.hpp"
#include "trace_objects.hpp"

namespace plumb::layers {

template <Call call>
using CallTag = std::integral_constant<Call, call>;

/// The snapshots that a world gave: which save each was, by the hash of its bytes.
struct Saves {
  std::map<std::uint64_t, std::uint64_t> by_hash;
  std::uint64_t count = 0;
};

/// Where the encoders write, and what they know of the call's world.
struct Encoding {
  ByteWriter& out;
  ObjectNames& names;
  Saves& saves;
  PlumbResult result;

  [[nodiscard]] bool done() const { return result >= 0; }

  /// An array's head. True when elements follow.
  bool array(const void* data, std::uint32_t count, std::size_t stride) {
    out.put<std::uint8_t>(data != nullptr);
    out.put(count);
    out.put<std::uint64_t>(stride);
    return data != nullptr;
  }
  /// Structs with the caller's stride, handles as numbers. Members that the caller's struct lacks are 0.
  template <class Row>
  void rows(const Row* data, std::size_t stride, std::uint32_t count) {
    if (!array(data, count, stride)) return;
    for (std::uint32_t i = 0; i < count; ++i) {
      Row row{};
      std::memcpy(static_cast<void*>(&row), reinterpret_cast<const std::byte*>(data) + i * stride,
                  std::min(stride, sizeof row));
      row_with_arrays(row);
    }
  }
  void handles(const std::uint64_t* data, std::uint32_t count, Objects kind) {
    if (!array(data, count, sizeof(std::uint64_t))) return;
    for (std::uint32_t i = 0; i < count; ++i) out.put(names.number(kind, data[i]));
  }
  /// Room for output: whether there was any, and for how many.
  void room(const void* data, std::uint32_t capacity) {
    out.put<std::uint8_t>(data != nullptr);
    out.put(capacity);
  }
  void output(std::uint64_t count, std::span<const std::byte> bytes) {
    out.put(count);
    out.put(hash_bytes(bytes));
  }
  /// The rows of an output array that were written.
  template <class Row>
  void output_rows(const Row* data, std::size_t stride, std::uint32_t capacity, std::uint32_t count) {
    ByteWriter bytes;
    for (std::uint32_t i = 0; i < std::min(capacity, count); ++i) {
      Row row;
      std::memcpy(&row, reinterpret_cast<const std::byte*>(data) + i * stride, sizeof row);
      names.to_numbers(row);
      bytes.put(row);
    }
    output(count, bytes.bytes());
  }

  void value(const PlumbSettingValue& value) {
    out.put(value.type);
    out.put(value.number);
    out.put_string(value.choice);
  }

 private:
  template <class Row>
  void row_with_arrays(Row& row) {
    names.to_numbers(row);
    out.put(row);
  }
  void row_with_arrays(PlumbCookedShape& shape) {
    const std::span bytes(static_cast<const std::byte*>(shape.data), shape.data == nullptr ? 0 : shape.size);
    shape.data = nullptr;
    out.put(shape);
    if (array(bytes.data(), static_cast<std::uint32_t>(bytes.size()), 1)) out.put_bytes(bytes);
  }
  void row_with_arrays(PlumbWorldDesc& desc) {
    desc.settings = nullptr;
    out.put(desc);
  }
  // As bodies were before rolling friction, and joints before gears, where there is none, so that older traces are read
  // alike; struct_size tells. One that is refused keeps its own, to be refused again.
  template <class Desc>
  void put_grown(Desc& desc, bool has_later, std::size_t before) {
    names.to_numbers(desc);
    if (!has_later && desc.struct_size == sizeof desc) desc.struct_size = static_cast<std::uint32_t>(before);
    out.put_bytes(std::as_bytes(std::span(&desc, 1)).first(desc.struct_size > before ? sizeof desc : before));
  }
  void row_with_arrays(PlumbBodyDesc& desc) {
    put_grown(desc, desc.rolling_friction != 0 || desc.spinning_friction != 0, backend::kBodyDesc10);
  }
  void row_with_arrays(PlumbJointDesc& desc) { put_grown(desc, desc.ratio != 0, backend::kJointDesc10); }
  // Arrays are there only for the types that have them: members of other types may hold anything. Of the descriptor the
  // part that all versions have; what came later follows where there is any, so that older traces are read alike.
  void row_with_arrays(PlumbShapeDesc& desc) {
    const bool hull = desc.type == PLUMB_CONVEX_HULL, mesh = desc.type == PLUMB_TRIANGLE_MESH;
    const auto* vertices = hull || mesh ? desc.vertices : nullptr;
    const auto* indices = mesh ? desc.indices : nullptr;
    const auto* heights = desc.type == PLUMB_HEIGHT_FIELD ? desc.heights : nullptr;
    const auto* children = desc.type == PLUMB_COMPOUND ? desc.children : nullptr;
    const PlumbShapeDesc given = desc;
    desc.vertices = desc.heights = nullptr;
    desc.indices = nullptr;
    desc.children = nullptr;
    out.put_bytes(std::as_bytes(std::span(&desc, 1)).first(backend::kShapeDesc10));
    rows(reinterpret_cast<const PlumbVec3*>(vertices), sizeof(PlumbVec3), vertices == nullptr ? 0 : desc.vertex_count);
    rows(reinterpret_cast<const std::array<std::uint32_t, 3>*>(indices), 12,
         indices == nullptr ? 0 : desc.triangle_count);
    rows(heights, sizeof(double), heights == nullptr ? 0 : desc.rows * desc.columns);
    rows(children, sizeof(PlumbCompoundChild), children == nullptr ? 0 : desc.child_count);
    if (!backend::has_triangle_materials(given)) return;
    rows(given.materials, sizeof(PlumbMaterial), given.material_count);
    rows(given.triangle_materials, sizeof(std::uint32_t), static_cast<std::uint32_t>(backend::triangles_of(given)));
  }
};

// create_shapes, create_bodies, joints.create, cooking.create
template <Call call, class Desc>
void encode(CallTag<call>, Encoding e, const Desc* descs, std::size_t stride, std::uint32_t count, std::uint64_t* ids) {
  e.rows(descs, stride, count);
  for (std::uint32_t i = 0; e.done() && i < count; ++i) e.names.add(CallTraits<call>::objects, ids[i]);
}
// destroy_shapes, destroy_bodies, joints.destroy
template <Call call>
void encode(CallTag<call>, Encoding e, const std::uint64_t* ids, std::uint32_t count) {
  e.handles(ids, count, CallTraits<call>::objects);
}
// list_bodies, debug.*, exceptions.list
template <Call call, class Row>
void encode(CallTag<call>, Encoding e, Row* out, std::uint32_t capacity, std::uint32_t* count) {
  e.room(out, capacity);
  if (!e.done()) return;
  if constexpr (std::is_same_v<Row, PlumbBody>) {
    struct Listed {
      PlumbBody body;
    };
    e.output_rows(reinterpret_cast<const Listed*>(out), sizeof(PlumbBody), capacity, *count);
  } else {
    e.output_rows(out, sizeof(Row), capacity, *count);
  }
}
// contacts, events, manifolds.read
template <Call call, class Row>
void encode(CallTag<call>, Encoding e, Row* out, std::size_t stride, std::uint32_t capacity, std::uint32_t* count) {
  e.out.put<std::uint64_t>(stride);
  e.room(out, capacity);
  if (e.done()) e.output_rows(out, stride, capacity, *count);
}
template <Call call>
std::size_t row_size(std::uint32_t field, PlumbDataType type) {
  const std::uint32_t columns =
      CallTraits<call>::objects == Objects::joints ? joint_columns_of(field) : columns_of(field);
  return columns * (type == PLUMB_F64 ? sizeof(double) : sizeof(float));
}
inline std::vector<std::byte> tight(const void* rows, std::size_t size, std::size_t stride, std::uint32_t count) {
  std::vector<std::byte> bytes(size * count);
  for (std::uint32_t i = 0; i < count; ++i)
    std::memcpy(bytes.data() + i * size, static_cast<const std::byte*>(rows) + i * stride, size);
  return bytes;
}
// read, joints.read
template <Call call>
void encode(CallTag<call>, Encoding e, std::uint32_t field, PlumbDataType type, const std::uint64_t* ids,
            std::uint32_t count, void* rows, std::size_t stride) {
  e.out.put(field);
  e.out.put(type);
  e.handles(ids, count, CallTraits<call>::objects);
  e.out.put<std::uint64_t>(stride);
  if (e.done()) e.output(count, tight(rows, row_size<call>(field, type), stride, count));
}
// write, joints.write
template <Call call>
void encode(CallTag<call>, Encoding e, std::uint32_t field, PlumbDataType type, const std::uint64_t* ids,
            std::uint32_t count, const void* rows, std::size_t stride) {
  e.out.put(field);
  e.out.put(type);
  e.handles(ids, count, CallTraits<call>::objects);
  if (!e.array(rows, count, stride)) return;
  const std::size_t size = std::min(row_size<call>(field, type), stride);
  e.out.put_bytes(tight(rows, size, stride, count));
}
// queries.rays, queries.casts
template <Call call, class Query>
void encode(CallTag<call>, Encoding e, PlumbHitMode mode, const Query* queries, std::size_t stride, std::uint32_t count,
            PlumbHit* hits, std::uint32_t capacity, std::uint32_t* hit_count) {
  e.out.put(mode);
  e.rows(queries, stride, count);
  e.room(hits, capacity);
  if (e.done()) e.output_rows(hits, sizeof(PlumbHit), capacity, *hit_count);
}
inline void encode(CallTag<Call::queries_overlaps>, Encoding e, const PlumbOverlap* overlaps, std::size_t stride,
                   std::uint32_t count, PlumbHit* hits, std::uint32_t capacity, std::uint32_t* hit_count) {
  e.rows(overlaps, stride, count);
  e.room(hits, capacity);
  if (e.done()) e.output_rows(hits, sizeof(PlumbHit), capacity, *hit_count);
}
inline void encode(CallTag<Call::queries_penetrations>, Encoding e, const PlumbOverlap* overlaps, std::size_t stride,
                   std::uint32_t count, PlumbPenetration* out, std::uint32_t capacity, std::uint32_t* out_count) {
  e.rows(overlaps, stride, count);
  e.room(out, capacity);
  if (e.done()) e.output_rows(out, sizeof(PlumbPenetration), capacity, *out_count);
}
inline void encode(CallTag<Call::closest_bodies>, Encoding e, PlumbHitMode mode, const PlumbProbe* probes,
                   std::size_t stride, std::uint32_t count, PlumbClosest* out, std::uint32_t capacity,
                   std::uint32_t* out_count) {
  e.out.put(mode);
  e.rows(probes, stride, count);
  e.room(out, capacity);
  if (e.done()) e.output_rows(out, sizeof(PlumbClosest), capacity, *out_count);
}
inline void encode(CallTag<Call::collide_pairs>, Encoding e, const PlumbPosedPair* pairs, std::size_t stride,
                   std::uint32_t count, PlumbPairResult*, PlumbPairPoint* points, std::uint32_t capacity,
                   std::uint32_t* point_count) {
  e.rows(pairs, stride, count);
  e.room(points, capacity);
  if (e.done()) e.output_rows(points, sizeof(PlumbPairPoint), capacity, *point_count);
}
inline void encode(CallTag<Call::core_user_data>, Encoding e, PlumbBody id, std::uint64_t* user_data) {
  e.out.put(e.names.number(Objects::bodies, id));
  if (e.done()) e.output(1, std::as_bytes(std::span(user_data, 1)));
}
inline void encode(CallTag<Call::core_set_gravity>, Encoding e, const PlumbVec3* gravity) {
  e.rows(gravity, sizeof(PlumbVec3), 1);
}
inline void encode(CallTag<Call::core_step>, Encoding e, const PlumbStepDesc* desc) {
  e.rows(desc, sizeof(PlumbStepDesc), 1);
}
// Of a report, what is the same from run to run: no times.
inline std::array<std::uint32_t, 6> steady(const PlumbStepReport& report) {
  return {report.bodies, report.awake, report.contacts, report.joints, report.dropped, report.nonfinite};
}
inline void encode(CallTag<Call::core_wait>, Encoding e, PlumbStepReport* report) {
  e.out.put<std::uint8_t>(report != nullptr);
  if (!e.done() || report == nullptr) return;
  const auto counts = steady(*report);
  e.output(1, std::as_bytes(std::span(counts)));
}
inline void encode(CallTag<Call::settings_get>, Encoding e, const char* name, PlumbSettingValue* value) {
  e.out.put_string(name);
  if (!e.done()) return;
  ByteWriter bytes;
  Encoding{bytes, e.names, e.saves, e.result}.value(*value);
  e.output(1, bytes.bytes());
}
inline void encode(CallTag<Call::settings_set>, Encoding e, const char* name, const PlumbSettingValue* value) {
  e.out.put_string(name);
  if (e.array(value, 1, 0)) e.value(*value);
}
// Snapshots are the engine's own bytes: a restore is recorded by which save of the world it goes back to.
inline void encode_save(Encoding e, const void* data, std::size_t capacity, const std::size_t* size) {
  const bool saved = e.result == PLUMB_OK;
  e.out.put<std::uint8_t>(saved);
  e.out.put<std::uint64_t>(capacity);
  if (saved) e.saves.by_hash[hash_bytes({static_cast<const std::byte*>(data), *size})] = ++e.saves.count;
}
inline void encode(CallTag<Call::snapshot_save>, Encoding e, void* data, std::size_t capacity, std::size_t* size) {
  encode_save(e, data, capacity, size);
}
inline void encode(CallTag<Call::snapshot_save_world>, Encoding e, void* data, std::size_t capacity,
                   std::size_t* size) {
  encode_save(e, data, capacity, size);
}
inline void encode(CallTag<Call::snapshot_restore>, Encoding e, const void* data, std::size_t size) {
  const std::span<const std::byte> bytes(static_cast<const std::byte*>(data), data == nullptr ? 0 : size);
  const auto known = e.saves.by_hash.find(hash_bytes(bytes));
  e.out.put<std::uint64_t>(known == e.saves.by_hash.end() ? 0 : known->second);
  if (known == e.saves.by_hash.end() && e.array(data, static_cast<std::uint32_t>(size), 1)) e.out.put_bytes(bytes);
}
inline void encode(CallTag<Call::snapshot_hash>, Encoding e, std::uint64_t* hash) {
  if (e.done()) e.output(1, std::as_bytes(std::span(hash, 1)));
}
inline void encode(CallTag<Call::state_borrow>, Encoding e, const PlumbStateRequest* request, PlumbDLManagedTensor**,
                   PlumbFence* fence) {
  e.rows(request, sizeof(PlumbStateRequest), 1);
  e.out.put<std::uint8_t>(fence != nullptr);
}
inline void encode(CallTag<Call::state_rows>, Encoding e, PlumbBody* ids, std::uint32_t capacity, std::uint32_t* count,
                   std::uint64_t*) {
  e.room(ids, capacity);
  if (e.done()) e.output(*count, {});
}
inline void encode(CallTag<Call::modify_shapes>, Encoding e, const PlumbShape* shapes, const PlumbShapeDesc* descs,
                   std::size_t stride, std::uint32_t count) {
  e.handles(shapes, count, Objects::shapes);
  e.rows(descs, stride, count);
}
// modify.bodies, modify.joints, manifolds.modify
template <Call call, class Change>
void encode(CallTag<call>, Encoding e, const Change* changes, std::size_t stride, std::uint32_t count) {
  e.rows(changes, stride, count);
}
inline void encode(CallTag<Call::exceptions_set>, Encoding e, const PlumbBodyPair* pairs, std::size_t stride,
                   std::uint32_t count, std::uint32_t touch) {
  e.rows(pairs, stride, count);
  e.out.put(touch);
}

}  // namespace plumb::layers
