#include "report/page/parts/looks.hpp"

#include <array>
#include <cstdint>
#include <utility>

namespace plumb::harness {
namespace {

/// Engines that people compare, each with a hue of its own; whatever is not among them takes one by its name.
constexpr std::array<std::pair<std::string_view, std::size_t>, 12> known_hues{{
    {"impulse", 0},
    {"bullet", 1},
    {"ode", 2},
    {"physx", 3},
    {"jolt", 4},
    {"mujoco", 7},
    {"rapier", 5},
    {"newton", 6},
    {"chrono", 3},
    {"dart", 4},
    {"havok", 6},
    {"box3d", 5},
}};

/// FNV-1a: the same on every machine, which std::hash need not be.
std::uint32_t stable_hash(std::string_view text) {
  std::uint32_t hash = 2166136261u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

std::size_t shade_of(std::string_view member) {
  if (member.empty() || member == "f32" || member == "cpu") return 0;
  if (member == "f64" || member == "double") return 1;
  if (member == "cuda" || member == "gpu") return 2;
  return stable_hash(member) % page_shades;
}

}  // namespace

std::string_view engine_family(std::string_view backend) { return backend.substr(0, backend.find('-')); }

EngineLook look_of(std::string_view backend) {
  const std::string_view family = engine_family(backend);
  const std::string_view member = family.size() < backend.size() ? backend.substr(family.size() + 1) : "";
  for (const auto& [name, hue] : known_hues) {
    if (name == family) return {hue, shade_of(member)};
  }
  return {stable_hash(family) % page_hues, shade_of(member)};
}

}  // namespace plumb::harness
