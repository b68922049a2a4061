// What of a step a body is solved in: islands that bear much have shorter sub-steps than others, each as its own loads
// ask (solver/choose_substeps.hpp).
#pragma once

#include "bodies/body.hpp"
#include "bodies/step_counters.hpp"

namespace plumb::impulse {

/// Of what the host moves: it goes its way through the step with the sub-steps of each level.
constexpr std::uint32_t kEveryLevel = kSubstepLevels;
/// Of what a solver leaves out, since it is known how it comes out of the step (solver/settled_islands.hpp).
constexpr std::uint32_t kSettledLevel = kSubstepLevels + 1;

/// Of a body that can be pushed, from step to step.
struct BodyPace {
  Real load_rate;        ///< sub-steps that its loads ask for, 1/s
  Real last_h;           ///< the last sub-step in which it was, s; 0 before its first
  std::uint32_t column;  ///< mass of the bodies that stand on it one on the other, as far as known, kg: bits of a float
};

/// Of a body in this step.
struct BodyLevel {
  std::uint32_t level;  ///< among SubstepLevels; or kEveryLevel, or kSettledLevel
  Real ratio;           ///< its sub-step to its last one; 1 in its first step
  BodyPace before;      ///< to be put back when the step is
};

/// Levels of bodies by body, or of all bodies the first where there are none.
class BodyLevels {
 public:
  BodyLevels() = default;
  BodyLevels(const BodyLevel* levels, const StepCounters* counters) : levels_(levels), counters_(counters) {}

  PLUMB_HD std::uint32_t operator()(std::uint32_t body) const { return have_several() ? levels_[body].level : 0; }
  /// Of a contact or a joint, by those of its two bodies that can be pushed: they are of one island.
  PLUMB_HD std::uint32_t of_pair(const Velocity* velocities, std::uint32_t a, std::uint32_t b) const {
    return have_several() ? levels_[leading(velocities, a, b)].level : 0;
  }
  /// Share of the last step's impulses that such a pair starts from.
  PLUMB_HD Real warm_start(const StepParameters& step, const Velocity* velocities, std::uint32_t a,
                           std::uint32_t b) const {
    if (levels_ == nullptr) return step.warm_start;
    if (!step.warm_starting) return 0;
    if (all_go_on()) return 1;
    const BodyLevel& level = levels_[leading(velocities, a, b)];
    return level.before.last_h > 0 ? level.ratio : Real(0);
  }
  /// This sub-step over the last one, squared.
  PLUMB_HD Real shortened(const StepParameters& step, std::uint32_t body) const {
    if (levels_ == nullptr) return step.shortened;
    return all_go_on() ? Real(1) : levels_[body].ratio * levels_[body].ratio;
  }

 private:
  // What is the same for all is not looked up for each.
  PLUMB_HD bool have_several() const { return levels_ != nullptr && counters_->levels.count > 1; }
  PLUMB_HD bool all_go_on() const { return counters_->levels.count <= 1 && counters_->levels.other_substeps == 0; }

  /// Which of two bodies tells of both. kNone may be one of them.
  PLUMB_HD std::uint32_t leading(const Velocity* velocities, std::uint32_t a, std::uint32_t b) const {
    const auto last_h = [&](std::uint32_t i) {
      return i != kNone && velocities[i].inverse_mass > 0 ? levels_[i].before.last_h : Real(-1);
    };
    return last_h(a) > last_h(b) ? a : b;
  }

  const BodyLevel* levels_ = nullptr;
  const StepCounters* counters_ = nullptr;
};

}  // namespace plumb::impulse
