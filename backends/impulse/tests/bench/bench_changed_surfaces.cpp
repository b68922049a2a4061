// What it costs to dig: a pit of 8 x 8 points in a large height field, and in a mesh of the same triangles, by changing
// the shape and by making another for its body; and the step after it, beside one without, with boxes that lie there.
//
// usage: bench_impulse_changed_surfaces [BACKEND [POINTS_A_SIDE [BODIES [TIMES]]]]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "plumb/loader.hpp"

namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}
double median(std::vector<double> all) {
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

/// Points 1 m apart.
class Ground {
 public:
  Ground(PlumbShapeType type, std::uint32_t side) : type_(type), side_(side) {
    const double half = (side - 1) / 2.0;
    for (std::uint32_t row = 0; row < side; ++row)
      for (std::uint32_t column = 0; column < side; ++column) {
        const double height = 0.3 * std::sin(0.7 * column) * std::cos(0.4 * row);
        heights_.push_back(height);
        vertices_.insert(vertices_.end(), {column - half, height, row - half});
        const std::uint32_t a = row * side + column;
        if (row + 1 < side && column + 1 < side)
          indices_.insert(indices_.end(), {a, a + side, a + 1, a + 1, a + side, a + side + 1});
      }
  }
  /// No deeper than the ground is somewhere.
  void dig(std::uint32_t at_row, std::uint32_t at_column) {
    for (std::uint32_t row = at_row; row < at_row + 8; ++row)
      for (std::uint32_t column = at_column; column < at_column + 8; ++column)
        heights_[row * side_ + column] = vertices_[3 * (row * side_ + column) + 1] = -0.25;
  }
  [[nodiscard]] PlumbShapeDesc desc() const {
    PlumbShapeDesc desc = plumb::shape_desc(type_);
    desc.heights = heights_.data();
    desc.rows = desc.columns = side_;
    desc.spacing = {1, 0, 1};
    desc.vertices = vertices_.data();
    desc.vertex_count = side_ * side_;
    desc.indices = indices_.data();
    desc.triangle_count = static_cast<std::uint32_t>(indices_.size() / 3);
    return desc;
  }

 private:
  PlumbShapeType type_;
  std::uint32_t side_;
  std::vector<double> heights_, vertices_;
  std::vector<std::uint32_t> indices_;
};

class World {
 public:
  World(const plumb::Backend& backend, const PlumbShapeDesc& ground, std::uint32_t bodies) {
    PlumbWorldDesc desc = plumb::world_desc(PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION);
    desc.gravity = {0, -9.81, 0};
    world_ = backend.create_world(desc);
    PlumbShapeDesc box = plumb::shape_desc(PLUMB_BOX);
    box.half_extents = {0.3, 0.3, 0.3};
    PlumbShape cube = 0;
    plumb::check(*world_, world_->create_shapes({&box, 1}, {&cube, 1}));
    make_ground(ground);
    PlumbBodyDesc floor = plumb::body_desc(PLUMB_STATIC);
    floor.shape = shape_;
    plumb::check(*world_, world_->create_bodies({&floor, 1}, {&body_, 1}));
    std::vector<PlumbBodyDesc> descs(bodies, plumb::body_desc());
    const auto across = static_cast<std::uint32_t>(std::ceil(std::sqrt(bodies)));
    for (std::uint32_t i = 0; i < bodies; ++i) {
      descs[i].shape = cube;
      descs[i].density = 1000;
      descs[i].pose.position = {1.1 * (i % across) - 0.55 * across, 0.8, 1.1 * (i / across) - 0.55 * across};
    }
    std::vector<PlumbBody> ids(bodies);
    plumb::check(*world_, world_->create_bodies(descs, ids));
  }
  void change(const PlumbShapeDesc& ground) {
    plumb::check(*world_, world_->modify()->modify_shapes({&shape_, 1}, {&ground, 1}));
  }
  void give_another(const PlumbShapeDesc& ground) {
    const PlumbShape before = shape_;
    make_ground(ground);
    PlumbBodyChange other = plumb::body_change(body_);
    other.what = PLUMB_MODIFY_SHAPE;
    other.shape = shape_;
    plumb::check(*world_, world_->modify()->modify_bodies({&other, 1}));
    plumb::check(*world_, world_->destroy_shapes({&before, 1}));
  }
  void step() {
    PlumbStepReport report{};
    plumb::check(*world_, world_->step(1.0 / 60));
    plumb::check(*world_, world_->wait(report));
  }

 private:
  void make_ground(const PlumbShapeDesc& ground) {
    plumb::check(*world_, world_->create_shapes({&ground, 1}, {&shape_, 1}));
  }
  std::unique_ptr<plumb::IPhysicsWorld> world_;
  PlumbShape shape_ = 0;
  PlumbBody body_ = 0;
};

void measure(const plumb::Backend& backend, PlumbShapeType type, std::uint32_t side, std::uint32_t bodies, int times) {
  Ground ground(type, side);
  World world(backend, ground.desc(), bodies);
  for (int i = 0; i < 120; ++i) world.step();
  const auto timed = [](auto&& call) {
    const Clock::time_point start = Clock::now();
    call();
    return since(start);
  };
  std::vector<double> changed, stepped, rested, another;
  for (int i = 0; i < times; ++i) {
    const std::uint32_t at = (37U * static_cast<std::uint32_t>(i)) % (side - 8);
    ground.dig(at, (at * 7) % (side - 8));
    changed.push_back(timed([&] { world.change(ground.desc()); }));
    stepped.push_back(timed([&] { world.step(); }));
    rested.push_back(timed([&] { world.step(); }));
    if (i % 4 == 0) another.push_back(timed([&] { world.give_another(ground.desc()); }));
  }
  std::printf(
      "%-12s of %u x %u points, %u boxes: ms to change it %.3f, to give another %.2f; a step after it %.3f, one later "
      "%.3f\n",
      type == PLUMB_HEIGHT_FIELD ? "height field" : "mesh", side, side, bodies, median(changed), median(another),
      median(stepped), median(rested));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const plumb::Backend backend = plumb::open_backend(argc > 1 ? argv[1] : IMPULSE_LIBRARY);
    const auto number = [&](int i, long usual) { return argc > i ? std::strtol(argv[i], nullptr, 10) : usual; };
    const auto side = static_cast<std::uint32_t>(number(2, 513)), bodies = static_cast<std::uint32_t>(number(3, 1000));
    for (const PlumbShapeType type : {PLUMB_HEIGHT_FIELD, PLUMB_TRIANGLE_MESH})
      measure(backend, type, side, bodies, static_cast<int>(number(4, 40)));
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_impulse_changed_surfaces: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
