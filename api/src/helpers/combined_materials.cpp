#include "plumb/helpers/combined_materials.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::helpers {

double geometric_mean(double a, double b) { return std::sqrt(a * b); }
double average(double a, double b) { return (a + b) / 2; }
double smaller(double a, double b) { return std::min(a, b); }
double larger(double a, double b) { return std::max(a, b); }
double product(double a, double b) { return a * b; }

void CombinedMaterials::operator()(std::span<const PlumbManifold> manifolds,
                                   std::vector<PlumbManifoldChange>& changes) const {
  for (std::uint32_t i = 0; i < manifolds.size(); ++i) {
    const auto a = known_.find(manifolds[i].body_a), b = known_.find(manifolds[i].body_b);
    if (a == known_.end() || b == known_.end()) continue;
    changes.push_back({i,
                       PLUMB_MANIFOLD_FRICTION | PLUMB_MANIFOLD_RESTITUTION,
                       friction_(a->second.friction, b->second.friction),
                       std::min(restitution_(a->second.restitution, b->second.restitution), 1.0),
                       {0, 0, 0}});
  }
}

}  // namespace plumb::helpers
