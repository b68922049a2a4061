// Lies about how deep shapes overlap.
#include "honest.hpp"

namespace plumb::lying {
namespace {

/// Rows are changed one by one, after they are sorted.
template <auto change>
void change_penetrations() {
  liar.queries.penetrations = [](PlumbWorld* world, const PlumbOverlap* overlaps, std::size_t stride,
                                 std::uint32_t count, PlumbPenetration* out, std::uint32_t capacity,
                                 std::uint32_t* found) {
    const PlumbResult result = honest.queries.penetrations(world, overlaps, stride, count, out, capacity, found);
    for (std::uint32_t i = 0; result >= 0 && i < std::min(capacity, *found); ++i) change(out[i]);
    return result;
  };
}

}  // namespace

void depths_are_halved() {
  change_penetrations<[](PlumbPenetration& row) { row.depth /= 2; }>();
}
void ways_out_lead_aside() {
  change_penetrations<[](PlumbPenetration& row) {
    const PlumbVec3 n = row.normal;
    row.normal = {n.y, n.z, n.x};
  }>();
}
void last_children_are_deepest() {
  change_penetrations<[](PlumbPenetration& row) { row.child = row.child == 0 ? 0 : 1; }>();
}
void depths_see_all() {
  liar.queries.penetrations = [](PlumbWorld* world, const PlumbOverlap* overlaps, std::size_t stride,
                                 std::uint32_t count, PlumbPenetration* out, std::uint32_t capacity,
                                 std::uint32_t* found) {
    std::vector<PlumbOverlap> changed = copied(overlaps, stride, count);
    for (PlumbOverlap& overlap : changed) overlap.filter = {~0U, ~0U, 0, 0};
    return honest.queries.penetrations(world, changed.data(), sizeof(PlumbOverlap), count, out, capacity, found);
  };
}

}  // namespace plumb::lying
