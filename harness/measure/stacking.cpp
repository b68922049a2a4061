// The list of measures of stacks, and what they share.
#include "measure/stacking.hpp"

#include <algorithm>

#include "measure/groups.hpp"

namespace plumb::harness {

double distance_from_start(const Scene& scene, std::span<const PoseRow> poses, std::size_t body) {
  return (referee::vec(poses[body].position) - referee::vec(scene.bodies[body].desc.pose.position)).norm();
}

void add_survival(MeasureContext& context, const Survival& survival, double seconds) {
  context.expect("stands", survival.whole(), true);
  context.compare("survival", survival.time(), seconds, seconds);
}

void add_ground_force(MeasureContext& context, const ImpulseAccount& account, double total_mass) {
  const referee::Vec3 weight = total_mass * referee::vec(context.scene().gravity);
  context.add({"ground_force", account.from_ground().norm(), weight.norm(),
               (account.from_ground() + weight).norm() / weight.norm(), std::nullopt, ""});
}

std::span<const MeasureEntry> stacking_measures() {
  static constexpr const char* boxes_args[] = {"boxes"};
  static constexpr const char* pyramid_args[] = {"boxes", "base"};
  static constexpr const char* ratio_args[] = {"lower", "upper"};
  static constexpr const char* overhang_args[] = {"blocks", "share"};
  static constexpr const char* spheres_args[] = {"top", "base", "ground", "friction"};
  static constexpr const char* lattice_args[] = {"spheres"};
  static constexpr MeasureEntry entries[] = {
      {"tower", "sink, drift, depth and rest of a tower, from the ground up", boxes_args, measure_tower},
      {"pyramid", "boxes in place, symmetry and depth of a planar pyramid", pyramid_args, measure_pyramid},
      {"mass_ratio", "depth, rest and forces of one box on another", ratio_args, measure_mass_ratio},
      {"overhang", "whether the harmonic stack stands", overhang_args, measure_overhang},
      {"four_spheres", "whether three spheres carry a fourth, and by which forces", spheres_args, measure_four_spheres},
      {"sphere_lattice", "overlaps of many spheres that fall and scatter", lattice_args, measure_sphere_lattice},
  };
  return entries;
}

}  // namespace plumb::harness
