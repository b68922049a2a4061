#include "referee/expanding_polytope.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace plumb::referee {

namespace {

struct Difference {
  Vec3 point, on_a, on_b;
};

struct Facet {
  std::array<std::size_t, 3> corner;
  Vec3 normal;
  double offset;
};

class Expansion {
 public:
  Expansion(const ConvexView& a, const ConvexView& b) : a_(a), b_(b) {}

  Penetration run() {
    start();
    for (int i = 0; i < 1000; ++i) {
      const Facet nearest = *nearest_facet();
      const Difference next = support(nearest.normal);
      if (next.point.dot(nearest.normal) - nearest.offset <= 1e-12 * size_ || !insert(next)) break;
    }
    return answer(*nearest_facet());
  }

 private:
  [[nodiscard]] Difference support(const Vec3& direction) const {
    const Vec3 on_a = a_.support(direction), on_b = b_.support(-direction);
    return {on_a - on_b, on_a, on_b};
  }

  [[nodiscard]] std::vector<Facet>::const_iterator nearest_facet() const {
    return std::ranges::min_element(facets_, {}, &Facet::offset);
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
    add_facet(0, 1, 2);
    add_facet(1, 0, 3);
    add_facet(2, 1, 3);
    add_facet(0, 2, 3);
    for (const Difference& point : first) insert(point);
  }

  void add_facet(std::size_t i, std::size_t j, std::size_t k) {
    const Vec3& p = points_[i].point;
    const Vec3 normal = (points_[j].point - p).cross(points_[k].point - p).normalized();
    facets_.push_back({{i, j, k}, normal, normal.dot(p)});
  }

  // False when the point is not outside.
  bool insert(const Difference& point) {
    std::map<std::pair<std::size_t, std::size_t>, int> edges;  // of the facets that see the point
    std::vector<Facet> kept;
    for (const Facet& facet : facets_) {
      if (facet.normal.dot(point.point) - facet.offset <= 1e-14 * size_) {
        kept.push_back(facet);
        continue;
      }
      for (std::size_t e = 0; e < 3; ++e) edges[{facet.corner[e], facet.corner[(e + 1) % 3]}] = 1;
    }
    if (edges.empty()) return false;
    points_.push_back(point);
    facets_.swap(kept);
    for (const auto& [edge, seen] : edges)
      if (!edges.contains({edge.second, edge.first})) add_facet(edge.first, edge.second, points_.size() - 1);
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
};

}  // namespace

Penetration expanding_polytope(const ConvexView& a, const ConvexView& b) { return Expansion(a, b).run(); }

}  // namespace plumb::referee
