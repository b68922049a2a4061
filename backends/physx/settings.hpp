// PhysX's knobs. Every default is PhysX's own, as PxSceneDesc and new bodies and shapes have it.
#pragma once

#include "physx_math.hpp"
#include "plumb/backend/settings_table.hpp"

namespace plumb::px {

struct Settings {
  enum class Solver { pgs, tgs };
  enum class Ccd { swept, speculative };
  enum class BroadPhase { pabp, abp, sap, gpu };

  int position_iterations, velocity_iterations, batch_size;
  Solver solver;
  BroadPhase broad_phase;
  double bounce_threshold, max_angular_speed, max_depenetration_speed, max_bias_coefficient;
  struct Contacts {
    double offset, rest_offset;
    bool pcm, average_point;  ///< the GPU always has the first
  } contacts;
  struct Friction {
    double offset_threshold, correlation_distance;
    bool every_iteration, strong;
  } friction;
  struct Continuous {
    Ccd by;
    int most_passes;
  } continuous;
  struct Sleep {
    double threshold, time;
  } sleep;
  bool forces_every_iteration, stabilization, enhanced_determinism;
};

[[nodiscard]] const backend::SettingsTable<Settings>& settings_table();

/// Those that a scene takes when it is made.
void put_settings(const Settings& settings, PxSceneDesc& desc);
/// Those that it takes at any time.
void apply_settings(const Settings& settings, PxScene& scene);

}  // namespace plumb::px
