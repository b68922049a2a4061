// Bodies that see whom they overlap and push nobody: the step does not know of them, and afterwards they ask like any
// query.
#include "plugin/world.hpp"

namespace plumb::impulse {

void World::sense() {
  simulation_.bodies.state.fetch(sensors_.all(), kPosePart);
  std::vector<PlumbOverlap> looks;
  std::vector<std::uint32_t> who;
  const auto look = [&](std::uint32_t slot, std::uint32_t row) {
    const Proxy& proxy = simulation_.colliders.proxies[row];
    const Quat& turn = simulation_.bodies.state.orientation[slot];
    const Position at = moved(simulation_.bodies.state.position[slot], rotate(turn, proxy.frame.position));
    const QuatD q = to_double(turn * proxy.frame.orientation);
    looks.push_back({proxy.shape, {{at.x, at.y, at.z}, {q.x, q.y, q.z, q.w}}, bodies_[slot].filter});
    who.push_back(slot);
  };
  for (const std::uint32_t slot : sensors_) {
    const BodyRecord& body = bodies_[slot];
    if (body.proxy != kNone) look(slot, body.proxy);
    for (const std::uint32_t row : body.more_proxies) look(slot, row);
  }
  for (const PlumbHit& hit : overlap_shapes(looks).hits) {
    if (simulation_.exclusions.excepts(who[hit.query], slot_of(hit.body))) continue;
    const BodyRecord& sensor = bodies_[who[hit.query]];
    const bool moves = sensor.motion != PLUMB_STATIC || bodies_[slot_of(hit.body)].motion != PLUMB_STATIC;
    if (moves) told_.touches.touch_sensor(sensor.id, hit.body);
  }
}

}  // namespace plumb::impulse
