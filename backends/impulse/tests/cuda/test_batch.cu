// What several executors enqueue together is, for each of them, what it enqueues alone: loops of all kinds, sorts,
// sums and copies, from a list that was recorded once.
#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <vector>

#include "exec/executor.hpp"
#include "exec/sort.hpp"
#include "math/real.hpp"

namespace plumb::impulse {

namespace batch_test {

struct Scramble {
  std::uint32_t* numbers;
  std::uint32_t by;
  PLUMB_HD void operator()(std::uint32_t i) const { numbers[i] = (numbers[i] ^ by) * 2654435761U + i; }
};
/// Loops that depend on each other, longer and shorter than a block.
struct Mix {
  std::uint32_t *numbers, *others;
  const std::uint32_t* count;
  PLUMB_DEVICE void operator()(Team& team) const {
    const Mix self = *this;
    const std::uint32_t n = *count;
    team.each(n, [self, n](std::uint32_t i) { self.others[i] = self.numbers[n - 1 - i] + 1; });
    team.single([self, n] { self.others[n] = self.others[0] ^ self.others[n - 1]; });
    team.each(n, [self, n](std::uint32_t i) { self.numbers[i] = self.others[i] + self.others[n] % 7; });
    team.each_group(3, 5, [self](Team& group, std::uint32_t g) {
      group.each(10, [self, g](std::uint32_t i) { self.numbers[g] += i + g; });
    });
  }
};
struct Low {
  std::uint32_t* numbers;
  PLUMB_HD void operator()(std::uint32_t i) const { numbers[i] &= 0xffU; }
};

}  // namespace batch_test

namespace {

/// One world's arrays and what it does with them.
struct World {
  explicit World(std::uint32_t count)
      : executor(nullptr, 1),
        n(count),
        numbers(count),
        others(count + 1U),
        order(count),
        sorted(count),
        sorted_order(count),
        sums(count),
        total(1) {
    size.grow(1);
    input.grow(count);
    output.grow(count);
    size[0] = count;
    std::vector<std::uint32_t> places(count);
    std::iota(places.begin(), places.end(), 0U);
    order.assign(places);
    sort.reserve(count);
    scan.reserve(count);
  }

  void step(std::uint32_t number) {
    for (std::uint32_t i = 0; i < n; ++i) input[i] = i * 7919U + number * n;
    executor.to_device(size, 1);
    executor.to_device(input, n);
    executor.record(recording, [this] {
      executor.run(n, batch_test::Scramble{input.device(), n});
      executor.team({size.device(), n}, 0, batch_test::Mix{input.device(), others.data(), size.device()});
      executor.run(Count{size.device(), 2 * n}, batch_test::Low{input.device()});
      sort.run(executor, Count{size.device(), n}, input.device(), order.data(), sorted.data(), sorted_order.data(), 8);
      scan.run(executor, Count{size.device(), n}, sorted_order.data(), sums.data(), total.data());
      scan.run(executor, n, sums.data(), input.device(), total.data());
      sort.run(executor, n, input.device(), sorted_order.data(), sorted.data(), order.data(), 32);
      executor.run(n, batch_test::Scramble{sorted.data(), n});
      executor.run(n, Take{sorted.data(), order.data(), output.device()});
      executor.to_host(output, n);
    });
  }
  [[nodiscard]] std::vector<std::uint32_t> result() {
    executor.wait();
    return {output.host(), output.host() + n};
  }

  struct Take {
    const std::uint32_t *sorted, *order;
    std::uint32_t* to;
    PLUMB_HD void operator()(std::uint32_t i) const { to[i] = sorted[i] ^ order[i] << 16; }
  };

  Executor executor;
  std::uint32_t n;
  Mirror<std::uint32_t> size, input, output;
  Buffer<std::uint32_t> numbers, others, order, sorted, sorted_order, sums, total;
  RadixSort<std::uint32_t> sort;
  Scan scan;
  Recording recording;
};

/// Few worlds have more threads each than many.
void is_for_each_what_it_is_alone(std::size_t copies) {
  const std::uint32_t counts[] = {5, 20, 63, 64, 65, 127, 129, 600, 1500, 20};
  const auto batch = std::make_shared<Batch>();
  std::vector<std::unique_ptr<World>> alone, together;
  for (std::size_t copy = 0; copy < copies; ++copy)
    for (const std::uint32_t count : counts) {
      if (copy == 0) alone.push_back(std::make_unique<World>(count));
      together.push_back(std::make_unique<World>(count));
      together.back()->executor.join(batch);
    }
  for (std::uint32_t number = 0; number < 6; ++number) {
    const auto takes_part = [&](std::size_t w) { return number != 3 || w % 2 == 0; };
    for (std::size_t w = 0; w < together.size(); ++w) {
      if (!takes_part(w)) continue;
      if (w < alone.size()) alone[w]->step(number);
      together[w]->step(number);
      if (number == 4 && w == 2) EXPECT_EQ(together[w]->result(), alone[w]->result());  // others have yet to begin
    }
    for (std::size_t w = 0; w < together.size(); ++w) {
      if (!takes_part(w)) continue;
      const std::size_t like = w % alone.size();
      EXPECT_EQ(together[w]->result(), alone[like]->result()) << "world " << w << ", step " << number;
    }
    if (number == 4) together[0]->executor.leave();
  }
  together[1]->step(7);  // goes with a step that nobody waits for
}

TEST(Batch, IsForEachWhatItIsAlone) {
  if (const std::string unmet = Executor::unmet_requirement(); !unmet.empty()) GTEST_SKIP() << unmet;
  is_for_each_what_it_is_alone(1);
  is_for_each_what_it_is_alone(60);
}

}  // namespace
}  // namespace plumb::impulse
