// The order of operations in this file is part of its result: the file is compiled without contraction.
#include "scene/generators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/limits.hpp"

namespace plumb::harness {
namespace {

class Writer {
 public:
  Writer(double friction, std::vector<SceneShape>& shapes, std::vector<SceneBody>& bodies)
      : friction_(friction), shapes_(shapes), bodies_(bodies) {}

  std::size_t box(const std::string& name, const PlumbVec3& half_extents) {
    SceneShape shape;
    shape.name = name;
    shape.desc = shape_desc(PLUMB_BOX);
    shape.desc.half_extents = half_extents;
    shapes_.push_back(std::move(shape));
    return shapes_.size() - 1;
  }

  void body(const std::string& name, PlumbMotion motion, std::size_t shape, const PlumbVec3& position,
            const PlumbQuat& orientation) {
    SceneBody body;
    body.name = name;
    body.shape = shape;
    body.desc = body_desc(motion);
    body.desc.pose = {position, orientation};
    body.desc.material.friction = friction_;
    bodies_.push_back(std::move(body));
  }

  void fixed(const std::string& name, const std::string& shape, const PlumbVec3& position, const PlumbVec3& half) {
    body(name, PLUMB_STATIC, box(shape, half), position, {0, 0, 0, 1});
  }

  void ground(double half_width) { fixed("ground", "ground", {0, -1, 0}, {half_width, 1, half_width}); }

  void cube(const PlumbVec3& position, const PlumbQuat& orientation) {
    if (cubes_ == 0) cube_shape_ = box("box", {0.5, 0.5, 0.5});
    body(fmt::format("box{}", cubes_++), PLUMB_DYNAMIC, cube_shape_, position, orientation);
  }

 private:
  double friction_;
  std::vector<SceneShape>& shapes_;
  std::vector<SceneBody>& bodies_;
  std::size_t cube_shape_ = 0;
  std::size_t cubes_ = 0;
};

void pyramid(Writer& writer, std::int64_t base, double x, double z) {
  for (std::int64_t row = 0; row < base; ++row) {
    for (std::int64_t i = 0; i < base - row; ++i) {
      const double middle = static_cast<double>(base - row - 1) / 2;
      writer.cube({x + (static_cast<double>(i) - middle) * 1.02, 0.5 + static_cast<double>(row), z}, {0, 0, 0, 1});
    }
  }
}

void many_pyramids(Writer& writer, std::int64_t count) {
  const double middle = static_cast<double>(count - 1) / 2;
  for (std::int64_t a = 0; a < count; ++a)
    for (std::int64_t c = 0; c < count; ++c)
      pyramid(writer, 10, (static_cast<double>(a) - middle) * 12, (static_cast<double>(c) - middle) * 3);
}

/// Uniform random orientation: Shoemake, "Uniform random rotations", Graphics Gems III (1992).
PlumbQuat random_orientation(double u1, double u2, double u3) {
  const double a = std::sqrt(1 - u1);
  const double b = std::sqrt(u1);
  const double t = 2 * std::numbers::pi;
  return {a * std::sin(t * u2), a * std::cos(t * u2), b * std::sin(t * u3), b * std::cos(t * u3)};
}

void pile(Writer& writer, std::int64_t count, std::uint32_t seed, double spacing, double layer) {
  const auto columns = static_cast<std::int64_t>(std::nearbyint(std::pow(static_cast<double>(count) / 2, 1.0 / 3)));
  const std::int64_t k = std::max<std::int64_t>(columns, 1);
  const std::int64_t layers = (count + k * k - 1) / (k * k);
  const double half = (spacing * static_cast<double>(k) + 2) / 2;
  const double height = layer * static_cast<double>(layers) + 20;
  writer.ground(500);
  int wall = 0;
  for (const double side : {-1.0, 1.0})
    writer.fixed(fmt::format("wall{}", wall++), side < 0 ? "wall_left" : "wall_right",
                 {side * (half + .5), height / 2, 0}, {.5, height / 2, half + 1});
  for (const double side : {-1.0, 1.0})
    writer.fixed(fmt::format("wall{}", wall++), side < 0 ? "wall_back" : "wall_front",
                 {0, height / 2, side * (half + .5)}, {half + 1, height / 2, .5});
  const double middle = static_cast<double>(k - 1) / 2;
  for (std::int64_t j = 0; j < count; ++j) {
    SplitMix64 random(seed, static_cast<std::uint32_t>(j));
    const double jx = random.uniform(), jy = random.uniform(), jz = random.uniform();
    const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
    const auto ix = static_cast<double>(j % k);
    const auto iz = static_cast<double>((j / k) % k);
    const auto iy = static_cast<double>(j / (k * k));
    writer.cube(
        {(ix - middle) * spacing + .2 * jx - .1, 1 + iy * layer + .2 * jy - .1, (iz - middle) * spacing + .2 * jz - .1},
        random_orientation(u1, u2, u3));
  }
}

}  // namespace

std::uint64_t SplitMix64::next() {
  state_ += 0x9E3779B97F4A7C15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

double SplitMix64::uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

const std::vector<std::string>& generator_words() {
  static const std::vector<std::string> words{"pyramid", "manypyramids", "pile", "wide_pile"};
  return words;
}

std::int64_t largest_count(std::size_t generator) {
  constexpr std::int64_t most[] = {1999, 190, most_objects, most_objects};
  return most[generator];
}

std::size_t generated_bodies(std::size_t generator, std::int64_t count) {
  const auto n = static_cast<std::size_t>(count);
  if (generator == 0) return n * (n + 1) / 2;
  return generator == 1 ? 55 * n * n : n;
}

void generate(std::size_t generator, std::int64_t count, std::uint32_t seed, double friction,
              std::vector<SceneShape>& shapes, std::vector<SceneBody>& bodies) {
  Writer writer(friction, shapes, bodies);
  switch (generator) {
    case 0: writer.ground(500); return pyramid(writer, count, 0, 0);
    case 1: writer.ground(std::max(500.0, 6 * static_cast<double>(count) + 50)); return many_pyramids(writer, count);
    case 2: return pile(writer, count, seed, 1.3, 1.5);
    case 3: return pile(writer, count, seed, 2, 2);
    default: throw std::logic_error("a generator beyond generator_words()");
  }
}

}  // namespace plumb::harness
