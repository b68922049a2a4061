// What comes out of a step: contact points with their impulses, and who touches whom.
#include "contacts.hpp"

#include <algorithm>

#include "plumb/assert.hpp"
#include "world.hpp"

namespace plumb::bullet {
namespace {

/// Child of a compound or triangle of a mesh, out of what Bullet notes at a point.
std::uint32_t child_index(const Body& body, int index) {
  if (!body.shape || index < 0) return 0;
  const bool indexed = body.shape->type == PLUMB_COMPOUND || body.shape->type == PLUMB_TRIANGLE_MESH;
  return indexed ? static_cast<std::uint32_t>(index) : 0;
}

/// Bullet keeps points across a small gap; they touch when they overlap or push.
bool touches(const btPersistentManifold& manifold) {
  for (int k = 0; k < manifold.getNumContacts(); ++k) {
    const btManifoldPoint& point = manifold.getContactPoint(k);
    if (point.m_distance1 <= 0 || point.m_appliedImpulse > 0) return true;
  }
  return false;
}

}  // namespace

PlumbContact contact_of(const btManifoldPoint& point, const Body& a, const Body& b, bool with_impulses) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  PlumbContact contact{};
  contact.body_a = a.handle;
  contact.body_b = b.handle;
  contact.child_a = child_index(a, point.m_index0);
  contact.child_b = child_index(b, point.m_index1);
  contact.position = to_plumb((point.m_positionWorldOnA + point.m_positionWorldOnB) / 2);
  contact.normal = to_plumb(-point.m_normalWorldOnB);
  contact.depth = -static_cast<double>(point.m_distance1);
  contact.normal_impulse = unknown;
  contact.tangent_impulse = {unknown, unknown, unknown};
  if (with_impulses) {
    contact.normal_impulse = static_cast<double>(point.m_appliedImpulse);
    contact.tangent_impulse = to_plumb(-(point.m_lateralFrictionDir1 * point.m_appliedImpulseLateral1 +
                                         point.m_lateralFrictionDir2 * point.m_appliedImpulseLateral2));
  }
  contact.feature = reinterpret_cast<std::uintptr_t>(point.m_userPersistentData);
  return contact;
}

bool World::is_solved(const btPersistentManifold& manifold) const {
  const Body &a = *our_body(manifold.getBody0()), &b = *our_body(manifold.getBody1());
  PLUMB_ASSERT(&a != &b && slot_of(a.handle) != slot_of(b.handle));
  if (a.is_sensor() || b.is_sensor()) return false;
  return (a.is(PLUMB_DYNAMIC) && a.isActive()) || (b.is(PLUMB_DYNAMIC) && b.isActive());
}

/// Points get a number of their own in Bullet's user data, which lives as long as the point persists.
void World::gather_contacts() {
  contacts_.rows.clear();
  btDispatcher& dispatcher = parts_.dispatcher;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (manifold.getNumContacts() == 0 || !is_solved(manifold)) continue;
    const Body &a = *our_body(manifold.getBody0()), &b = *our_body(manifold.getBody1());
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      btManifoldPoint& point = manifold.getContactPoint(k);
      if (point.m_userPersistentData == nullptr)
        point.m_userPersistentData = reinterpret_cast<void*>(++contacts_.last_point_id);
      contacts_.rows.push_back(contact_of(point, a, b, needs(PLUMB_NEED_CONTACT_IMPULSES)));
    }
  }
}

/// Adds the impulses of the sub-steps before to the points of the last one; what did not live that long stands by
/// itself.
void World::add_sub_step_impulses() {
  const auto by_feature = [](const PlumbContact& a, const PlumbContact& b) { return a.feature < b.feature; };
  std::stable_sort(contacts_.of_sub_steps.begin(), contacts_.of_sub_steps.end(), by_feature);
  std::sort(contacts_.rows.begin(), contacts_.rows.end(), by_feature);
  const std::size_t last = contacts_.rows.size();
  for (const PlumbContact& earlier : contacts_.of_sub_steps) {
    const auto found = std::lower_bound(
        contacts_.rows.begin(), contacts_.rows.begin() + static_cast<std::ptrdiff_t>(last), earlier, by_feature);
    const bool lives =
        found != contacts_.rows.begin() + static_cast<std::ptrdiff_t>(last) && found->feature == earlier.feature;
    PLUMB_ASSERT(earlier.feature != 0);
    PlumbContact* sum = lives ? &*found
                        : contacts_.rows.size() > last && contacts_.rows.back().feature == earlier.feature
                            ? &contacts_.rows.back()
                            : nullptr;
    if (sum == nullptr) {
      contacts_.rows.push_back(earlier);
      continue;
    }
    sum->normal_impulse += earlier.normal_impulse;
    sum->tangent_impulse.x += earlier.tangent_impulse.x;
    sum->tangent_impulse.y += earlier.tangent_impulse.y;
    sum->tangent_impulse.z += earlier.tangent_impulse.z;
  }
}

std::span<const PlumbContact> World::contacts() {
  if (!contacts_.fresh) {
    gather_contacts();
    if (!contacts_.of_sub_steps.empty()) add_sub_step_impulses();
    contacts_.fresh = true;
  }
  return contacts_.rows;
}

void World::track_touches() {
  btDispatcher& dispatcher = parts_.dispatcher;
  const bool contacts = needs(PLUMB_NEED_EVENTS), sensors = needs(PLUMB_NEED_SENSORS);
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (!touches(manifold)) continue;
    const Body &a = *our_body(manifold.getBody0()), &b = *our_body(manifold.getBody1());
    if (a.is_sensor() || b.is_sensor()) {
      if (sensors)
        events_.touches.touch_sensor(a.is_sensor() ? a.handle : b.handle, a.is_sensor() ? b.handle : a.handle);
    } else if (contacts) {
      events_.touches.touch(a.handle, b.handle);
    }
  }
  events_.touches.finish_step(events_.rows);
}

}  // namespace plumb::bullet
