// Worlds, shapes, bodies, and what comes out of a step.
#include "shared.hpp"

using plumb::IPhysicsWorld;
using plumb::web::lent;
using plumb::web::told;

PLUMB_WEB(PlumbResult, plumb_create_world)(const PlumbWorldDesc* desc, IPhysicsWorld** world) {
  return plumb::web::guarded([&] {
    *world = plumb::web::backend().create_world(*desc).release();
    return PLUMB_OK;
  });
}
PLUMB_WEB(void, plumb_destroy_world)(IPhysicsWorld* world) { delete world; }

PLUMB_WEB(PlumbResult, plumb_create_shapes)
(IPhysicsWorld* world, const PlumbShapeDesc* descs, std::uint32_t count, PlumbShape* ids) {
  return told(*world, world->create_shapes({descs, count}, {ids, count}));
}
PLUMB_WEB(PlumbResult, plumb_destroy_shapes)(IPhysicsWorld* world, const PlumbShape* ids, std::uint32_t count) {
  return told(*world, world->destroy_shapes({ids, count}));
}
PLUMB_WEB(PlumbResult, plumb_create_bodies)
(IPhysicsWorld* world, const PlumbBodyDesc* descs, std::uint32_t count, PlumbBody* ids) {
  return told(*world, world->create_bodies({descs, count}, {ids, count}));
}
PLUMB_WEB(PlumbResult, plumb_destroy_bodies)(IPhysicsWorld* world, const PlumbBody* ids, std::uint32_t count) {
  return told(*world, world->destroy_bodies({ids, count}));
}
/// How many live; ids: in order of creation, until the next call on the world.
PLUMB_WEB(std::int32_t, plumb_bodies)(IPhysicsWorld* world, const PlumbBody** ids) {
  return lent(ids, [&] { return world->bodies(); });
}

PLUMB_WEB(std::uint32_t, plumb_columns)(PlumbField field) { return plumb::columns_of(field); }
/// Without ids the first bodies in order of creation.
PLUMB_WEB(PlumbResult, plumb_read)
(IPhysicsWorld* world, PlumbField field, const PlumbBody* ids, std::uint32_t count, std::byte* rows) {
  const std::span<const PlumbBody> bodies{ids, ids == nullptr ? 0 : std::size_t{count}};
  return told(*world, world->read(field, bodies, plumb::web::rows_at(rows, count, plumb::columns_of(field))));
}
PLUMB_WEB(PlumbResult, plumb_write)
(IPhysicsWorld* world, PlumbField field, const PlumbBody* ids, std::uint32_t count, const std::byte* rows) {
  return told(*world, world->write(field, {ids, count}, plumb::web::rows_at(rows, count, plumb::columns_of(field))));
}
PLUMB_WEB(PlumbResult, plumb_set_gravity)(IPhysicsWorld* world, const PlumbVec3* gravity) {
  return told(*world, world->set_gravity(*gravity));
}

/// A step, done when this returns.
PLUMB_WEB(PlumbResult, plumb_step)(IPhysicsWorld* world, double dt, PlumbStepReport* report) {
  const PlumbResult started = world->step(dt);
  return told(*world, started < 0 ? started : world->wait(*report));
}
/// The same in halves: what was found between the two is read and modified (extensions.cpp).
PLUMB_WEB(PlumbResult, plumb_begin_step)(IPhysicsWorld* world, double dt) { return told(*world, world->step(dt)); }
PLUMB_WEB(PlumbResult, plumb_wait)(IPhysicsWorld* world, PlumbStepReport* report) {
  return told(*world, world->wait(*report));
}
/// How many there are of the last step, or a result below 0; they live until the next call on the world.
PLUMB_WEB(std::int32_t, plumb_contacts)(IPhysicsWorld* world, const PlumbContact** rows) {
  return lent(rows, [&] { return world->contacts(); });
}
PLUMB_WEB(std::int32_t, plumb_events)(IPhysicsWorld* world, const PlumbEvent** rows) {
  return lent(rows, [&] { return world->events(); });
}

PLUMB_WEB(PlumbResult, plumb_hash)(IPhysicsWorld* world, std::uint64_t* value) {
  return told(*world, world->hash(*value));
}
