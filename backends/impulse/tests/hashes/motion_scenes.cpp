// Scenes of bodies that are joined with limits, motors and springs, held along axes, or too fast for a step.
#include "tests/hashes/motion_scenes.hpp"

#include <array>
#include <cmath>

namespace plumb::impulse::test {

namespace {

PlumbJoint join(Scene& scene, PlumbJointDesc desc, PlumbBody a, const PlumbVec3& in_a, PlumbBody b,
                const PlumbVec3& in_b) {
  desc.body_a = a;
  desc.body_b = b;
  desc.frame_a.position = in_a;
  desc.frame_b.position = in_b;
  PlumbJoint id = 0;
  check(scene.world(), scene.world().joints()->create_joints({&desc, 1}, {&id, 1}));
  return id;
}

PlumbBodyDesc of_mass(double mass) {
  PlumbBodyDesc desc = body_desc();
  desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
  desc.mass = mass;
  return desc;
}

}  // namespace

/// Puppets of a trunk and four limbs, which stiffen, kick and break as they fall on a step.
void puppets(Scene& scene) {
  scene.ground();
  scene.add_static(scene.box({1, 0.5, 4}), {0.5, 0.5, 0});
  const PlumbShape trunk = scene.box({0.2, 0.4, 0.15}), limb = scene.capsule(0.08, 0.25);
  PlumbJointDesc hinge = joint_desc(PLUMB_JOINT_HINGE), universal = joint_desc(PLUMB_JOINT_UNIVERSAL),
                 generic = joint_desc(PLUMB_JOINT_GENERIC);
  hinge.limits[3] = {-0.5, 1.2, 1, 0};
  hinge.motors[3] = {4, 20, 1, 0};
  universal.limits[3] = universal.limits[4] = {-0.6, 0.6, 1, 0};
  universal.springs[3] = {0.1, 2, 0.3, 1, 0};
  universal.break_force = 20000;
  hinge.springs[3] = {0.4, 20, 1, 1, PLUMB_SPRING_STIFFNESS};
  generic.springs[4] = {0, 0, 0.5, 1, PLUMB_SPRING_STIFFNESS};
  for (int axis = 0; axis < 6; ++axis) generic.axis_modes[axis] = axis < 3 ? PLUMB_AXIS_LOCKED : PLUMB_AXIS_LIMITED;
  for (int axis = 3; axis < 6; ++axis) generic.limits[axis] = {-0.4, 0.3, 1, 0};
  for (int i = 0; i < 6; ++i) {
    const double x = 0.9 * i - 2, y = 2.5 + 0.2 * i, z = 0.5 * (i % 2);
    const PlumbBody body = scene.add(trunk, {x, y, z});
    const PlumbBody arms[2] = {scene.add(limb, {x - 0.35, y, z}), scene.add(limb, {x + 0.35, y, z})};
    const PlumbBody legs[2] = {scene.add(limb, {x - 0.12, y - 0.8, z}), scene.add(limb, {x + 0.12, y - 0.8, z})};
    join(scene, generic, body, {-0.3, 0.3, 0}, arms[0], {0.05, 0.3, 0});
    join(scene, universal, body, {0.3, 0.3, 0}, arms[1], {-0.05, 0.3, 0});
    join(scene, hinge, body, {-0.12, -0.42, 0}, legs[0], {0, 0.38, 0});
    join(scene, hinge, body, {0.12, -0.42, 0}, legs[1], {0, 0.38, 0});
  }
}

void sockets(Scene& scene) {
  scene.ground();
  scene.add_static(scene.box({0.3, 0.6, 3}), {0.5, 0.6, 0});
  const PlumbShape limb = scene.capsule(0.08, 0.15), head = scene.sphere(0.2);
  PlumbJointDesc socket = joint_desc(PLUMB_JOINT_SWING_TWIST);
  socket.frame_a.orientation = socket.frame_b.orientation = {0, 0, 0.6, 0.8};  // between x and y
  for (int chain = 0; chain < 8; ++chain) {
    const double half = 0.2 + 0.15 * chain;
    socket.limits[3] = {-0.4, 0.1 * chain, chain % 3 != 0 ? 1U : 0U, 0};
    socket.limits[4] = {-half, half, chain != 5 ? 1U : 0U, 0};
    socket.limits[5] = {-0.7, 0.7, chain != 5 ? 1U : 0U, 0};
    socket.motors[3] = {2, 0.5, chain % 4 == 1 ? 1U : 0U, 0};
    socket.springs[3] = {0.1, 3, 0.2, chain % 4 == 2 ? 1U : 0U, PLUMB_SPRING_FREQUENCY};
    PlumbBody before = 0;
    for (int i = 0; i < 8; ++i) {
      const PlumbVec3 at = {0.3 * chain - 1, 1.6 + 0.46 * i, 0.25 * chain - 1};
      const PlumbBody body = i == 7 ? scene.add(head, at) : scene.add(limb, at);
      if (before != 0) join(scene, socket, before, {0, 0.23, 0}, body, {0, -0.23, 0});
      before = body;
    }
    if (chain % 3 == 2) join(scene, socket, 0, {0.3 * chain - 1, 5.2, 0.25 * chain - 1}, before, {0, 0.38, 0});
  }
}

void gears(Scene& scene) {
  scene.ground();
  const double half = std::sqrt(0.5);
  const PlumbQuat to_y{0, 0, half, half}, to_z{0, -half, 0, half};  // of x
  const PlumbShape wheel = scene.box({0.05, 0.2, 0.2}), table = scene.box({0.5, 0.05, 0.5}),
                   box = scene.box({0.2, 0.2, 0.2});
  const auto axle = [&](const PlumbVec3& at, double speed) {
    const PlumbBody body = scene.add(wheel, at, to_z);
    PlumbJointDesc hinge = joint_desc(PLUMB_JOINT_HINGE);
    hinge.frame_a.orientation = to_z;
    hinge.motors[3] = {speed, 400, speed != 0 ? 1U : 0U, 0};
    join(scene, hinge, 0, at, body, {0, 0, 0});
    return body;
  };
  PlumbJointDesc gear = joint_desc(PLUMB_JOINT_GEAR), rack = joint_desc(PLUMB_JOINT_RACK_AND_PINION),
                 slider = joint_desc(PLUMB_JOINT_SLIDER);
  slider.frame_a.orientation = slider.frame_b.orientation = rack.frame_b.orientation = to_y;
  for (int i = 0; i < 6; ++i) {
    const double z = 1.5 * i - 4, y = 1 + 0.1 * i;
    PlumbBody before = axle({-1, y, z}, i % 3 == 2 ? 0 : -6 - i);
    for (int k = 0; k < 1 + i % 4; ++k) {
      const PlumbBody next = axle({-0.7 + 0.3 * k, y, z}, 0);
      gear.ratio = (k % 2 == 0 ? 1.5 : -0.8) + 0.1 * i;
      join(scene, gear, before, {0, 0, 0}, next, {0, 0, 0});
      before = next;
    }
    const PlumbBody lifted = scene.add(table, {1.2, y, z});
    join(scene, slider, 0, {1.2, y, z}, lifted, {0, 0, 0});
    rack.ratio = (i % 2 == 0 ? 5 : -5) - i;
    join(scene, rack, before, {0, 0, 0}, lifted, {-0.5, 0, 0});
    scene.body = of_mass(20 + 60.0 * i);
    for (int k = 0; k < 2; ++k) scene.add(box, {1.2 + 0.05 * k, y + 0.26 + 0.41 * k, z});
    scene.body = body_desc();
  }
  const PlumbBody ring[3] = {axle({-3, 1, 0}, 0), axle({-3, 1, 1}, 5), axle({-3, 1, 2}, 0)};
  for (int i = 0; i < 3; ++i) {
    gear.ratio = -1;
    join(scene, gear, ring[i], {0, 0, 0}, ring[(i + 1) % 3], {0, 0, 0});
  }
  for (int i = 0; i < 4; ++i) {
    const PlumbBody a = scene.add(box, {-4.0 - 0.5 * (i % 2), 1 + 0.5 * i, 0.1 * i});
    const PlumbBody b = scene.add(box, {-4.5 + 0.5 * (i % 2), 1.2 + 0.5 * i, 0.3});
    gear.ratio = 0.5 + i;
    join(scene, gear, a, {0, 0, 0}, b, {0, 0, 0});
  }
}

void led_limbs(Scene& scene) {
  scene.ground();
  scene.add_static(scene.box({0.4, 0.4, 2}), {0.3, 0.4, 0});
  const PlumbShape limb = scene.capsule(0.08, 0.15), box = scene.box({0.2, 0.2, 0.2});
  std::vector<PlumbJoint> led;
  for (int chain = 0; chain < 6; ++chain) {
    PlumbJointDesc socket = joint_desc(PLUMB_JOINT_SWING_TWIST);
    socket.frame_a.orientation = socket.frame_b.orientation = {0, 0, 0.6, 0.8};  // between x and y
    for (std::size_t axis = 3; axis < 6; ++axis)
      socket.springs[axis] = {0, chain % 2 == 0 ? 600.0 : 8.0, chain % 2 == 0 ? 30.0 : 0.5, 1,
                              chain % 2 == 0 ? PLUMB_SPRING_STIFFNESS : PLUMB_SPRING_FREQUENCY};
    socket.limits[3] = {-0.4, 0.3, chain % 3 == 1 ? 1U : 0U, 0};
    socket.limits[4] = {-0.6, 0.6, chain > 2 ? 1U : 0U, 0};
    socket.limits[5] = {-0.9, 0.9, chain > 2 ? 1U : 0U, 0};
    socket.motors[4] = {1.5, 6, chain == 5 ? 1U : 0U, 0};
    PlumbBody before = 0;
    for (int i = 0; i < 6; ++i) {
      const PlumbVec3 at = {0.5 * chain - 1, 1.2 + 0.46 * i, 0.3 * chain - 1};
      const PlumbBody body = scene.add(limb, at);
      if (before != 0) led.push_back(join(scene, socket, before, {0, 0.23, 0}, body, {0, -0.23, 0}));
      before = body;
    }
    scene.add(box, {0.5 * chain - 1, 4.5 + 0.1 * chain, 0.3 * chain - 1});
  }
  scene.before_step = [=](Scene& all, int step) {
    if (step % 20 != 10) return;
    for (std::size_t i = 0; i < led.size(); ++i) {
      const double way = (step / 20 + static_cast<int>(i)) % 3 - 1;
      const std::array<double, 6> rest = {0, 0, 0, 0.2 * way, 0.5 * way, i % 2 == 0 ? -0.4 * way : 0};
      check(all.world(), all.world().joints()->write_joints(PLUMB_JOINT_SPRING_REST, {&led[i], 1},
                                                            const_rows_over(std::span(&rest, 1))));
    }
  };
}

/// Doors swing between limits, pistons are driven back and forth, wheels hang on springs, planks are welded to a bridge
/// that breaks under what falls on it.
void clockwork(Scene& scene) {
  scene.ground();
  const PlumbShape plank = scene.box({0.5, 0.05, 0.3}), block = scene.box({0.3, 0.3, 0.3}), wheel = scene.sphere(0.3);
  PlumbJointDesc door = joint_desc(PLUMB_JOINT_HINGE), piston = joint_desc(PLUMB_JOINT_SLIDER);
  door.limits[3] = {-0.8, 0.6, 1, 0};
  door.motors[3] = {3, 40, 1, 0};
  piston.limits[0] = {-0.7, 0.7, 1, 0};
  piston.motors[0] = {1, 5000, 1, 0};
  std::vector<PlumbJoint> driven;
  for (int i = 0; i < 4; ++i) {
    const double z = 1.5 * i;
    driven.push_back(join(scene, door, 0, {-6, 2, z}, scene.add(plank, {-5.5, 2, z}), {-0.5, 0, 0}));
    driven.push_back(join(scene, piston, 0, {-2, 0.4, z}, scene.add(block, {-2, 0.4, z}), {0, 0, 0}));
    PlumbJointDesc strut = joint_desc(PLUMB_JOINT_DISTANCE);
    strut.rest_length = 1;
    strut.springs[0] = {0, 2.0 + i, 0.1, 1, 0};
    join(scene, strut, 0, {1, 3, z}, scene.add(wheel, {1, 2, z}), {0, 0, 0});
  }
  PlumbJointDesc weld = joint_desc(PLUMB_JOINT_FIXED);
  weld.break_torque = 900;
  PlumbBody before = 0;
  for (int i = 0; i < 6; ++i) {
    const PlumbBody here = scene.add(plank, {4.5 + i, 3, 0});
    join(scene, weld, before, before == 0 ? PlumbVec3{4, 3, 0} : PlumbVec3{0.5, 0, 0}, here, {-0.5, 0, 0});
    before = here;
  }
  join(scene, weld, before, {0.5, 0, 0}, scene.add_static(block, {10.3, 3, 0}), {-0.3, 0, 0});
  scene.before_step = [=](Scene& all, int step) {
    if (step == 60) all.add(block, {7, 5, 0});
    if (step % 50 != 49) return;
    const double way = step % 100 < 50 ? -1 : 1;
    for (std::size_t i = 0; i < driven.size(); ++i) {
      const std::size_t axis = i % 2 == 0 ? 3 : 0;
      std::vector<double> row(12, 0);  // speed and strength of each axis
      row[2 * axis] = way * (axis == 3 ? 3 : 1);
      row[2 * axis + 1] = axis == 3 ? 40 : 5000;
      check(all.world(), all.world().joints()->write_joints(PLUMB_JOINT_MOTOR, {&driven[i], 1},
                                                            ConstRows(reinterpret_cast<const std::byte*>(row.data()), 1,
                                                                      12 * sizeof(double), PLUMB_F64)));
    }
  };
}

/// Bullets through a wall of cubes that stand on a ground, and a spinning rod beside them.
void bullets(Scene& scene) {
  scene.ground();
  const PlumbShape cube = scene.box({0.25, 0.25, 0.25});
  for (int i = 0; i < 40; ++i) scene.add(cube, {2, 0.25 + 0.5 * (i / 10), 0.51 * (i % 10) - 2.3});
  scene.body.flags = PLUMB_BODY_CCD;
  const PlumbShape ball = scene.sphere(0.1), rod = scene.box({0.02, 1, 0.02});
  for (int i = 0; i < 8; ++i) {
    scene.body.linear_velocity = {150.0 + 60 * i, 3, 4.0 - i};
    scene.add(ball, {-20.0 - 7 * i, 0.6 + 0.1 * i, 0.5 * i - 1.7});
  }
  scene.body.linear_velocity = {3, 0, 0};
  scene.body.angular_velocity = {0, 0, 45};
  scene.add(rod, {0, 1.2, 3});
}

/// A cart and a table with boxes on them, a chain that falls into a heap, and a heavy ball that swings on a rope.
void loads(Scene& scene) {
  scene.ground();
  const PlumbShape hull = scene.box({1.5, 0.25, 0.7}), wheel = scene.sphere(0.35), crate = scene.box({0.4, 0.4, 0.4});
  scene.body = of_mass(800);
  const PlumbBody cart = scene.add(hull, {0, 0.6, 0});
  for (const PlumbVec3& at : {PlumbVec3{1, 0, 0.9}, {1, 0, -0.9}, {-1, 0, 0.9}, {-1, 0, -0.9}}) {
    scene.body = of_mass(15);
    PlumbJointDesc axle = joint_desc(PLUMB_JOINT_HINGE);
    axle.frame_a.orientation = axle.frame_b.orientation = {0, -std::sqrt(0.5), 0, std::sqrt(0.5)};  // about z
    join(scene, axle, cart, {at.x, -0.25, at.z}, scene.add(wheel, {at.x, 0.35, at.z}), {0, 0, 0});
  }
  scene.body = of_mass(2000);
  scene.add(crate, {0, 1.25, 0});

  const PlumbShape plate = scene.box({0.8, 0.03, 0.5}), leg = scene.box({0.03, 0.35, 0.03});
  scene.body = of_mass(30);
  const PlumbBody top = scene.add(plate, {6, 0.73, 0});
  for (const PlumbVec3& at : {PlumbVec3{0.7, 0, 0.4}, {0.7, 0, -0.4}, {-0.7, 0, 0.4}, {-0.7, 0, -0.4}}) {
    scene.body = of_mass(2);
    join(scene, joint_desc(PLUMB_JOINT_FIXED), top, {at.x, -0.03, at.z}, scene.add(leg, {6 + at.x, 0.35, at.z}),
         {0, 0.35, 0});
  }
  scene.body = of_mass(300);
  scene.add(crate, {6, 1.16, 0});

  const PlumbShape link = scene.capsule(0.05, 0.15), ball = scene.sphere(0.25);
  PlumbBody before = 0;
  for (int i = 0; i < 10; ++i) {
    scene.body = of_mass(5);
    const PlumbBody here = scene.add(link, {-6 + 0.002 * (i % 3), 0.7 + 0.4 * i, 0.001 * i});
    if (before != 0) scene.ball_joint(before, {0, 0.2, 0}, here, {0, -0.2, 0});
    before = here;
  }
  before = 0;
  for (int i = 0; i < 12; ++i) {
    scene.body = of_mass(0.1);
    const PlumbBody here = scene.add(link, {0.2 + 0.4 * i, 8, 4}, {0, 0, std::sqrt(0.5), std::sqrt(0.5)});
    scene.ball_joint(before, before == 0 ? PlumbVec3{0, 8, 4} : PlumbVec3{0, -0.2, 0}, here, {0, 0.2, 0});
    before = here;
  }
  scene.body = of_mass(100);
  scene.ball_joint(before, {0, -0.2, 0}, scene.add(ball, {5.05, 8, 4}), {-0.25, 0, 0});
}

/// A heap in a plane, pushed by bodies that only slide or only turn.
void held(Scene& scene) {
  scene.container(4, 30);
  scene.body.locks = PLUMB_LOCK_LINEAR_Z | PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Y;
  const PlumbShape brick = scene.box({0.4, 0.25, 0.3}), ball = scene.sphere(0.3);
  for (int i = 0; i < 40; ++i) scene.add(i % 3 == 0 ? ball : brick, {1.1 * (i % 6) - 2.8, 1 + 0.8 * (i / 6), 0});
  scene.body.locks = PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Y | PLUMB_LOCK_ANGULAR_Z;
  scene.body.linear_velocity = {5, 0, 0};
  for (int i = 0; i < 4; ++i) scene.add(brick, {-3, 4.0 + i, 1.5});
  scene.body.locks = PLUMB_LOCK_LINEAR_X | PLUMB_LOCK_LINEAR_Y | PLUMB_LOCK_ANGULAR_X;
  scene.body.angular_velocity = {0, 2, 5};
  for (int i = 0; i < 3; ++i) scene.add(brick, {1.0 * i - 1, 2.0 + i, -2});
}

}  // namespace plumb::impulse::test
