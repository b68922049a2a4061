// Which proxies there are to collide: those that move, those that do not, and planes, which have no box.
#pragma once

#include "world/body_table.hpp"
#include "world/collider_table.hpp"

namespace plumb::impulse {

/// Rows of proxies, ascending.
class ProxyList {
 public:
  [[nodiscard]] std::uint32_t count() const { return count_; }
  [[nodiscard]] std::uint32_t operator[](std::uint32_t i) const { return rows_[i]; }
  [[nodiscard]] ProxyRows view() { return {rows_.device(), room_}; }

  void clear() { count_ = room_ = 0; }
  void add(std::uint32_t proxy);
  /// Makes the list up to `room` with a row that is nobody's, so that a recorded step serves on while proxies come and
  /// go. room is at least count().
  void fill(std::uint32_t room, std::uint32_t sentinel);
  void upload(Executor& executor) {
    if (room_ != 0) executor.to_device(rows_, room_);
  }

 private:
  Mirror<std::uint32_t> rows_;
  std::uint32_t count_ = 0, room_ = 0;
};

struct ProxyLists {
  ProxyList movers, statics, planes;
  std::uint32_t types = 0;  ///< a bit for each ShapeType among them

  /// Lists them anew. Returns whether the statics are others than before.
  bool find(const ColliderTable& colliders, const Table<BodyMass>& mass);
};

/// The median place of some bodies of a list: one body that was lost far out does not move it. Not of an empty list.
[[nodiscard]] Position middle_of(const ProxyList& list, const ColliderTable& colliders, BodyState& state);

}  // namespace plumb::impulse
