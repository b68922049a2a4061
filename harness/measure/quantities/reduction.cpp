#include "measure/quantities/reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plumb/assert.hpp"

namespace plumb::harness {
namespace {

constexpr double slack = 1e-6;  ///< steps by which times that are meant to be equal may differ

/// The last three samples.
class Last {
 public:
  void push(const SeriesPoint& sample) {
    PLUMB_ASSERT(count_ == 0 || sample.time > here_.time);
    before_ = last_;
    last_ = here_;
    here_ = sample;
    ++count_;
  }
  [[nodiscard]] const SeriesPoint& first() const { return before_; }
  [[nodiscard]] const SeriesPoint& second() const { return last_; }
  [[nodiscard]] const SeriesPoint& third() const { return here_; }
  [[nodiscard]] bool has(std::size_t count) const { return count_ >= count; }

 private:
  SeriesPoint before_{}, last_{}, here_{};
  std::size_t count_ = 0;
};

class AtTime : public Reduction {
 public:
  explicit AtTime(const ReductionSpec& spec) : Reduction(spec) {}

 private:
  void take(const SeriesPoint& sample) override {
    if (done_) return;
    const double time = spec().begin, eps = slack * spec().dt;
    last_.push(sample);
    if (spec().of_step || std::abs(sample.time - time) <= eps) {
      done_ = sample.time >= time - eps;
      if (done_) value_ = sample.value;
    } else if (spec().smooth) {
      // The parabola through the sample before the time, the one after, and its successor where there is one.
      if (!last_.has(3)) return;
      value_ = parabola_at(last_.first(), last_.second(), last_.third(), time);
      done_ = last_.second().time >= time;
    } else if (last_.has(2) && sample.time > time) {
      const SeriesPoint& before = last_.second();
      value_ = before.value + (sample.value - before.value) * (time - before.time) / (sample.time - before.time);
      done_ = true;
    }
  }
  [[nodiscard]] Result taken() const override { return {value_, "the run ended before that time"}; }

  Last last_;
  bool done_ = false;
  double value_ = not_measured;
};

class Extreme : public Reduction {
 public:
  explicit Extreme(const ReductionSpec& spec)
      : Reduction(spec), sign_(spec.take == Take::min || spec.take == Take::time_of_min ? -1 : 1) {}

 private:
  void take(const SeriesPoint& sample) override {
    last_.push(spec().take == Take::max_abs ? SeriesPoint{sample.time, std::abs(sample.value)} : sample);
    consider(last_.third());
    if (!spec().smooth || !last_.has(3)) return;
    if (const auto between = vertex(last_.first(), last_.second(), last_.third(), sign_)) consider(*between);
  }
  void consider(const SeriesPoint& point) {
    if (holds(point.time) && !(sign_ * point.value <= sign_ * best_.value)) best_ = point;
  }
  [[nodiscard]] Result taken() const override {
    return {gives_a_time(spec().take) ? best_.time : best_.value, "there was no sample"};
  }

  double sign_;
  Last last_;
  SeriesPoint best_{not_measured, not_measured};
};

/// Of instants the mean over time by the trapezoid rule; of steps the mean of those that lie wholly within.
class Mean : public Reduction {
 public:
  explicit Mean(const ReductionSpec& spec) : Reduction(spec) {}

 private:
  void take(const SeriesPoint& sample) override {
    const double value = spec().take == Take::rms ? sample.value * sample.value : sample.value;
    if (!holds(sample.time) || (spec().of_step && !holds(sample.time - spec().dt))) return;
    if (spec().of_step || count_ == 0) {
      sum_ += value;
    } else {
      trapezoids_ += (last_ + value) / 2;
    }
    last_ = value;
    ++count_;
  }
  [[nodiscard]] Result taken() const override {
    const auto count = static_cast<double>(count_);
    double mean = sum_ / count;
    if (!spec().of_step && count_ > 1) mean = trapezoids_ / (count - 1);
    return {spec().take == Take::rms ? std::sqrt(mean) : mean, "there was no sample"};
  }

  double sum_ = 0, trapezoids_ = 0, last_ = 0;
  std::size_t count_ = 0;
};

/// How far samples lie apart: the largest from the smallest, or each from the smallest before it.
class RiseOrRange : public Reduction {
 public:
  explicit RiseOrRange(const ReductionSpec& spec) : Reduction(spec) {}

 private:
  void take(const SeriesPoint& sample) override {
    if (!holds(sample.time)) return;
    lowest_ = count_ == 0 ? sample.value : std::min(lowest_, sample.value);
    highest_ = count_ == 0 ? sample.value : std::max(highest_, sample.value);
    rise_ = std::max(rise_, sample.value - lowest_);
    ++count_;
  }
  [[nodiscard]] Result taken() const override {
    if (count_ == 0) return {not_measured, "there was no sample"};
    return {spec().take == Take::rise ? rise_ : highest_ - lowest_, ""};
  }

  double lowest_ = 0, highest_ = 0, rise_ = 0;
  std::size_t count_ = 0;
};

/// Passes of a level: the first, or the mean interval between passes in the direction of the first.
class Passes : public Reduction {
 public:
  explicit Passes(const ReductionSpec& spec) : Reduction(spec) {}

 private:
  void take(const SeriesPoint& sample) override {
    last_.push(sample);
    if (!last_.has(2)) return;
    const auto time = crossing(last_.second(), last_.third(), spec().level);
    if (!time || !holds(*time)) return;
    if (count_ == 0) first_ = *time;
    if (count_ % 2 == 0) same_way_ = *time;
    ++count_;
  }
  [[nodiscard]] Result taken() const override {
    if (spec().take == Take::crossing_time) return {first_, fmt::format("it never passed {:g}", spec().level)};
    if (count_ < 3)
      return {not_measured, fmt::format("it passed {:g} {} times, and a period takes 3", spec().level, count_)};
    PLUMB_ASSERT(same_way_ > first_);
    return {(same_way_ - first_) / static_cast<double>((count_ - 1) / 2), ""};
  }

  Last last_;
  double first_ = not_measured, same_way_ = not_measured;
  std::size_t count_ = 0;
};

}  // namespace

const std::vector<std::string>& take_words() {
  static const std::vector<std::string> words{"at",   "min",   "max",         "max_abs",     "mean",          "rms",
                                              "rise", "range", "time_of_min", "time_of_max", "crossing_time", "period"};
  return words;
}

const std::vector<std::string>& take_docs() {
  static const std::vector<std::string> docs{
      "the value at the time \"at\", left out: at the end",
      "the smallest value",
      "the largest value",
      "the largest magnitude",
      "the mean over time; of a quantity that belongs to a step, over the steps that lie wholly within",
      "the root of the mean square, likewise",
      "the most by which it rose above its smallest value until then: of an energy what was made of nothing",
      "the largest value less the smallest",
      "when it was smallest",
      "when it was largest",
      "when it first passed \"level\"",
      "the mean time from one pass of \"level\" to the next in the same direction"};
  return docs;
}

bool Reduction::wants(double time) const {
  constexpr double around = 2.5;  // steps, in which lie the three samples of a parabola
  return time >= spec_.begin - around * spec_.dt && time <= spec_.end + around * spec_.dt;
}

bool Reduction::holds(double time) const {
  const double eps = slack * spec_.dt;
  return time >= spec_.begin - eps && time <= spec_.end + eps;
}

void Reduction::add(const SeriesPoint& sample) {
  if (lost_ || !wants(sample.time)) return;
  if (std::isfinite(sample.value))
    take(sample);
  else if (sample.time <= spec_.end + slack * spec_.dt)
    lost_ = sample.time;
}

Reduction::Result Reduction::result() const {
  if (lost_) return {not_measured, fmt::format("not finite at {:g} s", *lost_)};
  Result result = taken();
  if (std::isfinite(result.value)) result.trouble.clear();
  return result;
}

std::unique_ptr<Reduction> make_reduction(const ReductionSpec& spec) {
  PLUMB_ASSERT(spec.dt > 0);
  if (spec.take == Take::at) return std::make_unique<AtTime>(spec);
  if (spec.take == Take::mean || spec.take == Take::rms) return std::make_unique<Mean>(spec);
  if (spec.take == Take::rise || spec.take == Take::range) return std::make_unique<RiseOrRange>(spec);
  if (needs_a_level(spec.take)) return std::make_unique<Passes>(spec);
  return std::make_unique<Extreme>(spec);
}

double samples_within(const ReductionSpec& spec) {
  const double before = spec.of_step && (spec.take == Take::mean || spec.take == Take::rms) ? 1 : 0;
  const double first = std::max(std::ceil(spec.begin / spec.dt - slack) + before, spec.of_step ? 1.0 : 0.0);
  return std::max(0.0, std::floor(spec.end / spec.dt + slack) - first + 1);
}

}  // namespace plumb::harness
