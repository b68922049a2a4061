// The contact problem of a scene's next step, by the referee's geometry: for scenes whose bodies nothing but gravity
// and contacts moves.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "referee/shape.hpp"
#include "reference/step_problem.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

/// A contact and how it stood before the step.
struct FoundContact {
  reference::StepContact contact;
  double gap;          ///< m; below 0: overlap
  double speed;        ///< normal velocity before the step, m/s; below 0: approaching
  double free_speed;   ///< and with gravity's part of the step, were there no contacts
  double restitution;  ///< of the pair
};

class StepContacts {
 public:
  /// Scene must outlive it.
  explicit StepContacts(const Scene& scene);

  /// Why the scene is out of reach: joints, forces, shapes without contact points ...; "" when it is not.
  [[nodiscard]] const std::string& obstacle() const { return obstacle_; }
  [[nodiscard]] const std::vector<referee::Mass>& masses() const { return masses_; }
  /// A hundredth of the smallest moving body's size: what two shapes may be apart, or a face may be tilted, and still
  /// touch. m
  [[nodiscard]] double flat() const { return flat_; }
  [[nodiscard]] reference::StepForces forces() const;

  /// All contacts that the step may close; biases are left at 0.
  [[nodiscard]] std::vector<FoundContact> find(std::span<const referee::BodyState> before) const;

  /// The problem as the laws have it: gaps may close, what approaches bounces by its restitution.
  [[nodiscard]] reference::StepProblem problem(std::span<const referee::BodyState> before) const;

 private:
  [[nodiscard]] bool may_meet(std::size_t a, std::size_t b) const;

  const Scene* scene_;
  std::string obstacle_;
  std::vector<referee::ShapePtr> shapes_;
  std::vector<referee::Mass> masses_;
  std::vector<double> radii_;  ///< of the bodies, about their centres of mass; infinite ones do not occur
  double flat_ = 0;
};

}  // namespace plumb::harness
