// Fixed steps under frames of any length, with poses interpolated between the last two steps (Fiedler, "Fix your
// timestep", 2004).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "plumb/helpers/contact_modification.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::helpers {

struct FixedStepSettings {
  double dt = 1.0 / 60;  ///< s, > 0
  int most_steps =
      4;  ///< in one frame, >= 1; time beyond them is dropped, so that slow steps do not ask for more steps
};

/// What a frame came to.
struct FixedFrame {
  int steps = 0;
  double alpha = 0;    ///< 0..1: where the frame lies between the last two steps
  double dropped = 0;  ///< s that the world will never catch up with: the spiral of death, cut off
};

/// The state after the last two steps of some bodies, and a blend of both. Allocates when it is made, then never again.
class FixedStep {
 public:
  static constexpr PlumbNeeds needs = 0;

  /// world outlives this. bodies: those whose poses are shown. Throws Error on a setting out of range or a stale body.
  FixedStep(IPhysicsWorld& world, std::span<const PlumbBody> bodies, const FixedStepSettings& settings = {});

  /// Steps as often as frame_time (s, >= 0) asks for; before_step(dt) is called before each step, to drive the world,
  /// after_step() after each, to hear what happened in it. Throws Error when a step fails.
  template <class BeforeStep, class AfterStep>
  FixedFrame advance(double frame_time, BeforeStep&& before_step, AfterStep&& after_step) {
    FixedFrame frame = begin(frame_time);
    for (int i = 0; i < frame.steps; ++i) {
      before_step(settings_.dt);
      step();
      after_step();
    }
    blend(frame.alpha);
    return frame;
  }
  template <class BeforeStep>
  FixedFrame advance(double frame_time, BeforeStep&& before_step) {
    return advance(frame_time, before_step, [] {});
  }
  FixedFrame advance(double frame_time) {
    return advance(frame_time, [](double) {});
  }

  /// From now on contacts are changed so in each step; empty: no more.
  void modify_contacts(ModifyContacts modify) { modify_ = std::move(modify); }

  /// Of the bodies, in their order, at the frame's time: one step behind the world at alpha 0.
  [[nodiscard]] std::span<const PlumbPose> poses() const { return blended_; }
  /// Linear and angular velocity at the frame's time, six numbers a body.
  [[nodiscard]] std::span<const double> velocities() const { return blended_velocities_; }
  /// The report of the last step.
  [[nodiscard]] const PlumbStepReport& report() const { return report_; }

  /// After a teleport: shows the world as it is now, without a blend from where bodies were. Keeps the time.
  void reset();

 private:
  struct State {
    std::vector<PlumbPose> poses;
    std::vector<double> velocities;
  };
  FixedFrame begin(double frame_time);
  void step();
  void blend(double alpha);
  void read(State& state);

  IPhysicsWorld& world_;
  std::vector<PlumbBody> bodies_;
  FixedStepSettings settings_;
  double time_ = 0;  // that frames gave and steps did not take
  ModifyContacts modify_;
  PlumbStepReport report_{};
  State before_, after_;
  std::vector<PlumbPose> blended_;
  std::vector<double> blended_velocities_;
};

/// Between a and b: positions linearly, orientations along the shorter arc at a constant rate (slerp; Shoemake 1985).
[[nodiscard]] PlumbPose interpolate(const PlumbPose& a, const PlumbPose& b, double alpha);

}  // namespace plumb::helpers
