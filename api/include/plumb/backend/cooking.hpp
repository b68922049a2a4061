// plumb.cooking/1 for a class that has work of its own to put into the bytes of a shape. The guard does the rest: it
// frames what the class gives, knows it again, and answers for all other shapes and classes, whose bytes hold the
// descriptor.
#pragma once

#include <concepts>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "plumb/backend/checks.hpp"

namespace plumb::backend {

/// What a class's bytes are known by, beside the number type of its arithmetic.
struct CookedFormat {
  const char* name;       ///< at most 31 bytes; backends that read each other's bytes have one name
  std::uint32_t version;  ///< another one whenever the same descriptor is cooked into other bytes
};

/// A shape as cook() of the class gave it: whole, for a checksum was right. Whoever forges bytes can make it right, so
/// nothing in them may be relied on to stay in bounds.
struct CookedPayload {
  PlumbShapeType type;
  std::span<const std::byte> bytes;  ///< at any address
};

/// Derive from it, and have static members as HasCooking says.
class ICookedShapes {
 public:
  virtual ~ICookedShapes() = default;
  /// As create_shapes(), all or none. Throws PLUMB_E_CORRUPT for bytes that cook() never gave.
  virtual PlumbResult create_cooked(std::span<const CookedPayload> shapes, std::span<const PlumbShape> ids) = 0;
};

/// cook() is asked on any thread for shapes of which capability() says PLUMB_NATIVE of PLUMB_CAP_COOKING, with what
/// create_shapes() would get. The same descriptor gives the same bytes.
template <class World>
concept HasCooking = std::derived_from<World, ICookedShapes> && requires(const PlumbShapeDesc& desc) {
  { World::cook(desc) } -> std::same_as<std::vector<std::byte>>;
  { World::cooked_format() } -> std::same_as<CookedFormat>;
};

class CookedWriter {
 public:
  template <class T>
  void value(const T& it) {
    items(&it, 1);
  }
  /// T has no padding, whose bytes would be anything.
  template <class T>
  void items(const T* first, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* from = reinterpret_cast<const std::byte*>(first);
    bytes_.insert(bytes_.end(), from, from + count * sizeof(T));
  }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Of bytes that may be anything: gives no more than there is, and throws PLUMB_E_CORRUPT instead.
class CookedReader {
 public:
  explicit CookedReader(std::span<const std::byte> bytes) : left_(bytes) {}

  /// The bytes of the next `count` elements of `size` bytes.
  std::span<const std::byte> take(std::uint64_t count, std::size_t size) {
    if (count > left_.size() / size) corrupt("ends too early");
    const auto taken = left_.first(static_cast<std::size_t>(count) * size);
    left_ = left_.subspan(taken.size());
    return taken;
  }
  template <class T>
  [[nodiscard]] T value() {
    T it;
    std::memcpy(static_cast<void*>(&it), take(1, sizeof(T)).data(), sizeof(T));
    return it;
  }
  template <class T>
  [[nodiscard]] std::vector<T> list(std::uint64_t count) {
    const auto bytes = take(count, sizeof(T));
    std::vector<T> all(static_cast<std::size_t>(count));
    if (!all.empty()) std::memcpy(static_cast<void*>(all.data()), bytes.data(), bytes.size());
    return all;
  }
  /// All has been taken.
  void finish() const {
    if (!left_.empty()) corrupt("goes on behind its end");
  }

  [[noreturn]] static void corrupt(const char* what) {
    refuse(PLUMB_E_CORRUPT, std::string("the cooked shape ") + what + "; cook its descriptor anew");
  }

 private:
  std::span<const std::byte> left_;
};

}  // namespace plumb::backend
