// Contacts: who may push whom, with which material, and what came of it.
#include <cmath>

#include "few_points.hpp"
#include "world.hpp"

namespace plumb::dart6 {

/// DART tells the points of a pair one after the other.
std::vector<::dart::collision::Contact*> World::meeting_points() {
  const std::vector<::dart::collision::Contact*> found = collisions_.find();
  std::vector<::dart::collision::Contact*> kept;
  for (auto from = found.begin(); from != found.end();) {
    const ::dart::collision::Contact& first = **from;
    const auto to = std::find_if(from, found.end(), [&](const ::dart::collision::Contact* other) {
      return other->collisionObject1 != first.collisionObject1 || other->collisionObject2 != first.collisionObject2;
    });
    const std::vector<::dart::collision::Contact*> few = few_points({from, to});
    kept.insert(kept.end(), few.begin(), few.end());
    from = to;
  }
  return kept;
}

bool World::may_meet(const Geom& one, const Geom& two) const {
  const Body &a = *one.body, &b = *two.body;
  if (&a == &b || !may_touch(a.desc.filter, b.desc.filter)) return false;
  const std::pair pair = in_order(a, b);
  if (excepted_.contains(pair) || apart_.contains(pair)) return false;
  if (a.is_sensor() || b.is_sensor())
    return a.is_sensor() != b.is_sensor() && !(a.is(PLUMB_STATIC) && b.is(PLUMB_STATIC));
  return needs(PLUMB_NEED_COLLISION) && (a.is(PLUMB_DYNAMIC) || b.is(PLUMB_DYNAMIC));
}

PairMaterial World::material_of(const Geom& a, const Geom& b) const {
  const auto surface = [](const Geom& geom) -> Eigen::Vector3d {
    return geom.body->node->getWorldTransform().linear() * eigen(geom.material->surface_velocity);
  };
  return {std::sqrt(a.material->friction * b.material->friction),
          std::max(a.material->restitution, b.material->restitution), surface(a) - surface(b)};
}

void World::find_contacts(double h, std::vector<::dart::constraint::ConstraintBasePtr>& constraints) {
  meeting_.touching.clear();
  for (::dart::collision::Contact* contact : meeting_points()) {
    const Geom &a = skeletons_.geom(*contact->collisionObject1), &b = skeletons_.geom(*contact->collisionObject2);
    if (a.body->is_sensor() || b.body->is_sensor()) {
      const auto [sensor, other] = a.body->is_sensor() ? std::pair(a.body, b.body) : std::pair(b.body, a.body);
      touches_.touch_sensor(sensor->handle, other->handle);
      continue;
    }
    meeting_.touching.push_back({contact, std::make_shared<PairContact>(*contact, material_of(a, b), settings_, h)});
    constraints.push_back(meeting_.touching.back().constraint);
  }
}

/// Which of two geoms DART names first may differ from one sub-step to the next; here it is always the one made first.
void World::gather_impulses(double h) {
  if (!needs(PLUMB_NEED_CONTACTS | PLUMB_NEED_EVENTS)) return;
  for (const Touch& touch : meeting_.touching) {
    const auto place = [&](const ::dart::collision::CollisionObject* object) {
      return skeletons_.geom_of.at(object->getShapeFrame());
    };
    std::size_t first = place(touch.contact->collisionObject1), second = place(touch.contact->collisionObject2);
    double sign = -1;
    if (first > second) {
      std::swap(first, second);
      sign = 1;
    }
    const Geom &a = skeletons_.geoms[first], &b = skeletons_.geoms[second];
    const PlumbVec3 impulse = scale(sign * h, vec(touch.contact->force));  // on b
    Impulses& pair = meeting_.impulses[{first, second}];
    if (pair.sub_step < 0) pair.sub_step = sub_step_;
    PlumbContact contact{};
    contact.body_a = a.body->handle;
    contact.body_b = b.body->handle;
    contact.child_a = a.child;
    contact.child_b = b.child;
    contact.position = vec(touch.contact->point);
    contact.normal = scale(sign, vec(touch.contact->normal));
    contact.depth = touch.contact->penetrationDepth;
    contact.normal_impulse = dot(impulse, contact.normal);
    pair.sum = add(pair.sum, impulse);
    if (pair.sub_step == sub_step_) pair.points.push_back(contact);
    touches_.touch(contact.body_a, contact.body_b);
  }
}

/// What a pair has pushed with over the step is shared out among its first points by what each pushed with at first.
void World::finish_contacts() {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  meeting_.rows.clear();
  if (!needs(PLUMB_NEED_CONTACTS)) return;
  for (auto& [geoms, pair] : meeting_.impulses) {
    double all = 0;
    for (const PlumbContact& point : pair.points) all += point.normal_impulse;
    for (PlumbContact point : pair.points) {
      const double share = all > 0 ? point.normal_impulse / all : 1.0 / static_cast<double>(pair.points.size());
      const double along = dot(pair.sum, point.normal);
      point.normal_impulse = share * along;
      point.tangent_impulse = scale(share, sub(pair.sum, scale(along, point.normal)));
      if (!needs(PLUMB_NEED_CONTACT_IMPULSES)) {
        point.normal_impulse = unknown;
        point.tangent_impulse = {unknown, unknown, unknown};
      }
      meeting_.rows.push_back(point);
    }
  }
}

}  // namespace plumb::dart6
