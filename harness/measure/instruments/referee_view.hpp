// All bodies of a simulation as the referee sees them: overlaps, energy, and the impulses that the ground gives.
#pragma once

#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "measure/measure.hpp"
#include "referee/contacts.hpp"
#include "referee/joints.hpp"
#include "referee/mechanics.hpp"
#include "referee/world_penetration.hpp"

namespace plumb::harness {

class RefereeView {
 public:
  /// Scene must outlive the view.
  explicit RefereeView(const Scene& scene);

  /// Overlaps of all pairs that may touch: filters, sensors and joints that keep their bodies apart are heeded. All
  /// statistics are NaN when a pose is not finite: a world that exploded has no small depth.
  [[nodiscard]] referee::WorldPenetration penetration(std::span<const PoseRow> poses) const;
  [[nodiscard]] std::vector<referee::BodyState> states(Simulation& simulation) const;
  [[nodiscard]] referee::Energy energy(Simulation& simulation) const;
  [[nodiscard]] const std::vector<referee::Mass>& masses() const { return masses_; }
  [[nodiscard]] double total_mass() const { return total_mass_; }
  /// The largest error of any joint, of each kind. Those that the host has cut until the time are left out.
  [[nodiscard]] referee::JointError joint_error(std::span<const PoseRow> poses, double time = 0) const;
  /// Largest drift of any joint: how far its frames' origins are from where it allows them, m.
  [[nodiscard]] double joint_gap(std::span<const PoseRow> poses, double time = 0) const {
    return joint_error(poses, time).position;
  }

 private:
  const Scene* scene_;
  std::vector<referee::ShapePtr> shapes_;
  std::vector<referee::Mass> masses_;
  double total_mass_ = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> jointed_;
  bool all_may_touch_ = true;
};

/// Mean and largest of the depths of all overlaps, m.
struct DepthSummary {
  double mean = 0, p99 = 0, max = 0;
};
[[nodiscard]] DepthSummary depth_summary(const referee::WorldPenetration& penetration);

/// Force that each contact of a pair of bodies carried, summed over steps. For engines that tell impulses.
class ImpulseAccount {
 public:
  explicit ImpulseAccount(Simulation& simulation);
  /// Adds the contacts of the last step.
  void add(Simulation& simulation);

  struct PairForce {
    double normal, tangent;  ///< N, mean over the steps added
  };
  /// Of the pair in either order; 0 0 when it never touched.
  [[nodiscard]] PairForce between(std::size_t body_a, std::size_t body_b) const;
  /// Mean force of all bodies without mass on those with mass, N.
  [[nodiscard]] referee::Vec3 from_ground() const;

 private:
  struct Sum {
    referee::Vec3 normal = referee::Vec3::Zero(), tangent = referee::Vec3::Zero();  ///< on the second body, N s
  };
  std::unordered_map<PlumbBody, std::size_t> index_;
  std::vector<bool> moves_;
  std::unordered_map<std::uint64_t, Sum> pairs_;  ///< by index of the smaller body, then the larger
  referee::Vec3 ground_ = referee::Vec3::Zero();
  double seconds_ = 0;
};

/// The scene with more needs, where the backend has them all: for what is measured if it can be, and left out if not.
struct WantedScene {
  Scene scene;
  bool granted;
};
[[nodiscard]] WantedScene with_wanted(MeasureContext& context, PlumbNeeds needs);

}  // namespace plumb::harness
