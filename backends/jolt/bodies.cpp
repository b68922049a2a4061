// Shapes and bodies of a world: made and taken away, and which pairs of bodies are kept apart.
#include "make_body.hpp"
#include "materials.hpp"
#include "world.hpp"

namespace plumb::jolt {

PlumbResult World::create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) {
  std::vector<std::unique_ptr<Shape>> made;
  for (const PlumbShapeDesc& desc : descs) {
    std::vector<const Shape*> children;
    for (std::uint32_t i = 0; desc.type == PLUMB_COMPOUND && i < desc.child_count; ++i)
      children.push_back(&shape(desc.children[i].shape));
    made.push_back(make_shape(desc, children, settings_.convex_radius));
  }
  for (std::size_t i = 0; i < made.size(); ++i) put(shapes_, ids[i], std::move(made[i]));
  return PLUMB_OK;
}

PlumbResult World::destroy_shapes(std::span<const PlumbShape> ids) {
  for (const PlumbShape id : ids) shapes_[slot_of(id)].reset();
  return PLUMB_OK;
}

/// Jolt's number of a body is its slot, so that a world that is put back has the same numbers.
void World::make_body(Body& body) {
  JPH::BodyCreationSettings made = body_settings(body.desc, body.shape, settings_, needs(PLUMB_NEED_GYROSCOPIC));
  made.mUserData = reinterpret_cast<std::uintptr_t>(&body);
  const auto generation = static_cast<JPH::uint8>(generation_of(body.handle));
  body.jolt = interface().CreateBodyWithID(JPH::BodyID(slot_of(body.handle), generation), made);
  if (body.jolt == nullptr)
    throw Error(PLUMB_E_OUT_OF_MEMORY, "Jolt has no room for more bodies; give body_capacity of the world");
  set_inertia(*body.jolt, body.desc);
  if (body.shape != nullptr && body.shape->has_materials()) ask_for_materials(system_);
}

PlumbResult World::create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) {
  std::vector<std::unique_ptr<Body>> made;
  try {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      auto body = std::make_unique<Body>();
      body->handle = ids[i];
      body->desc = descs[i];
      body->shape = descs[i].shape == 0 ? nullptr : &shape(descs[i].shape);
      make_body(*body);
      made.push_back(std::move(body));
    }
  } catch (...) {
    for (const auto& body : made) interface().DestroyBody(body->id());
    throw;
  }
  std::vector<JPH::BodyID> awake, still;
  for (auto& body : made) {
    body->was_asleep = body->is(PLUMB_DYNAMIC) && (body->desc.flags & PLUMB_BODY_ASLEEP) != 0;
    (body->was_asleep || body->is(PLUMB_STATIC) ? still : awake).push_back(body->id());
    if (body->is(PLUMB_KINEMATIC)) kinematic_.push_back(body.get());
    rules_.set_filter(slot_of(body->handle), body->desc.filter);
    if (needs(PLUMB_NEED_FILTERS)) ask_filter(*body);
    put(bodies_, body->handle, std::move(body));
  }
  const auto add = [&](std::vector<JPH::BodyID>& list, JPH::EActivation activation) {
    const int count = static_cast<int>(list.size());
    if (count == 0) return;
    const JPH::BodyInterface::AddState state = interface().AddBodiesPrepare(list.data(), count);
    interface().AddBodiesFinalize(list.data(), count, state, activation);
  };
  add(still, JPH::EActivation::DontActivate);
  add(awake, JPH::EActivation::Activate);
  return PLUMB_OK;
}

PlumbResult World::destroy_bodies(std::span<const PlumbBody> ids) {
  touches_.forget(ids, pending_events_);
  for (const PlumbBody id : ids) {
    const Body& gone = body(id);
    touch_anew(gone);
    std::erase(kinematic_, &gone);
    interface().RemoveBody(gone.id());
    interface().DestroyBody(gone.jolt->GetID());
    bodies_[slot_of(id)].reset();
  }
  listener_.forget_all();
  lent_.contacts.clear();
  return PLUMB_OK;
}

PlumbResult World::set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) {
  for (const PlumbBodyPair& pair : pairs) keep_apart(body(pair.body_a), body(pair.body_b), touch ? -1 : 1);
  return PLUMB_OK;
}

void World::ask_filter(const Body& body) {
  if (body.jolt->GetCollisionGroup().GetGroupFilter() != nullptr) return;
  body.jolt->SetCollisionGroup(JPH::CollisionGroup(rules_.group_filter(), slot_of(body.handle), 0));
}

void World::keep_apart(const Body& a, const Body& b, int reasons) {
  rules_.keep_apart(slot_of(a.handle), slot_of(b.handle), reasons);
  for (const Body* at : {&a, &b}) {
    ask_filter(*at);
    interface().InvalidateContactCache(at->id());
  }
}

/// Jolt leaves those asleep from under whom something is taken.
void World::touch_anew(const Body& body) {
  interface().InvalidateContactCache(body.id());
  if (!needs(PLUMB_NEED_SLEEPING) || body.shape == nullptr) return;
  JPH::AABox around = body.jolt->GetWorldSpaceBounds();
  around.ExpandBy(JPH::Vec3::sReplicate(static_cast<float>(2 * settings_.speculative_distance)));
  interface().ActivateBodiesInAABox(around, {}, {});
}

}  // namespace plumb::jolt
