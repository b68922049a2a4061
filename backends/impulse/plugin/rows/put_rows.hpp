// Rows of many bodies on their way to the host's memory, on all threads that the world may use.
#pragma once

#include <algorithm>
#include <cstring>
#include <span>

#include "bodies/state_rows.hpp"
#include "exec/executor.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::impulse {

/// f(first, end) for consecutive ranges that together are 0 .. n - 1, at once where n is large.
template <class F>
void in_ranges(Executor& executor, std::size_t n, const F& f) {
  constexpr std::size_t kLeast = 8192;  // rows that are worth a thread
  const auto parts = static_cast<std::uint32_t>(std::clamp<std::size_t>(n / kLeast, 1, executor.host_threads()));
  if (parts == 1) return f(std::size_t{0}, n);
  executor.on_host(parts, [&](std::uint32_t part) { f(n * part / parts, n * (part + 1) / parts); });
}

/// Of each body row_of(slot), whose numbers begin with those that the host wants.
template <class RowOf>
void put_rows(Executor& executor, std::span<const PlumbBody> ids, const Rows& rows, const RowOf& row_of) {
  in_ranges(executor, ids.size(), [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const auto row = row_of(slot_of(ids[i]));
      double numbers[std::size(row.numbers)];
      std::copy(std::begin(row.numbers), std::end(row.numbers), numbers);
      rows.put(i, numbers, std::size(row.numbers));
    }
  });
}

/// The same from rows by slot; as they are where the host wants them so, slots in a row at once.
template <class Row>
void copy_rows(Executor& executor, const Row* by_slot, std::span<const PlumbBody> ids, const Rows& rows) {
  const bool as_they_are =
      rows.type() == PLUMB_F64 && sizeof(Row{}.numbers[0]) == sizeof(double) && rows.stride() == sizeof(Row);
  if (!as_they_are) return put_rows(executor, ids, rows, [&](std::uint32_t slot) { return by_slot[slot]; });
  in_ranges(executor, ids.size(), [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end;) {
      const std::uint32_t slot = slot_of(ids[i]);
      std::size_t next = i + 1;
      while (next < end && slot_of(ids[next]) == slot + (next - i)) ++next;
      std::memcpy(rows.data() + i * sizeof(Row), by_slot + slot, (next - i) * sizeof(Row));
      i = next;
    }
  });
}

}  // namespace plumb::impulse
