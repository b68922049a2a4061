// Which triangles of a surface a box meets that is carried along a line in the surface's frame. visit(triangle) may
// bring visit.most, a length along the way, closer: beyond it nothing is looked for any more, and a negative one ends
// the search. Triangles may be visited that the box misses by a little; none that it touches is left out.
#pragma once

#include "geometry/surface.hpp"
#include "queries/sweep_search.hpp"

namespace plumb::impulse {

/// A box about a start and the way that it goes; of no length where it stays.
struct SurfaceWay {
  Vec64 start, along;  ///< unit, or 0
  Box carried;         ///< about the start
};

/// By the mesh's tree, what is nearer first.
template <class Visit>
PLUMB_HD void visit_way(const MeshView& mesh, const SurfaceWay& way, Visit& visit) {
  SweptBox sweep(way.start, way.along, visit.most, way.carried);
  const auto look = [&](std::uint32_t triangle) {
    visit(triangle);
    sweep.last = sweep.place_of(visit.most);
  };
  visit_nearest_first(mesh.tree, sweep, look);
}

/// Row by row of cells across the axis that the way runs along: in each row those cells that the box passes while it is
/// over that row, so that a way costs as many cells as it crosses.
class FieldWalk {
 public:
  PLUMB_HD FieldWalk(const HeightView& field, const SurfaceWay& way)
      : field_(field),
        carried_{to_numbers<double>(way.carried.low), to_numbers<double>(way.carried.high)},
        along_(way.along),
        middle_(-dot(way.start, way.along)) {
    base_ = way.start + middle_ * along_;
    spacing_[0] = static_cast<double>(field.spacing_x);
    spacing_[1] = static_cast<double>(field.spacing_z);
    first_[0] = static_cast<double>(field.x0);
    first_[1] = static_cast<double>(field.z0);
    corners_[0] = field.columns;
    corners_[1] = field.rows;
    for (int k = 0; k < 2; ++k)
      slack_[k] = kSlack * (abs(first_[k]) + abs(base_[2 * k]) + abs(carried_.low[2 * k]) + abs(carried_.high[2 * k]));
  }

  template <class Visit>
  PLUMB_HD void run(Visit& visit) {
    double begin = -middle_, end = min(visit.most - middle_, line_shapes::kFar);
    for (int k = 0; k < 2; ++k)
      if (!within(2 * k, first_[k] - slack_[k], -first_[k] + slack_[k], begin, end)) return;
    const int major = abs(along_.x) * spacing_[1] >= abs(along_.z) * spacing_[0] ? 0 : 1;
    Range slabs = cells(major, begin, end);
    const bool down = along_[2 * major] < 0;
    for (std::uint32_t i = slabs.first; i <= slabs.last; ++i) {
      const std::uint32_t slab = down ? slabs.last - (i - slabs.first) : i;
      const double low = first_[major] + spacing_[major] * static_cast<double>(slab), high = low + spacing_[major];
      double enter = begin, leave = min(end, visit.most - middle_);
      if (!within(2 * major, low - slack_[major], high + slack_[major], enter, leave)) continue;
      visit_slab(major, slab, enter, leave, visit);
      if (visit.most < 0) return;
    }
  }

 private:
  static constexpr double kSlack = 16 * static_cast<double>(kEpsilon);

  struct Range {
    std::uint32_t first, last;
  };
  struct Box64 {
    Vec64 low, high;
  };

  /// Narrows begin to end, places along the way, to where the box touches low to high on an axis. False: nowhere.
  PLUMB_HD bool within(int axis, double low, double high, double& begin, double& end) const {
    const double d = along_[axis], from = low - carried_.high[axis] - base_[axis],
                 to = high - carried_.low[axis] - base_[axis];
    if (d == 0) return from <= 0 && to >= 0 && begin <= end;
    const double a = clamp((d > 0 ? from : to) / d, -line_shapes::kFar, line_shapes::kFar),
                 b = clamp((d > 0 ? to : from) / d, -line_shapes::kFar, line_shapes::kFar);
    begin = max(begin, a);
    end = min(end, b);
    return begin <= end;
  }
  /// What the box covers on an axis on its way from enter to leave.
  PLUMB_HD void covered(int axis, double enter, double leave, double& low, double& high) const {
    const double a = base_[axis] + enter * along_[axis], b = base_[axis] + leave * along_[axis];
    low = min(a, b) + carried_.low[axis];
    high = max(a, b) + carried_.high[axis];
  }
  PLUMB_HD Range cells(int k, double enter, double leave) const {
    double low, high;
    covered(2 * k, enter, leave, low, high);
    return {cell(k, low - slack_[k]), cell(k, high + slack_[k])};
  }
  /// The cell at a coordinate; the nearest where it is outside.
  PLUMB_HD std::uint32_t cell(int k, double x) const {
    const double at = (x - first_[k]) / spacing_[k], last = static_cast<double>(corners_[k] - 2);
    return at > 0 ? static_cast<std::uint32_t>(min(at, last)) : 0U;
  }

  template <class Visit>
  PLUMB_HD void visit_slab(int major, std::uint32_t slab, double enter, double leave, Visit& visit) const {
    const Range others = cells(1 - major, enter, leave);
    double low, high;
    covered(1, enter, leave, low, high);
    const double slack = kSlack * (abs(low) + abs(high));
    for (std::uint32_t other = others.first; other <= others.last; ++other) {
      const std::uint32_t column = major == 0 ? slab : other, row = major == 0 ? other : slab;
      const Real* at = field_.heights + row * field_.columns + column;
      const Real* next = at + field_.columns;
      const Real least = min(min(at[0], at[1]), min(next[0], next[1])),
                 most = max(max(at[0], at[1]), max(next[0], next[1]));
      if (static_cast<double>(most) < low - slack || static_cast<double>(least) > high + slack) continue;
      for (std::uint32_t k = 0; k < 2; ++k) {
        visit(2 * (row * (field_.columns - 1) + column) + k);
        if (visit.most < 0) return;
      }
    }
  }

  const HeightView& field_;
  Box64 carried_;
  Vec64 along_;
  double middle_;
  Vec64 base_;  ///< the way's point nearest to the surface's middle: places along the way count from here
  double spacing_[2], first_[2], slack_[2];  ///< along x and z
  std::uint32_t corners_[2];
};

template <class Visit>
PLUMB_HD void visit_way(const HeightView& field, const SurfaceWay& way, Visit& visit) {
  FieldWalk(field, way).run(visit);
}

/// f(view) for a mesh or a height field.
template <class F>
PLUMB_HD void with_surface(const Surfaces& surfaces, const Shape& shape, const F& f) {
  if (shape.type == ShapeType::kMesh)
    f(surfaces.meshes[shape.hull]);
  else
    f(surfaces.fields[shape.hull]);
}

}  // namespace plumb::impulse
