// Which joints are links of DART's skeletons, and who is whose child.
#pragma once

#include <memory>
#include <vector>

#include "joints/joint.hpp"

namespace plumb::dart6 {

/// Sets the links of bodies and joints; the answer has each body after its parent, and those of one skeleton together.
/// Joints that could not close a loop become links first, else in the order of creation. Throws Error
/// (PLUMB_E_UNSUPPORTED) where one of them would have to close one; nothing is changed then.
[[nodiscard]] std::vector<Body*> grow_trees(const std::vector<std::unique_ptr<Body>>& bodies,
                                            const std::vector<std::unique_ptr<Joint>>& joints);

}  // namespace plumb::dart6
