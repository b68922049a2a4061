// Lies about casts that turn.
#include <cmath>

#include "honest.hpp"

namespace plumb::lying {
namespace {

/// The casts are changed before they are asked, and each hit after, with its cast as it was asked.
template <auto change_cast, auto change_hit>
void change_turning() {
  liar.queries.turning_casts = [](PlumbWorld* world, PlumbHitMode mode, const PlumbTurningCast* casts,
                                  std::size_t stride, std::uint32_t count, PlumbHit* hits, std::uint32_t capacity,
                                  std::uint32_t* found) {
    const std::vector<PlumbTurningCast> asked = copied(casts, stride, count);
    std::vector<PlumbTurningCast> changed = asked;
    for (PlumbTurningCast& cast : changed) change_cast(cast);
    const PlumbResult result = honest.queries.turning_casts(world, mode, changed.data(), sizeof(PlumbTurningCast),
                                                            count, hits, capacity, found);
    for (std::uint32_t i = 0; result >= 0 && i < std::min(capacity, *found); ++i)
      change_hit(hits[i], asked[hits[i].query]);
    return result;
  };
}
constexpr auto kSame = [](auto&&...) {};

}  // namespace

void rods_meet_a_percent_early() {
  change_turning<kSame, [](PlumbHit& hit, const PlumbTurningCast&) { hit.fraction *= 0.99; }>();
}
void boards_meet_floors_elsewhere() {
  change_turning<kSame, [](PlumbHit& hit, const PlumbTurningCast&) { hit.position.x += 0.1; }>();
}
void shapes_turn_the_other_way() {
  change_turning<[](PlumbTurningCast& cast) {
    cast.rotation = {-cast.rotation.x, -cast.rotation.y, -cast.rotation.z};
  },
                 kSame>();
}
void what_turns_is_late() {
  change_turning<kSame, [](PlumbHit& hit, const PlumbTurningCast& cast) {
    if (cast.rotation.x != 0) hit.fraction = std::min(1.0, 1.05 * hit.fraction);
  }>();
}
void turning_casts_see_all() {
  change_turning<[](PlumbTurningCast& cast) { cast.filter = {~0U, ~0U, 0, 0}; }, kSame>();
}
void more_than_a_turn_is_one() {
  change_turning<[](PlumbTurningCast& cast) {
    const double angle = std::hypot(cast.rotation.x, cast.rotation.y, cast.rotation.z);
    if (6.2 < angle) cast.rotation = {0, 6.2, 0};
  },
                 kSame>();
}

}  // namespace plumb::lying
