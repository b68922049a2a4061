// plumb.cooking/1: meshes with Bullet's tree over their triangles. Hulls are made anew, for how depends on settings of
// the world.
#include "cooking/cooked_mesh.hpp"
#include "world.hpp"

namespace plumb::bullet {

backend::CookedFormat World::cooked_format() { return {"bullet", 1}; }

std::vector<std::byte> World::cook(const PlumbShapeDesc& desc) { return cook_mesh(desc); }

PlumbResult World::create_cooked(std::span<const backend::CookedPayload> shapes, std::span<const PlumbShape> ids) {
  std::vector<std::shared_ptr<const Shape>> made;
  for (const backend::CookedPayload& cooked : shapes) made.push_back(make_cooked_mesh(cooked.bytes));
  put_shapes(std::move(made), ids);
  return PLUMB_OK;
}

}  // namespace plumb::bullet
