#include "collisions.hpp"

#include <ode/ode.h>

#include <array>
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/collision/ode/OdeCollisionGroup.hpp>
#include <dart/collision/ode/OdeCollisionObject.hpp>
#include <span>

#include "making.hpp"

namespace plumb::dart6 {

using ::dart::collision::Contact;
using ::dart::collision::OdeCollisionObject;

/// DART does not let others ask its space of ODE.
class Collisions::Group final : public ::dart::collision::OdeCollisionGroup {
 public:
  using OdeCollisionGroup::getOdeSpaceId;
  using OdeCollisionGroup::OdeCollisionGroup;
  using OdeCollisionGroup::updateEngineData;
};

namespace {

using Detector = std::shared_ptr<::dart::collision::CollisionDetector>;

Detector make_detector() {
  const std::lock_guard lock(making());
  return ::dart::collision::OdeCollisionDetector::create();
}

void unmake_detector(Detector& detector) {
  const std::lock_guard lock(making());
  detector.reset();
}

/// ODE has memory of its own for each thread that collides, and a detector takes it where it is made.
void prepare_this_thread() {
  struct Ours {
    Detector detector = make_detector();
    ~Ours() { unmake_detector(detector); }
  };
  thread_local const Ours ours;
}

OdeCollisionObject& object_of(dGeomID geom) { return *static_cast<OdeCollisionObject*>(dGeomGetData(geom)); }

/// One ray on its way through a space.
struct Search {
  const Skeletons& skeletons;
  dGeomID ray;
  PlumbVec3 along;
  std::vector<RayMeeting> found;

  static void near(void* self, dGeomID one, dGeomID two) {
    Search& search = *static_cast<Search*>(self);
    search.meet(one == search.ray ? two : one);
  }

  /// ODE's meshes and shapes disagree about the sign of normals; the surface that is met looks at the ray.
  void meet(dGeomID other) {
    const Geom& geom = skeletons.geom(object_of(other));
    std::array<dContactGeom, 16> points;  // a mesh or field is met several times
    const int count = dCollide(ray, other, static_cast<int>(points.size()), points.data(), sizeof(dContactGeom));
    for (int i = 0; i < count; ++i) {
      const dContactGeom& point = points[static_cast<std::size_t>(i)];
      PlumbVec3 normal{point.normal[0], point.normal[1], point.normal[2]};
      if (dot(normal, along) > 0) normal = scale(-1, normal);
      const int side = point.g1 == other ? point.side1 : point.side2;
      found.push_back({&geom,
                       point.depth,
                       {point.pos[0], point.pos[1], point.pos[2]},
                       normal,
                       side < 0 ? 0 : static_cast<std::uint32_t>(side)});
    }
  }
};

struct GeomFree {
  void operator()(dxGeom* geom) const { dGeomDestroy(geom); }
};

}  // namespace

Collisions::Collisions() : detector_(make_detector()) {}

Collisions::~Collisions() {
  forget();
  unmake_detector(detector_);
}

void Collisions::forget() {
  found_.clear();
  group_.reset();
}

void Collisions::take(const Skeletons& skeletons, May may) {
  skeletons_ = &skeletons;
  may_ = std::move(may);
  group_ = std::make_unique<Group>(detector_);
  group_->setAutomaticUpdate(false);
  for (const auto& skeleton : skeletons.all) group_->addShapeFramesOf(skeleton.get());
}

void Collisions::meet(dxGeom* one, dxGeom* two) {
  OdeCollisionObject &a = object_of(one), &b = object_of(two);
  if (!may_(skeletons_->geom(a), skeletons_->geom(b))) return;
  std::array<dContactGeom, MAX_COLLIDE_RETURNS> points;
  const int count = dCollide(one, two, MAX_COLLIDE_RETURNS, points.data(), sizeof(dContactGeom));
  for (const dContactGeom& point : std::span(points).first(static_cast<std::size_t>(count))) {
    const Eigen::Vector3d normal(point.normal[0], point.normal[1], point.normal[2]);
    if (Contact::isZeroNormal(normal) || !(point.depth >= 0)) continue;
    Contact& contact = found_.emplace_back();
    contact.collisionObject1 = &a;
    contact.collisionObject2 = &b;
    contact.point = {point.pos[0], point.pos[1], point.pos[2]};
    contact.normal = normal;
    contact.penetrationDepth = point.depth;
  }
}

std::vector<Contact*> Collisions::find() {
  std::vector<Contact*> found;
  found_.clear();
  if (!group_) return found;
  prepare_this_thread();
  group_->updateEngineData();
  dSpaceCollide(group_->getOdeSpaceId(), this,
                [](void* self, dGeomID one, dGeomID two) { static_cast<Collisions*>(self)->meet(one, two); });
  for (Contact& contact : found_) found.push_back(&contact);
  return found;
}

std::vector<RayMeeting> Collisions::meet_ray(const Skeletons& skeletons, const PlumbVec3& from, const PlumbVec3& along,
                                             double length) {
  if (!group_) return {};
  prepare_this_thread();
  group_->updateEngineData();
  const std::unique_ptr<dxGeom, GeomFree> ray(dCreateRay(nullptr, length));
  dGeomRaySet(ray.get(), from.x, from.y, from.z, along.x, along.y, along.z);
  Search search{skeletons, ray.get(), along, {}};
  dSpaceCollide2(ray.get(), reinterpret_cast<dGeomID>(group_->getOdeSpaceId()), &search, &Search::near);
  return std::move(search.found);
}

}  // namespace plumb::dart6
