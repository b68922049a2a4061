// One query of a batch on its way through PhysX's trees.
#pragma once

#include <algorithm>

#include "queries/exact.hpp"
#include "world.hpp"

namespace plumb::px {

/// Lets PhysX look at the parts of bodies that a function says are seen.
template <class Sees>
class SightOf final : public PxQueryFilterCallback {
 public:
  explicit SightOf(const Sees& sees) : sees_(sees) {}
  PxQueryHitType::Enum preFilter(const PxFilterData&, const PxShape* shape, const PxRigidActor*, PxHitFlags&) override {
    return sees_(*part_of(*shape).body) ? PxQueryHitType::eTOUCH : PxQueryHitType::eNONE;
  }
  PxQueryHitType::Enum postFilter(const PxFilterData&, const PxQueryHit&, const PxShape*,
                                  const PxRigidActor*) override {
    return PxQueryHitType::eTOUCH;
  }

 private:
  const Sees& sees_;
};

[[nodiscard]] inline PxQueryFilterData look_at_all() {
  PxQueryFilterData data;
  data.flags |= PxQueryFlag::ePREFILTER;
  return data;
}

/// Bodies that a query sees.
[[nodiscard]] inline auto seen_by(const PlumbFilter& filter) {
  return [&filter](const Body& body) { return !body.is_sensor() && may_touch(filter, body.desc.filter); };
}

/// Calls on_hit(hit) for all that PhysX finds.
template <class Hit, class OnHit>
class Each final : public PxHitCallback<Hit> {
 public:
  explicit Each(OnHit on_hit) : PxHitCallback<Hit>(room_, kRoom), on_hit_(std::move(on_hit)) {}
  PxAgain processTouches(const Hit* hits, PxU32 count) override {
    for (const Hit* hit = hits; hit != hits + count; ++hit) on_hit_(*hit);
    return true;
  }

 private:
  static constexpr PxU32 kRoom = 64;

  OnHit on_hit_;
  Hit room_[kRoom];
};
template <class Hit, class OnHit>
[[nodiscard]] Each<Hit, OnHit> each(OnHit on_hit) {
  return Each<Hit, OnHit>(std::move(on_hit));
}

/// Calls on_part for parts of bodies that are seen and whose bounds meet these, and may be for others.
template <class Sees, class OnPart>
void find_near(const PxScene& scene, const PxBounds3& bounds, const Sees& sees, OnPart on_part) {
  SightOf<Sees> sight(sees);
  auto found =
      each<PxOverlapHit>([&](const PxOverlapHit& hit) { on_part(part_of(*hit.shape), *hit.shape, *hit.actor); });
  (void)scene.overlap(PxBoxGeometry(bounds.getExtents() + PxVec3(1e-3f)), PxTransform(bounds.getCenter()), found,
                      look_at_all(), &sight);
}

/// Calls on_part for parts of bodies that are seen and that a piece overlaps, which may be a surface.
template <class Sees, class OnPart>
void find_overlaps(const PxScene& scene, const PxGeometry& geometry, const PxTransform& at, const Sees& sees,
                   OnPart on_part) {
  PxBounds3 bounds;
  PxGeometryQuery::computeGeomBounds(bounds, geometry, at);
  const PxVec3 most(1e6f);  // a plane has no bounds
  bounds = PxBounds3(bounds.minimum.maximum(-most), bounds.maximum.minimum(most));
  find_near(scene, bounds, sees, [&](const Part& part, const PxShape& shape, const PxRigidActor& actor) {
    if (PxGeometryQuery::overlap(geometry, at, shape.getGeometry(), PxShapeExt::getGlobalPose(shape, actor)))
      on_part(part);
  });
}

/// Calls run(query, collector) for each of a batch. The hits live until the next batch of the same thread.
template <class Query, class Run>
Hits gather(PlumbHitMode mode, std::span<const Query> queries, Run&& run) {
  thread_local std::vector<PlumbHit> hits;
  hits.clear();
  for (std::uint32_t i = 0; i < queries.size(); ++i) {
    backend::HitCollector collector(hits, i, mode);
    run(queries[i], collector);
    collector.finish();
  }
  return {PLUMB_OK, hits};
}

/// Whether a piece is made of triangles.
[[nodiscard]] inline bool is_surface(const PxGeometry& geometry) {
  return geometry.getType() == PxGeometryType::eTRIANGLEMESH || geometry.getType() == PxGeometryType::eHEIGHTFIELD;
}

/// Calls on_leaf(leaf, child) for the leaves of a piece that meet a box; base is taken off places.
template <class OnLeaf>
void for_leaves(const PxGeometry& geometry, const PxTransform& at, const PxBounds3& bounds, const PxVec3& base,
                OnLeaf on_leaf) {
  if (!is_surface(geometry)) {
    on_leaf(Leaf(geometry, PxTransform(at.p - base, at.q)), PxU32{0});
    return;
  }
  const PxBoxGeometry box(bounds.getExtents() + PxVec3(1e-3f));
  const PxTransform place(bounds.getCenter());
  const bool mesh = geometry.getType() == PxGeometryType::eTRIANGLEMESH;
  PxU32 faces[128];
  bool more = true;
  for (PxU32 first = 0; more;) {
    const PxU32 count =
        mesh ? PxMeshQuery::findOverlapTriangleMesh(box, place, static_cast<const PxTriangleMeshGeometry&>(geometry),
                                                    at, faces, std::size(faces), first, more)
             : PxMeshQuery::findOverlapHeightField(box, place, static_cast<const PxHeightFieldGeometry&>(geometry), at,
                                                   faces, std::size(faces), first, more);
    first += count;
    if (count == 0) return;
    for (PxU32 i = 0; i < count; ++i) {
      PxTriangle triangle;
      mesh ? PxMeshQuery::getTriangle(static_cast<const PxTriangleMeshGeometry&>(geometry), at, faces[i], triangle)
           : PxMeshQuery::getTriangle(static_cast<const PxHeightFieldGeometry&>(geometry), at, faces[i], triangle);
      for (PxVec3& corner : triangle.verts) corner -= base;
      on_leaf(Leaf(triangle), faces[i]);
    }
  }
}

/// Which child of a body's shape a face of a part is.
[[nodiscard]] inline std::uint32_t child_of(const Part& part, PxU32 face) {
  const Shape& shape = *part.body->shape;
  return shape.type == PLUMB_TRIANGLE_MESH ? shape.triangle_of(face) : part.piece->child;
}

}  // namespace plumb::px
