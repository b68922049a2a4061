// What is done to a machine that was read before it runs, and how it is watched.
#pragma once

#include "base/json.hpp"
#include "convert/imported.hpp"

namespace plumb::harness {

struct SetUp {
  bool fix_base = false;  ///< bodies that joints hold others to, and nothing holds, are static
  bool hold = false;      ///< a motor in every axis that can move keeps it as it is, as strong as the file says
  bool ground = false;    ///< a plane below the lowest point
};

/// Sets the scene's needs, too: those that its bodies and joints have.
void set_up(Imported& imported, const SetUp& wanted);

/// Adds a measure and metrics with truths that hold for every machine: no joint opens, nothing sinks in, and where
/// nobody drives it no energy is made of nothing.
void add_metrics(Json& scene_json, const Scene& scene);

/// Adds to these: no joint bends where it is stiff, or goes beyond its limits.
void add_joint_metrics(Json& scene_json, const Scene& scene);

}  // namespace plumb::harness
