// Pairs are kept sorted, so that the events of a step are the difference of two lists.
#include "events.hpp"

#include <algorithm>
#include <tuple>

#include "plumb/assert.hpp"
namespace plumb::ode {

bool before(const BodyPair& x, const BodyPair& y) {
  const auto key = [](const BodyPair& p) {
    return std::tuple(slot_of(p.a), slot_of(p.b), generation_of(p.a), generation_of(p.b));
  };
  return key(x) < key(y);
}

void PairEvents::compare(std::vector<BodyPair>& known, std::vector<BodyPair>& now, PlumbEventType begin,
                         PlumbEventType end) {
  std::sort(now.begin(), now.end(), before);
  now.erase(std::unique(now.begin(), now.end()), now.end());
  PLUMB_ASSERT(std::is_sorted(known.begin(), known.end(), before));
  auto old = known.cbegin();
  for (const BodyPair& pair : now) {
    for (; old != known.cend() && before(*old, pair); ++old) events_.push_back({end, 0, old->a, old->b, 0});
    if (old != known.cend() && *old == pair) {
      ++old;
    } else {
      events_.push_back({begin, 0, pair.a, pair.b, 0});
    }
  }
  for (; old != known.cend(); ++old) events_.push_back({end, 0, old->a, old->b, 0});
  known.swap(now);
  now.clear();
}

void PairEvents::end_step() {
  std::stable_sort(events_.begin(), events_.end(), [](const PlumbEvent& x, const PlumbEvent& y) {
    const auto key = [](const PlumbEvent& e) {
      return std::tuple(e.type, slot_of(e.body_a), slot_of(e.body_b), slot_of(e.joint));
    };
    return key(x) < key(y);
  });
}

}  // namespace plumb::ode
