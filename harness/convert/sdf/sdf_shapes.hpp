// The collisions of a link as shapes.
#pragma once

#include <sdf/Link.hh>

#include "convert/builder.hpp"

namespace plumb::harness {

/// In the link's frame.
[[nodiscard]] std::vector<LinkShape> shapes_of(const sdf::Link& link, bool moves, const std::string& name,
                                               const ModelFolders& folders, Remarks& remarks);

/// What all collisions of the link let pass: bitmasks that scenes have for whole bodies.
[[nodiscard]] std::uint32_t bitmask_of(const sdf::Link& link, const std::string& name, Remarks& remarks);

}  // namespace plumb::harness
