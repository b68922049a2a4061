// What goes through plumb is what ODE does: bit for bit.
#include <gtest/gtest.h>

#include <cstring>

#include "native_program.hpp"
#include "plumb_program.hpp"

namespace plumb::ode_test {
namespace {

class Trajectories : public testing::TestWithParam<Scene> {};

TEST_P(Trajectories, EqualTheNativeProgramBitForBit) {
  std::vector<std::vector<double>> expected(300);
  {
    NativeProgram native(GetParam());
    for (auto& rows : expected) {
      native.step();
      native.read(rows);
    }
  }
  PlumbProgram program(GetParam());
  std::vector<double> rows;
  for (std::size_t step = 0; step < expected.size(); ++step) {
    program.step();
    program.read(rows);
    ASSERT_EQ(rows.size(), expected[step].size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      ASSERT_EQ(std::memcmp(&rows[i], &expected[step][i], sizeof(double)), 0)
          << "step " << step << ", moving body " << i / 13 << ", column " << i % 13 << ": " << rows[i] << " instead of "
          << expected[step][i];
  }
}

// What a world keeps for others must not change what it does.
TEST(Trajectories, AreTheSameWhateverElseIsAskedOfTheWorld) {
  std::vector<double> plain, asked;
  PlumbProgram one(pile(30)), other(pile(30), usual_needs | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES |
                                                  PLUMB_NEED_EVENTS | PLUMB_NEED_JOINT_REACTIONS | PLUMB_NEED_QUERIES |
                                                  PLUMB_NEED_FILTERS | PLUMB_NEED_SENSORS);
  for (int i = 0; i < 200; ++i) {
    one.step();
    other.step();
  }
  one.read(plain);
  other.read(asked);
  EXPECT_EQ(plain, asked);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Trajectories, testing::Values(tower(10), pyramid(8), pile(60), chain(10), pendulum()),
                         [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace plumb::ode_test
