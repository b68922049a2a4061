// A scene as a model in MJCF, the format of MuJoCo (its "XML Reference").
#pragma once

#include "convert/imported.hpp"

namespace plumb::harness {

/// Z is up there. What joints hold together is a tree, from a body that stands or one that is free; what closes a loop
/// is an equality: a ball joint "connect", a fixed one "weld", a hinge two "connect" on its axis. Throws UsageError for
/// distance joints, for others that close a loop or hold a kinematic body, and for flat meshes; what else MJCF has no
/// word for becomes remarks.
[[nodiscard]] std::string write_mjcf(const Scene& scene, const std::string& name, Remarks& remarks);

}  // namespace plumb::harness
