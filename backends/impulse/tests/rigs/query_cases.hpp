// What the benchmarks of queries measure, on the CPU and on a CUDA device: rays against a pile of boxes in its
// container, the boxes around balls and in cubes where the rays begin; and a hash of the hits, which must be the same
// on both.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "tests/rigs/box_fields.hpp"
#include "tests/rigs/query_rig.hpp"

namespace plumb::impulse {

/// `boxes` cubes of 1 m thrown into a container so that they overlap as little as in a pile that has settled: two cubes
/// in three cubic metres of it.
class QueryBench {
 public:
  QueryBench(std::uint32_t boxes, std::uint32_t rays, std::uint32_t threads) : rig(threads) {
    FieldDice dice(11);
    cube_ = rig.add_shape(make({Real(.5), Real(.5), Real(.5)}));
    ball_ = rig.add_shape({ShapeType::kSphere, 0, {Real(.1), 0, 0}, Real(.1)});
    const auto across = static_cast<std::uint32_t>(std::lround(cube_root(boxes)));
    const double pitch = 1.145, half = .5 * pitch * across;  // 1.5 m3 a cube
    for (std::uint32_t i = 0; i < boxes; ++i) {
      const Vec shake = dice.in_cube(Real(.1));
      const Position at = {pitch * (i % across + .5) - half + static_cast<double>(shake.x),
                           pitch * (i / across / across + .5) + static_cast<double>(shake.y),
                           pitch * (i / across % across + .5) - half + static_cast<double>(shake.z)};
      rig.add(cube_, at, turn(dice), true);
    }
    const auto size = static_cast<Real>(half);
    const std::uint32_t ground = rig.add_shape(make({100, 1, 100})),
                        wall = rig.add_shape(make({1, 4 * size, size + 2})),
                        side = rig.add_shape(make({size + 2, 4 * size, 1}));
    const Quat upright = {0, 0, 0, 1};
    rig.add(ground, {0, -1, 0}, upright, false);
    for (const double s : {-1.0, 1.0}) {
      rig.add(wall, {s * (half + 1.2), 2 * half, 0}, upright, false);
      rig.add(side, {0, 2 * half, s * (half + 1.2)}, upright, false);
    }
    rig.update({0, half, 0});
    rays_ = rays_into(dice, rays, half);
  }

  /// The whole call, with the way of the rays there and of the hits back.
  void ask() { hits_ = rig.rays(PLUMB_HIT_CLOSEST, rays_); }
  [[nodiscard]] const std::vector<PlumbRay>& rays() const { return rays_; }
  /// A ball of 10 cm where each ray begins, for what is within `most` metres.
  [[nodiscard]] std::vector<PlumbProbe> probes(double most) const {
    std::vector<PlumbProbe> probes;
    for (const PlumbRay& ray : rays_)
      probes.push_back({std::uint64_t{1} << 32 | ball_, {ray.origin, {0, 0, 0, 1}}, most, ray.filter});
    return probes;
  }
  /// A cube of 1 m where each ray begins.
  [[nodiscard]] std::vector<PlumbOverlap> cubes() const {
    std::vector<PlumbOverlap> cubes;
    for (const PlumbRay& ray : rays_)
      cubes.push_back({std::uint64_t{1} << 32 | cube_, {ray.origin, {0, 0, 0, 1}}, ray.filter});
    return cubes;
  }
  /// A cube of 1 m moved a ray's first 5 m, and turned on the way by `turn` rad about some axis.
  [[nodiscard]] std::vector<PlumbTurningCast> turning_cubes(double turn) const {
    std::vector<PlumbTurningCast> casts;
    for (const PlumbRay& ray : rays_) {
      const PlumbVec3& t = ray.translation;
      const double length = std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z), k = 5 / length, r = turn / length;
      casts.push_back({std::uint64_t{1} << 32 | cube_,
                       {ray.origin, {0, 0, 0, 1}},
                       {k * t.x, k * t.y, k * t.z},
                       {r * t.y, r * t.z, r * t.x},
                       ray.filter});
    }
    return casts;
  }
  /// The same without turning.
  [[nodiscard]] std::vector<PlumbCast> cast_cubes() const {
    std::vector<PlumbCast> casts;
    for (const PlumbTurningCast& cast : turning_cubes(0))
      casts.push_back({cast.shape, cast.pose, cast.translation, cast.filter});
    return casts;
  }
  /// FNV-1a over the hits of the last call.
  [[nodiscard]] std::uint64_t hash() const {
    std::uint64_t h = 0xCBF29CE484222325U;
    const auto* bytes = reinterpret_cast<const unsigned char*>(hits_.data());
    for (std::size_t i = 0; i < hits_.size_bytes(); ++i) h = (h ^ bytes[i]) * 0x100000001B3U;
    return h;
  }
  [[nodiscard]] std::size_t found() const {
    std::size_t count = 0;
    for (const PlumbHit& hit : hits_) count += hit.body != 0 ? 1 : 0;
    return count;
  }

  QueryRig rig;

 private:
  static Shape make(const Vec& half) { return {ShapeType::kBox, 0, half, length(half)}; }
  static Quat turn(FieldDice& dice) {
    for (;;) {  // a point of the ball, drawn from the cube, put on the sphere
      const Quat q = {dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)};
      const Real square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
      if (square < 1 && square > Real(.01)) return normalized(q);
    }
  }
  /// From anywhere above and within the container to anywhere within: what looks, listens and shoots there.
  static std::vector<PlumbRay> rays_into(FieldDice& dice, std::uint32_t count, double half) {
    std::vector<PlumbRay> rays(count);
    const auto within = [&](double height) {
      const Vec v = dice.in_cube(1);
      return PlumbVec3{half * static_cast<double>(v.x), height * (1 + static_cast<double>(v.y)),
                       half * static_cast<double>(v.z)};
    };
    for (PlumbRay& ray : rays) {
      const PlumbVec3 from = within(2 * half), to = within(half);
      ray = {from, {2 * (to.x - from.x), 2 * (to.y - from.y), 2 * (to.z - from.z)}, {1, ~0U, 0, 0}};
    }
    return rays;
  }

  std::uint32_t cube_, ball_;
  std::vector<PlumbRay> rays_;
  std::span<const PlumbHit> hits_;
};

}  // namespace plumb::impulse
