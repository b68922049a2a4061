#include "plumb/helpers/contact_events.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common.hpp"

namespace plumb::helpers {
namespace {

constexpr double kNotTold = std::numeric_limits<double>::quiet_NaN();

bool is_lower(PlumbBody a, PlumbBody b) { return slot_of(a) < slot_of(b); }

/// Of an event, a contact or a pair: sorts by the lower slot, then by the higher.
template <class Of>
std::pair<std::uint32_t, std::uint32_t> slots(const Of& of) {
  return {slot_of(of.body_a), slot_of(of.body_b)};
}
constexpr auto by_slots = [](const auto& a, const auto& b) { return slots(a) < slots(b); };

void put_lower_first(PlumbContact& point) {
  if (!is_lower(point.body_b, point.body_a)) return;
  std::swap(point.body_a, point.body_b);
  std::swap(point.child_a, point.child_b);
  point.normal = scale(-1, point.normal);
}

/// By what a point's share of the pair's position and normal is: what it bears, where the engine tells that.
double borne(const PlumbContact& point) {
  return std::isnan(point.normal_impulse) ? 0 : std::max(point.normal_impulse, 0.0);
}

}  // namespace

ContactEvents::ContactEvents(IPhysicsWorld& world, const ContactEventSettings& settings)
    : world_(world), settings_(settings) {
  require(std::isfinite(settings.min_speed) && settings.min_speed >= 0,
          "contact events: min_speed is " + std::to_string(settings.min_speed) + " m/s: give 0 or more");
  require(std::isfinite(settings.min_impulse) && settings.min_impulse >= 0,
          "contact events: min_impulse is " + std::to_string(settings.min_impulse) + " N s: give 0 or more");
}

void ContactEvents::watch(std::span<const PlumbBody> bodies) {
  watched_.assign(bodies.begin(), bodies.end());
  std::sort(watched_.begin(), watched_.end());
}

bool ContactEvents::is_watched(PlumbBody a, PlumbBody b) const {
  const auto is_one = [&](PlumbBody body) { return std::binary_search(watched_.begin(), watched_.end(), body); };
  return watched_.empty() || is_one(a) || is_one(b);
}

void ContactEvents::before_step() {
  const std::span<const PlumbBody> all = world_.bodies();
  bodies_.assign(all.begin(), all.end());
  poses_.resize(bodies_.size());
  velocities_.resize(6 * bodies_.size());
  read_rows(world_, PLUMB_FIELD_POSE, bodies_, std::span(poses_));
  const Rows rows(reinterpret_cast<std::byte*>(velocities_.data()), bodies_.size(), 6 * sizeof(double), PLUMB_F64);
  if (!bodies_.empty()) check(world_, world_.read(PLUMB_FIELD_VELOCITY, bodies_, rows));
  std::uint32_t slots = 0;
  for (const PlumbBody body : bodies_) slots = std::max(slots, slot_of(body) + 1);
  states_.resize(slots);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const double* v = &velocities_[6 * i];
    states_[slot_of(bodies_[i])] = {bodies_[i], poses_[i], {}, {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}, {}};
  }
}

void ContactEvents::after_step() {
  began_.clear();
  hits_.clear();
  sort_events();
  sort_contacts();
  read_touching();
  std::vector<PairContact> began, hits, striking;
  auto begin = begins_.begin();
  const auto tell_unlisted = [&](const auto& is_before) {
    for (; begin != begins_.end() && is_before(slots(*begin)); ++begin) {
      PairContact pair{
          begin->body_a, begin->body_b, 0, 0, {kNotTold, kNotTold, kNotTold}, {kNotTold, kNotTold, kNotTold}};
      began.push_back(pair);
    }
  };
  for (auto first = points_.begin(); first != points_.end();) {
    const auto pair_slots = slots(*first);
    const auto last = std::find_if(first, points_.end(), [&](const PlumbContact& p) { return slots(p) != pair_slots; });
    const std::span<const PlumbContact> points(first, last);
    first = last;
    tell_unlisted([&](const auto& of) { return of < pair_slots; });
    const PairContact pair = sum_up(points);
    const bool begins = begin != begins_.end() && slots(*begin) == pair_slots;
    if (begins) {
      began.push_back(pair);
      ++begin;
    }
    if (!strikes(pair, points)) continue;
    striking.push_back(pair);
    if (!goes_on(pair)) hits.push_back(pair);
  }
  tell_unlisted([](const auto&) { return true; });
  began_ = std::move(began);
  hits_ = std::move(hits);
  striking_ = std::move(striking);
}

/// Of the step: what began, by slots, and what ended.
void ContactEvents::sort_events() {
  begins_.clear();
  ended_.clear();
  for (PlumbEvent event : world_.events()) {
    if (event.type != PLUMB_EVENT_CONTACT_BEGIN && event.type != PLUMB_EVENT_CONTACT_END) continue;
    if (!is_watched(event.body_a, event.body_b)) continue;
    if (is_lower(event.body_b, event.body_a)) std::swap(event.body_a, event.body_b);
    (event.type == PLUMB_EVENT_CONTACT_BEGIN ? begins_ : ended_).push_back(event);
  }
  std::sort(begins_.begin(), begins_.end(), by_slots);
}

void ContactEvents::sort_contacts() {
  points_.clear();
  for (PlumbContact point : world_.contacts()) {
    if (!is_watched(point.body_a, point.body_b)) continue;
    put_lower_first(point);
    points_.push_back(point);
  }
  std::stable_sort(points_.begin(), points_.end(), by_slots);
}

/// Of bodies in contact. What the host moves has no mass, and its speed is that of the step: where it is to be may have
/// been set after its last speed was known.
void ContactEvents::read_touching() {
  std::vector<PlumbBody> touching;
  for (const PlumbContact& point : points_) {
    touching.push_back(point.body_a);
    touching.push_back(point.body_b);
  }
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  std::vector<MassRow> masses(touching.size());
  std::vector<Motion> after(touching.size());
  read_rows(world_, PLUMB_FIELD_MASS, touching, std::span(masses));
  read_rows(world_, PLUMB_FIELD_VELOCITY, touching, std::span(after));
  for (std::size_t i = 0; i < touching.size(); ++i) {
    const std::uint32_t slot = slot_of(touching[i]);
    require(slot < states_.size() && states_[slot].body == touching[i],
            "contact events: a body in contact was not there at before_step(): call it right before the step");
    BodyState& state = states_[slot];
    state.centre = centre_of_mass(state.pose, masses[i]);
    state.after = after[i];
    if (!(masses[i].mass > 0)) state.before = state.after;
  }
}

double ContactEvents::closing_speed(const PlumbContact& point, Motion BodyState::*when) const {
  const auto velocity = [&](PlumbBody body) {
    const BodyState& state = states_[slot_of(body)];
    return add((state.*when).linear, cross((state.*when).angular, sub(point.position, state.centre)));
  };
  return dot(sub(velocity(point.body_a), velocity(point.body_b)), point.normal);
}

PairContact ContactEvents::sum_up(std::span<const PlumbContact> points) const {
  double sum = 0;
  for (const PlumbContact& point : points) sum += borne(point);
  const auto most = std::max_element(points.begin(), points.end(), [&](const PlumbContact& a, const PlumbContact& b) {
    return sum > 0 ? borne(a) < borne(b) : a.depth < b.depth;
  });
  PairContact pair{most->body_a, most->body_b, most->child_a, most->child_b};
  bool is_told = true;
  for (const PlumbContact& point : points) {
    const double share = sum > 0 ? borne(point) / sum : 1 / static_cast<double>(points.size());
    pair.position = add(pair.position, scale(share, point.position));
    pair.normal = add(pair.normal, scale(share, point.normal));
    pair.closing_speed = std::max(pair.closing_speed, closing_speed(point, &BodyState::before));
    is_told = is_told && !std::isnan(point.normal_impulse);
  }
  pair.normal = direction(pair.normal, most->normal);
  if (is_told) pair.impulse = sum;
  return pair;
}

/// Points are listed before they touch. Those that bear something do; where that is not told, those that no longer
/// close as they did.
bool ContactEvents::strikes(const PairContact& pair, std::span<const PlumbContact> points) const {
  if (pair.closing_speed < settings_.min_speed) return false;
  if (!std::isnan(pair.impulse)) return pair.impulse > 0 && pair.impulse >= settings_.min_impulse;
  return settings_.min_impulse == 0 && std::all_of(points.begin(), points.end(), [&](const PlumbContact& point) {
           return closing_speed(point, &BodyState::after) <= pair.closing_speed / 2;
         });
}

/// It is the blow of the step before, which has slowed the two.
bool ContactEvents::goes_on(const PairContact& pair) const {
  if (settings_.min_speed == 0) return false;
  const auto last = std::lower_bound(striking_.begin(), striking_.end(), pair, by_slots);
  return last != striking_.end() && last->body_a == pair.body_a && last->body_b == pair.body_b &&
         pair.closing_speed < last->closing_speed;
}

}  // namespace plumb::helpers
