// State on its way into bytes, or out of them. Both ways go through the same calls, so that they name the same things
// in the same order. Whoever hands bytes in has made sure that they are whole and were written by this code.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "exec/memory.hpp"

namespace plumb::impulse {

class Archive {
 public:
  Archive() = default;                                                                  ///< is written
  explicit Archive(std::span<const std::byte> bytes) : reads_(true), unread_(bytes) {}  ///< is read

  [[nodiscard]] bool reads() const { return reads_; }
  [[nodiscard]] std::vector<std::byte> take_bytes() { return std::move(written_); }

  template <class T>
  void value(T& it) {
    items(&it, 1);
  }
  template <class T>
  void list(std::vector<T>& it) {
    std::uint64_t size = it.size();
    value(size);
    it.resize(static_cast<std::size_t>(size));
    items(it.data(), it.size());
  }
  /// The first n of them, which there must be.
  template <class T>
  void items(T* first, std::size_t n) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (n == 0) return;
    if (!reads_) {
      const auto* from = reinterpret_cast<const std::byte*>(first);
      written_.insert(written_.end(), from, from + n * sizeof(T));
      return;
    }
    if (unread_.size() / sizeof(T) < n) ends_too_early();
    std::memcpy(static_cast<void*>(first), unread_.data(), n * sizeof(T));
    unread_ = unread_.subspan(n * sizeof(T));
  }
  /// The first n of them, wherever they lie.
  template <class T>
  void rows(Buffer<T>& buffer, std::size_t n) {
    std::vector<T> host = reads_ ? std::vector<T>(n) : buffer.to_host(n);
    items(host.data(), n);
    if (reads_) buffer.from_host(host.data(), n);
  }
  /// Likewise; all others are as at first, when nobody had had them.
  template <class T>
  void rows_of_all(Buffer<T>& buffer, std::size_t n) {
    rows(buffer, n);
    if (reads_) buffer.clear_from(n);
  }

 private:
  [[noreturn]] static void ends_too_early();

  bool reads_ = false;
  std::vector<std::byte> written_;
  std::span<const std::byte> unread_;
};

}  // namespace plumb::impulse
