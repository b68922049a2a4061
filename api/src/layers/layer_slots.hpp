// How a layer gets its tables. A table is bare C functions without a context, so each of the 16 slots of a kind of
// layer has functions of its own (thunks), stamped from one template for every call of calls.inl, that know their slot.
//
//   host -> slot 3's table -> Thunk<Layer, 3, Call::core_step> -> Layer object in slot 3 -> on<Call::core_step>(...)
//
// A Layer derives from LayerBase, and has  template <Call call, class... Args> auto on(Args... args);
#pragma once

#include <array>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <tuple>
#include <utility>

#include "calls.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::layers {

/// What every layer has: the tables it forwards to, and answers to questions that it does not care to change.
class LayerBase {
 public:
  explicit LayerBase(const PlumbBackendTable* next) : core_(next) {
    for_each_extension([this]<class Table>(const char* name) {
      std::get<const Table*>(extensions_) = static_cast<const Table*>(core_->extension(name));
    });
  }

  [[nodiscard]] const PlumbBackendTable* next_core() const { return core_; }
  /// Null where the backend has no such extension.
  template <class Table>
  [[nodiscard]] const Table* next_table() const {
    if constexpr (std::is_same_v<Table, PlumbBackendTable>) {
      return core_;
    } else {
      return std::get<const Table*>(extensions_);
    }
  }
  template <Call call>
  [[nodiscard]] auto next() const {
    return next_table<typename CallTraits<call>::Table>()->*CallTraits<call>::pointer;
  }

  PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char** note) {
    return core_->capability(kind, a, b, note);
  }
  const char* error_text(PlumbWorld* world) { return core_->error_text(world); }

 private:
  const PlumbBackendTable* core_;
  std::tuple<const PlumbJointsTable*, const PlumbQueriesTable*, const PlumbCollideTable*, const PlumbDebugTable*,
             const PlumbSettingsTable*, const PlumbSnapshotTable*, const PlumbStateTable*, const PlumbExceptionsTable*,
             const PlumbModifyTable*, const PlumbManifoldsTable*, const PlumbClosestTable*, const PlumbCookingTable*>
      extensions_{};
};

/// The 16 slots of one kind of layer.
template <class Layer>
class LayerSlots {
 public:
  static constexpr std::size_t count = 16;

  /// Makes a layer in a free slot and gives its table. Throws Error when all are taken.
  template <class... Args>
  static const PlumbBackendTable* open(const std::string& kind, const PlumbBackendTable* next, Args&&... args) {
    const std::lock_guard lock(mutex_);
    for (std::size_t slot = 0; slot < count; ++slot) {
      if (slots_[slot].layer != nullptr) continue;
      slots_[slot].layer = std::make_unique<Layer>(next, std::forward<Args>(args)...);
      fill(slot, std::make_index_sequence<count>());
      return &std::get<PlumbBackendTable>(slots_[slot].tables);
    }
    throw Error(PLUMB_E_OUT_OF_MEMORY,
                "all " + std::to_string(count) + " " + kind + " layers of this process are in use");
  }

  /// Null for a table that is not of this kind of layer.
  static Layer* find(const PlumbBackendTable* table) {
    const std::lock_guard lock(mutex_);
    for (Slot& slot : slots_)
      if (slot.layer != nullptr && &std::get<PlumbBackendTable>(slot.tables) == table) return slot.layer.get();
    return nullptr;
  }
  /// The table of a layer that forwards to next, or null.
  static const PlumbBackendTable* find_over(const PlumbBackendTable* next) {
    const std::lock_guard lock(mutex_);
    for (Slot& slot : slots_)
      if (slot.layer != nullptr && slot.layer->next_core() == next) return &std::get<PlumbBackendTable>(slot.tables);
    return nullptr;
  }
  /// Has the layer of a table finish() what it writes and frees its slot, also where finish() throws. Throws Error for
  /// a table that open() did not give.
  static void finish(const std::string& kind, const PlumbBackendTable* table) {
    Layer* layer = find(table);
    if (layer == nullptr)
      throw Error(PLUMB_E_INVALID_ARGUMENT, "end_" + kind + " got a table that " + kind + "() did not give");
    try {
      layer->finish();
    } catch (...) {
      close(table);
      throw;
    }
    close(table);
  }

 private:
  static void close(const PlumbBackendTable* table) {
    const std::lock_guard lock(mutex_);
    for (Slot& slot : slots_)
      if (&std::get<PlumbBackendTable>(slot.tables) == table) slot.layer.reset();
  }

  struct Slot {
    std::unique_ptr<Layer> layer;
    std::tuple<PlumbBackendTable, PlumbJointsTable, PlumbQueriesTable, PlumbCollideTable, PlumbDebugTable,
               PlumbSettingsTable, PlumbSnapshotTable, PlumbStateTable, PlumbExceptionsTable, PlumbModifyTable,
               PlumbManifoldsTable, PlumbClosestTable, PlumbCookingTable>
        tables;
  };

  template <std::size_t slot, Call call, class Pointer>
  struct Thunk;
  template <std::size_t slot, Call call, class Result, class Table, class... Args>
  struct Thunk<slot, call, Result (*Table::*)(Args...)> {
    static Result run(Args... args) { return answer<call, Result>(slot, args...); }
  };
  // A function beside the thunks, so that it is compiled once for all slots.
  template <Call call, class Result, class... Args>
  static Result answer(std::size_t slot, Args... args) {
    Layer& layer = *slots_[slot].layer;
    if constexpr (std::is_same_v<Result, PlumbResult>) {
      try {
        return layer.template on<call>(args...);
      } catch (const std::bad_alloc&) {
        return PLUMB_E_OUT_OF_MEMORY;
      } catch (...) {
        return PLUMB_E_INTERNAL;
      }
    } else {
      return layer.template on<call>(args...);
    }
  }

  template <std::size_t slot>
  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char** note) {
    return slots_[slot].layer->capability(kind, a, b, note);
  }
  template <std::size_t slot>
  static const char* error_text(PlumbWorld* world) {
    return slots_[slot].layer->error_text(world);
  }
  template <std::size_t slot>
  static const void* extension(const char* name) {
    const void* table = slots_[slot].layer->next_core()->extension(name);
    if (table == nullptr || name == nullptr) return table;
    for_each_extension([&]<class Table>(const char* known) {
      if (std::strcmp(known, name) == 0) table = &std::get<Table>(slots_[slot].tables);
    });
    return table;
  }

  // Copies next's tables as far as both sides know them, then puts the slot's thunks in the place of what they hold.
  template <std::size_t... all>
  static void fill(std::size_t slot, std::index_sequence<all...>) {
    auto& tables = slots_[slot].tables;
    const Layer& layer = *slots_[slot].layer;
    std::apply(
        [&layer](auto&... table) { (copy(table, layer.template next_table<std::decay_t<decltype(table)>>()), ...); },
        tables);
    PlumbBackendTable& core = std::get<PlumbBackendTable>(tables);
    core.capability = std::array{&capability<all>...}[slot];
    core.extension = std::array{&extension<all>...}[slot];
    core.error_text = std::array{&error_text<all>...}[slot];
    for_each_call([&tables, slot]<Call call>() {
      constexpr auto pointer = CallTraits<call>::pointer;
      auto& table = std::get<typename CallTraits<call>::Table>(tables);
      if (has(table, pointer))
        table.*pointer = std::array{&Thunk<all, call, std::remove_cv_t<decltype(pointer)>>::run...}[slot];
    });
  }
  template <class Table>
  static void copy(Table& table, const Table* next) {
    table = Table{};
    if (next == nullptr) return;
    const std::size_t size = std::min<std::size_t>(sizeof(Table), next->struct_size);
    std::memcpy(&table, next, size);
    table.struct_size = static_cast<std::uint32_t>(size);
  }

  static inline std::mutex mutex_;
  static inline std::array<Slot, count> slots_;
};

}  // namespace plumb::layers
