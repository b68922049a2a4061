// Contacts: who may push whom, with which material, and what came of it. MuJoCo takes the larger friction of two and
// knows no restitution, so every contact gets the pair's own between its detection and its solution.
#include <cmath>
#include <numbers>

#include "world.hpp"

namespace plumb::mujoco {
namespace {

/// Of a damped spring that keeps the share e of the speed.
double damping_ratio_of(double e) {
  const double log = std::log(std::max(e, 1e-3));
  return -log / std::sqrt(std::numbers::pi * std::numbers::pi + log * log);
}

/// A spring that throws back within the given time, which MuJoCo takes as negative stiffness and damping.
void make_bouncy(mjContact& contact, double restitution, double time) {
  const double rate = std::numbers::pi / time;
  const mjtNum hard[mjNIMP] = {mjMAXIMP, mjMAXIMP, 0.001, 0.5, 2};
  contact.solref[0] = -rate * rate;
  contact.solref[1] = -2 * damping_ratio_of(restitution) * rate;
  std::copy(hard, hard + mjNIMP, contact.solimp);
}

/// Of critical damping: with less what should not bounce does, at 1 with e^-2 of its speed, as nothing holds it back.
constexpr double kNoRebound = 3;

constexpr int kNotSolved = 1;  ///< as MuJoCo marks contacts in a gap

}  // namespace

bool World::may_push(const Body& a, const Body& b) const {
  if (!may_touch(a.desc.filter, b.desc.filter)) return false;
  const std::pair pair = in_order(a, b);
  return !excepted_.contains(pair) && !apart_.contains(pair);
}

void World::judge_contacts(double h) {
  mjData* d = model_.data.get();
  for (mjContact& contact : std::span(d->contact, static_cast<std::size_t>(d->ncon))) {
    const Geom &one = model_.geoms[static_cast<std::size_t>(contact.geom1)],
               &two = model_.geoms[static_cast<std::size_t>(contact.geom2)];
    const Body &a = *one.body, &b = *two.body;
    const bool allowed = &a != &b && may_push(a, b);
    if (a.is_sensor() || b.is_sensor()) {
      if (allowed && contact.dist <= 0 && a.is_sensor() != b.is_sensor())
        touches_.touch_sensor(a.is_sensor() ? a.handle : b.handle, a.is_sensor() ? b.handle : a.handle);
      contact.exclude = kNotSolved;
      continue;
    }
    if (!allowed || !needs(PLUMB_NEED_COLLISION) || !(a.is(PLUMB_DYNAMIC) || b.is(PLUMB_DYNAMIC))) {
      contact.exclude = kNotSolved;
      continue;
    }
    const double friction = std::sqrt(one.material->friction * two.material->friction);
    const double restitution = std::max(one.material->restitution, two.material->restitution);
    const double rolling = std::max(a.desc.rolling_friction, b.desc.rolling_friction);
    const double spinning = std::max(a.desc.spinning_friction, b.desc.spinning_friction);
    contact.dim = rolling > 0 ? 6 : spinning > 0 ? 4 : friction > 0 ? 3 : 1;
    contact.friction[0] = contact.friction[1] = std::max(friction, mjMINMU);
    contact.friction[2] = std::max(spinning, mjMINMU);
    contact.friction[3] = contact.friction[4] = std::max(rolling, mjMINMU);
    contact.solref[0] = settings_.contact_time;
    contact.solref[1] = settings_.contact_damping;
    if (needs(PLUMB_NEED_RESTITUTION)) contact.solref[1] = std::max(contact.solref[1], kNoRebound);
    put_impedance(settings_, contact.solimp);
    if (restitution > 0) make_bouncy(contact, restitution, settings_.bounce_substeps * h);
  }
}

/// Surfaces that move are contacts of which the wanted sliding speed is not 0.
void World::drive_surfaces() {
  if (!needs(PLUMB_NEED_SURFACE_VELOCITY)) return;
  mjData* d = model_.data.get();
  const auto surface = [](const Geom& geom) {
    return rotate(geom.body->pose.orientation, geom.material->surface_velocity);
  };
  for (const mjContact& contact : std::span(d->contact, static_cast<std::size_t>(d->ncon))) {
    if (contact.efc_address < 0 || contact.dim == 1) continue;
    const PlumbVec3 slide = sub(surface(model_.geoms[static_cast<std::size_t>(contact.geom1)]),
                                surface(model_.geoms[static_cast<std::size_t>(contact.geom2)]));
    for (int k = 0; k < 2; ++k) {
      const double wanted = dot(slide, vec(contact.frame + 3 + 3 * k));
      const auto drive = [&](int row, double share) {
        d->efc_aref[contact.efc_address + row] += d->efc_KBIP[4 * (contact.efc_address + row) + 1] * share * wanted;
      };
      if (model_.model->opt.cone == mjCONE_ELLIPTIC) {
        drive(1 + k, 1);
      } else {  // edges of the pyramid: the normal and a share of a tangent, either way
        drive(2 * k, contact.friction[k]);
        drive(2 * k + 1, -contact.friction[k]);
      }
    }
  }
}

void World::gather_impulses(double h) {
  mjData* d = model_.data.get();
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& at = d->contact[i];
    if (at.efc_address < 0) continue;
    const Geom &one = model_.geoms[static_cast<std::size_t>(at.geom1)],
               &two = model_.geoms[static_cast<std::size_t>(at.geom2)];
    mjtNum force[6];
    mj_contactForce(model_.model.get(), d, i, force);
    Impulses& pair = impulses_[{at.geom1, at.geom2}];
    if (pair.sub_step < 0) pair.sub_step = sub_step_;
    PlumbContact contact{};
    contact.body_a = one.body->handle;
    contact.body_b = two.body->handle;
    contact.child_a = one.child;
    contact.child_b = two.child;
    contact.position = vec(at.pos);
    contact.normal = vec(at.frame);
    contact.depth = -at.dist;
    contact.normal_impulse = h * force[0];
    for (int k = 0; k < 3; ++k) pair.sum = add(pair.sum, scale(h * force[k], vec(at.frame + 3 * k)));
    if (pair.sub_step == sub_step_) pair.points.push_back(contact);
    if (at.dist <= 0 || force[0] > 0) touches_.touch(contact.body_a, contact.body_b);
  }
}

/// What a pair has pushed with over the step is shared out among its first points by what each pushed with at first.
void World::finish_contacts() {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  contacts_.clear();
  if (!needs(PLUMB_NEED_CONTACTS)) return;
  for (auto& [geoms, pair] : impulses_) {
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
      contacts_.push_back(point);
    }
  }
}

}  // namespace plumb::mujoco
