// An engine's refusal of a part of a scene, told by the name that the scene gives it and not by its place in a batch.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "plumb/physics_world.hpp"

namespace plumb::harness {

class PartRefused : public Error {
 public:
  /// list: "shapes", "bodies" or "joints", as in scene files; said: what is wrong with the part.
  PartRefused(PlumbResult code, const std::string& list, const std::string& name, const std::string& said);
  [[nodiscard]] const std::string& list() const { return list_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string list_, name_;
};

/// Calls make(); an Error of it that begins with an element, "descs[3].mass is ...", is thrown on as PartRefused.
void naming_parts(const char* list, const std::function<std::string(std::size_t)>& name_of,
                  const std::function<void()>& make);

}  // namespace plumb::harness
