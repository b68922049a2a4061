// Entities of a list by index, by name, and their index in it.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace plumb::gazebo {

template <class Entity>
using Listed = std::vector<std::unique_ptr<Entity>>;

template <class Entity>
[[nodiscard]] Entity* at(const Listed<Entity>* list, std::size_t index) {
  return list != nullptr && index < list->size() ? (*list)[index].get() : nullptr;
}

inline const std::string& name_of(const auto& entity) {
  if constexpr (requires { entity.name(); })
    return entity.name();
  else
    return entity.name;
}

template <class Entity>
[[nodiscard]] Entity* named(const Listed<Entity>* list, const std::string& name) {
  if (list != nullptr)
    for (const auto& entity : *list)
      if (name_of(*entity) == name) return entity.get();
  return nullptr;
}

/// -1, as a size, for what is not in it.
template <class Entity>
[[nodiscard]] std::size_t index_in(const Listed<Entity>* list, const Entity* entity) {
  if (list != nullptr)
    for (std::size_t i = 0; i < list->size(); ++i)
      if ((*list)[i].get() == entity) return i;
  return static_cast<std::size_t>(-1);
}

template <class Entity>
[[nodiscard]] std::size_t count(const Listed<Entity>* list) {
  return list != nullptr ? list->size() : 0;
}

}  // namespace plumb::gazebo
