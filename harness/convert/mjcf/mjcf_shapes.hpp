// The geoms of a body as shapes.
#pragma once

#include "convert/builder.hpp"
#include "convert/mjcf/mjcf_types.hpp"

namespace plumb::harness {

/// Whether it may touch anything, by its own word or the model's.
[[nodiscard]] bool collides(const mjModel& model, int geom);

/// In the body's frame. Geoms that collide with nothing are for the eye and left out.
[[nodiscard]] std::vector<LinkShape> shapes_of(const mjModel& model, int body, bool moves, Remarks& remarks);

}  // namespace plumb::harness
