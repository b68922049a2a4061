#include "hosts/ogre/game/scene.hpp"

#include <array>
#include <cmath>

#include "hosts/ogre/game/vectors.hpp"

namespace plumb::ogre {
namespace {

constexpr double kWood = 400;   // kg/m3
constexpr double kHalf = 0.25;  // m, of a box

PlumbShapeDesc box_of(const PlumbVec3& half_extents) {
  PlumbShapeDesc desc = shape_desc(PLUMB_BOX);
  desc.half_extents = half_extents;
  return desc;
}

/// A sphere, or a capsule or cylinder along y.
PlumbShapeDesc round_of(PlumbShapeType type, double radius, double half_height) {
  PlumbShapeDesc desc = shape_desc(type);
  desc.radius = radius;
  desc.half_height = half_height;
  return desc;
}

PlumbQuat about_z(double angle) { return {0, 0, std::sin(angle / 2), std::cos(angle / 2)}; }

Thing thing(const std::string& name, PlumbMotion motion, const PlumbShapeDesc& shape, const PlumbPose& pose,
            std::uint32_t colour) {
  Thing made{name, shape, body_desc(motion), colour};
  made.body.pose = pose;
  made.body.density = kWood;
  made.body.material.friction = 0.6;
  return made;
}

PlumbPose at(double x, double y, double z) { return {{x, y, z}, {0, 0, 0, 1}}; }

void add_pyramid(std::vector<Thing>& things, int base) {
  constexpr std::array<std::uint32_t, 3> shades{0x3d7ea6, 0x5c9ead, 0x7fb7be};
  for (int row = 0; row < base; ++row)
    for (int i = 0; i < base - row; ++i)
      things.push_back(thing("pyramid " + std::to_string(row) + "." + std::to_string(i), PLUMB_DYNAMIC,
                             box_of({kHalf, kHalf, kHalf}),
                             at(-1.2 + (2 * i - (base - row - 1)) * 1.04 * kHalf, kHalf + 2 * row * kHalf, -2.5),
                             shades[static_cast<std::size_t>(row + i) % shades.size()]));
}

void add_falling(std::vector<Thing>& things) {
  for (int i = 0; i < 4; ++i)
    things.push_back(thing("falling box " + std::to_string(i), PLUMB_DYNAMIC, box_of({kHalf, kHalf, kHalf}),
                           {{-3.2 + 0.3 * i, 2.5 + i, 1.2 - 0.2 * i}, about_z(0.4 * i)}, kFalling));
  things.push_back(thing("sphere", PLUMB_DYNAMIC, round_of(PLUMB_SPHERE, 0.3, 0), at(-4.6, 4, -0.6), 0xd1495b));
  things.push_back(
      thing("capsule", PLUMB_DYNAMIC, round_of(PLUMB_CAPSULE, 0.2, 0.3), {{-4.4, 5, 0.4}, about_z(1)}, 0x9b5de5));
  things.push_back(
      thing("cylinder", PLUMB_DYNAMIC, round_of(PLUMB_CYLINDER, 0.25, 0.3), {{-1.5, 4, 0.6}, about_z(0.5)}, 0x66a182));
}

}  // namespace

Scene make_scene() {
  Scene scene;
  std::vector<Thing>& things = scene.things;
  things.push_back(thing("ground", PLUMB_STATIC, box_of({12, 0.5, 12}), at(0, -0.5, 0), 0xb8b8ae));
  things.push_back(thing("ramp", PLUMB_STATIC, box_of({1.6, 0.1, 1.4}), {{-4.6, 0.75, 0}, about_z(-0.45)}, 0x8d8a7b));
  scene.platform = things.size();
  const PlumbVec3 start = platform_at(0);
  things.push_back(thing("platform", PLUMB_KINEMATIC, box_of(kPlatformHalfExtents), {start, {0, 0, 0, 1}}, 0xe8c547));
  const double top = start.y + kPlatformHalfExtents.y;
  for (int i = 0; i < 2; ++i)
    things.push_back(thing("carried box " + std::to_string(i), PLUMB_DYNAMIC, box_of({kHalf, kHalf, kHalf}),
                           at(start.x + 0.85, top + kHalf, start.z - 0.7 + 1.4 * i), 0xf2f2f2));
  things.push_back(thing("ball", PLUMB_DYNAMIC, round_of(PLUMB_SPHERE, 0.4, 0), at(0.6, 0.4, 0.6), 0xd7263d));
  add_pyramid(things, 5);
  add_falling(things);
  scene.character = {-0.2, 0.95, 2.6};
  return scene;
}

PlumbVec3 platform_at(double seconds) {
  struct Stop {
    double time;
    PlumbVec3 place;
  };
  constexpr PlumbVec3 low{3.2, 0.09, 1.2}, high{3.2, 1.8, 1.2}, across{3.2, 1.8, -2};
  constexpr std::array<Stop, 9> stops{Stop{0, low},  {2.5, low}, {5, high},  {6, high},  {8.5, across},
                                      {9.5, across}, {12, high}, {13, high}, {15.5, low}};
  const double time = std::fmod(seconds, stops.back().time);
  std::size_t next = 1;
  while (stops[next].time <= time) ++next;
  const Stop &from = stops[next - 1], &to = stops[next];
  const double part = (time - from.time) / (to.time - from.time);
  const double eased = part * part * (3 - 2 * part);  // no jerk where it stops, that nobody falls off
  return add(from.place, scale(eased, sub(to.place, from.place)));
}

}  // namespace plumb::ogre
