// All manifolds of a world, each once.
#pragma once

#include "world.hpp"

namespace plumb::box3d {

template <class Visit>
void World::each_manifold(Visit&& visit) {
  for (const auto& at : bodies_) {
    if (!at || !at->is(PLUMB_DYNAMIC)) continue;
    const int capacity = b3Body_GetContactCapacity(at->id);
    if (contact_data_.size() < static_cast<std::size_t>(capacity))
      contact_data_.resize(static_cast<std::size_t>(capacity));
    const int count = capacity == 0 ? 0 : b3Body_GetContactData(at->id, contact_data_.data(), capacity);
    for (const b3ContactData& data : std::span(contact_data_).first(static_cast<std::size_t>(count))) {
      const Body &a = owner(data.shapeIdA), &b = owner(data.shapeIdB);
      const Body& other = &a == at.get() ? b : a;
      if (other.is(PLUMB_DYNAMIC) && slot_of(other.handle) < slot_of(at->handle)) continue;  // told there
      for (int k = 0; k < data.manifoldCount; ++k) visit(data, a, b, data.manifolds[k]);
    }
  }
}

}  // namespace plumb::box3d
