// A scene as a page builds and steps it itself, with the engine's WebAssembly.
#pragma once

#include "base/json.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

/// "header": what a replay must know (record/trajectory_header.hpp), and "driven": whether its energy says nothing of
/// the
///   engine.
/// "needs", "gravity", "settings" ({}), "shapes", "bodies", "joints": as api/web takes them (plumb.d.mts), in the
/// scene's
///   order; for handles stand numbers in these lists. Of meshes and height fields the points stand in the header alone.
/// "masses": of each body by the referee mass, centre of mass, and xx yy zz xy xz yz of the inertia about it, in the
///   body's axes.
/// "host": as SceneAction; "cuts": [joint, seconds] of each that the host takes away.
/// Numbers keep all their bits: the page steps what the harness steps.
[[nodiscard]] Json live_world(const Scene& scene);

}  // namespace plumb::harness
