// plumb.state/1: rows lent where they lie. Compiled for every memory that the engine can work in.
#include <gtest/gtest.h>

#include <thread>

#include "exec/memory.hpp"
#include "exec/phase_clock.hpp"
#include "math/real.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kRowNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;
constexpr std::int32_t kHost = 1, kDevice = 2;
const std::int32_t kOwn = Executor::device_type();
const bool kOnHost = kOwn == kHost;

/// A tensor, given back in the end.
using Tensor = std::shared_ptr<PlumbDLManagedTensor>;

class LentRows : public ::testing::Test {
 protected:
  LentRows() {
    if (const std::string unmet = Executor::unmet_requirement(); !unmet.empty()) return;
    scene_ = std::make_unique<Scene>(engine(), kRowNeeds, PlumbVec3{0, -9.81, 0}, 1);
    scene_->ground();
    box_ = scene_->box({0.5, 0.3, 0.2});
    for (int i = 0; i < 20; ++i) {
      Random random(static_cast<std::uint64_t>(i));
      scene_->body.angular_velocity = {1, 2, random.between(-1, 1)};
      bodies_.push_back(scene_->add(box_, {2.0 * i, 1, 0}, random.turn()));
    }
    bodies_.insert(bodies_.begin(), scene_->world().bodies().front());
  }
  void SetUp() override {
    if (const std::string unmet = Executor::unmet_requirement(); !unmet.empty()) GTEST_SKIP() << unmet;
  }

  IState& state() { return *scene_->world().state(); }
  Tensor borrow(PlumbField field, std::int32_t device = kOwn, PlumbFence* fence = nullptr) {
    const PlumbStateRequest request = {sizeof request, field, device, device == kOwn ? 0U : 1U};
    PlumbDLManagedTensor* tensor = nullptr;
    result_ = check(scene_->world(), state().borrow(request, tensor, fence));
    return {tensor, [](PlumbDLManagedTensor* lent) { lent->deleter(lent); }};
  }
  std::string refusal(std::int32_t device, std::uint32_t allow_copy) {
    const PlumbStateRequest request = {sizeof request, PLUMB_FIELD_POSE, device, allow_copy};
    PlumbDLManagedTensor* tensor = nullptr;
    EXPECT_EQ(state().borrow(request, tensor, nullptr), PLUMB_E_UNSUPPORTED);
    EXPECT_EQ(tensor, nullptr);
    return scene_->world().error_text();
  }

  /// The tensor's numbers, fetched from where they lie.
  static std::vector<double> numbers(const Tensor& lent) {
    const PlumbDLTensor& tensor = lent->dl_tensor;
    const auto count = static_cast<std::size_t>(tensor.shape[0] * tensor.shape[1]);
    if (tensor.dtype.bits == 64) return fetch<double>(tensor, count);
    const std::vector<float> narrow = fetch<float>(tensor, count);
    return {narrow.begin(), narrow.end()};
  }
  template <class T>
  static std::vector<T> fetch(const PlumbDLTensor& tensor, std::size_t count) {
    std::vector<T> numbers(count);
    if (tensor.device.device_type == kHost)
      std::memcpy(numbers.data(), tensor.data, count * sizeof(T));
    else
      memory::download(numbers.data(), tensor.data, count * sizeof(T));
    return numbers;
  }

  /// Rows as read() gives them.
  std::vector<double> read(PlumbField field) {
    const std::size_t columns = columns_of(field);
    std::vector<double> rows(columns * bodies_.size());
    check(scene_->world(), scene_->world().read(field, bodies_,
                                                Rows(reinterpret_cast<std::byte*>(rows.data()), bodies_.size(),
                                                     columns * sizeof(double), PLUMB_F64)));
    return rows;
  }

  std::unique_ptr<Scene> scene_;
  PlumbShape box_ = 0;
  std::vector<PlumbBody> bodies_;
  PlumbResult result_ = PLUMB_OK;
};

TEST_F(LentRows, AreWhatReadGives) {
  for (const PlumbField field : {PLUMB_FIELD_POSE, PLUMB_FIELD_VELOCITY}) {
    const std::size_t columns = columns_of(field);
    for (int round = 0; round < 3; ++round) {
      const Tensor lent = borrow(field);
      EXPECT_EQ(result_, PLUMB_OK);
      EXPECT_EQ(lent->flags, 1U) << "read only, and no copy";
      EXPECT_EQ(lent->version.major, 1U);
      const PlumbDLTensor& tensor = lent->dl_tensor;
      EXPECT_EQ(tensor.device.device_type, kOwn);
      ASSERT_EQ(tensor.ndim, 2);
      ASSERT_EQ(tensor.shape[0], static_cast<std::int64_t>(bodies_.size()));
      ASSERT_EQ(tensor.shape[1], static_cast<std::int64_t>(columns));
      EXPECT_EQ(tensor.strides[0], static_cast<std::int64_t>(columns));
      EXPECT_EQ(tensor.strides[1], 1);
      EXPECT_EQ(tensor.dtype.code, 2);
      EXPECT_EQ(tensor.dtype.bits, field == PLUMB_FIELD_POSE ? 64 : 8 * sizeof(Real));
      EXPECT_EQ(numbers(lent), read(field)) << "field " << field << ", round " << round;
      scene_->run(7);
    }
  }
}

TEST_F(LentRows, FollowTheStepsAndStayAsTheyAreBetweenThem) {
  const Tensor lent = borrow(PLUMB_FIELD_POSE);
  scene_->run(3);
  EXPECT_EQ(numbers(lent), read(PLUMB_FIELD_POSE)) << "rows that were lent before the steps";
  scene_->run(3);
  const std::vector<double> before = numbers(lent);
  EXPECT_EQ(before, read(PLUMB_FIELD_POSE)) << "after more steps";
  scene_->write(PLUMB_FIELD_POSE, bodies_[4], {7, 8, 9, 0, 0, 0, 1});
  const Tensor again = borrow(PLUMB_FIELD_POSE);
  EXPECT_EQ(numbers(again), read(PLUMB_FIELD_POSE)) << "rows that were lent after the write";
  EXPECT_EQ(numbers(again)[4 * 7], 7);
  EXPECT_EQ(numbers(lent), before) << "rows that were lent before the write";
}

TEST_F(LentRows, SayWhoseTheyAre) {
  (void)borrow(PLUMB_FIELD_POSE);  // so that steps bring them
  std::vector<PlumbBody> first(bodies_.size());
  std::span<const PlumbBody> ids;
  std::uint64_t generation = 0, later = 0;
  ASSERT_EQ(state().row_map(ids, generation), PLUMB_OK);
  EXPECT_TRUE(std::equal(ids.begin(), ids.end(), bodies_.begin(), bodies_.end()));
  scene_->run(2);
  ASSERT_EQ(state().row_map(ids, later), PLUMB_OK);
  EXPECT_EQ(later, generation) << "a step changes no rows";
  scene_->remove(bodies_[5]);
  ASSERT_EQ(state().row_map(ids, later), PLUMB_OK);
  EXPECT_NE(later, generation);
  EXPECT_EQ(ids[5], 0U) << "the row of a body that is gone";
  EXPECT_EQ(ids[6], bodies_[6]);
  // Its centre of mass and principal axes are not those of its frame.
  const PlumbBody newcomer = scene_->add(scene_->hull({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0.5, 0, 3}}), {0, 30, 0});
  generation = later;
  ASSERT_EQ(state().row_map(ids, later), PLUMB_OK);
  EXPECT_NE(later, generation);
  EXPECT_EQ(ids[5], newcomer);
  bodies_[5] = newcomer;
  scene_->run(2);
  EXPECT_EQ(numbers(borrow(PLUMB_FIELD_POSE)), read(PLUMB_FIELD_POSE));
  EXPECT_NEAR(numbers(borrow(PLUMB_FIELD_POSE))[5 * 7 + 1], 30, 0.1) << "its frame, not its centre of mass";
}

TEST_F(LentRows, OutliveGrowthAndTheWorld) {
  scene_->run(2);
  const std::vector<double> then = read(PLUMB_FIELD_POSE);
  Tensor lent = borrow(PLUMB_FIELD_POSE);
  for (int i = 0; i < 500; ++i) scene_->add(box_, {2.0 * i, 40, 0});
  scene_->run(2);
  EXPECT_EQ(borrow(PLUMB_FIELD_POSE)->dl_tensor.shape[0], 521);
  scene_.reset();
  EXPECT_EQ(numbers(lent), then);
  std::thread([&] { lent.reset(); }).join();
}

TEST_F(LentRows, AreRefusedWhereTheyAreNot) {
  EXPECT_NE(refusal(7, 1).find("ask for device_type"), std::string::npos);
  if (kOnHost) {
    EXPECT_NE(refusal(kDevice, 1).find("keeps its state on the host; ask for device_type 1"), std::string::npos);
  } else {
    EXPECT_NE(refusal(kHost, 0).find("keeps its state on the device; ask for device_type 2"), std::string::npos);
    EXPECT_NE(refusal(kHost, 0).find("set allow_copy"), std::string::npos);
  }
}

TEST_F(LentRows, OfTheHostAreACopyOfThoseOfTheDevice) {
  if (kOnHost) GTEST_SKIP() << "the engine works in the host's memory";
  for (const PlumbField field : {PLUMB_FIELD_POSE, PLUMB_FIELD_VELOCITY}) {
    scene_->run(3);
    PlumbFence fence = {this, this};
    const Tensor lent = borrow(field, kHost, &fence);
    EXPECT_EQ(result_, PLUMB_COPIED);
    EXPECT_EQ(lent->flags, 3U);
    EXPECT_EQ(fence.stream, nullptr);
    EXPECT_EQ(fence.event, nullptr);
    EXPECT_EQ(numbers(lent), read(field));
    EXPECT_EQ(numbers(lent), numbers(borrow(field)));
  }
}

}  // namespace
}  // namespace plumb::impulse::test
