// What it costs to look at contacts before they are solved: boxes that rest, with nothing declared, with contact
// modification declared and no body that asks for it, with all contacts read, and with a tenth of them changed.
//
// usage: bench_impulse_contact_modification [BACKEND [BODIES]]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "plumb/loader.hpp"

namespace {

enum class Mode { kPlain, kDeclared, kRead, kChanged };
constexpr int kWarmUp = 60, kSteps = 180;

std::unique_ptr<plumb::IPhysicsWorld> world_of(const plumb::Backend& backend, int bodies, Mode mode) {
  PlumbNeeds needs = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;
  if (mode != Mode::kPlain) needs |= PLUMB_NEED_CONTACT_MODIFICATION;
  auto world = backend.create_world(plumb::world_desc(needs));
  PlumbShapeDesc boxes[2] = {plumb::shape_desc(PLUMB_BOX), plumb::shape_desc(PLUMB_BOX)};
  boxes[0].half_extents = {200, 0.5, 200};
  boxes[1].half_extents = {0.5, 0.5, 0.5};
  PlumbShape shapes[2];
  plumb::check(*world, world->create_shapes(boxes, shapes));
  std::vector<PlumbBodyDesc> descs(1, plumb::body_desc(PLUMB_STATIC));
  descs[0].shape = shapes[0];
  descs[0].pose.position = {0, -0.5, 0};
  const int side = std::max(4, static_cast<int>(std::lround(std::cbrt(2.0 * bodies))));
  for (int i = 0; i < bodies; ++i) {
    PlumbBodyDesc box = plumb::body_desc();
    box.shape = shapes[1];
    if (mode >= Mode::kRead) box.flags = PLUMB_BODY_MODIFY_CONTACTS;
    const int layer = i / (side * side);
    box.pose.position = {1.1 * (i % side), 0.5 + 1.02 * layer, 1.1 * (i / side % side) + 0.05 * (layer % 2)};
    descs.push_back(box);
  }
  std::vector<PlumbBody> ids(descs.size());
  plumb::check(*world, world->create_bodies(descs, ids));
  return world;
}

/// How many contacts were shown.
std::size_t step(plumb::IPhysicsWorld& world, Mode mode) {
  std::size_t shown = 0;
  plumb::check(world, world.step(1.0 / 60));
  for (bool goes_on = mode >= Mode::kRead; goes_on;) {
    std::span<const PlumbManifold> rows;
    plumb::check(world, world.manifolds()->read_manifolds(rows));
    goes_on = !rows.empty();
    shown += rows.size();
    std::vector<PlumbManifoldChange> changes;
    for (std::uint32_t row = 0; mode == Mode::kChanged && row < rows.size(); row += 10) {
      changes.push_back(plumb::manifold_change(row));
      changes.back().what = PLUMB_MANIFOLD_FRICTION;
      changes.back().friction = 0.6;
    }
    if (goes_on) plumb::check(world, world.manifolds()->modify_manifolds(changes));
  }
  PlumbStepReport report{};
  plumb::check(world, world.wait(report));
  return shown;
}

void measure(const plumb::Backend& backend, int bodies, Mode mode, const char* what) {
  const auto world = world_of(backend, bodies, mode);
  std::vector<double> times;
  std::size_t shown = 0;
  for (int i = 0; i < kWarmUp + kSteps; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    shown = step(*world, mode);
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  const auto middle = times.begin() + kWarmUp + kSteps / 2;
  std::nth_element(times.begin() + kWarmUp, middle, times.end());
  std::printf("%-40s %8.3f ms a step (median of %d), %zu contacts shown\n", what, *middle, kSteps, shown);
}

}  // namespace

int main(int count, char** arguments) {
  const plumb::Backend backend = plumb::open_backend(count > 1 ? arguments[1] : IMPULSE_LIBRARY);
  const int bodies = count > 2 ? std::atoi(arguments[2]) : 1000;
  std::printf("%s, %d boxes\n", backend.info().name, bodies);
  measure(backend, bodies, Mode::kPlain, "nothing declared");
  measure(backend, bodies, Mode::kDeclared, "declared, nobody asks");
  measure(backend, bodies, Mode::kRead, "all contacts read");
  measure(backend, bodies, Mode::kChanged, "a tenth of them changed");
}
