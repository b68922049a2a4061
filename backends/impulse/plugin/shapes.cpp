// Shapes of a world, and the proxies by which bodies have them.
#include <string>

#include "plugin/ranges.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

namespace {

bool is_identity(const PlumbPose& pose) {
  return pose.position.x == 0 && pose.position.y == 0 && pose.position.z == 0 && pose.orientation.x == 0 &&
         pose.orientation.y == 0 && pose.orientation.z == 0 && pose.orientation.w == 1;
}

}  // namespace

/// The row of a shape. What consists of others, or has its origin elsewhere, is told in `parts` too; `row` is its own.
Shape World::to_shape(const PlumbShapeDesc& desc, std::uint32_t row, Compound& parts) {
  Shape shape{};
  switch (desc.type) {
    case PLUMB_SPHERE:
      shape.type = ShapeType::kSphere;
      shape.size = {static_cast<Real>(desc.radius), 0, 0};
      shape.reach = shape.size.x;
      break;
    case PLUMB_BOX:
      shape.type = ShapeType::kBox;
      shape.size = to_vec(desc.half_extents);
      shape.reach = length(shape.size);
      break;
    case PLUMB_CAPSULE:
      shape.type = ShapeType::kCapsule;
      shape.size = {static_cast<Real>(desc.radius), static_cast<Real>(desc.half_height), 0};
      shape.reach = shape.size.x + shape.size.y;
      break;
    case PLUMB_CYLINDER:
      shape.type = ShapeType::kCylinder;
      shape.size = {static_cast<Real>(desc.radius), static_cast<Real>(desc.half_height), 0};
      shape.reach = length(shape.size);
      break;
    case PLUMB_CONVEX_HULL:
      return hull_shape(simulation_.colliders.hulls.add(
          std::span(reinterpret_cast<const PlumbVec3*>(desc.vertices), desc.vertex_count)));
    case PLUMB_PLANE: shape.type = ShapeType::kPlane; break;
    case PLUMB_TRIANGLE_MESH:
      return placed_surface(ShapeType::kMesh, simulation_.colliders.surfaces.add_mesh(simulation_.executor(), desc),
                            row, parts);
    case PLUMB_HEIGHT_FIELD:
      return placed_surface(ShapeType::kHeightField, simulation_.colliders.surfaces.add_field(desc), row, parts);
    case PLUMB_COMPOUND: parts = to_compound(desc); break;  // its children have rows of their own
    default: throw Error(PLUMB_E_UNSUPPORTED, "shape type " + std::to_string(desc.type) + " is not in impulse yet");
  }
  return shape;
}

/// The frame of a surface has its origin in the middle of its box, which is told in `parts`; `row`: as of to_shape().
Shape World::placed_surface(ShapeType type, const AddedSurface& added, std::uint32_t row, Compound& parts) {
  parts = {{row, {added.centre, {0, 0, 0, 1}}, false, {}}};
  return surface_shape(type, added);
}

/// hull: its row in the pool.
Shape World::hull_shape(std::uint32_t hull) const {
  Shape shape{};
  shape.type = ShapeType::kHull;
  shape.hull = hull;
  shape.reach = simulation_.colliders.hulls.reach(shape.hull);
  return shape;
}

void World::dismantle(const Shape& shape) {
  if (shape.type == ShapeType::kHull) simulation_.colliders.hulls.remove(shape.hull);
  if (shape.type == ShapeType::kMesh) simulation_.colliders.surfaces.remove_mesh(shape.hull);
  if (shape.type == ShapeType::kHeightField) simulation_.colliders.surfaces.remove_field(shape.hull);
}

/// make(i, parts): the i-th shape, as to_shape() gives it.
template <class Make>
PlumbResult World::add_shapes(std::span<const PlumbShape> ids, const Make& make) {
  std::vector<Shape> made;
  std::vector<Compound> parts(ids.size());
  made.reserve(ids.size());
  std::uint32_t rows = 0;
  for (const PlumbShape id : ids) rows = std::max(rows, slot_of(id) + 1);
  simulation_.reserve_shapes(rows);
  try {
    bool has_parts = false;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      made.push_back(make(i, parts[i]));
      has_parts = has_parts || !parts[i].empty();
    }
    if (has_parts && rows > compounds_.size()) compounds_.resize(rows);
  } catch (...) {
    for (const Shape& shape : made) dismantle(shape);
    throw;
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    simulation_.colliders.shapes.edit(slot_of(ids[i])) = made[i];
    if (!parts[i].empty()) compounds_[slot_of(ids[i])] = std::move(parts[i]);
  }
  return PLUMB_OK;
}

PlumbResult World::create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) {
  for (std::size_t i = 0; i < descs.size(); ++i) require_range(descs[i], i);
  return add_shapes(ids, [&](std::size_t i, Compound& parts) { return to_shape(descs[i], slot_of(ids[i]), parts); });
}

PlumbResult World::create_cooked(std::span<const backend::CookedPayload> shapes, std::span<const PlumbShape> ids) {
  ColliderTable& colliders = simulation_.colliders;
  return add_shapes(ids, [&](std::size_t i, Compound& parts) {
    backend::CookedReader bytes(shapes[i].bytes);
    return shapes[i].type == PLUMB_TRIANGLE_MESH
               ? placed_surface(ShapeType::kMesh, colliders.surfaces.add_cooked_mesh(bytes), slot_of(ids[i]), parts)
               : hull_shape(colliders.hulls.add(HullRows(bytes)));
  });
}

PlumbResult World::destroy_shapes(std::span<const PlumbShape> ids) {
  for (const PlumbShape id : ids) {
    dismantle(simulation_.colliders.shapes[slot_of(id)]);
    simulation_.colliders.shapes.edit(slot_of(id)) = {};
    if (slot_of(id) < compounds_.size()) compounds_[slot_of(id)].clear();
  }
  return PLUMB_OK;
}

/// The parts of a compound or surface; null for all other shapes.
const Compound* World::parts_of(std::uint32_t shape) const {
  return shape < compounds_.size() && !compounds_[shape].empty() ? &compounds_[shape] : nullptr;
}

/// Gives the body the proxies of a shape.
void World::attach(std::uint32_t slot, std::uint32_t shape) {
  BodyRecord& body = bodies_[slot];
  body.shape = shape;
  body.proxy = proxy_slots_.take(slot);
  const Compound* parts = parts_of(shape);
  for (std::size_t i = 1; parts != nullptr && i < parts->size(); ++i)
    body.more_proxies.push_back(proxy_slots_.take_any(simulation_.bodies.count));
  simulation_.reserve_proxies(proxy_slots_.end());
  simulation_.colliders.count = proxy_slots_.end();
  fill_proxies(slot);
}

/// Puts the body's shape into the rows that its proxies have.
void World::fill_proxies(std::uint32_t slot) {
  const BodyRecord& body = bodies_[slot];
  const Compound* parts = parts_of(body.shape);
  if (parts == nullptr) {
    if (body.proxy < proxies_.size()) proxies_[body.proxy] = {};
    return attach_part(slot, body.proxy, body.shape, nullptr);
  }
  if (proxies_.size() < proxy_slots_.end()) proxies_.resize(proxy_slots_.end());
  for (std::size_t i = 0; i < parts->size(); ++i) {
    const CompoundPart& part = (*parts)[i];
    const std::uint32_t row = i == 0 ? body.proxy : body.more_proxies[i - 1];
    proxies_[row] = {static_cast<std::uint32_t>(i), part.has_material, part.material};
    attach_part(slot, row, part.shape, is_identity(part.pose) ? nullptr : &part.pose);
  }
}

/// pose: of the shape in the body's frame; null: the body's own.
void World::attach_part(std::uint32_t slot, std::uint32_t row, std::uint32_t shape, const PlumbPose* pose) {
  const BodyFrame& frame = simulation_.bodies.frames[slot];
  Proxy& proxy = simulation_.colliders.proxies.edit(row);
  proxy = {};
  proxy.body = slot;
  proxy.shape = shape;
  proxy.first_step = simulation_.steps() + 1;
  const QuatD to_principal = conjugate(frame.principal);
  proxy.frame.orientation = to_quat(pose == nullptr ? to_principal : to_principal * to_double(pose->orientation));
  const Position from_centre =
      pose == nullptr ? -frame.centre_of_mass : to_position(pose->position) - frame.centre_of_mass;
  const Position offset = rotate(to_principal, from_centre);
  proxy.frame.position = {static_cast<Real>(offset.x), static_cast<Real>(offset.y), static_cast<Real>(offset.z)};
  put_proxy_row(slot, row);
}

void World::detach(std::uint32_t slot) {
  BodyRecord& body = bodies_[slot];
  const auto give_back = [this](std::uint32_t row) {
    simulation_.colliders.proxies.edit(row).shape = kNone;
    proxy_slots_.give_back(row);
  };
  if (body.proxy != kNone) give_back(body.proxy);
  for (const std::uint32_t row : body.more_proxies) give_back(row);
  body.shape = body.proxy = kNone;
  body.more_proxies.clear();
}

void World::put_proxy_row(std::uint32_t slot, std::uint32_t row) {
  const BodyRecord& body = bodies_[slot];
  const bool own = row < proxies_.size() && proxies_[row].has_material;
  const PlumbMaterial& material = own ? proxies_[row].material : body.material;
  Proxy& proxy = simulation_.colliders.proxies.edit(row);
  proxy.material = {static_cast<Real>(material.friction), static_cast<Real>(material.restitution)};
  const std::uint32_t flags = (body.motion == PLUMB_DYNAMIC ? 0 : kProxyImmovable) | (body.senses ? kProxyUnseen : 0);
  if (row < simulation_.colliders.surface_velocities.size()) {
    const PlumbVec3& v = material.surface_velocity;
    const Position principal = rotate(conjugate(simulation_.bodies.frames[slot].principal), Position{v.x, v.y, v.z});
    simulation_.colliders.surface_velocities.edit(row) = to_vec(PlumbVec3{principal.x, principal.y, principal.z});
  }
  simulation_.colliders.filters.edit(row) = {slot, body.filter.category, body.filter.mask, body.filter.group, flags};
}

/// What a contact tells of the proxy beside its body: the triangle where it is a surface.
std::uint32_t World::child_of(std::uint32_t proxy, std::uint32_t triangle) const {
  const std::uint32_t shape = simulation_.colliders.proxies[proxy].shape;
  PLUMB_ASSERT(shape != kNone);
  if (is_surface(simulation_.colliders.shapes[shape].type)) return triangle;
  return proxy < proxies_.size() ? proxies_[proxy].child : 0;
}

}  // namespace plumb::impulse
