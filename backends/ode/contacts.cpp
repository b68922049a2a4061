// ODE's normals point into its first body; ours go from a to b, and a is the body of the lower slot.
#include "contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "plumb/assert.hpp"
namespace plumb::ode {
namespace {

/// Slower sliding than this has no direction worth following. m/s.
constexpr double least_sliding = 1e-3;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Velocity of the body's surface at a point, the belt's own motion included.
PlumbVec3 belt_velocity(const GeomTag& tag) {
  const PlumbVec3& belt = tag.surface_velocity;
  return is_zero(belt) ? belt : rotate(tag.body->orientation(), belt);
}

PlumbVec3 velocity_at(const Body& body, const PlumbVec3& point) {
  if (body.body == nullptr) return {};
  return add(body.linear_velocity(), cross(vec(dBodyGetAngularVel(body.body)), sub(point, body.centre())));
}

bool knows(const Body& body, const Body& other) {
  return std::find(body.untouchable.begin(), body.untouchable.end(), &other) != body.untouchable.end();
}

}  // namespace

/// Two geoms whose bounds overlap, in ODE's order.
struct ContactPass::Pair {
  const GeomTag& first;
  const GeomTag& second;
  bool awake;
};

bool ContactPass::shows(const Pair& pair) {
  return pair.awake && (pair.first.body->shows_contacts || pair.second.body->shows_contacts);
}

ContactPass::ContactPass(const WorldInit& init, dWorldID world)
    : world_(world),
      group_(dJointGroupCreate(0)),
      needs_{.collision = init.needs(PLUMB_NEED_COLLISION),
             .filters = init.needs(PLUMB_NEED_FILTERS),
             .sensors = init.needs(PLUMB_NEED_SENSORS),
             .sleeping = init.needs(PLUMB_NEED_SLEEPING),
             .surface_velocity = init.needs(PLUMB_NEED_SURFACE_VELOCITY),
             .modification = init.needs(PLUMB_NEED_CONTACT_MODIFICATION),
             .contacts = init.needs(PLUMB_NEED_CONTACTS),
             .impulses = init.needs(PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES),
             .events = init.needs(PLUMB_NEED_EVENTS)} {}

void ContactPass::configure(const Settings& settings) {
  mode_ = settings.friction_model == FrictionModel::pyramid ? dContactApprox1 : 0;
  if (settings.contact.erp >= 0) mode_ |= dContactSoftERP;
  if (settings.contact.cfm >= 0) mode_ |= dContactSoftCFM;
  sliding_directions_ = settings.friction_directions == FrictionDirections::sliding;
  substeps_ = settings.substeps;
  dContact blank{};
  blank.surface.soft_erp = settings.contact.erp;
  blank.surface.soft_cfm = settings.contact.cfm;
  blank.surface.bounce_vel = settings.bounce_vel;
  scratch_.assign(static_cast<std::size_t>(settings.max_contacts), blank);
}

void ContactPass::begin_step() {
  contacts_.clear();
  sources_.clear();
  substep_starts_.clear();
  held_.clear();
  held_points_.clear();
  shown_.clear();
}

void ContactPass::begin_substep() {
  PLUMB_ASSERT(held_.empty() && feedbacks_used_ == 0);
  pairs_ = points_ = 0;  // the report tells of the last sub-step
  substep_starts_.push_back(contacts_.size());
}

void ContactPass::detect(dSpaceID space) { dSpaceCollide(space, this, &ContactPass::near); }

void ContactPass::near(void* self, dGeomID first, dGeomID second) {
  static_cast<ContactPass*>(self)->meet(first, second);
}

bool ContactPass::may_meet(const GeomTag& one, const GeomTag& two) const {
  const bool sensor = one.sensor || two.sensor;
  if (sensor ? (one.sensor && two.sensor) : !one.dynamic && !two.dynamic) return false;
  if (!sensor && !needs_.collision) return false;
  if (needs_.filters && !may_touch(one.body->filter, two.body->filter)) return false;
  return !(one.choosy && two.choosy && knows(*one.body, *two.body));
}

std::vector<ContactPass::Touch> ContactPass::look(dSpaceID space) {
  struct Look {
    const ContactPass* self;
    std::vector<dContactGeom> points;
    std::vector<Touch> found;
  } look = {this, std::vector<dContactGeom>(scratch_.size()), {}};
  dSpaceCollide(space, &look, [](void* data, dGeomID first, dGeomID second) {
    auto& [self, points, found] = *static_cast<Look*>(data);
    const GeomTag &one = tag_of(first), &two = tag_of(second);
    if (one.sensor || two.sensor || !self->may_meet(one, two)) return;
    const int count = dCollide(first, second, static_cast<int>(points.size()), points.data(), sizeof(dContactGeom));
    if (count == 0) return;
    const dContactGeom& deepest =
        *std::max_element(points.begin(), points.begin() + count,
                          [](const dContactGeom& p, const dContactGeom& q) { return p.depth < q.depth; });
    found.push_back({one.body, two.body, scale(-1, vec(deepest.normal)), deepest.depth});
  });
  return std::move(look.found);
}

void ContactPass::meet(dGeomID first, dGeomID second) {
  const GeomTag &one = tag_of(first), &two = tag_of(second);
  if (!may_meet(one, two)) return;
  const bool sensor = one.sensor || two.sensor;
  ++pairs_;
  const auto sleeps = [](const GeomTag& tag) { return tag.id == nullptr || dBodyIsEnabled(tag.id) == 0; };
  const Pair pair{one, two, !needs_.sleeping || !sleeps(one) || !sleeps(two)};
  if (!sensor && !pair.awake && !needs_.contacts && !needs_.events) return;
  const int wanted = sensor ? 1 | static_cast<int>(CONTACTS_UNIMPORTANT) : static_cast<int>(scratch_.size());
  const int count = dCollide(first, second, wanted, &scratch_[0].geom, sizeof(dContact));
  if (count == 0) return;
  PLUMB_ASSERT(count > 0 && static_cast<std::size_t>(count) <= scratch_.size());
  if (sensor) {
    const PlumbBody a = one.body->handle, b = two.body->handle;
    sensed_.push_back(one.sensor ? BodyPair{a, b} : BodyPair{b, a});
  } else if (needs_.modification) {
    hold_back(pair, count);
  } else {
    respond(pair, std::span(scratch_).first(static_cast<std::size_t>(count)), nullptr);
  }
}

/// Friction sqrt(mu1 mu2), restitution max(e1, e2), unless the host wants others; rolling and spinning friction the
/// larger.
struct ContactPass::Surface {
  /// point: where they touch, for surfaces with materials by triangle.
  Surface(const Pair& pair, const dContactGeom& point, int base_mode, const PlumbManifoldChange* change)
      : mode(base_mode) {
    const Coefficients one = coefficients_at(pair.first, point), two = coefficients_at(pair.second, point);
    mu = one.friction == two.friction ? one.friction : std::sqrt(one.friction * two.friction);
    bounce = std::max(one.restitution, two.restitution);
    if (change != nullptr && (change->what & PLUMB_MANIFOLD_FRICTION) != 0) mu = change->friction;
    if (change != nullptr && (change->what & PLUMB_MANIFOLD_RESTITUTION) != 0) bounce = change->restitution;
    if (bounce > 0) mode |= dContactBounce;
    rolling = std::max(pair.first.rolling, pair.second.rolling);
    spinning = std::max(pair.first.spinning, pair.second.spinning);
    if (rolling > 0 || spinning > 0) mode |= dContactRolling | dContactAxisDep | dContactApprox1;
  }
  int mode;
  double mu, bounce, rolling, spinning;
};

bool ContactPass::has_materials(const Pair& pair) {
  const auto has = [](const GeomTag& tag) { return !tag.body->shape->materials.empty(); };
  return has(pair.first) || has(pair.second);
}

/// Of a geom where it is touched.
ContactPass::Coefficients ContactPass::coefficients_at(const GeomTag& tag, const dContactGeom& point) {
  const Shape& shape = *tag.body->shape;
  const PlumbMaterial* own = nullptr;
  if (shape.type == PLUMB_TRIANGLE_MESH) own = shape.materials.of(child_of(tag, point));
  if (shape.type == PLUMB_HEIGHT_FIELD && !shape.materials.empty()) {
    dVector3 local;
    dGeomGetPosRelPoint(tag.placed.geom, point.pos[0], point.pos[1], point.pos[2], local);
    own = shape.materials.at(local[0], local[2]);
  }
  return own == nullptr ? Coefficients{tag.friction, tag.restitution} : Coefficients{own->friction, own->restitution};
}

/// By how much the second's surface runs over the first's, which may be other than their bodies say.
PlumbVec3 ContactPass::belts_of(const Pair& pair, const PlumbManifoldChange* change) const {
  if (change == nullptr || (change->what & PLUMB_MANIFOLD_SURFACE_VELOCITY) == 0)
    return needs_.surface_velocity ? sub(belt_velocity(pair.second), belt_velocity(pair.first)) : PlumbVec3{};
  return is_swapped(pair) ? scale(-1, change->surface_velocity) : change->surface_velocity;
}

void ContactPass::respond(const Pair& pair, std::span<dContact> points, const PlumbManifoldChange* change) {
  const GeomTag &one = pair.first, &two = pair.second;
  points_ += static_cast<std::uint32_t>(points.size());
  if (needs_.events) {
    const PlumbBody a = one.body->handle, b = two.body->handle;
    touching_.push_back(slot_of(a) < slot_of(b) ? BodyPair{a, b} : BodyPair{b, a});
  }
  Surface surface(pair, points[0].geom, mode_, change);
  const bool by_triangle = has_materials(pair);
  const PlumbVec3 belts = belts_of(pair, change);
  for (dContact& contact : points) {
    dJointID joint = nullptr;
    if (by_triangle) surface = Surface(pair, contact.geom, mode_, change);
    const bool aimed = surface.mu > 0 && (sliding_directions_ || !is_zero(belts));
    if (pair.awake) {
      contact.surface.mode = surface.mode;
      contact.surface.mu = surface.mu;
      contact.surface.bounce = surface.bounce;
      contact.surface.mu2 = surface.mu;  // dContactAxisDep is of both
      contact.surface.rho = contact.surface.rho2 = surface.rolling;
      contact.surface.rhoN = surface.spinning;
      if (aimed) aim_friction(pair, contact, belts);
      joint = dJointCreateContact(world_, group_, &contact);
      dJointAttach(joint, one.id, two.id);
    }
    if (needs_.contacts) record(pair, contact.geom, joint);
  }
}

// The joint's rows ask for t.(v1 - v2) = motion of the bodies at the point; surfaces that move by s1 and s2 themselves
// stick when v1 + s1 = v2 + s2. Where ODE has swapped the bodies, because the first is static, signs and normal turn.
void ContactPass::aim_friction(const Pair& pair, dContact& contact, const PlumbVec3& belts) const {
  const bool reversed = pair.first.id == nullptr;
  const PlumbVec3 normal = scale(reversed ? -1 : 1, vec(contact.geom.normal));
  const auto tangential = [&](const PlumbVec3& v) { return sub(v, scale(dot(v, normal), normal)); };
  PlumbVec3 along = tangential(belts);
  if (sliding_directions_) {
    const PlumbVec3 point = vec(contact.geom.pos);
    const PlumbVec3 slip =
        tangential(sub(sub(velocity_at(*pair.first.body, point), velocity_at(*pair.second.body, point)), belts));
    if (length(slip) > least_sliding) along = slip;
  }
  if (length(along) <= least_sliding) return;
  const PlumbVec3 t1 = normalized(along), t2 = cross(normal, t1);
  contact.fdir1[0] = t1.x;
  contact.fdir1[1] = t1.y;
  contact.fdir1[2] = t1.z;
  contact.surface.mode |= dContactFDir1 | dContactMotion1 | dContactMotion2;
  contact.surface.motion1 = (reversed ? -1 : 1) * dot(t1, belts);
  contact.surface.motion2 = (reversed ? -1 : 1) * dot(t2, belts);
}

bool ContactPass::is_swapped(const Pair& pair) {
  return slot_of(pair.second.body->handle) < slot_of(pair.first.body->handle);
}

std::uint32_t ContactPass::child_of(const GeomTag& tag, const dContactGeom& point) {
  if (tag.body->shape->type != PLUMB_TRIANGLE_MESH) return tag.placed.child;
  const int side = point.g1 == tag.placed.geom ? point.side1 : point.side2;
  return side < 0 ? 0 : std::min(static_cast<std::uint32_t>(side), tag.body->shape->triangle_count - 1);
}

/// Without its impulses.
PlumbContact ContactPass::contact_of(const Pair& pair, const dContactGeom& point) {
  const bool swapped = is_swapped(pair);
  const GeomTag& a = swapped ? pair.second : pair.first;
  const GeomTag& b = swapped ? pair.first : pair.second;
  PlumbContact contact{};
  contact.body_a = a.body->handle;
  contact.body_b = b.body->handle;
  contact.child_a = child_of(a, point);
  contact.child_b = child_of(b, point);
  contact.position = vec(point.pos);
  contact.normal = scale(swapped ? 1 : -1, vec(point.normal));
  contact.depth = point.depth;
  contact.normal_impulse = unknown;
  contact.tangent_impulse = {unknown, unknown, unknown};
  return contact;
}

void ContactPass::record(const Pair& pair, const dContactGeom& point, dJointID joint) {
  contacts_.push_back(contact_of(pair, point));
  if (!needs_.impulses) return;
  Source source{nullptr, false};
  if (joint != nullptr) {
    if (feedbacks_used_ == feedbacks_.size()) feedbacks_.emplace_back();
    dJointFeedback& feedback = feedbacks_[feedbacks_used_++];
    feedback = {};
    dJointSetFeedback(joint, &feedback);
    // A body that is not there is never ODE's first.
    const dBodyID ode_first = pair.first.id != nullptr ? pair.first.id : pair.second.id;
    source = {&feedback, ode_first == (is_swapped(pair) ? pair.first : pair.second).id};
  }
  sources_.push_back(source);
  PLUMB_ASSERT(sources_.size() == contacts_.size());
}

void ContactPass::end_substep(double h) {
  // A world that did not declare collision never detects.
  PLUMB_ASSERT(held_.empty());
  const std::size_t first = substep_starts_.empty() ? sources_.size() : substep_starts_.back();
  for (std::size_t i = first; i < sources_.size(); ++i) {
    const Source& source = sources_[i];
    if (source.feedback == nullptr) continue;
    PlumbContact& contact = contacts_[i];
    const PlumbVec3 impulse = scale(source.b_is_first ? h : -h, vec(source.feedback->f1));
    contact.normal_impulse = dot(impulse, contact.normal);
    contact.tangent_impulse = sub(impulse, scale(contact.normal_impulse, contact.normal));
  }
  feedbacks_used_ = 0;
  dJointGroupEmpty(group_);
}

void ContactPass::hold_back(const Pair& pair, int count) {
  const std::span<dContact> points = std::span(scratch_).first(static_cast<std::size_t>(count));
  const bool shown = shows(pair);
  held_.push_back({&pair.first, &pair.second, pair.awake, held_points_.size(), points.size(), shown, shown_.size()});
  held_points_.insert(held_points_.end(), points.begin(), points.end());
  if (shown) shown_.push_back(show(pair, points));
}

/// Of more points than a manifold has room for the deepest.
PlumbManifold ContactPass::show(const Pair& pair, std::span<const dContact> points) const {
  std::vector<dContactGeom> deepest;
  for (const dContact& point : points) deepest.push_back(point.geom);
  std::stable_sort(deepest.begin(), deepest.end(),
                   [](const dContactGeom& p, const dContactGeom& q) { return p.depth > q.depth; });
  deepest.resize(std::min<std::size_t>(deepest.size(), PLUMB_MANIFOLD_POINTS));
  const bool swapped = is_swapped(pair);
  const PlumbContact first = contact_of(pair, deepest[0]);
  PlumbManifold row{};
  row.body_a = first.body_a;
  row.body_b = first.body_b;
  row.child_a = first.child_a;
  row.child_b = first.child_b;
  row.point_count = static_cast<std::uint32_t>(deepest.size());
  row.normal = first.normal;
  PlumbVec3 middle{};
  for (std::size_t i = 0; i < deepest.size(); ++i) {
    row.position[i] = vec(deepest[i].pos);
    row.depth[i] = deepest[i].depth;
    middle = add(middle, scale(1.0 / static_cast<double>(deepest.size()), row.position[i]));
  }
  const PlumbVec3 of_first = velocity_at(*pair.first.body, middle), of_second = velocity_at(*pair.second.body, middle);
  row.velocity = swapped ? sub(of_first, of_second) : sub(of_second, of_first);
  const Surface surface(pair, deepest[0], mode_, nullptr);
  row.friction = surface.mu;
  row.restitution = surface.bounce;
  row.surface_velocity = scale(swapped ? -1 : 1, belts_of(pair, nullptr));
  return row;
}

void ContactPass::respond(std::span<const PlumbManifoldChange> changes) {
  std::vector<const PlumbManifoldChange*> of_shown(shown_.size(), nullptr);
  for (const PlumbManifoldChange& change : changes) {
    PLUMB_ASSERT(change.manifold < shown_.size());
    of_shown[change.manifold] = &change;
  }
  for (const Held& held : held_) {
    const PlumbManifoldChange* change = held.is_shown ? of_shown[held.shown] : nullptr;
    if (change != nullptr && (change->what & PLUMB_MANIFOLD_DISABLED) != 0) continue;
    respond({*held.first, *held.second, held.awake},
            std::span(held_points_).subspan(held.first_point, held.point_count), change);
  }
  held_.clear();
  held_points_.clear();
  shown_.clear();
}

// The k-th point of a pair of geoms in one sub-step is taken for the k-th in the next: geometry of the last, impulses
// of all. A point that the last sub-steps no longer had stays, so that no impulse is lost.
void ContactPass::merge_substeps() {
  struct Entry {
    std::size_t index;
    std::uint32_t nth;
  };
  const auto key = [&](std::size_t i) {
    const PlumbContact& c = contacts_[i];
    return std::tuple(slot_of(c.body_a), slot_of(c.body_b), c.child_a, c.child_b);
  };
  std::vector<Entry> entries;
  entries.reserve(contacts_.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    // A pair's points of one sub-step follow each other.
    const bool starts = std::binary_search(substep_starts_.begin(), substep_starts_.end(), i);
    entries.push_back({i, !starts && i != 0 && key(i) == key(i - 1) ? entries.back().nth + 1 : 0});
  }
  std::stable_sort(entries.begin(), entries.end(), [&](const Entry& x, const Entry& y) {
    return std::tuple(key(x.index), x.nth) < std::tuple(key(y.index), y.nth);
  });
  PLUMB_ASSERT(std::is_sorted(substep_starts_.begin(), substep_starts_.end()));
  std::vector<PlumbContact> merged;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    PlumbContact contact = contacts_[entries[i].index];
    const bool again =
        i != 0 && entries[i].nth == entries[i - 1].nth && key(entries[i].index) == key(entries[i - 1].index);
    if (again) {
      contact.normal_impulse += merged.back().normal_impulse;
      contact.tangent_impulse = add(contact.tangent_impulse, merged.back().tangent_impulse);
      merged.back() = contact;
    } else {
      merged.push_back(contact);
    }
  }
  contacts_.swap(merged);
}

void ContactPass::end_step(PairEvents& events) {
  if (substeps_ > 1 && needs_.contacts) merge_substeps();
  if (needs_.events) events.touching(touching_);
  if (needs_.sensors) events.sensed(sensed_);
}

}  // namespace plumb::ode
