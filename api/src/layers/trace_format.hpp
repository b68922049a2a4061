// The trace file: every call of a run, in the order in which they ended. Little-endian throughout.
//
//   header   "PLUMBTRC", u32 format, u32 PLUMB_VERSION, strings: backend name, version, build, device;
//            u32 rows_every, u32 checksum of all before it
//   record   u32 length of its body, u32 checksum of the body, body. The body begins with a u8:
//     1..199   the number of a call in calls.inl, then
//                u64 world      the how manieth of the trace, from 1
//                i32 result, and when it is below 0 the error text (string)
//                inputs         scalars as they stand in the signature; arrays as u8 there (0: null), u32 count,
//                               u64 stride, elements
//                outputs        u64 count, u64 hash; only where the result is not below 0 and the call has any
//     200      settings in force in a world that was just made: u64 world, u32 count, (string name, value)...
//     201      state after a step: u64 world, u64 step (from 1), u64 hash, u32 bodies, u8 rows follow,
//                rows: bodies x 13 f64 (7 of pose, 6 of velocity) in order of creation
//     255      end: u64 how many records came before. A file without it is torn.
//
//   string   u32 length, bytes. A null one has length 0xffffffff.
//   structs  in their C layout on 64-bit machines (which tests/abi pins), pointers 0, followed by what they pointed to.
//   handles  the how manieth object of its kind in its world, from 1: below 2^32, which no handle is, as generations
//            start at 1. Handles that the world never gave stand as they are, with generation 2^32-1 in place of 0.
//   hash     plumb::backend::StateHash over the words of the outputs, handles as above.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "plumb/backend/state_hash.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::layers {

static_assert(std::endian::native == std::endian::little, "traces are written from memory as it is");

inline constexpr char trace_magic[8] = {'P', 'L', 'U', 'M', 'B', 'T', 'R', 'C'};
inline constexpr std::uint32_t trace_format = 1;
inline constexpr std::uint8_t settings_record = 200, state_record = 201, end_record = 255;
inline constexpr std::uint32_t null_string = 0xffffffffu;

/// StateHash over bytes, the last word filled with zeros.
[[nodiscard]] inline std::uint64_t hash_bytes(std::span<const std::byte> bytes) {
  backend::StateHash hash;
  hash.add_word(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
    hash.add_word(word);
  }
  return hash.value();
}
[[nodiscard]] inline std::uint32_t checksum(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(hash_bytes(bytes));
}

class ByteWriter {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { put_bytes({reinterpret_cast<const std::byte*>(&value), sizeof value}); }
  void put_bytes(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  void put_string(const char* text) {
    const std::size_t length = text == nullptr ? 0 : std::strlen(text);
    put(text == nullptr ? null_string : static_cast<std::uint32_t>(length));
    put_bytes({reinterpret_cast<const std::byte*>(text), length});
  }

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T> T get() {
    T value;
    std::memcpy(&value, get_bytes(sizeof value).data(), sizeof value);
    return value;
  }
  std::span<const std::byte> get_bytes(std::size_t size) {
    if (size > bytes_.size()) throw Error(PLUMB_E_CORRUPT, "it ends in the middle of a record");
    const auto taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }
  /// is_null, when given, tells null from "".
  std::string get_string(bool* is_null = nullptr) {
    const auto length = get<std::uint32_t>();
    if (is_null != nullptr) *is_null = length == null_string;
    if (length == null_string) return {};
    const auto bytes = get_bytes(length);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace plumb::layers
