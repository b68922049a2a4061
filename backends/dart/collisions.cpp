#include "collisions.hpp"

#include <ode/ode.h>

#include <array>
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/collision/ode/OdeCollisionGroup.hpp>
#include <dart/collision/ode/OdeCollisionObject.hpp>

namespace plumb::dart6 {

using ::dart::collision::CollisionObject;
using ::dart::collision::Contact;

class Collisions::Filter final : public ::dart::collision::CollisionFilter {
 public:
  Filter(const Skeletons& skeletons, May may) : skeletons_(skeletons), may_(std::move(may)) {}
  bool ignoresCollision(const CollisionObject* a, const CollisionObject* b) const override {
    return !may_(skeletons_.geom(*a), skeletons_.geom(*b));
  }

 private:
  const Skeletons& skeletons_;
  May may_;
};

/// DART asks ODE for no rays; here is the space of which they can be asked.
class Collisions::Group final : public ::dart::collision::OdeCollisionGroup {
 public:
  using OdeCollisionGroup::getOdeSpaceId;
  using OdeCollisionGroup::OdeCollisionGroup;
  using OdeCollisionGroup::updateEngineData;
};

namespace {

/// ODE has memory of its own for each thread that collides, and a detector takes it where it is made.
void prepare_this_thread() { thread_local const auto detector = ::dart::collision::OdeCollisionDetector::create(); }

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
    const Geom& geom = skeletons.geom(*static_cast<const ::dart::collision::OdeCollisionObject*>(dGeomGetData(other)));
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

Collisions::Collisions() : detector_(::dart::collision::OdeCollisionDetector::create()) {}
Collisions::~Collisions() = default;

void Collisions::forget() {
  result_.clear();
  group_.reset();
  filter_.reset();
}

void Collisions::take(const Skeletons& skeletons, May may) {
  filter_ = std::make_shared<Filter>(skeletons, std::move(may));
  group_ = std::make_unique<Group>(detector_);
  group_->setAutomaticUpdate(false);
  for (const auto& skeleton : skeletons.all) group_->addShapeFramesOf(skeleton.get());
}

std::vector<Contact*> Collisions::find() {
  std::vector<Contact*> found;
  result_.clear();
  if (!group_) return found;
  prepare_this_thread();
  constexpr std::size_t all = 1'000'000;
  group_->collide(::dart::collision::CollisionOption(true, all, filter_), &result_);
  for (std::size_t i = 0; i < result_.getNumContacts(); ++i) {
    Contact& contact = result_.getContact(i);
    if (!Contact::isZeroNormal(contact.normal) && contact.penetrationDepth >= 0) found.push_back(&contact);
  }
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
