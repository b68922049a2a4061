#include "materials.hpp"

#include <algorithm>

namespace plumb::jolt {

const PlumbMaterial& material_of(const JPH::Body& body, JPH::SubShapeID part) {
  const Body& of = owner(body);
  const PlumbMaterial* own = of.shape != nullptr && of.shape->has_materials() ? of.shape->material_of(part) : nullptr;
  return own == nullptr ? of.desc.material : *own;
}

void ask_for_materials(JPH::PhysicsSystem& system) {
  system.SetCombineFriction(
      [](const JPH::Body& a, const JPH::SubShapeID& part_a, const JPH::Body& b, const JPH::SubShapeID& part_b) {
        return static_cast<float>(std::sqrt(material_of(a, part_a).friction * material_of(b, part_b).friction));
      });
  system.SetCombineRestitution(
      [](const JPH::Body& a, const JPH::SubShapeID& part_a, const JPH::Body& b, const JPH::SubShapeID& part_b) {
        return static_cast<float>(std::max(material_of(a, part_a).restitution, material_of(b, part_b).restitution));
      });
}

}  // namespace plumb::jolt
