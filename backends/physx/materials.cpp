#include "materials.hpp"

#include <algorithm>

#include "start.hpp"

namespace plumb::px {

Materials::~Materials() {
  for (const auto& [coefficients, material] : made_) material->release();
}

void Materials::forget_unused() {
  std::erase_if(made_, [](const auto& entry) {
    if (entry.second->getReferenceCount() > 1) return false;
    entry.second->release();
    return true;
  });
  most_ = std::max<std::size_t>(1024, 2 * made_.size());
}

PxMaterial& Materials::of(const PlumbMaterial& material) {
  const float root = std::sqrt(scalar(material.friction, "friction"));
  if (made_.size() >= most_) forget_unused();
  PxMaterial*& made = made_[{root, static_cast<float>(material.restitution)}];
  if (made != nullptr) return *made;
  made = physics().createMaterial(root, root, static_cast<float>(material.restitution));
  if (made == nullptr) {
    made_.erase({root, static_cast<float>(material.restitution)});
    throw Error(PLUMB_E_OUT_OF_MEMORY, "PhysX has no room for more materials" + because());
  }
  PxMaterial& fresh = *made;
  fresh.setFrictionCombineMode(PxCombineMode::eMULTIPLY);
  fresh.setRestitutionCombineMode(PxCombineMode::eMAX);
  fresh.setFlag(PxMaterialFlag::eDISABLE_STRONG_FRICTION, !strong_friction_);
  return fresh;
}

}  // namespace plumb::px
