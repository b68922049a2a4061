#include "referee/expanding_polytope.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "plumb/assert.hpp"
#include "referee/difference.hpp"

namespace plumb::referee {

namespace {

struct Facet {
  std::array<std::size_t, 3> corner;
  std::array<std::size_t, 3> across;  // the facet on the other side of the edge corner[i] -> corner[i + 1]
  Vec3 normal;
  double offset;
  bool alive;
};

// Of the size: how near the hull must come to the surface, and how far outside a facet a point must be to see it.
constexpr double converged = 1e-11;
constexpr double visible = 1e-13;

class Expansion {
 public:
  Expansion(const ConvexView& a, const ConvexView& b) : a_(a), b_(b) {}

  Penetration run() {
    start();
    for (int i = 0; i < 1000; ++i) {
      const std::size_t nearest = nearest_facet();
      PLUMB_ASSERT(nearest != none && facets_[nearest].alive);
      const Facet& facet = facets_[nearest];
      const Difference next = support(facet.normal);
      if (next.point.dot(facet.normal) - facet.offset <= converged * size_ || !insert(next, nearest)) break;
    }
    return answer(facets_[nearest_facet()]);
  }

 private:
  [[nodiscard]] Difference support(const Vec3& direction) const {
    const Vec3 on_a = a_.support(direction), on_b = b_.support(-direction);
    return {on_a - on_b, on_a, on_b};
  }

  [[nodiscard]] std::size_t nearest_facet() const {
    std::size_t best = none;
    for (std::size_t f = 0; f < facets_.size(); ++f)
      if (facets_[f].alive && (best == none || facets_[f].offset < facets_[best].offset)) best = f;
    return best;
  }

  // The widest tetrahedron among the support points of 14 directions, then the others one by one.
  void start() {
    std::vector<Difference> first;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (const int count = std::abs(x) + std::abs(y) + std::abs(z); count == 1 || count == 3)
            first.push_back(support(Vec3(x, y, z)));
    const auto take_furthest = [&](auto&& measure) {
      const auto furthest = std::ranges::max_element(first, {}, [&](const Difference& d) { return measure(d.point); });
      points_.push_back(*furthest);
    };
    const Vec3 middle = first[0].point;
    take_furthest([&](const Vec3& p) { return (p - middle).norm(); });
    take_furthest([&](const Vec3& p) { return (p - points_[0].point).norm(); });
    const Vec3 edge = points_[1].point - points_[0].point;
    size_ = edge.norm();
    take_furthest([&](const Vec3& p) { return edge.cross(p - points_[0].point).norm(); });
    const Vec3 normal = edge.cross(points_[2].point - points_[0].point);
    take_furthest([&](const Vec3& p) { return std::abs(normal.dot(p - points_[0].point)); });
    if (normal.dot(points_[3].point - points_[0].point) > 0) std::swap(points_[1], points_[2]);
    add_facet(0, 1, 2, {1, 2, 3});
    add_facet(1, 0, 3, {0, 3, 2});
    add_facet(2, 1, 3, {0, 1, 3});
    add_facet(0, 2, 3, {0, 2, 1});
    for (const Difference& point : first)
      for (std::size_t f = 0; f < facets_.size(); ++f)
        if (facets_[f].alive && height(facets_[f], point.point) > 1e-6 * size_ && insert(point, f)) break;
  }

  void add_facet(std::size_t i, std::size_t j, std::size_t k, const std::array<std::size_t, 3>& across) {
    PLUMB_ASSERT(std::max({i, j, k}) < points_.size() && i != j && j != k && k != i);
    const Vec3& p = points_[i].point;
    const Vec3 normal = (points_[j].point - p).cross(points_[k].point - p).normalized();
    facets_.push_back({{i, j, k}, across, normal, normal.dot(p), true});
  }

  [[nodiscard]] static double height(const Facet& facet, const Vec3& point) {
    return facet.normal.dot(point) - facet.offset;
  }

  // Replaces the facets that see a point, found by neighbours from one of them, by a cone to it. False, and nothing has
  // changed, when rounding leaves their rim without the form of one loop or a facet of the cone without area.
  bool insert(const Difference& point, std::size_t from) {
    std::vector<std::size_t> seen = {from};
    std::vector<bool> is_seen(facets_.size(), false);
    is_seen[from] = true;
    struct RimEdge {
      std::size_t stays, to;
    };
    std::map<std::size_t, RimEdge> rim;  // by the corner that the edge starts from, seen from the cone
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Facet& facet = facets_[seen[i]];
      for (const std::size_t next : facet.across)
        if (!is_seen[next] && height(facets_[next], point.point) > visible * size_) {
          is_seen[next] = true;
          seen.push_back(next);
        }
    }
    for (const std::size_t f : seen)
      for (std::size_t e = 0; e < 3; ++e) {
        const Facet& facet = facets_[f];
        if (is_seen[facet.across[e]]) continue;
        const std::size_t start = facet.corner[e], end = facet.corner[(e + 1) % 3];
        const Vec3 &p = points_[start].point, &q = points_[end].point;
        const double area = (q - p).cross(point.point - p).norm();
        if (!(area > 1e-15 * size_ * (q - p).norm()) || !rim.insert({start, {facet.across[e], end}}).second)
          return false;
      }
    std::size_t walked = 0;
    for (std::size_t at = rim.begin()->first; walked == 0 || at != rim.begin()->first; at = rim.at(at).to)
      if (++walked > rim.size()) return false;
    if (walked != rim.size()) return false;

    PLUMB_ASSERT(rim.size() >= 3);
    points_.push_back(point);
    for (const std::size_t f : seen) facets_[f].alive = false;
    std::map<std::size_t, std::size_t> cone;  // facet by the corner that its rim edge starts from
    for (const auto& [start, edge] : rim) cone[start] = facets_.size() + cone.size();
    std::map<std::size_t, std::size_t> before;  // the corner before each on the rim
    for (const auto& [start, edge] : rim) before[edge.to] = start;
    for (const auto& [start, edge] : rim) {
      Facet& stays = facets_[edge.stays];
      for (std::size_t e = 0; e < 3; ++e)
        if (stays.corner[e] == edge.to && stays.corner[(e + 1) % 3] == start) stays.across[e] = cone[start];
      add_facet(start, edge.to, points_.size() - 1, {edge.stays, cone[edge.to], cone[before[start]]});
    }
    return true;
  }

  [[nodiscard]] Penetration answer(const Facet& facet) const {
    const Difference outermost = support(facet.normal);
    const double depth = outermost.point.dot(facet.normal);
    // Barycentric weights of the origin's foot on the facet give the two deepest points.
    const Vec3 foot = facet.offset * facet.normal;
    const Vec3 &p = points_[facet.corner[0]].point, &q = points_[facet.corner[1]].point,
               &r = points_[facet.corner[2]].point;
    const double area = (q - p).cross(r - p).dot(facet.normal);
    const double weight[3] = {(q - foot).cross(r - foot).dot(facet.normal) / area,
                              (r - foot).cross(p - foot).dot(facet.normal) / area,
                              (p - foot).cross(q - foot).dot(facet.normal) / area};
    Vec3 middle = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      middle += weight[i] / 2 * (points_[facet.corner[i]].on_a + points_[facet.corner[i]].on_b);
    return {depth, facet.normal, middle};
  }

  const ConvexView& a_;
  const ConvexView& b_;
  std::vector<Difference> points_;
  std::vector<Facet> facets_;
  double size_ = 0;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
};

}  // namespace

Penetration expanding_polytope(const ConvexView& a, const ConvexView& b) { return Expansion(a, b).run(); }

}  // namespace plumb::referee
