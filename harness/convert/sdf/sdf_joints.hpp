// The joints of a model.
#pragma once

#include <sdf/Joint.hh>

#include "convert/builder.hpp"

namespace plumb::harness {

/// What a joint holds, by index.
struct JointEnds {
  std::optional<std::size_t> parent;  ///< none: the world
  std::size_t child;
};

/// The joint of a model that stands at this place in the world; where nothing moves none is added, with a remark.
void add_sdf_joint(const sdf::Joint& joint, const std::string& name, const referee::Pose& model, const JointEnds& ends,
                   Imported& imported);

}  // namespace plumb::harness
