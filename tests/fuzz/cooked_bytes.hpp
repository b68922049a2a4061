// A shape by way of bytes, some of which are torn or changed on the way.
#pragma once

#include <random>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::fuzz {

class CookedBytes {
 public:
  /// Null where the backend has no such table; then nothing may be asked.
  explicit CookedBytes(const PlumbCookingTable* table) : table_(table) {}

  /// "" when there are bytes, else which rule was broken, or "refused".
  const char* cook(const PlumbShapeDesc* desc, std::mt19937_64& random) {
    PlumbCooked cooked{};
    cooked.struct_size = sizeof cooked;
    const PlumbResult result = table_->cook(desc, &cooked);
    if (result < PLUMB_E_DEVICE_LOST || result > PLUMB_OK) return "a result that cook does not have";
    if (result < 0) return cooked.message[0] == '\0' ? "a shape that is not cooked without a word" : "refused";
    const auto* first = static_cast<const std::byte*>(cooked.data);
    bytes_.assign(first, first + cooked.size);
    table_->release(cooked.data);
    if (random() % 4 == 0) bytes_.resize(random() % bytes_.size());
    if (random() % 4 == 0 && !bytes_.empty()) bytes_[random() % bytes_.size()] ^= static_cast<std::byte>(random());
    return "";
  }
  PlumbResult create(PlumbWorld* world, PlumbShape* id) const {
    const PlumbCookedShape shape = {sizeof shape, 0, bytes_.data(), bytes_.size()};
    return table_->create(world, &shape, sizeof shape, 1, id);
  }

 private:
  const PlumbCookingTable* table_;
  std::vector<std::byte> bytes_;
};

}  // namespace plumb::fuzz
