#include "report/page/parts/looks.hpp"

#include <array>
#include <cstdint>
#include <utility>

namespace plumb::harness {
namespace {

/// Engines that people compare, each with a hue of its own; whatever is not among them takes one by its name.
constexpr std::array<std::pair<std::string_view, std::size_t>, 15> known_hues{{
    {"impulse", 0},
    {"bullet", 1},
    {"ammo", 1},  // Bullet, compiled for browsers
    {"ode", 2},
    {"physx", 3},
    {"jolt", 4},
    {"box3d", 5},
    {"havok", 6},
    {"mujoco", 7},
    {"dart", 8},
    {"rapier", 9},
    {"cannon", 10},
    {"newton", 11},
    {"simbody", 11},
    {"chrono", 10},
}};

constexpr std::string_view hosted = "node-";  ///< what runs as WebAssembly: "node-jolt" is of jolt's family
constexpr std::size_t hosted_shade = 3;

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

std::string_view engine_family(std::string_view backend) {
  if (backend.starts_with(hosted)) backend.remove_prefix(hosted.size());
  return backend.substr(0, backend.find('-'));
}

EngineLook look_of(std::string_view backend) {
  const std::string_view family = engine_family(backend), name = backend.substr(backend.find(family));
  const std::string_view member = family.size() < name.size() ? name.substr(family.size() + 1) : "";
  const std::size_t shade = member.empty() && backend.starts_with(hosted) ? hosted_shade : shade_of(member);
  for (const auto& [known, hue] : known_hues) {
    if (known == family) return {hue, shade};
  }
  return {stable_hash(family) % page_hues, shade};
}

}  // namespace plumb::harness
