// Lies about which bodies are near.
#include <cmath>

#include "honest.hpp"

namespace plumb::lying {
namespace {

/// Rows are changed one by one, each with its probe.
template <auto change>
void change_closest() {
  liar.closest.bodies = [](PlumbWorld* world, PlumbHitMode mode, const PlumbProbe* probes, std::size_t stride,
                           std::uint32_t count, PlumbClosest* out, std::uint32_t capacity, std::uint32_t* found) {
    const PlumbResult result = honest.closest.bodies(world, mode, probes, stride, count, out, capacity, found);
    const std::vector<PlumbProbe> asked = copied(probes, stride, count);
    for (std::uint32_t i = 0; result >= 0 && i < std::min(capacity, *found); ++i)
      if (out[i].body != 0) change(out[i], asked[out[i].probe]);
    return result;
  };
}
/// The probes are changed before they are asked.
template <auto change>
void change_probes() {
  liar.closest.bodies = [](PlumbWorld* world, PlumbHitMode mode, const PlumbProbe* probes, std::size_t stride,
                           std::uint32_t count, PlumbClosest* out, std::uint32_t capacity, std::uint32_t* found) {
    std::vector<PlumbProbe> changed = copied(probes, stride, count);
    for (std::uint32_t i = 0; i < count; ++i) change(changed[i], i);
    return honest.closest.bodies(world, mode, changed.data(), sizeof(PlumbProbe), count, out, capacity, found);
  };
}

}  // namespace

void closest_are_a_per_mille_further() {
  change_closest<[](PlumbClosest& row, const PlumbProbe&) { row.distance *= 1.001; }>();
}
void first_children_are_told() {
  change_closest<[](PlumbClosest& row, const PlumbProbe&) { row.child = 0; }>();
}
void closest_points_are_swapped() {
  change_closest<[](PlumbClosest& row, const PlumbProbe&) { std::swap(row.on_probe, row.on_body); }>();
}
void probes_look_half_as_far() {
  change_probes<[](PlumbProbe& probe, std::uint32_t) { probe.most_distance /= 2; }>();
}
void probes_see_all() {
  change_probes<[](PlumbProbe& probe, std::uint32_t) { probe.filter = {~0U, ~0U, 0, 0}; }>();
}
void closest_far_away_are_a_centimetre_off() {
  change_closest<[](PlumbClosest& row, const PlumbProbe& probe) {
    if (0 < row.distance && 1e4 < std::abs(probe.pose.position.x)) row.distance += 0.01;
  }>();
}
void probes_beyond_a_thousand_are_beside() {
  change_probes<[](PlumbProbe& probe, std::uint32_t i) {
    if (i >= 1000) probe.pose.position.x += 0.01;
  }>();
}
void bad_probes_are_answered() {
  liar.closest.bodies = [](PlumbWorld* world, PlumbHitMode mode, const PlumbProbe* probes, std::size_t stride,
                           std::uint32_t count, PlumbClosest* out, std::uint32_t capacity, std::uint32_t* found) {
    const PlumbResult result = honest.closest.bodies(world, mode, probes, stride, count, out, capacity, found);
    return result < 0 ? *found = 0, PlumbResult{PLUMB_OK} : result;
  };
}
/// Sensors are made bodies like others.
void probes_see_sensors() {
  liar.core.create_bodies = [](PlumbWorld* world, const PlumbBodyDesc* descs, std::size_t stride, std::uint32_t count,
                               PlumbBody* ids) {
    std::vector<PlumbBodyDesc> changed = copied(descs, stride, count);
    for (PlumbBodyDesc& desc : changed) desc.flags &= ~static_cast<std::uint32_t>(PLUMB_BODY_SENSOR);
    return honest.core.create_bodies(world, changed.data(), sizeof(PlumbBodyDesc), count, ids);
  };
}

}  // namespace plumb::lying
