// What goes through plumb is what ODE does: bit for bit.
#include <gtest/gtest.h>

#include <cstring>

#include "native_program.hpp"
#include "plumb_program.hpp"

namespace plumb::ode_test {
namespace {

class Trajectories : public testing::TestWithParam<Scene> {};

void expect_same_bits(const std::vector<double>& got, const std::vector<double>& expected, std::size_t columns) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i)
    ASSERT_EQ(std::memcmp(&got[i], &expected[i], sizeof(double)), 0)
        << "moving body " << i / columns << ", column " << i % columns << ": " << got[i] << " instead of "
        << expected[i];
}

TEST_P(Trajectories, EqualTheNativeProgramBitForBit) {
  std::vector<StateRows> expected(300);
  {
    NativeProgram native(GetParam());
    for (StateRows& rows : expected) {
      native.step();
      native.read(rows);
    }
  }
  PlumbProgram program(GetParam());
  StateRows rows;
  for (std::size_t step = 0; step < expected.size(); ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    program.step();
    program.read(rows);
    ASSERT_NO_FATAL_FAILURE(expect_same_bits(rows.poses, expected[step].poses, 7));
    ASSERT_NO_FATAL_FAILURE(expect_same_bits(rows.velocities, expected[step].velocities, 6));
  }
}

// What a world keeps for others must not change what it does.
TEST(Trajectories, AreTheSameWhateverElseIsAskedOfTheWorld) {
  PlumbProgram one(pile(30)),
      other(pile(30), usual_needs | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES | PLUMB_NEED_EVENTS |
                          PLUMB_NEED_JOINT_REACTIONS | PLUMB_NEED_QUERIES | PLUMB_NEED_FILTERS | PLUMB_NEED_SENSORS);
  for (int i = 0; i < 200; ++i) {
    one.step();
    other.step();
  }
  StateRows plain, asked;
  one.read(plain);
  other.read(asked);
  EXPECT_EQ(plain, asked);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Trajectories, testing::Values(tower(10), pyramid(8), pile(60), chain(10), pendulum()),
                         [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace plumb::ode_test
