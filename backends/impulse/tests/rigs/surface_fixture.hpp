// Meshes and height fields in a world and as triangles on a list, for tests that ask the world.
#pragma once

#include "tests/rigs/query_fixture.hpp"
#include "tests/rigs/surface_reference.hpp"

namespace plumb::impulse::test {

/// A surface in the world and as triangles.
struct Ground {
  PlumbBody body;
  bool numbered;  ///< its triangles are told
  std::vector<Corners> triangles;
};

class SurfaceQueries : public Queries {
 protected:
  void SetUp() override {
    Queries::SetUp();
    if (!IsSkipped()) clear();
  }
  void clear() {
    make(0, 1);
    grounds_.clear();
  }
  /// A hilly mesh, a closed one, and a hilly field of unequal sides, all turned somehow.
  void make_grounds() {
    add_mesh(grid(12, 0.5, [&](double x, double z) { return 0.5 * std::sin(2 * x) * std::cos(1.5 * z); }),
             pose_about(2), false);
    add_mesh(cube(0.8, 3), pose_about(3), true);
    std::vector<double> heights;
    for (int i = 0; i < 9 * 14; ++i) heights.push_back(dice_.uniform(0, 0.8));
    PlumbShapeDesc desc = field_desc(heights, 9, 14, 0.6);
    desc.spacing.z = 0.35;
    add_field(desc, pose_about(2));
  }
  void add_mesh(const TriangleSet& set, const PlumbPose& pose, bool moves) {
    const PlumbShape shape = scene_->make(set.desc());
    PlumbBodyDesc desc = body_desc(moves ? PLUMB_KINEMATIC : PLUMB_STATIC);
    desc.shape = shape;
    desc.pose = pose;
    PlumbBody id = 0;
    check(scene_->world(), scene_->world().create_bodies({&desc, 1}, {&id, 1}));
    grounds_.push_back({id, true, triangles_of(set, pose)});
  }
  void add_field(const PlumbShapeDesc& desc, const PlumbPose& pose) {
    const PlumbBody id = scene_->add_static(scene_->make(desc), pose.position, pose.orientation);
    grounds_.push_back({id, false, triangles_of(triangles_of_field(desc), pose)});
  }

  std::vector<Ground> grounds_;
};

}  // namespace plumb::impulse::test
