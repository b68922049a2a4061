// Lies about shapes that are cooked.
#include <set>

#include "honest.hpp"

namespace plumb::lying {
namespace {

/// The descriptor is another before it is cooked, and its vertices are copied for that.
template <auto change>
void change_cooked() {
  liar.cooking.cook = [](const PlumbShapeDesc* desc, PlumbCooked* cooked) {
    PlumbShapeDesc changed = *desc;
    const std::size_t numbers = std::size_t{3} * desc->vertex_count;
    const bool has_vertices = desc->type == PLUMB_TRIANGLE_MESH || desc->type == PLUMB_CONVEX_HULL;
    std::vector<double> vertices(desc->vertices, desc->vertices + (has_vertices ? numbers : 0));
    change(changed, vertices);
    if (has_vertices) changed.vertices = vertices.data();
    return honest.cooking.cook(&changed, cooked);
  };
}

std::set<PlumbShape>& from_bytes() {
  static std::set<PlumbShape> shapes;
  return shapes;
}
/// Of the world that was made last.
void remember_cooked() {
  liar.core.create_world = [](const PlumbWorldDesc* desc, PlumbWorld** world) {
    from_bytes().clear();
    return honest.core.create_world(desc, world);
  };
  liar.cooking.create = [](PlumbWorld* world, const PlumbCookedShape* shapes, std::size_t stride, std::uint32_t count,
                           PlumbShape* ids) {
    const PlumbResult result = honest.cooking.create(world, shapes, stride, count, ids);
    if (result >= 0) from_bytes().insert(ids, ids + count);
    return result;
  };
}

}  // namespace

void cooked_balls_are_a_per_mille_larger() {
  change_cooked<[](PlumbShapeDesc& desc, std::vector<double>&) { desc.radius *= 1.001; }>();
}
void cooked_hulls_are_a_per_mille_longer() {
  change_cooked<[](PlumbShapeDesc& desc, std::vector<double>& vertices) {
    for (std::size_t i = 0; desc.type == PLUMB_CONVEX_HULL && i < vertices.size(); i += 3) vertices[i] *= 1.001;
  }>();
}
void cooked_meshes_are_a_millimetre_higher() {
  change_cooked<[](PlumbShapeDesc& desc, std::vector<double>& vertices) {
    for (std::size_t i = 1; desc.type == PLUMB_TRIANGLE_MESH && i < vertices.size(); i += 3) vertices[i] += 1e-3;
  }>();
}
void cooked_triangles_have_no_material() {
  change_cooked<[](PlumbShapeDesc& desc, std::vector<double>&) { desc.material_count = 0; }>();
}
void cooked_grounds_stay() {
  remember_cooked();
  liar.modify.shapes = [](PlumbWorld* world, const PlumbShape* shapes, const PlumbShapeDesc* descs, std::size_t stride,
                          std::uint32_t count) -> PlumbResult {
    return from_bytes().contains(*shapes) ? PLUMB_OK : honest.modify.shapes(world, shapes, descs, stride, count);
  };
}
/// A cooked sphere is another geometry, which a snapshot knows.
void snapshots_do_not_know_cooked_shapes() {
  change_cooked<[](PlumbShapeDesc& desc, std::vector<double>&) { desc.radius += 1e-9; }>();
}
void cooked_bytes_are_numbered() {
  liar.cooking.cook = [](const PlumbShapeDesc* desc, PlumbCooked* cooked) {
    static int number = 0;
    const PlumbResult result = honest.cooking.cook(desc, cooked);
    if (result >= 0 && ++number > 20)
      *const_cast<std::byte*>(static_cast<const std::byte*>(cooked->data) + cooked->size - 1) ^= std::byte{1};
    return result;
  };
}
void torn_bytes_are_made_into_balls() {
  liar.cooking.create = [](PlumbWorld* world, const PlumbCookedShape* shapes, std::size_t stride, std::uint32_t count,
                           PlumbShape* ids) {
    const PlumbResult result = honest.cooking.create(world, shapes, stride, count, ids);
    if (result >= 0) return result;
    PlumbShapeDesc ball = shape_desc(PLUMB_SPHERE);
    ball.radius = 1;
    return honest.core.create_shapes(world, &ball, sizeof ball, 1, ids);
  };
}

}  // namespace plumb::lying
