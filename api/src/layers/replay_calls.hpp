// How each call is read from a trace and made again, by the shape of its signature. The mirror of trace_encode.hpp.
#pragma once

#include <deque>

#include "trace_encode.hpp"

namespace plumb::layers {

struct Outputs {
  std::uint64_t count = 0, hash = 0;
};

struct ReplayedWorld {
  PlumbWorld* world = nullptr;  ///< null when it could not be made, or is gone
  ObjectNames names;
  std::vector<std::vector<std::byte>> saves;
};

/// What a call's replay reads from, and leaves behind: its outputs as the recorder would have written them.
struct Decoding {
  ByteReader& in;
  ReplayedWorld& to;
  PlumbResult recorded;
  std::deque<std::vector<std::byte>> memory = {};  ///< nested arrays, alive until the call is made
  std::optional<Outputs> outputs = std::nullopt;

  /// An array as the call takes it: data is null where it was.
  template <class Row>
  struct Array {
    std::vector<Row> rows;
    bool present = false;
    std::uint32_t count = 0;
    std::size_t stride = sizeof(Row);

    [[nodiscard]] Row* data() { return present ? rows.data() : nullptr; }
  };

  template <class Row, class Read>
  Array<Row> array(std::size_t least, Read&& read) {
    Array<Row> array;
    array.present = in.get<std::uint8_t>() != 0;
    array.count = in.get<std::uint32_t>();
    // A stride that was too short stays so, that the replaying backend may refuse it too.
    array.stride = std::min<std::size_t>(in.get<std::uint64_t>(), sizeof(Row));
    if (!array.present) return array;
    if (array.count > in.left() / least) throw Error(PLUMB_E_CORRUPT, "an array is longer than its record");
    for (std::uint32_t i = 0; i < array.count; ++i) array.rows.push_back(read());
    if (array.rows.empty()) array.rows.reserve(1);  // so that data() is not null
    return array;
  }
  template <class Row>
  Array<Row> rows() {
    auto read = array<Row>(recorded_size<Row>(), [this] { return row<Row>(); });
    if (read.stride >= recorded_size<Row>()) read.stride = sizeof(Row);
    return read;
  }
  Array<std::uint64_t> handles(Objects kind) {
    return array<std::uint64_t>(sizeof(std::uint64_t), [&] { return to.names.handle(kind, in.get<std::uint64_t>()); });
  }

  /// Room for output; data is null where none was given.
  template <class Row>
  struct Room {
    std::vector<Row> rows;
    std::uint32_t capacity = 0;

    [[nodiscard]] Row* data() { return rows.empty() ? nullptr : rows.data(); }
  };
  template <class Row>
  Room<Row> room() {
    const bool present = in.get<std::uint8_t>() != 0;
    Room<Row> room;
    room.capacity = in.get<std::uint32_t>();
    if (present) room.rows.resize(room.capacity);
    return room;
  }
  void output(std::uint64_t count, std::span<const std::byte> bytes) { outputs = Outputs{count, hash_bytes(bytes)}; }
  template <class Row>
  void output_rows(const Row* data, std::uint32_t capacity, std::uint32_t count) {
    ByteWriter bytes;
    for (std::uint32_t i = 0; i < std::min(capacity, count); ++i) {
      Row row = data[i];
      to.names.to_numbers(row);
      bytes.put(row);
    }
    output(count, bytes.bytes());
  }

  /// A setting's value; its choice lives as long as this.
  PlumbSettingValue value() {
    PlumbSettingValue value{};
    value.type = in.get<PlumbSettingType>();
    value.number = in.get<double>();
    bool is_null = false;
    const std::string choice = in.get_string(&is_null);
    value.choice = is_null ? nullptr : keep(choice);
    return value;
  }
  /// A name; null where it was.
  const char* name() {
    bool is_null = false;
    const std::string text = in.get_string(&is_null);
    return is_null ? nullptr : keep(text);
  }
  const char* keep(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text.c_str(), text.size() + 1));
    return reinterpret_cast<const char*>(memory.emplace_back(bytes.begin(), bytes.end()).data());
  }

 private:
  /// How much of a row a trace of any version has.
  template <class Row>
  static constexpr std::size_t recorded_size() {
    if (std::is_same_v<Row, PlumbBodyDesc>) return backend::kBodyDesc10;
    if (std::is_same_v<Row, PlumbJointDesc>) return backend::kJointDesc10;
    return std::is_same_v<Row, PlumbShapeDesc> ? backend::kShapeDesc10 : sizeof(Row);
  }
  template <class Row>
  Row row() {
    Row row{};
    const auto bytes = in.get_bytes(recorded_size<Row>());
    std::memcpy(static_cast<void*>(&row), bytes.data(), bytes.size());
    if constexpr (std::is_same_v<Row, PlumbShapeDesc>) {
      row.vertices = reinterpret_cast<const double*>(keep_rows<PlumbVec3>());
      row.indices = reinterpret_cast<const std::uint32_t*>(keep_rows<std::array<std::uint32_t, 3>>());
      row.heights = keep_rows<double>();
      row.children = keep_rows<PlumbCompoundChild>();
      if (!backend::has_triangle_materials(row)) return row;
      row.materials = keep_rows<PlumbMaterial>();
      row.triangle_materials = keep_rows<std::uint32_t>();
    } else if constexpr (std::is_same_v<Row, PlumbCookedShape>) {
      row.data = keep_bytes();
    } else {
      constexpr std::size_t before = recorded_size<Row>();
      if constexpr (before < sizeof(Row)) {
        const auto later = in.get_bytes(row.struct_size > before ? sizeof(Row) - before : 0);
        std::memcpy(reinterpret_cast<std::byte*>(&row) + before, later.data(), later.size());
        if (row.struct_size == before) row.struct_size = sizeof(Row);
      }
      to.names.to_handles(row);
    }
    return row;
  }
  /// An array of bytes, which may be many.
  const std::byte* keep_bytes() {
    const bool present = in.get<std::uint8_t>() != 0;
    const auto count = in.get<std::uint32_t>();
    static_cast<void>(in.get<std::uint64_t>());  // their stride
    if (!present) return nullptr;
    const auto bytes = in.get_bytes(count);
    auto& kept = memory.emplace_back(bytes.begin(), bytes.end());
    kept.resize(kept.size() + 1);  // so that data() is not null
    return kept.data();
  }
  template <class Row>
  const Row* keep_rows() {
    Array<Row> read = rows<Row>();
    if (!read.present) return nullptr;
    const auto bytes = std::as_bytes(std::span(read.rows));
    auto& kept = memory.emplace_back(bytes.begin(), bytes.end());
    kept.resize(kept.size() + 1);  // so that data() is not null
    return reinterpret_cast<const Row*>(kept.data());
  }
};

template <Call call, class Desc>
PlumbResult again(CallTag<call>, Decoding& d,
                  PlumbResult (*next)(PlumbWorld*, const Desc*, std::size_t, std::uint32_t, std::uint64_t*)) {
  auto descs = d.rows<Desc>();
  std::vector<std::uint64_t> ids(descs.count);
  const PlumbResult result = next(d.to.world, descs.data(), descs.stride, descs.count, ids.data());
  // Objects that were made then and not now get names that no object has.
  for (std::uint32_t i = 0; d.recorded >= 0 && i < descs.count; ++i)
    d.to.names.add(CallTraits<call>::objects, result >= 0 ? ids[i] : ObjectNames::foreign | i);
  return result;
}
template <Call call>
PlumbResult again(CallTag<call>, Decoding& d, PlumbResult (*next)(PlumbWorld*, const std::uint64_t*, std::uint32_t)) {
  auto ids = d.handles(CallTraits<call>::objects);
  return next(d.to.world, ids.data(), ids.count);
}
template <Call call, class Row>
PlumbResult again(CallTag<call>, Decoding& d, PlumbResult (*next)(PlumbWorld*, Row*, std::uint32_t, std::uint32_t*)) {
  auto out = d.room<Row>();
  std::uint32_t count = 0;
  const PlumbResult result = next(d.to.world, out.data(), out.capacity, &count);
  if (result < 0) return result;
  if constexpr (std::is_same_v<Row, PlumbBody>) {
    struct Listed {
      PlumbBody body;
    };
    d.output_rows(reinterpret_cast<const Listed*>(out.data()), out.capacity, count);
  } else {
    d.output_rows(out.data(), out.capacity, count);
  }
  return result;
}
template <Call call, class Row>
PlumbResult again(CallTag<call>, Decoding& d,
                  PlumbResult (*next)(PlumbWorld*, Row*, std::size_t, std::uint32_t, std::uint32_t*)) {
  const auto stride = std::min<std::size_t>(d.in.get<std::uint64_t>(), sizeof(Row));
  auto out = d.room<Row>();
  std::uint32_t count = 0;
  const PlumbResult result = next(d.to.world, out.data(), stride, out.capacity, &count);
  if (result >= 0) d.output_rows(out.data(), out.capacity, count);
  return result;
}
template <Call call>
PlumbResult again(CallTag<call>, Decoding& d,
                  PlumbResult (*next)(PlumbWorld*, std::uint32_t, PlumbDataType, const std::uint64_t*, std::uint32_t,
                                      void*, std::size_t)) {
  const auto field = d.in.get<std::uint32_t>();
  const auto type = d.in.get<PlumbDataType>();
  auto ids = d.handles(CallTraits<call>::objects);
  const std::size_t size = row_size<call>(field, type);
  const auto stride = std::min<std::size_t>(d.in.get<std::uint64_t>(), size);
  std::vector<std::byte> rows(size * ids.count);
  const PlumbResult result = next(d.to.world, field, type, ids.data(), ids.count, rows.data(), stride);
  if (result >= 0) d.output(ids.count, rows);
  return result;
}
template <Call call>
PlumbResult again(CallTag<call>, Decoding& d,
                  PlumbResult (*next)(PlumbWorld*, std::uint32_t, PlumbDataType, const std::uint64_t*, std::uint32_t,
                                      const void*, std::size_t)) {
  const auto field = d.in.get<std::uint32_t>();
  const auto type = d.in.get<PlumbDataType>();
  auto ids = d.handles(CallTraits<call>::objects);
  const bool present = d.in.get<std::uint8_t>() != 0;
  const auto count = d.in.get<std::uint32_t>();
  const auto stride = std::min<std::size_t>(d.in.get<std::uint64_t>(), row_size<call>(field, type));
  const auto rows = d.in.get_bytes(present ? stride * count : 0);
  return next(d.to.world, field, type, ids.data(), ids.count, present ? rows.data() : nullptr, stride);
}
inline PlumbResult again(CallTag<Call::modify_shapes>, Decoding& d, decltype(PlumbModifyTable::shapes) next) {
  auto shapes = d.handles(Objects::shapes);
  auto descs = d.rows<PlumbShapeDesc>();
  return next(d.to.world, shapes.data(), descs.data(), descs.stride, descs.count);
}
template <class Forward>
PlumbResult again_hits(Decoding& d, Forward&& forward) {
  auto hits = d.room<PlumbHit>();
  std::uint32_t count = 0;
  const PlumbResult result = forward(hits.data(), hits.capacity, &count);
  if (result >= 0) d.output_rows(hits.data(), hits.capacity, count);
  return result;
}
template <Call call, class Query>
PlumbResult again(CallTag<call>, Decoding& d,
                  PlumbResult (*next)(PlumbWorld*, PlumbHitMode, const Query*, std::size_t, std::uint32_t, PlumbHit*,
                                      std::uint32_t, std::uint32_t*)) {
  const auto mode = d.in.get<PlumbHitMode>();
  auto queries = d.rows<Query>();
  return again_hits(d, [&](PlumbHit* hits, std::uint32_t capacity, std::uint32_t* count) {
    return next(d.to.world, mode, queries.data(), queries.stride, queries.count, hits, capacity, count);
  });
}
inline PlumbResult again(CallTag<Call::queries_overlaps>, Decoding& d, decltype(PlumbQueriesTable::overlaps) next) {
  auto overlaps = d.rows<PlumbOverlap>();
  return again_hits(d, [&](PlumbHit* hits, std::uint32_t capacity, std::uint32_t* count) {
    return next(d.to.world, overlaps.data(), overlaps.stride, overlaps.count, hits, capacity, count);
  });
}
inline PlumbResult again(CallTag<Call::queries_penetrations>, Decoding& d,
                         decltype(PlumbQueriesTable::penetrations) next) {
  auto overlaps = d.rows<PlumbOverlap>();
  auto out = d.room<PlumbPenetration>();
  std::uint32_t count = 0;
  const PlumbResult result =
      next(d.to.world, overlaps.data(), overlaps.stride, overlaps.count, out.data(), out.capacity, &count);
  if (result >= 0) d.output_rows(out.data(), out.capacity, count);
  return result;
}
inline PlumbResult again(CallTag<Call::closest_bodies>, Decoding& d, decltype(PlumbClosestTable::bodies) next) {
  const auto mode = d.in.get<PlumbHitMode>();
  auto probes = d.rows<PlumbProbe>();
  auto out = d.room<PlumbClosest>();
  std::uint32_t count = 0;
  const PlumbResult result =
      next(d.to.world, mode, probes.data(), probes.stride, probes.count, out.data(), out.capacity, &count);
  if (result >= 0) d.output_rows(out.data(), out.capacity, count);
  return result;
}
inline PlumbResult again(CallTag<Call::collide_pairs>, Decoding& d, decltype(PlumbCollideTable::pairs) next) {
  auto pairs = d.rows<PlumbPosedPair>();
  auto points = d.room<PlumbPairPoint>();
  std::vector<PlumbPairResult> results(pairs.count);
  std::uint32_t count = 0;
  const PlumbResult result =
      next(d.to.world, pairs.data(), pairs.stride, pairs.count, results.data(), points.data(), points.capacity, &count);
  if (result >= 0) d.output_rows(points.data(), points.capacity, count);
  return result;
}
inline PlumbResult again(CallTag<Call::core_user_data>, Decoding& d, decltype(PlumbBackendTable::user_data) next) {
  std::uint64_t value = 0;
  const PlumbResult result = next(d.to.world, d.to.names.handle(Objects::bodies, d.in.get<std::uint64_t>()), &value);
  if (result >= 0) d.output(1, std::as_bytes(std::span(&value, 1)));
  return result;
}
inline PlumbResult again(CallTag<Call::core_set_gravity>, Decoding& d, decltype(PlumbBackendTable::set_gravity) next) {
  return next(d.to.world, d.rows<PlumbVec3>().data());
}
inline PlumbResult again(CallTag<Call::core_step>, Decoding& d, decltype(PlumbBackendTable::step) next) {
  return next(d.to.world, d.rows<PlumbStepDesc>().data());
}
inline PlumbResult again(CallTag<Call::core_wait>, Decoding& d, decltype(PlumbBackendTable::wait) next) {
  if (d.in.get<std::uint8_t>() == 0) return next(d.to.world, nullptr);
  PlumbStepReport report{};
  report.struct_size = sizeof report;
  const PlumbResult result = next(d.to.world, &report);
  const auto counts = steady(report);
  if (result >= 0) d.output(1, std::as_bytes(std::span(counts)));
  return result;
}
inline PlumbResult again(CallTag<Call::settings_get>, Decoding& d, decltype(PlumbSettingsTable::get) next) {
  PlumbSettingValue value{};
  const PlumbResult result = next(d.to.world, d.name(), &value);
  if (result < 0) return result;
  ByteWriter bytes;
  Saves no_saves;
  Encoding{bytes, d.to.names, no_saves, result}.value(value);
  d.output(1, bytes.bytes());
  return result;
}
inline PlumbResult again(CallTag<Call::settings_set>, Decoding& d, decltype(PlumbSettingsTable::set) next) {
  const char* name = d.name();
  auto value = d.array<PlumbSettingValue>(1, [&d] { return d.value(); });
  return next(d.to.world, name, value.data());
}
inline PlumbResult save_again(Decoding& d, decltype(PlumbSnapshotTable::save) next) {
  const bool saved = d.in.get<std::uint8_t>() != 0;
  const auto capacity = d.in.get<std::uint64_t>();
  std::size_t size = 0;
  // Another engine's snapshot has another size: what fitted then must fit now.
  PlumbResult result = next(d.to.world, nullptr, 0, &size);
  std::vector<std::byte> data(saved ? size : std::min<std::size_t>(capacity, size));
  if (result >= 0 && (saved || capacity != 0)) result = next(d.to.world, data.data(), data.size(), &size);
  if (saved) d.to.saves.push_back(std::move(data));
  return result;
}
inline PlumbResult again(CallTag<Call::snapshot_save>, Decoding& d, decltype(PlumbSnapshotTable::save) next) {
  return save_again(d, next);
}
inline PlumbResult again(CallTag<Call::snapshot_save_world>, Decoding& d,
                         decltype(PlumbSnapshotTable::save_world) next) {
  return save_again(d, next);
}
inline PlumbResult again(CallTag<Call::snapshot_restore>, Decoding& d, decltype(PlumbSnapshotTable::restore) next) {
  const auto save = d.in.get<std::uint64_t>();
  if (save > d.to.saves.size()) throw Error(PLUMB_E_CORRUPT, "a restore names a save that was not made");
  if (save != 0) return next(d.to.world, d.to.saves[save - 1].data(), d.to.saves[save - 1].size());
  auto data = d.array<std::byte>(1, [&d] { return d.in.get<std::byte>(); });
  return next(d.to.world, data.data(), data.count);
}
inline PlumbResult again(CallTag<Call::snapshot_hash>, Decoding& d, decltype(PlumbSnapshotTable::hash) next) {
  std::uint64_t hash = 0;
  const PlumbResult result = next(d.to.world, &hash);
  if (result >= 0) d.output(1, std::as_bytes(std::span(&hash, 1)));
  return result;
}
inline PlumbResult again(CallTag<Call::state_borrow>, Decoding& d, decltype(PlumbStateTable::borrow) next) {
  auto request = d.rows<PlumbStateRequest>();
  const bool fenced = d.in.get<std::uint8_t>() != 0;
  PlumbDLManagedTensor* tensor = nullptr;
  PlumbFence fence{};
  const PlumbResult result = next(d.to.world, request.data(), &tensor, fenced ? &fence : nullptr);
  if (result >= 0 && tensor != nullptr) tensor->deleter(tensor);
  return result;
}
inline PlumbResult again(CallTag<Call::state_rows>, Decoding& d, decltype(PlumbStateTable::rows) next) {
  auto ids = d.room<PlumbBody>();
  std::uint32_t count = 0;
  std::uint64_t generation = 0;
  const PlumbResult result = next(d.to.world, ids.data(), ids.capacity, &count, &generation);
  if (result >= 0) d.output(count, {});
  return result;
}
template <Call call, class Change>
PlumbResult again(CallTag<call>, Decoding& d,
                  PlumbResult (*next)(PlumbWorld*, const Change*, std::size_t, std::uint32_t)) {
  auto changes = d.rows<Change>();
  return next(d.to.world, changes.data(), changes.stride, changes.count);
}
inline PlumbResult again(CallTag<Call::exceptions_set>, Decoding& d, decltype(PlumbExceptionsTable::set) next) {
  auto pairs = d.rows<PlumbBodyPair>();
  const auto touch = d.in.get<std::uint32_t>();
  return next(d.to.world, pairs.data(), pairs.stride, pairs.count, touch);
}

}  // namespace plumb::layers
