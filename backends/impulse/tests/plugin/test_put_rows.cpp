// Poses and velocities of many bodies at once are those of each by itself, however the host wants the rows laid out.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

class PutRows : public ::testing::TestWithParam<std::uint32_t> {
 protected:
  static constexpr int kBodies = 40000;

  PutRows() : scene_(engine(), PLUMB_NEED_ROTATION, {0, -9.81, 0}, GetParam()) {
    Random random(2);
    scene_.body.material.friction = 0;
    scene_.body.angular_velocity = {1, 2, 3};
    const PlumbShape box = scene_.box({0.1, 0.2, 0.3});
    for (int i = 0; i < kBodies; ++i) ids_.push_back(scene_.add(box, {1.0 * i, 0, 0}, random.turn()));
    for (int i = 0; i < 300; ++i) {  // gaps in the slots
      scene_.remove(ids_[static_cast<std::size_t>(100 * i)]);
      ids_[static_cast<std::size_t>(100 * i)] = 0;
    }
    std::erase(ids_, PlumbBody{0});
    scene_.run(1);
  }

  [[nodiscard]] std::vector<double> one_by_one(PlumbField field, std::size_t columns) {
    std::vector<double> rows(columns * ids_.size());
    for (std::size_t i = 0; i < ids_.size(); ++i)
      check(scene_.world(),
            scene_.world().read(field, {&ids_[i], 1}, Rows(at(rows, columns * i), 1, columns * 8, PLUMB_F64)));
    return rows;
  }
  template <class T>
  void expect_all(const std::vector<double>& expected, PlumbField field, std::size_t columns, std::size_t stride) {
    constexpr T untouched = -77;
    std::vector<T> rows(stride * ids_.size(), untouched);
    check(scene_.world(),
          scene_.world().read(
              field, ids_, Rows(at(rows, 0), ids_.size(), stride * sizeof(T), sizeof(T) == 8 ? PLUMB_F64 : PLUMB_F32)));
    for (std::size_t i = 0; i < ids_.size(); ++i)
      for (std::size_t k = 0; k < stride; ++k)
        ASSERT_EQ(rows[stride * i + k], k < columns ? static_cast<T>(expected[columns * i + k]) : untouched)
            << i << ", " << k;
  }

  Scene scene_;
  std::vector<PlumbBody> ids_;

 private:
  template <class T>
  static std::byte* at(std::vector<T>& rows, std::size_t i) {
    return reinterpret_cast<std::byte*>(&rows[i]);
  }
};

TEST_P(PutRows, OfAllAreThoseOfEach) {
  for (const bool backwards : {false, true}) {
    if (backwards) std::reverse(ids_.begin(), ids_.end());
    for (const auto& [field, columns] : {std::pair{PLUMB_FIELD_POSE, std::size_t{7}}, {PLUMB_FIELD_VELOCITY, 6}}) {
      const std::vector<double> expected = one_by_one(field, columns);
      for (const std::size_t stride : {columns, columns + 2}) {
        expect_all<double>(expected, field, columns, stride);
        expect_all<float>(expected, field, columns, stride);
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Threads, PutRows, ::testing::Values(1U, 3U));

}  // namespace
}  // namespace plumb::impulse::test
