// Lies about what a backend shows of itself.
#include "honest.hpp"

namespace plumb::lying {
namespace {

/// Calls change(row) for every row of PlumbDebugTable's `look`.
template <auto look, auto change>
struct Changed;
template <class Row, PlumbResult (*PlumbDebugTable::*look)(PlumbWorld*, Row*, std::uint32_t, std::uint32_t*),
          auto change>
struct Changed<look, change> {
  static PlumbResult call(PlumbWorld* world, Row* out, std::uint32_t capacity, std::uint32_t* count) {
    const PlumbResult result = (honest.debug.*look)(world, out, capacity, count);
    for (std::uint32_t i = 0; result >= 0 && i < std::min(capacity, *count); ++i) change(out[i]);
    return result;
  }
};
template <auto look, auto change>
void change_rows_of() {
  liar.debug.*look = &Changed<look, change>::call;
}

}  // namespace

void leaves_too_small() {
  change_rows_of<&PlumbDebugTable::boxes, [](PlumbDebugBox& box) {
    if (box.body != 0) box.upper = box.lower;
  }>();
}
void inner_boxes_too_small() {
  change_rows_of<&PlumbDebugTable::boxes, [](PlumbDebugBox& box) {
    if (box.body == 0) box.upper = box.lower;
  }>();
}
void axes_turned_round() {
  change_rows_of<&PlumbDebugTable::axes, [](PlumbDebugAxis& row) {
    row.axis = {-row.axis.x, -row.axis.y, -row.axis.z};
  }>();
}
void no_axes() {
  liar.debug.axes = [](PlumbWorld* world, PlumbDebugAxis* out, std::uint32_t capacity, std::uint32_t* count) {
    const PlumbResult result = honest.debug.axes(world, out, capacity, count);
    return result < 0 ? result : (*count = 0, PlumbResult{PLUMB_OK});
  };
}
void everybody_is_an_island() {
  change_rows_of<&PlumbDebugTable::bodies, [](PlumbDebugBody& row) {
    if (row.island >= 0) row.island = static_cast<std::int32_t>(slot_of(row.body));
  }>();
}
void one_island_for_all() {
  change_rows_of<&PlumbDebugTable::bodies, [](PlumbDebugBody& row) { row.island = std::min(row.island, 0); }>();
}
void sleepers_told_awake() {
  change_rows_of<&PlumbDebugTable::bodies, [](PlumbDebugBody& row) { row.asleep = 0; }>();
}
void one_colour_for_all() {
  change_rows_of<&PlumbDebugTable::constraints, [](PlumbDebugConstraint& row) { row.colour = 0; }>();
}
void joints_are_not_told() {
  change_rows_of<&PlumbDebugTable::constraints, [](PlumbDebugConstraint& row) { row.joint = 0; }>();
}
void who_asks_pushes() {
  liar.debug.boxes = [](PlumbWorld* world, PlumbDebugBox* out, std::uint32_t capacity, std::uint32_t* count) {
    PlumbBody bodies[2];
    std::uint32_t living = 0;
    const double velocity[6] = {1e-3, 0, 0, 0, 0, 0};
    if (honest.core.list_bodies(world, bodies, 2, &living) >= 0 && living > 1)
      honest.core.write(world, PLUMB_FIELD_VELOCITY, PLUMB_F64, &bodies[1], 1, velocity, sizeof velocity);
    return honest.debug.boxes(world, out, capacity, count);
  };
}
void boxes_told_whole() {
  liar.debug.boxes = [](PlumbWorld* world, PlumbDebugBox* out, std::uint32_t capacity, std::uint32_t* count) {
    const PlumbResult result = honest.debug.boxes(world, out, capacity, count);
    if (result != PLUMB_TRUNCATED) return result;
    *count = capacity;
    return PlumbResult{PLUMB_OK};
  };
}

}  // namespace plumb::lying
