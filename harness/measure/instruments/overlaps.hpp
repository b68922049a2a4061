// How deep bodies overlap over a run, by the referee's geometry (metrics of any scene that collides).
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "measure/measure.hpp"
#include "referee/shape.hpp"

namespace plumb::harness {

class Overlaps {
 public:
  /// shapes: of the scene, in its order; both must outlive it.
  Overlaps(const Scene& scene, const std::vector<referee::ShapePtr>& shapes);
  /// Of the poses that the simulation has.
  void add(Simulation& simulation);
  /// penetration_max, penetration_p50, _p95 and _p99; nothing where the scene does not need collision.
  void add_to(std::vector<Metric>& metrics) const;

 private:
  const Scene& scene_;
  const std::vector<referee::ShapePtr>& shapes_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> joined_;  ///< bodies that a joint keeps from touching
  double max_ = 0, p50_ = 0, p95_ = 0, p99_ = 0;
};

}  // namespace plumb::harness
