// Meshes and height fields that become others while the world goes on: as if they had been made so, wherever they are
// another, and as if nothing had happened elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;
constexpr std::uint32_t kCells = 24;
constexpr double kSide = 0.5;

using Height = std::function<double(double, double)>;

/// A ground as a mesh, as one whose triangles share no vertices, or as a height field.
enum class Kind { kMesh, kSoup, kField };
constexpr Kind kKinds[] = {Kind::kMesh, Kind::kSoup, Kind::kField};

struct Ground {
  Ground(Kind kind, const Height& height) : kind_(kind), set_(grid(kCells, kSide, height)) {
    for (std::size_t i = 1; i < set_.vertices.size(); i += 3) heights_.push_back(set_.vertices[i]);
    if (kind != Kind::kSoup) return;
    const TriangleSet joined = std::exchange(set_, {});
    for (const std::uint32_t i : joined.indices)
      set_.indices.push_back(set_.add(joined.vertices[3 * i], joined.vertices[3 * i + 1], joined.vertices[3 * i + 2]));
  }
  [[nodiscard]] PlumbShapeDesc desc() const {
    return kind_ == Kind::kField ? field_desc(heights_, kCells + 1, kCells + 1, kSide) : set_.desc();
  }

 private:
  Kind kind_;
  TriangleSet set_;
  std::vector<double> heights_;
};

void become(Scene& scene, PlumbShape shape, const PlumbShapeDesc& desc) {
  check(scene.world(), scene.world().modify()->modify_shapes({&shape, 1}, {&desc, 1}));
}

double flat(double, double) { return 0; }
double bumps(double x, double z) { return 0.3 * std::sin(1.3 * x) * std::cos(0.9 * z); }
/// From another middle on: the shape's own frame is elsewhere.
double hills(double x, double z) { return 0.2 + 0.8 * std::sin(0.7 * x + 0.4) * std::cos(0.5 * z); }
/// A pit in bumps, no deeper than the bumps are.
double pitted(double x, double z) { return std::abs(x) < 1.2 && std::abs(z) < 1.2 ? -0.29 : bumps(x, z); }

/// Level between walls and ditches, so that a floor that is a little elsewhere leaves the shape's box as it is.
Height sunk(double depth) {
  return [depth](double x, double z) { return std::abs(x) < 3 ? depth : 0.5 * std::copysign(1.0, z); };
}

std::vector<PlumbBody> drop_some(Scene& scene, double height = 1.6) {
  const PlumbShape shapes[] = {scene.box({0.3, 0.2, 0.25}), scene.sphere(0.25), scene.capsule(0.15, 0.25)};
  std::vector<PlumbBody> bodies;
  for (int i = 0; i < 25; ++i)
    bodies.push_back(scene.add(shapes[i % 3], {1.5 * (i % 5 - 2), height + 0.1 * (i % 4), 1.5 * (i / 5 - 2)}));
  return bodies;
}

TEST(ChangedSurfaces, AreWhatTheyWouldBeHadTheyBeenMadeSo) {
  const Height ways[][2] = {{flat, bumps}, {bumps, pitted}, {bumps, hills}, {hills, flat}, {pitted, bumps}};
  for (const Kind kind : kKinds)
    for (const auto& [before, after] : ways) {
      const Ground first(kind, before), then(kind, after);
      Scene changed(engine(), kNeeds, kDown, 1), made(engine(), kNeeds, kDown, 1);
      const PlumbShape shape = changed.make(first.desc());
      changed.add_static(shape, {0, 0, 0});
      made.add_static(made.make(then.desc()), {0, 0, 0});
      drop_some(changed);
      drop_some(made);
      become(changed, shape, then.desc());
      for (int i = 0; i < 40; ++i) {
        changed.run(5);
        made.run(5);
        ASSERT_EQ(changed.hash(), made.hash()) << static_cast<int>(kind) << ", after " << 5 * (i + 1) << " steps";
      }
    }
}

/// Other triangles, other materials: in place of what was there.
TEST(ChangedSurfaces, MayHaveOtherTrianglesAndMaterials) {
  const TriangleSet fine = grid(kCells, kSide, bumps), coarse = grid(kCells / 4, 4 * kSide, flat);
  const PlumbMaterial ice = {0.01, 0, {}}, sand = {0.9, 0, {}};
  for (const bool with_materials : {false, true}) {
    PlumbShapeDesc desc = coarse.desc();
    const std::vector<std::uint32_t> all_first(desc.triangle_count, 0);
    desc.materials = &sand;
    desc.material_count = with_materials ? 1 : 0;
    desc.triangle_materials = all_first.data();
    Scene changed(engine(), kNeeds, kDown, 1), made(engine(), kNeeds, kDown, 1);
    const PlumbShape shape = changed.make(fine.desc());
    made.add_static(made.make(desc), {0, 0, 0});
    changed.add_static(shape, {0, 0, 0});
    drop_some(changed);
    drop_some(made);
    become(changed, shape, desc);
    changed.run(60);
    made.run(60);
    EXPECT_EQ(changed.hash(), made.hash());
    if (!with_materials) continue;
    desc.materials = &ice;  // the same triangles
    become(changed, shape, desc);
    changed.body.linear_velocity = {3, 0, 0};
    changed.body.material = {1, 0, {}};
    const PlumbBody box = changed.add(changed.box({0.2, 0.1, 0.2}), {-5, 0.1, 5.3});
    changed.run(30);
    EXPECT_NEAR(changed.velocity(box)[0], 3 - 0.5 * 0.1 * 9.81, 0.02);
  }
}

/// What lies still is not looked for anew in every step: not where the ground goes away under it by less than its box.
TEST(ChangedSurfaces, WhatLiesOnThemFollows) {
  for (const Kind kind : kKinds) {
    Scene scene(engine(), kNeeds, kDown, 1);
    const PlumbShape shape = scene.make(Ground(kind, sunk(0)).desc());
    scene.add_static(shape, {0, 0, 0});
    const PlumbBody box = scene.add(scene.box({0.5, 0.25, 0.5}), {0.1, 0.25, 0.1});
    scene.run(90);
    const auto height = [&] { return scene.poses().back().position.y; };
    EXPECT_NEAR(height(), 0.25, 1e-3);
    for (int i = 1; i <= 4; ++i) {
      become(scene, shape, Ground(kind, sunk(-0.002 * i)).desc());
      scene.run(20);
      EXPECT_NEAR(height(), 0.25 - 0.002 * i, 2e-4) << static_cast<int>(kind);
    }
    become(scene, shape, Ground(kind, sunk(0.02)).desc());
    scene.run(60);
    EXPECT_NEAR(height(), 0.27, 1e-3);
    EXPECT_LT(std::abs(scene.velocity(box)[1]), 1e-3);
  }
}

/// Dug here and there before one step, and then far away in every step: who lies elsewhere keeps each bit.
TEST(ChangedSurfaces, ElsewhereNothingHappens) {
  for (const Kind kind : kKinds) {
    const auto pits = [](double left, double right) {
      return [=](double x, double z) {
        if (std::abs(std::abs(x) - 2) < 1.2 && z < -3) return x < 0 ? left : right;
        return std::abs(x) > 5.7 ? std::copysign(1.0, z) : 0.0;
      };
    };
    Scene digging(engine(), kNeeds, kDown, 1), quiet(engine(), kNeeds, kDown, 1);
    PlumbShape shapes[2];
    PlumbBody here = 0, there = 0;
    for (Scene* scene : {&digging, &quiet}) {
      PlumbShape& shape = shapes[scene == &quiet ? 1 : 0];
      shape = scene->make(Ground(kind, flat).desc());
      scene->add_static(shape, {0, 0, 0});
      const PlumbShape box = scene->box({0.3, 0.2, 0.25});
      for (int i = 0; i < 9; ++i) scene->add(box, {1.5 * (i % 3 - 1) + 0.1, 0.25, 1.5 * (i / 3)});
      here = scene->add(box, {-2, 0.2, -4.5});
      there = scene->add(box, {2, 0.2, -4.5});
      become(*scene, shape, Ground(kind, pits(0, 0)).desc());  // the corners are as high and deep as anything will be
      scene->run(60);
    }
    become(digging, shapes[0], Ground(kind, pits(-0.4, 0)).desc());
    become(digging, shapes[0], Ground(kind, pits(-0.4, -0.4)).desc());
    digging.run(2);
    quiet.run(2);
    EXPECT_LT(digging.velocity(here)[1], -0.2) << "where it was dug first";
    EXPECT_LT(digging.velocity(there)[1], -0.2);
    for (int i = 0; i < 40; ++i) {
      become(digging, shapes[0], Ground(kind, pits(-0.4 - 0.01 * i, -0.4)).desc());
      digging.run(1);
      quiet.run(1);
      const std::vector<PlumbPose> with = digging.poses(), without = quiet.poses();
      for (std::size_t b = 1; b <= 9; ++b)
        ASSERT_EQ(std::memcmp(&with[b], &without[b], sizeof with[b]), 0) << "body " << b << ", step " << i;
    }
  }
}

TEST(ChangedSurfaces, WakeWhoSleepsWhereTheyAreAnother) {
  for (const Kind kind : kKinds)
    for (const bool deep : {false, true}) {  // deeper than all the rest: the shape's frame is another
      const auto dug = [deep](double x, double z) {
        return std::abs(x) < 1.2 && std::abs(z) < 1.2 ? (deep ? -2.0 : -0.4) : x > 5.7 ? -0.5 * z / 6 : 0.0;
      };
      const auto level = [](double x, double z) { return x > 5.7 ? -0.5 * z / 6 : 0.0; };
      const auto raised = [&](double x, double z) {
        return std::abs(x + 4) < 0.6 && std::abs(z) < 0.6 ? 0.4 : level(x, z);
      };
      Scene scene(engine(), kNeeds | PLUMB_NEED_SLEEPING, kDown, 1);
      const PlumbShape shape = scene.make(Ground(kind, level).desc());
      scene.add_static(shape, {0, 0, 0});
      scene.add_static(scene.box({0.5, 0.05, 0.5}), {-4, 0.2, 0});  // a table under which the ground will rise
      const PlumbShape cube = scene.box({0.25, 0.25, 0.25});
      const PlumbBody over = scene.add(cube, {0, 0.25, 0}), far = scene.add(cube, {4, 0.25, 4}),
                      on_table = scene.add(cube, {-4, 0.5, 0});
      const auto awake = [&](PlumbBody body) {
        double row = 0;
        check(scene.world(), scene.world().read(PLUMB_FIELD_AWAKE, {&body, 1}, rows_over(std::span(&row, 1))));
        return row != 0;
      };
      scene.run(200);
      ASSERT_FALSE(awake(over) || awake(far) || awake(on_table));
      become(scene, shape, Ground(kind, dug).desc());
      EXPECT_TRUE(awake(over));
      EXPECT_FALSE(awake(far));
      EXPECT_FALSE(awake(on_table));
      scene.run(60);
      EXPECT_LT(scene.velocity(over)[1], 0.01);
      become(scene, shape, Ground(kind, raised).desc());
      EXPECT_TRUE(awake(on_table)) << "it touches the ground only now";
      EXPECT_FALSE(awake(far));
    }
}

/// Saved between a change and the step after it: nothing of the ground that was may be carried on.
TEST(ChangedSurfaces, AreKnownToSnapshots) {
  for (const Kind kind : kKinds) {
    const Ground before(kind, sunk(0)), after(kind, sunk(-0.01));
    const PlumbNeeds needs = kNeeds | PLUMB_NEED_SNAPSHOT;
    Scene scene(engine(), needs, kDown, 1), other(engine(), needs, kDown, 1);
    const PlumbShape shape = scene.make(before.desc());
    scene.add_static(shape, {0, 0, 0});
    other.add_static(other.make(after.desc()), {0, 0, 0});
    for (Scene* filled : {&scene, &other}) {
      drop_some(*filled);
      filled->add(filled->box({0.5, 0.25, 0.5}), {0.1, 0.25, 0.75});
    }
    scene.run(240);
    become(scene, shape, after.desc());
    std::span<const std::byte> lent;
    check(scene.world(), scene.world().snapshot()->save_world(lent));
    const std::vector<std::byte> saved(lent.begin(), lent.end());
    std::vector<std::uint64_t> states;
    for (int i = 0; i < 60; ++i) {
      scene.run(1);
      states.push_back(scene.hash());
    }
    for (Scene* again : {&scene, &other}) {
      check(again->world(), again->world().snapshot()->restore(saved));
      for (const std::uint64_t state : states) {
        again->run(1);
        ASSERT_EQ(again->hash(), state);
      }
    }
    become(scene, shape, before.desc());
    EXPECT_EQ(scene.world().snapshot()->restore(saved), PLUMB_E_CORRUPT);
  }
}

/// Two platforms of one shape: one that is carried along, and one that stands askew. A pit opens in both.
TEST(ChangedSurfaces, MayBeOfBodiesThatMove) {
  for (const Kind kind : kKinds) {
    Scene scene(engine(), kNeeds | PLUMB_NEED_KINEMATIC | PLUMB_NEED_SLEEPING, kDown, 1);
    const PlumbShape shape = scene.make(Ground(kind, flat).desc());
    const PlumbBody platform = scene.add_kinematic(shape, {0, 0, 0});
    const double half_turn = 0.4;
    scene.add_static(shape, {50, 0, 0}, {0, std::sin(half_turn), 0, std::cos(half_turn)});
    scene.body.material.friction = 0.9;
    const PlumbShape cube = scene.box({0.25, 0.25, 0.25});
    const PlumbBody rides = scene.add(cube, {4, 0.25, 4}), falls = scene.add(cube, {0, 0.25, 0}),
                    askew = scene.add(cube, {50, 0.25, 0});
    double x = 0;
    scene.before_step = [&](Scene& at, int) { at.target(platform, {x += 0.005, 0, 0}); };
    scene.run(60);
    become(scene, shape, Ground(kind, [](double at, double z) {
                           return std::abs(at) < 1.7 && std::abs(z) < 1.7 ? -1.0 : 0.0;
                         }).desc());
    scene.run(120);
    const auto at = [&](PlumbBody body) {
      PlumbPose pose{};
      check(scene.world(), scene.world().read(PLUMB_FIELD_POSE, {&body, 1}, rows_over(std::span(&pose, 1))));
      return pose.position;
    };
    EXPECT_NEAR(at(rides).x, 4 + x, 0.02);
    EXPECT_NEAR(at(rides).y, 0.25, 1e-3);
    EXPECT_NEAR(at(falls).y, -0.75, 1e-3);
    EXPECT_NEAR(at(askew).y, -0.75, 1e-3);
  }
}

TEST(ChangedSurfaces, AreSeenByQueries) {
  for (const Kind kind : kKinds) {
    Scene scene(engine(), kNeeds | PLUMB_NEED_QUERIES, kDown, 1);
    const PlumbShape shape = scene.make(Ground(kind, bumps).desc());
    scene.add_static(shape, {0, 0, 0});
    const auto ground_at = [&](double x, double z) {
      const PlumbRay ray = {{x, 5, z}, {0, -10, 0}, {1, ~0U, 0, 0}};
      const Hits hits = scene.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1});
      return hits.hits.empty() ? NAN : 5 - 10 * hits.hits[0].fraction;
    };
    EXPECT_NEAR(ground_at(0.5, 0.5), bumps(0.5, 0.5), 1e-5);
    for (const Height& now : {Height(pitted), Height(hills)}) {
      become(scene, shape, Ground(kind, now).desc());
      for (const double x : {-3.0, 0.5, 4.5}) EXPECT_NEAR(ground_at(x, 0.5), now(x, 0.5), 1e-5);
    }
  }
}

/// Waves under fifty bodies, another ground in every step, for six seconds: they are carried up and down, and never
/// get faster than waves and falls make them.
TEST(ChangedSurfaces, MayBeOthersInEveryStep) {
  for (const double dt : {1.0 / 30, 1.0 / 240})
    for (const Kind kind : {Kind::kMesh, Kind::kField}) {
      Scene scene(engine(), kNeeds | PLUMB_NEED_SLEEPING | PLUMB_NEED_CCD, kDown, 2);
      const auto wave = [](double t) {
        return [t](double x, double z) {
          const double rim = std::max(std::abs(x), std::abs(z)) > 5.6 ? 1.5 : 0;
          return rim + 0.15 * std::sin(1.1 * x + 1.7 * t) * std::cos(0.8 * z);
        };
      };
      const PlumbShape shape = scene.make(Ground(kind, wave(0)).desc());
      scene.add_static(shape, {0, 0, 0});
      std::vector<PlumbBody> bodies = drop_some(scene);
      for (const PlumbBody body : drop_some(scene, 2.6)) bodies.push_back(body);
      double fastest = 0, lowest = 9;
      for (int i = 0; i < static_cast<int>(6 / dt); ++i) {
        become(scene, shape, Ground(kind, wave(i * dt)).desc());
        PlumbStepReport report{};
        check(scene.world(), scene.world().step(dt));
        check(scene.world(), scene.world().wait(report));
        if (i * dt < 2) continue;
        for (const PlumbBody body : bodies) fastest = std::max(fastest, std::abs(scene.velocity(body)[1]));
        for (const PlumbPose& pose : scene.poses()) lowest = std::min(lowest, pose.position.y);
      }
      EXPECT_LT(fastest, 4) << dt;
      EXPECT_GT(lowest, -0.3) << dt;
    }
}

}  // namespace
}  // namespace plumb::impulse::test
