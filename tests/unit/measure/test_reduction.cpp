// Samples made into one number in a single pass, against whole series and closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "measure/quantities/reduction.hpp"

namespace plumb::harness {
namespace {

constexpr double spacing = 1.0 / 64;

template <class Function>
Reduction::Result reduced(const ReductionSpec& spec, const Function& function, int steps = 640) {
  const auto reduction = make_reduction(spec);
  for (int k = spec.of_step ? 1 : 0; k <= steps; ++k) reduction->add({k * spacing, function(k * spacing)});
  return reduction->result();
}

ReductionSpec window(Take take, double begin, double end) {
  ReductionSpec spec;
  spec.take = take;
  spec.begin = begin;
  spec.end = end;
  spec.dt = spacing;
  return spec;
}

ReductionSpec smooth(ReductionSpec spec) {
  spec.smooth = true;
  return spec;
}

ReductionSpec of_step(ReductionSpec spec) {
  spec.of_step = true;
  return spec;
}

double wave(double t) { return std::cos(3 * t) * std::exp(-t / 5); }

Series series_of_wave() {
  Series series;
  for (int k = 0; k <= 640; ++k) series.add(k * spacing, wave(k * spacing));
  return series;
}

TEST(Reduction, TakesTheValueAtATime) {
  const Series series = series_of_wave();
  for (const double time : {0.0, 1.0, 2.003, 3.5 + 0.3 * spacing, 9.99, 10.0}) {
    SCOPED_TRACE(time);
    EXPECT_NEAR(reduced(smooth(window(Take::at, time, time)), wave).value, series.at(time), 1e-15);
    EXPECT_NEAR(reduced(window(Take::at, time, time), wave).value, wave(time), 9 * spacing * spacing / 8);
  }
  EXPECT_EQ(reduced(window(Take::at, 2, 2), wave).value, wave(2));
  EXPECT_EQ(reduced(window(Take::at, 2 + spacing / 4, 2 + spacing / 4), [](double t) { return 3 * t; }).value,
            6 + 0.75 * spacing);
}

TEST(Reduction, TakesTheStepThatATimeLiesIn) {
  const auto step = [](double t) { return t / spacing; };
  EXPECT_EQ(reduced(of_step(window(Take::at, 0, 0)), step).value, 1);
  EXPECT_EQ(reduced(of_step(window(Take::at, spacing, spacing)), step).value, 1);
  EXPECT_EQ(reduced(of_step(window(Take::at, 1.5 * spacing, 1.5 * spacing)), step).value, 2);
}

TEST(Reduction, TakesExtremesOfSamplesOrOfTheParabolasBetween) {
  const Series series = series_of_wave();
  const auto tops = series.maxima(), lows = series.minima();
  EXPECT_EQ(reduced(smooth(window(Take::max, 1, 10)), wave).value, tops.front().value);
  EXPECT_EQ(reduced(smooth(window(Take::time_of_max, 1, 10)), wave).value, tops.front().time);
  EXPECT_EQ(reduced(smooth(window(Take::min, 0, 10)), wave).value, lows.front().value);
  EXPECT_EQ(reduced(smooth(window(Take::time_of_min, 2, 10)), wave).value, lows[1].time);
  EXPECT_EQ(reduced(smooth(window(Take::max_abs, 1, 10)), wave).value, -lows.front().value);
  double most = -1;
  for (int k = 64; k <= 640; ++k) most = std::max(most, wave(k * spacing));
  EXPECT_EQ(reduced(window(Take::max, 1, 10), wave).value, most);
  EXPECT_EQ(reduced(window(Take::max, 0, 10), wave).value, 1) << "the start counts";
}

TEST(Reduction, InventsNothingBesideAKink) {
  const auto jump = [](double t) { return t < 1 ? -1.0 : 1.0 - t / 100; };
  EXPECT_EQ(reduced(window(Take::max, 0, 10), jump).value, 0.99);
}

TEST(Reduction, RisesAreAboveWhatWasLowestBefore) {
  const auto falls = [](double t) { return -t; };
  EXPECT_EQ(reduced(window(Take::rise, 0, 10), falls).value, 0);
  EXPECT_EQ(reduced(window(Take::range, 0, 10), falls).value, 10);
  // Down by 4, up by 1 twice with a fall between, down to the end: once 1, not 2, and not what lies before the window.
  const auto hops = [](double t) { return t < 4 ? -t : std::abs(std::fmod(t, 2) - 1) - 5; };
  EXPECT_NEAR(reduced(window(Take::rise, 0, 10), hops).value, 1, 1e-12);
  EXPECT_NEAR(reduced(window(Take::range, 0, 10), hops).value, 5, 1e-12);
  EXPECT_NEAR(reduced(window(Take::range, 4, 10), hops).value, 1, 1e-12);
  EXPECT_NEAR(reduced(window(Take::rise, 4, 4.5), hops).value, 0, 1e-12);
  const auto explodes = [](double t) { return t < 2 ? 1.0 : NAN; };
  EXPECT_TRUE(std::isnan(reduced(window(Take::rise, 0, 10), explodes).value));
}

TEST(Reduction, MeansAreOverTime) {
  const double whole = 2 * std::numbers::pi;
  const auto sine = [](double t) { return std::sin(t) + 2; };
  EXPECT_NEAR(reduced(window(Take::mean, 0, 6.25), [](double t) { return 3 * t; }).value, 3 * 6.25 / 2, 1e-12);
  EXPECT_NEAR(reduced(window(Take::mean, 0, whole), sine).value, 2, 2e-3);
  EXPECT_NEAR(reduced(window(Take::rms, 1, 3), [](double t) { return t; }).value, std::sqrt(26.0 / 6), 1e-4);
  EXPECT_EQ(reduced(window(Take::mean, 2, 2), sine).value, sine(2));
}

TEST(Reduction, MeansOfStepsAreOfThoseThatLieWhollyWithin) {
  const auto number = [](double t) { return std::round(t / spacing); };
  EXPECT_EQ(reduced(of_step(window(Take::mean, 0, 4 * spacing)), number).value, 2.5);
  EXPECT_EQ(reduced(of_step(window(Take::mean, 2 * spacing, 4 * spacing)), number).value, 3.5);
  EXPECT_EQ(reduced(of_step(window(Take::mean, 1.5 * spacing, 4.5 * spacing)), number).value, 3.5);
}

TEST(Reduction, FindsPassesAndPeriods) {
  auto spec = window(Take::crossing_time, 0, 10);
  spec.level = 0;
  const auto passes = series_of_wave().crossings(0);
  EXPECT_EQ(reduced(spec, wave).value, passes.front());
  spec.take = Take::period;
  const std::size_t last = (passes.size() - 1) / 2 * 2;
  EXPECT_DOUBLE_EQ(reduced(spec, wave).value, (passes[last] - passes[0]) / (static_cast<double>(last) / 2));
  EXPECT_NEAR(reduced(spec, wave).value, 2 * std::numbers::pi / 3, 1e-4);
}

TEST(Reduction, SaysWhyThereIsNoNumber) {
  auto spec = window(Take::crossing_time, 0, 10);
  spec.level = 5;
  EXPECT_TRUE(std::isnan(reduced(spec, wave).value));
  EXPECT_EQ(reduced(spec, wave).trouble, "it never passed 5");
  spec = window(Take::period, 0, 1);
  EXPECT_EQ(reduced(spec, wave).trouble, "it passed 0 1 times, and a period takes 3");
  const auto explodes = [](double t) { return t < 2 ? 1.0 : NAN; };
  EXPECT_EQ(reduced(window(Take::max, 0, 10), explodes).trouble, "not finite at 2 s");
  EXPECT_EQ(reduced(window(Take::max, 0, 1), explodes).value, 1);
  EXPECT_EQ(reduced(window(Take::at, 1.99, 1.99), [](double t) { return t <= 2 ? 1.0 : NAN; }).value, 1);
}

TEST(Reduction, CountsWhatAWindowHolds) {
  EXPECT_EQ(samples_within(window(Take::max, 0, 10)), 641);
  EXPECT_EQ(samples_within(of_step(window(Take::max, 0, 10))), 640);
  EXPECT_EQ(samples_within(of_step(window(Take::mean, spacing, 2 * spacing))), 1);
  EXPECT_EQ(samples_within(of_step(window(Take::mean, 0.2 * spacing, 1.8 * spacing))), 0);
  EXPECT_EQ(samples_within(window(Take::mean, 0.2 * spacing, 0.8 * spacing)), 0);
  EXPECT_EQ(samples_within(window(Take::mean, 2, 1)), 0);
}

}  // namespace
}  // namespace plumb::harness
