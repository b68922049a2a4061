#include "tests/hashes/change_scenes.hpp"

#include <memory>

#include "tests/hashes/shape_scenes.hpp"

namespace plumb::impulse::test {

namespace {

/// One in which every other change takes the last one back, so that the heap stays one.
PlumbBodyChange changed_body(Random& random, PlumbBody body, const std::vector<PlumbShape>& shapes) {
  PlumbBodyChange change = body_change(body);
  change.mass_mode = PLUMB_MASS_FROM_DENSITY;
  change.density = random.between(500, 2000);
  change.shape = shapes[static_cast<std::size_t>(random.next() % shapes.size())];
  const bool back = random.next() % 2 == 0;
  switch (random.next() % 5) {
    case 0:
      change.what = PLUMB_MODIFY_MOTION;
      change.motion = back ? PlumbMotion{PLUMB_DYNAMIC} : static_cast<PlumbMotion>(random.next() % PLUMB_MOTION_COUNT);
      return change;
    case 1:
      change.what = PLUMB_MODIFY_MOTION | PLUMB_MODIFY_SHAPE | PLUMB_MODIFY_MASS;
      change.motion = PLUMB_DYNAMIC;
      return change;
    case 2: change.what = PLUMB_MODIFY_SHAPE; return change;
    case 3:
      change.what = PLUMB_MODIFY_MOTION | PLUMB_MODIFY_MASS | PLUMB_MODIFY_FLAGS;
      change.motion = PLUMB_DYNAMIC;
      change.flags = back ? 0 : static_cast<std::uint32_t>(PLUMB_BODY_NO_ROTATION);
      return change;
    default:
      change.what = PLUMB_MODIFY_LOCKS;
      change.locks = back ? 0 : static_cast<std::uint32_t>(random.next() % 64);
      return change;
  }
}

PlumbJointChange changed_joint(Random& random, PlumbJoint joint) {
  PlumbJointChange change = joint_change(joint);
  change.what = 1U << (random.next() % PLUMB_MODIFY_JOINT_COUNT);
  const std::uint32_t on = random.next() % 3 == 0 ? 0 : 1;
  change.enabled = change.collide_connected = on;
  change.frame_a.position = {0, -0.4 + random.between(-0.02, 0.02), 0};
  change.frame_b.position = {0, 0.4 + random.between(-0.02, 0.02), 0};
  change.limits[3] = {-random.between(0.1, 0.5), random.between(0.1, 0.5), on, 0};
  change.motors[3] = {random.between(-2, 2), 50, on, 0};
  change.springs[3] = {0, random.between(1, 3), 0.3, on, 0};
  change.break_force = on * 1e30;
  return change;
}

}  // namespace

void changers(Scene& scene) {
  scene.container(2, 20);
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  std::vector<PlumbBody> bodies;
  std::vector<PlumbJoint> joints;
  for (int i = 0; i < 40; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 700);
    const PlumbQuat turn = random.turn();
    const PlumbVec3 at = {0.8 * (i % 4) - 1.2, 0.6 + 0.7 * (i / 16), 0.8 * (i / 4 % 4) - 1.2};
    bodies.push_back(scene.add(shapes[static_cast<std::size_t>(i) % shapes.size()], at, turn));
  }
  PlumbBody above = scene.add_static(shapes[0], {0, 6, 0});
  for (int i = 0; i < 6; ++i) {
    const PlumbBody link = scene.add(shapes[2], {0, 5.2 - 0.8 * i, 0});
    PlumbJointDesc hinge = joint_desc(PLUMB_JOINT_HINGE);
    hinge.body_a = above;
    hinge.body_b = link;
    hinge.frame_a.position = {0, -0.4, 0};
    hinge.frame_b.position = {0, 0.4, 0};
    joints.push_back(scene.join(hinge));
    above = link;
  }
  scene.before_step = [=](Scene& all, int step) {
    Random random(static_cast<std::uint64_t>(step) + 7000);
    const std::size_t first = random.next() % bodies.size();
    std::vector<PlumbBodyChange> changes;
    for (std::size_t i = 0; i < 3; ++i)
      changes.push_back(changed_body(random, bodies[(first + 7 * i) % bodies.size()], shapes));
    for (const PlumbBodyChange& change : changes) all.modify(change);
    if (step % 5 == 0)
      all.modify(changed_joint(random, joints[static_cast<std::size_t>(random.next() % joints.size())]));
  };
}

void sieves(Scene& scene) {
  scene.container(3, 20);
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  scene.body.flags = PLUMB_BODY_MODIFY_CONTACTS;
  const PlumbBody shelf = scene.add_static(scene.box({2, 0.1, 2}), {0, 1.5, 0});
  for (int i = 0; i < 60; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 300);
    const PlumbQuat turn = random.turn();
    scene.body.flags = i % 4 == 3 ? 0U : static_cast<std::uint32_t>(PLUMB_BODY_MODIFY_CONTACTS);
    if (i % 10 == 4) scene.body.flags |= PLUMB_BODY_CCD;
    scene.body.material.restitution = i % 3 == 0 ? 0.5 : 0;
    const PlumbVec3 at = {1.2 * (i % 4) - 1.8, 0.6 + 1.1 * (i / 16), 1.2 * (i / 4 % 4) - 1.8};
    const PlumbBody thrown = scene.add(shapes[static_cast<std::size_t>(i) % shapes.size()], at, turn);
    if (i % 2 == 0) scene.write(PLUMB_FIELD_VELOCITY, thrown, {0, 12, 0, 1, 2, 3});
  }
  const auto now = std::make_shared<int>(0);
  scene.before_step = [now](Scene& /*all*/, int step) { *now = step; };
  scene.modify_contacts = [shelf, now](std::span<const PlumbManifold> rows, std::vector<PlumbManifoldChange>& changes) {
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
      const PlumbManifold& found = rows[row];
      PlumbManifoldChange change = manifold_change(row);
      const bool of_shelf = found.body_a == shelf || found.body_b == shelf;
      const double up = found.body_a == shelf ? 1 : -1;
      if (of_shelf && (up * found.normal.y < 0.5 || up * found.velocity.y > 0.5)) change.what = PLUMB_MANIFOLD_DISABLED;
      if (!of_shelf) {
        const auto patch = static_cast<std::uint32_t>(found.position[0].x + found.position[0].z + 100 + *now / 60);
        constexpr std::uint32_t kWhat[] = {0, PLUMB_MANIFOLD_FRICTION, PLUMB_MANIFOLD_SURFACE_VELOCITY,
                                           PLUMB_MANIFOLD_RESTITUTION | PLUMB_MANIFOLD_FRICTION};
        change.what = kWhat[patch % 4];
        change.friction = patch % 3 == 0 ? 1.5 : 0;
        change.restitution = 0.25 * (patch % 5);
        change.surface_velocity = {0.5, 0, -0.25 * (patch % 3)};
      }
      if (change.what != 0) changes.push_back(change);
    }
  };
}

}  // namespace plumb::impulse::test
