// The scenes whose hashes are recorded.
#include "tests/hashes/busy_scenes.hpp"
#include "tests/hashes/change_scenes.hpp"
#include "tests/hashes/motion_scenes.hpp"
#include "tests/hashes/scene.hpp"
#include "tests/hashes/shape_scenes.hpp"
#include "tests/rigs/drawers.hpp"

namespace plumb::impulse::test {

namespace {

constexpr PlumbNeeds kContactNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;

void tower(Scene& scene) {
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  for (int i = 0; i < 20; ++i) scene.add(cube, {0, 0.5 + i, 0});
}

void pyramid(Scene& scene, int rows, double x, double z) {
  scene.ground(x, z);
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < rows - row; ++i) scene.add(cube, {x + 1.05 * (i - 0.5 * (rows - row - 1)), 0.5 + row, z});
}
void pyramid_20(Scene& scene) { pyramid(scene, 20, 0, 0); }
void pyramid_10(Scene& scene) { pyramid(scene, 10, 0, 0); }
void pyramid_far(Scene& scene) { pyramid(scene, 10, 1e5, 1e5); }

/// n bodies in a container of k by k columns, each a little off its place and turned at random.
void pile(Scene& scene, int n, int k, const std::vector<PlumbShape>& shapes) {
  const int layers = (n + k * k - 1) / (k * k);
  scene.container((1.3 * k + 2) / 2, 1.5 * layers + 20);
  for (int i = 0; i < n; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const double middle = (k - 1) / 2.0;
    const PlumbVec3 place = {(i % k - middle) * 1.3 + random.between(-0.1, 0.1),
                             1 + i / (k * k) * 1.5 + random.between(-0.1, 0.1),
                             (i / k % k - middle) * 1.3 + random.between(-0.1, 0.1)};
    scene.add(shapes[static_cast<std::size_t>(i) % shapes.size()], place, random.turn());
  }
}
void pile_of_boxes(Scene& scene) { pile(scene, 1000, 8, {scene.box({0.5, 0.5, 0.5})}); }
void pile_of_spheres(Scene& scene) { pile(scene, 500, 7, {scene.sphere(0.5), scene.sphere(0.4), scene.sphere(0.6)}); }
void pile_of_all(Scene& scene) {
  const std::vector<PlumbVec3> octahedron = {{0.6, 0, 0},  {-0.6, 0, 0}, {0, 0.6, 0},
                                             {0, -0.6, 0}, {0, 0, 0.6},  {0, 0, -0.6}};
  const std::vector<PlumbVec3> wedge = {{-0.5, -0.4, -0.5}, {0.5, -0.4, -0.5}, {-0.5, -0.4, 0.5},
                                        {0.5, -0.4, 0.5},   {-0.5, 0.5, 0},    {0.5, 0.5, 0}};
  pile(scene, 300, 6,
       {scene.capsule(0.3, 0.4), scene.hull(octahedron), scene.box({0.5, 0.4, 0.3}), scene.hull(wedge),
        scene.sphere(0.45)});
}

/// Cubes turned about the normal of a plane of 27 degrees, with friction .5 (atan .5 = 26.57 degrees).
void slope(Scene& scene) {
  constexpr double kSine = 0.23344536385590542, kCosine = 0.97236992039767656;  // of 13.5 degrees
  const PlumbQuat tilt = {0, 0, kSine, kCosine};
  scene.add_static(scene.box({50, 0.5, 50}), {0, 0, 0}, tilt);
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  for (int i = 0; i < 8; ++i) {
    const double t = 0.1 * i, w = 1 / (1 + t * t);  // a turn of 2 atan t about y, by its half's rational sine
    const PlumbQuat yaw = {0, 2 * t * w, 0, (1 - t * t) * w};
    const PlumbQuat q = {kSine * yaw.y * -1, kCosine * yaw.y, kSine * yaw.w, kCosine * yaw.w};  // tilt * yaw
    const double z = 3.0 * i - 10;
    constexpr double kNormalX = -0.45399049973954675, kNormalY = 0.89100652418836786;  // sine and cosine of 27 degrees
    scene.add(cube, {kNormalX, kNormalY, z}, q);
  }
}

void bounces(Scene& scene) {
  scene.body.material.restitution = 0.8;
  scene.ground();
  const PlumbShape ball = scene.sphere(0.5);
  for (int i = 0; i < 10; ++i) scene.add(ball, {2.0 * i - 10, 1.0 + 0.5 * i, 0.1 * i});
}

void paddle(Scene& scene) {
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  for (int i = 0; i < 30; ++i) scene.add(cube, {1.2 * (i % 5) + 2, 0.5 + i / 15, 1.3 * (i / 5 % 3) - 1.3});
  const PlumbBody pusher = scene.add_kinematic(scene.box({0.25, 1, 3}), {0, 1.1, 0});
  scene.before_step = [pusher](Scene& all, int step) {  // 1.5 m/s there and back
    const int phase = step % 240;
    all.target(pusher, {0.025 * (phase < 120 ? phase : 240 - phase), 1.1, 0});
  };
}

void rotors(Scene& scene) {
  scene.body.material.friction = 0;
  const PlumbShape brick = scene.box({0.2, 0.5, 1}), plate = scene.box({1, 0.1, 0.7});
  for (int i = 0; i < 64; ++i) {
    Random random(static_cast<std::uint64_t>(1000 + i));
    scene.body.angular_velocity = {random.between(-5, 5), random.between(-5, 5), random.between(-5, 5)};
    scene.body.linear_velocity = {random.between(-1, 1), 0, 0};
    scene.add(i % 2 == 0 ? brick : plate, {0, 4.0 * (i % 8), 4.0 * (i / 8)}, random.turn());
  }
}

/// Thrown into a box with spins that are seen within a step, though nobody asks for the gyroscopic term; every fourth
/// hangs on the one before it.
void spinners(Scene& scene) {
  scene.container(3, 4);
  const PlumbShape kinds[] = {scene.capsule(0.05, 0.3), scene.box({0.05, 0.3, 0.2}),
                              scene.hull({{-0.3, 0, -0.1}, {0.3, 0, -0.1}, {0, 0, 0.2}, {0, 0.25, 0}})};
  PlumbBody before = 0;
  for (int i = 0; i < 48; ++i) {
    Random random(static_cast<std::uint64_t>(3000 + i));
    scene.body.angular_velocity = {random.between(-60, 60), random.between(-60, 60), random.between(-60, 60)};
    const PlumbVec3 at = {1.2 * (i % 4) - 1.8, 0.6 + 0.9 * (i / 16), 1.2 * (i / 4 % 4) - 1.8};
    const PlumbBody body = scene.add(kinds[i % 3], at, random.turn());
    if (i % 4 == 3) scene.ball_joint(before, {0.6, 0, 0}, body, {-0.6, 0, 0});
    before = body;
  }
}

/// Each cube twice as heavy as the one below it.
void heavy_tops(Scene& scene) {
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  for (int i = 0; i < 7; ++i) {
    scene.body.density = 1000.0 * (1 << i);
    scene.add(cube, {0, 0.5 + i, 0});
  }
}

void dominoes(Scene& scene) {
  scene.ground();
  const PlumbShape stone = scene.box({0.1, 0.5, 0.25});
  for (int i = 0; i < 20; ++i) {
    scene.body.angular_velocity = {0, 0, i == 0 ? -3.0 : 0.0};
    scene.add(stone, {0.5 * i, 0.5, 0});
  }
}

/// A chain that swings down into a stack.
void chain(Scene& scene) {
  scene.ground();
  const PlumbShape link = scene.capsule(0.1, 0.3), cube = scene.box({0.5, 0.5, 0.5});
  PlumbBody before = 0;
  for (int i = 0; i < 10; ++i) {
    constexpr double kHalf = 0.70710678118654752;
    const PlumbBody here = scene.add(link, {0.4 + 0.8 * i, 8.5, 0}, {0, 0, -kHalf, kHalf});  // y along x
    scene.ball_joint(before, before == 0 ? PlumbVec3{0, 8.5, 0} : PlumbVec3{0, 0.4, 0}, here, {0, -0.4, 0});
    before = here;
  }
  for (int i = 0; i < 4; ++i) scene.add(cube, {-1, 0.5 + i, 0});
}

/// Everything that a host may do to bodies between steps, done to a heap of them.
struct Meddler {
  std::vector<PlumbBody> bodies;
  PlumbShape cube, ball;
  PlumbBody pusher, shelf;

  void operator()(Scene& scene, int step) {
    Random random(static_cast<std::uint64_t>(step) + 77);
    const auto number = [&] { return random.between(-2, 2); };
    // The body is drawn after its row, here, as arguments have no order.
    const auto write_any = [&](PlumbField field, const std::vector<double>& row) {
      scene.write(field, bodies[random.next() % bodies.size()], row);
    };
    if (step % 40 < 30) scene.target(pusher, {0.02 * (step % 40) - 3, 1, 0.3});
    if (step % 3 == 0) {
      const PlumbQuat q = random.turn();
      write_any(PLUMB_FIELD_POSE, {number(), 6 + number(), number(), q.x, q.y, q.z, q.w});
    }
    if (step % 4 == 0) write_any(PLUMB_FIELD_VELOCITY, {number(), 0, number(), number(), 0, number()});
    if (step % 5 == 0) write_any(PLUMB_FIELD_IMPULSE_AT_POINT, {900, 900, 0, number(), 1, number()});
    if (step % 5 == 1) write_any(PLUMB_FIELD_ANGULAR_IMPULSE, {number(), 100, number()});
    if (step % 6 == 0) write_any(PLUMB_FIELD_FORCE_AT_POINT, {5e3, 1e4, 0, number(), 1, number()});
    if (step % 7 == 0) write_any(PLUMB_FIELD_MATERIAL, {random.uniform(), random.uniform()});
    if (step % 11 == 0) write_any(PLUMB_FIELD_GRAVITY_SCALE, {random.uniform()});
    if (step % 13 == 0) write_any(PLUMB_FIELD_DAMPING, {random.uniform(), random.uniform()});
    if (step % 17 == 0) write_any(PLUMB_FIELD_FILTER, {1, 4294967295.0, 1.0 + step % 2});
    if (step % 29 == 0) scene.write(PLUMB_FIELD_POSE, shelf, {3, 0.5 + 0.01 * step, 0, 0, 0, 0, 1});
    if (step % 19 == 18) {
      const auto gone = bodies.begin() + static_cast<std::ptrdiff_t>(random.next() % bodies.size());
      scene.remove(*gone);
      bodies.erase(gone);
    }
    if (step % 23 == 0) bodies.push_back(scene.add(step % 2 == 0 ? cube : ball, {number(), 9, number()}));
    if (step == 150) cube = scene.box({0.3, 0.2, 0.5});
  }
};

void meddling(Scene& scene) {
  scene.container(4, 40);
  Meddler meddler;
  meddler.cube = scene.box({0.4, 0.3, 0.5});
  meddler.ball = scene.sphere(0.4);
  for (int i = 0; i < 120; ++i) {
    Random random(static_cast<std::uint64_t>(3000 + i));
    meddler.bodies.push_back(scene.add(i % 3 == 0 ? meddler.ball : meddler.cube,
                                       {1.2 * (i % 5) - 2.4, 1 + 1.1 * (i / 25), 1.2 * (i / 5 % 5) - 2.4},
                                       random.turn()));
  }
  meddler.pusher = scene.add_kinematic(meddler.cube, {-3, 1, 0.3});
  meddler.shelf = scene.add_static(meddler.cube, {3, 0.5, 0});
  scene.before_step = meddler;
}

/// Towers that fall asleep, and are struck, pushed, undermined and woken.
void sleepers(Scene& scene) {
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5}), ball = scene.sphere(0.6);
  std::vector<PlumbBody> cubes;
  for (int i = 0; i < 48; ++i) cubes.push_back(scene.add(cube, {3.0 * (i % 4), 0.5 + i / 12, 3.0 * (i / 4 % 3)}));
  const PlumbBody pusher = scene.add_kinematic(scene.box({0.25, 0.5, 0.5}), {-2, 0.6, 6});
  scene.before_step = [=](Scene& all, int step) {
    if (step == 80) all.add(ball, {0.2, 7, 0.1});
    if (step == 120) all.remove(cubes[1]);
    if (step == 150) all.write(PLUMB_FIELD_AWAKE, cubes[14], {1});
    if (step >= 160 && step < 220) all.target(pusher, {-2 + 0.025 * (step - 160), 0.6, 6});
    if (step == 200) all.write(PLUMB_FIELD_IMPULSE, cubes[47], {900, 0, 100});
  };
}

bool has(const Backend& backend, const Choice& wanted) {
  for (const PlumbSettingInfo* info : backend.settings())
    for (std::uint32_t i = 0; std::string_view(info->name) == wanted.setting && i < info->choice_count; ++i)
      if (std::string_view(info->choices[i]) == wanted.choice) return true;
  return false;
}

}  // namespace

const std::vector<NamedScene>& named_scenes() {
  constexpr PlumbNeeds kNoContacts = PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC;
  constexpr PlumbNeeds kAll = kContactNeeds | PLUMB_NEED_GYROSCOPIC;
  constexpr PlumbNeeds kMeddlingNeeds =
      PLUMB_NEED_RESTITUTION | PLUMB_NEED_KINEMATIC | PLUMB_NEED_DAMPING | PLUMB_NEED_FORCES | PLUMB_NEED_FILTERS;
  static const std::vector<NamedScene> scenes = {
      {"tower-20", {}, kContactNeeds, kDown, &tower},
      {"pyramid-20", {}, kContactNeeds, kDown, &pyramid_20},
      {"pile-1000", {}, kContactNeeds, kDown, &pile_of_boxes},
      {"slope-27", {}, kContactNeeds, kDown, &slope},
      {"bounces", {}, kContactNeeds | PLUMB_NEED_RESTITUTION, kDown, &bounces},
      {"spheres-500", {}, kContactNeeds, kDown, &pile_of_spheres},
      {"paddle", {}, kContactNeeds | PLUMB_NEED_KINEMATIC, kDown, &paddle},
      {"rotors", {}, kNoContacts, {0, 0, 0}, &rotors},
      {"mixed-300", {}, kAll, kDown, &pile_of_all},
      {"heavy-tops", {}, kContactNeeds, kDown, &heavy_tops},
      {"pyramid-far", {}, kContactNeeds, kDown, &pyramid_far},
      {"dominoes", {}, kAll, kDown, &dominoes},
      {"chain", {}, kAll | PLUMB_NEED_JOINTS, kDown, &chain},
      {"meddling", {}, kAll | kMeddlingNeeds, kDown, &meddling},
      {"sleepers",
       {},
       kContactNeeds | PLUMB_NEED_KINEMATIC | PLUMB_NEED_FORCES | PLUMB_NEED_SLEEPING,
       kDown,
       &sleepers},
      {"pyramid-10-si", {"solver", "si"}, kContactNeeds, kDown, &pyramid_10},
      {"pyramid-10-jacobi", {"solver", "jacobi"}, kContactNeeds, kDown, &pyramid_10},
      {"pyramid-10-xpbd", {"solver", "xpbd"}, kContactNeeds, kDown, &pyramid_10},
      {"cylinders", {}, kAll, kDown, &pile_of_cylinders},
      {"compounds", {}, kAll, kDown, &pile_of_compounds},
      {"surfaces", {}, kAll | PLUMB_NEED_KINEMATIC, kDown, &pile_on_surfaces},
      {"puppets", {}, kAll | PLUMB_NEED_JOINTS | PLUMB_NEED_EVENTS, kDown, &puppets},
      {"sockets", {}, kAll | PLUMB_NEED_JOINTS | PLUMB_NEED_SLEEPING, kDown, &sockets},
      {"led-limbs", {}, kAll | PLUMB_NEED_JOINTS | PLUMB_NEED_SLEEPING, kDown, &led_limbs},
      {"gears", {}, kAll | PLUMB_NEED_JOINTS | PLUMB_NEED_JOINT_REACTIONS | PLUMB_NEED_SLEEPING, kDown, &gears},
      {"chequers", {}, kAll | PLUMB_NEED_RESTITUTION | PLUMB_NEED_CCD | PLUMB_NEED_SLEEPING, kDown, &chequers},
      {"bumps", {}, kAll | PLUMB_NEED_KINEMATIC | PLUMB_NEED_SLEEPING, kDown, &bumps},
      {"bullets", {}, kAll | PLUMB_NEED_CCD, kDown, &bullets},
      {"held", {}, kAll | PLUMB_NEED_AXIS_LOCKS, kDown, &held},
      {"loads", {}, kContactNeeds | PLUMB_NEED_JOINTS, kDown, &loads},
      {"sheets", {}, kAll | PLUMB_NEED_CCD | PLUMB_NEED_KINEMATIC, kDown, &sheets},
      {"boulders", {}, kAll, kDown, &boulders},
      {"clockwork", {}, kAll | PLUMB_NEED_JOINTS | PLUMB_NEED_JOINT_REACTIONS | PLUMB_NEED_EVENTS, kDown, &clockwork},
      {"comers", {}, kAll | PLUMB_NEED_SLEEPING, kDown, &comers},
      {"machines", {}, kContactNeeds | PLUMB_NEED_KINEMATIC | PLUMB_NEED_SLEEPING, kDown, &machines},
      {"belts", {}, kAll | PLUMB_NEED_KINEMATIC | PLUMB_NEED_SURFACE_VELOCITY | PLUMB_NEED_SLEEPING, kDown, &belts},
      {"rollers",
       {},
       kAll | PLUMB_NEED_JOINTS | PLUMB_NEED_RESTITUTION | PLUMB_NEED_SURFACE_VELOCITY | PLUMB_NEED_ROLLING_FRICTION |
           PLUMB_NEED_SLEEPING | PLUMB_NEED_CCD,
       kDown,
       &rollers},
      {"heavy-bridge", {}, kAll | PLUMB_NEED_JOINTS | PLUMB_NEED_AXIS_LOCKS, kDown, &heavy_bridge},
      {"drawers", {}, kContactNeeds | PLUMB_NEED_JOINTS, kDown, &drawers},
      {"sieves",
       {},
       kAll | PLUMB_NEED_RESTITUTION | PLUMB_NEED_SURFACE_VELOCITY | PLUMB_NEED_SLEEPING | PLUMB_NEED_CCD |
           PLUMB_NEED_CONTACT_MODIFICATION,
       kDown,
       &sieves},
      {"changers",
       {},
       kContactNeeds | PLUMB_NEED_JOINTS | PLUMB_NEED_KINEMATIC | PLUMB_NEED_AXIS_LOCKS | PLUMB_NEED_EVENTS,
       kDown,
       &changers},
      {"far-off", {}, kAll | PLUMB_NEED_JOINTS, kDown, &far_off},
      {"pyramid-20-once", {"relaxation", "step"}, kContactNeeds, kDown, &pyramid_20},
      {"puppets-iterative",
       {"joint_solver", "iterative"},
       kAll | PLUMB_NEED_JOINTS | PLUMB_NEED_EVENTS,
       kDown,
       &puppets},
      {"islands", {}, kContactNeeds | PLUMB_NEED_RESTITUTION, kDown, &islands},
      {"spinners", {}, kContactNeeds | PLUMB_NEED_JOINTS, kDown, &spinners},
  };
  return scenes;
}

std::string missing(const Backend& backend, const NamedScene& scene) {
  for (std::uint32_t bit = 0; bit < PLUMB_NEED_COUNT; ++bit)
    if ((scene.needs >> bit & 1) != 0 && backend.capability(PLUMB_CAP_NEED, bit) == PLUMB_NONE)
      return "need " + std::to_string(bit);
  if (scene.choice.setting != nullptr && !has(backend, scene.choice))
    return std::string(scene.choice.setting) + " " + scene.choice.choice;
  return {};
}

std::unique_ptr<Scene> build(const Backend& backend, const NamedScene& scene, std::uint32_t threads) {
  auto built = std::make_unique<Scene>(backend, scene.needs, scene.gravity, threads, scene.choice);
  scene.build(*built);
  return built;
}

}  // namespace plumb::impulse::test
