// Every knob of ODE that changes cost, quality or behaviour, by name.
#pragma once

#include <ode/ode.h>

#include "plumb/backend/settings_table.hpp"

namespace plumb::ode {

enum class Stepper { quickstep = 0, step = 1 };
enum class FrictionModel { pyramid = 0, constant = 1 };
enum class FrictionDirections { normal = 0, sliding = 1 };
enum class Space { hash = 0, sap = 1, quadtree = 2, simple = 3 };

/// The values in force. Choices are the index of the word.
struct Settings {
  Stepper stepper;
  int iterations;
  double sor_w;
  int substeps;
  double erp, cfm;
  struct Contact {
    double erp, cfm;            ///< below 0: those of the world
    double surface_layer;       ///< m
    double max_correcting_vel;  ///< m/s, 0: no limit
  } contact;
  int max_contacts;
  FrictionModel friction_model;
  FrictionDirections friction_directions;
  double bounce_vel;  ///< m/s
  bool gyroscopic, finite_rotation;
  struct Sleep {
    double linear, angular;  ///< m/s, rad/s
    int steps;
    double time;  ///< s
  } sleep;
  struct BroadPhase {
    Space space;
    int hash_min_level, hash_max_level;
    double quadtree_extent;  ///< m
    int quadtree_depth;
    int sap_axes;  ///< index of the word
  } broad_phase;
  int threads;
  int random_seed;
};

[[nodiscard]] const backend::SettingsTable<Settings>& settings_table();

/// A new, empty broad phase.
[[nodiscard]] dSpaceID make_space(const Settings& settings);

/// Hands the world's parameters to ODE.
void apply_to_world(const Settings& settings, dWorldID world);

}  // namespace plumb::ode
