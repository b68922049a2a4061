// What a world may have beyond the core: joints, queries, snapshots, settings, excluded pairs, changes.
#include "shared.hpp"

using plumb::IPhysicsWorld;
using plumb::web::with;

PLUMB_WEB(PlumbResult, plumb_create_joints)
(IPhysicsWorld* world, const PlumbJointDesc* descs, std::uint32_t count, PlumbJoint* ids) {
  return with(*world, world->joints(), "joints", [&](auto& joints) {
    return joints.create_joints({descs, count}, {ids, count});
  });
}
PLUMB_WEB(PlumbResult, plumb_destroy_joints)(IPhysicsWorld* world, const PlumbJoint* ids, std::uint32_t count) {
  return with(*world, world->joints(), "joints", [&](auto& joints) { return joints.destroy_joints({ids, count}); });
}
PLUMB_WEB(std::uint32_t, plumb_joint_columns)(PlumbJointField field) { return plumb::joint_columns_of(field); }
PLUMB_WEB(PlumbResult, plumb_read_joints)
(IPhysicsWorld* world, PlumbJointField field, const PlumbJoint* ids, std::uint32_t count, std::byte* rows) {
  return with(*world, world->joints(), "joints", [&](auto& joints) {
    return joints.read_joints(field, {ids, count}, plumb::web::rows_at(rows, count, plumb::joint_columns_of(field)));
  });
}
PLUMB_WEB(PlumbResult, plumb_write_joints)
(IPhysicsWorld* world, PlumbJointField field, const PlumbJoint* ids, std::uint32_t count, const std::byte* rows) {
  return with(*world, world->joints(), "joints", [&](auto& joints) {
    return joints.write_joints(field, {ids, count}, plumb::web::rows_at(rows, count, plumb::joint_columns_of(field)));
  });
}

namespace {

/// What queries found: rows that live until the next query.
template <class Query>
PlumbResult ask(IPhysicsWorld& world, const PlumbHit** hits, std::uint32_t* count, const Query& query) {
  return with(world, world.queries(), "queries", [&](auto& queries) {
    const plumb::Hits found = query(queries);
    *hits = found.hits.data();
    *count = static_cast<std::uint32_t>(found.hits.size());
    return found.result;
  });
}

}  // namespace

PLUMB_WEB(PlumbResult, plumb_cast_rays)
(IPhysicsWorld* world, PlumbHitMode mode, const PlumbRay* rays, std::uint32_t count, const PlumbHit** hits,
 std::uint32_t* hit_count) {
  return ask(*world, hits, hit_count, [&](auto& queries) { return queries.cast_rays(mode, {rays, count}); });
}
PLUMB_WEB(PlumbResult, plumb_cast_shapes)
(IPhysicsWorld* world, PlumbHitMode mode, const PlumbCast* casts, std::uint32_t count, const PlumbHit** hits,
 std::uint32_t* hit_count) {
  return ask(*world, hits, hit_count, [&](auto& queries) { return queries.cast_shapes(mode, {casts, count}); });
}
PLUMB_WEB(PlumbResult, plumb_turning_casts)
(IPhysicsWorld* world, PlumbHitMode mode, const PlumbTurningCast* casts, std::uint32_t count, const PlumbHit** hits,
 std::uint32_t* hit_count) {
  return ask(*world, hits, hit_count, [&](auto& queries) { return queries.turning_casts(mode, {casts, count}); });
}
PLUMB_WEB(PlumbResult, plumb_overlap_shapes)
(IPhysicsWorld* world, const PlumbOverlap* overlaps, std::uint32_t count, const PlumbHit** hits,
 std::uint32_t* hit_count) {
  return ask(*world, hits, hit_count, [&](auto& queries) { return queries.overlap_shapes({overlaps, count}); });
}

/// rows live until the next call.
PLUMB_WEB(PlumbResult, plumb_penetrations)
(IPhysicsWorld* world, const PlumbOverlap* overlaps, std::uint32_t count, const PlumbPenetration** rows,
 std::uint32_t* row_count) {
  return with(*world, world->queries(), "queries", [&](auto& queries) {
    const plumb::Penetrations found = queries.penetrations({overlaps, count});
    *rows = found.rows.data();
    *row_count = static_cast<std::uint32_t>(found.rows.size());
    return found.result;
  });
}

/// points live until the next call; each result says which of them are its.
PLUMB_WEB(PlumbResult, plumb_collide_pairs)
(IPhysicsWorld* world, const PlumbPosedPair* pairs, std::uint32_t count, PlumbPairResult* results,
 const PlumbPairPoint** points) {
  return with(*world, world->collide(), "collision without a step", [&](auto& collide) {
    std::span<const PlumbPairPoint> found;
    const PlumbResult result = collide.collide_pairs({pairs, count}, {results, count}, found);
    *points = found.data();
    return result;
  });
}

/// whole: 0, what moves, or 1, the whole world. The bytes live until the next call on the world.
PLUMB_WEB(PlumbResult, plumb_save)
(IPhysicsWorld* world, std::uint32_t whole, const std::byte** data, std::uint32_t* size) {
  return with(*world, world->snapshot(), "snapshots", [&](auto& snapshot) {
    std::span<const std::byte> bytes;
    const PlumbResult result = whole != 0 ? snapshot.save_world(bytes) : snapshot.save(bytes);
    *data = bytes.data();
    *size = static_cast<std::uint32_t>(bytes.size());
    return result;
  });
}
PLUMB_WEB(PlumbResult, plumb_restore)(IPhysicsWorld* world, const std::byte* data, std::uint32_t size) {
  return with(*world, world->snapshot(), "snapshots", [&](auto& snapshot) { return snapshot.restore({data, size}); });
}

PLUMB_WEB(PlumbResult, plumb_get_setting)(IPhysicsWorld* world, PlumbSetting* setting) {
  return with(*world, world->settings(), "settings",
              [&](auto& settings) { return settings.get_setting(setting->name, setting->value); });
}
PLUMB_WEB(PlumbResult, plumb_set_setting)(IPhysicsWorld* world, const PlumbSetting* setting) {
  return with(*world, world->settings(), "settings",
              [&](auto& settings) { return settings.set_setting(setting->name, setting->value); });
}

PLUMB_WEB(PlumbResult, plumb_set_exceptions)
(IPhysicsWorld* world, const PlumbBodyPair* pairs, std::uint32_t count, std::uint32_t touch) {
  return with(*world, world->exceptions(), "excluded pairs", [&](auto& exceptions) {
    return exceptions.set_exceptions({pairs, count}, touch != 0);
  });
}

PLUMB_WEB(PlumbResult, plumb_modify_bodies)
(IPhysicsWorld* world, const PlumbBodyChange* changes, std::uint32_t count) {
  return with(*world, world->modify(), "changes of living bodies", [&](auto& modify) {
    return modify.modify_bodies({changes, count});
  });
}
PLUMB_WEB(PlumbResult, plumb_modify_joints)
(IPhysicsWorld* world, const PlumbJointChange* changes, std::uint32_t count) {
  return with(*world, world->modify(), "changes of living joints", [&](auto& modify) {
    return modify.modify_joints({changes, count});
  });
}

PLUMB_WEB(PlumbResult, plumb_modify_shapes)
(IPhysicsWorld* world, const PlumbShape* shapes, const PlumbShapeDesc* descs, std::uint32_t count) {
  return with(*world, world->modify(), "changes of shapes", [&](auto& modify) {
    return modify.modify_shapes({shapes, count}, {descs, count});
  });
}

PLUMB_WEB(PlumbResult, plumb_create_cooked)
(IPhysicsWorld* world, const PlumbCookedShape* shapes, std::uint32_t count, PlumbShape* ids) {
  return with(*world, world->cooking(), "cooked shapes", [&](auto& cooking) {
    return cooking.create_cooked({shapes, count}, {ids, count});
  });
}

/// How many there are, or a result below 0; they live until the next call on the world.
PLUMB_WEB(std::int32_t, plumb_read_manifolds)(IPhysicsWorld* world, const PlumbManifold** rows) {
  std::span<const PlumbManifold> found;
  const PlumbResult result = with(*world, world->manifolds(), "contact modification",
                                  [&](auto& manifolds) { return manifolds.read_manifolds(found); });
  *rows = found.data();
  return result < 0 ? result : static_cast<std::int32_t>(found.size());
}
PLUMB_WEB(PlumbResult, plumb_modify_manifolds)
(IPhysicsWorld* world, const PlumbManifoldChange* changes, std::uint32_t count) {
  return with(*world, world->manifolds(), "contact modification", [&](auto& manifolds) {
    return manifolds.modify_manifolds({changes, count});
  });
}
