// Objects by their number instead of their handle: what makes a trace mean the same on any backend.
#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "calls.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::layers {

/// Calls visit(kind, handle) for every handle in a struct.
template <class Row, class Visit>
void for_each_handle(Row& row, Visit&& visit) {
  if constexpr (requires { row.body; }) visit(Objects::bodies, row.body);
  if constexpr (requires { row.body_a; }) visit(Objects::bodies, row.body_a), visit(Objects::bodies, row.body_b);
  if constexpr (requires { row.joint; }) visit(Objects::joints, row.joint);
  if constexpr (requires { row.shape; }) visit(Objects::shapes, row.shape);
  if constexpr (requires { row.shape_a; }) visit(Objects::shapes, row.shape_a), visit(Objects::shapes, row.shape_b);
}

/// The objects of one world in order of creation, living or not.
class ObjectNames {
 public:
  void add(Objects kind, std::uint64_t handle) {
    List& list = list_of(kind);
    list.handles.push_back(handle);
    list.numbers[handle] = list.handles.size();
  }
  /// What stands in the file for a handle.
  [[nodiscard]] std::uint64_t number(Objects kind, std::uint64_t handle) const {
    if (handle == 0) return 0;
    const List& list = list_of(kind);
    if (const auto found = list.numbers.find(handle); found != list.numbers.end()) return found->second;
    return generation_of(handle) == 0 ? handle | foreign : handle;
  }
  /// The handle for what stands in the file.
  [[nodiscard]] std::uint64_t handle(Objects kind, std::uint64_t number) const {
    if (number == 0 || generation_of(number) != 0) return number;
    const List& list = list_of(kind);
    return number <= list.handles.size() ? list.handles[number - 1] : number | foreign;
  }

  template <class Row>
  void to_numbers(Row& row) const {
    for_each_handle(row, [this](Objects kind, std::uint64_t& handle) { handle = number(kind, handle); });
  }
  template <class Row>
  void to_handles(Row& row) const {
    for_each_handle(row, [this](Objects kind, std::uint64_t& number) { number = handle(kind, number); });
  }

  static constexpr std::uint64_t foreign = std::uint64_t{0xffffffffu} << 32;

 private:
  struct List {
    std::vector<std::uint64_t> handles;
    std::unordered_map<std::uint64_t, std::uint64_t> numbers;
  };
  [[nodiscard]] List& list_of(Objects kind) { return lists_[static_cast<std::size_t>(kind)]; }
  [[nodiscard]] const List& list_of(Objects kind) const { return lists_[static_cast<std::size_t>(kind)]; }

  std::array<List, 4> lists_;
};

}  // namespace plumb::layers
