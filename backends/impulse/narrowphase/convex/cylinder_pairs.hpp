// Cylinders against all convex shapes. Everything is worked out in the cylinder's frame, the cylinder as first shape.
#pragma once

#include "narrowphase/convex/capsule.hpp"
#include "narrowphase/convex/cylinder_axes.hpp"
#include "narrowphase/convex/round_polyhedron.hpp"

namespace plumb::impulse {

namespace cylinder {

PLUMB_HD inline Cylinder of(const Shape& shape) { return {shape.size.x, shape.size.y}; }

/// The polyhedron's most level edge at its foremost corner, or that corner alone.
template <class View>
PLUMB_HD void foremost_edge(const View& view, const polyhedra::Placement& at, const Axis& axis, Vec& p, Vec& d) {
  const auto place = [&](std::uint32_t e) {
    const HullEdge edge = view.edge(e);
    p = at.turn * view.vertex(edge.from) + at.shift;
    d = at.turn * view.vertex(edge.to) + at.shift - p;
  };
  if (axis.kind == Axis::Kind::kEdge) return place(axis.feature);
  const std::uint32_t v = view.support(-multiply_transposed(at.turn, axis.normal));
  Real least = Real(0.05);
  p = at.turn * view.vertex(v) + at.shift;
  d = {0, 0, 0};
  std::uint32_t best = 0xffffffffU;
  for (std::uint32_t e = 0; e < view.edge_count(); ++e) {
    const HullEdge edge = view.edge(e);
    if (edge.from != v && edge.to != v) continue;
    const Vec along = at.turn * (view.vertex(edge.to) - view.vertex(edge.from));
    if (const Real slope = abs(dot(axis.normal, along)) / length(along); slope < least) {
      least = slope;
      best = e;
    }
  }
  if (best != 0xffffffffU) place(best);
}

/// Of a face that lies across the normal, and no part of the cylinder over it: the side that is nearest to what of the
/// cylinder is foremost. All sides are as far along the normal.
template <class View>
PLUMB_HD void nearest_side(const Cylinder& c, const View& view, std::uint32_t face, const polyhedra::Placement& at,
                           const Vec& n, Vec& p, Vec& d) {
  const Part3 part = part_along(n);
  const Vec u = c.radius * radial(n);
  const Vec from = part == Part3::kSide  ? Vec{u.x, -c.half, u.z}
                   : part == Part3::kCap ? Vec{0, cap_height(c, n), 0}
                                         : rim_point(c, n);
  const Vec along = {0, part == Part3::kSide ? 2 * c.half : Real(0), 0};
  Real least = kHuge;
  const std::uint32_t size = view.loop_size(face);
  for (std::uint32_t k = 0; k < size; ++k) {
    const Vec corner = at.turn * view.vertex(view.loop(face, k)) + at.shift;
    const Vec side = at.turn * view.vertex(view.loop(face, k + 1 == size ? 0 : k + 1)) + at.shift - corner;
    const ClosestPair near = closest_between(from, along, corner, side);
    if (const Real distance = length_squared(near.on_b - near.on_a); distance < least) {
      least = distance;
      p = corner;
      d = side;
    }
  }
}

template <class View>
PLUMB_HD bool touch_polyhedron(const Cylinder& c, const View& view, const polyhedra::Placement& at, Real margin,
                               Real tie, Manifold& out) {
  out.count = 0;
  Axis axis;
  if (!find_axis(c, view, at, margin, tie, axis)) return false;
  out.normal = axis.normal;
  const Vec against = -multiply_transposed(at.turn, axis.normal);
  const std::uint32_t face = axis.kind == Axis::Kind::kFace ? axis.feature : face_at_support(view, against);
  if (dot(view.normal(face), against) > kNearFace) {
    const FacePolygon<View> polygon = {view,     face, ContactPlane(axis.normal), at.turn,
                                       at.shift, true, view.loop_size(face)};
    touch_face(c, axis.normal, polygon, false, axis.separation, margin, tie, out);
    if (out.count != 0) return true;
  }
  Vec p, d;
  if (axis.kind == Axis::Kind::kFace)
    nearest_side(c, view, face, at, axis.normal, p, d);
  else
    foremost_edge(view, at, axis, p, d);
  touch_edge(c, axis.normal, p, d, 0, axis.separation, margin, out);
  return out.count != 0;
}

/// Where the segment p + [0, 1] d is nearest to the cylinder: the distance to a convex body is convex along it. Of one
/// that runs through the cylinder some place within.
PLUMB_HD inline Real nearest_on_segment(const Cylinder& c, const Vec& p, const Vec& d) {
  const auto distance = [&](Real s) { return max(nearest(c, p + s * d).distance, Real(0)); };
  Real low = 0, high = 1;
  Real s = high - kGolden, r = kGolden, at_s = distance(s), at_r = distance(r);
  for (int i = 0; i < kSections + 6; ++i) {
    if (at_s <= 0) return s;  // else it would end where the segment comes out
    if (at_r <= 0) return r;
    if (at_s <= at_r) {
      high = r;
      r = s;
      at_r = at_s;
      s = high - kGolden * (high - low);
      at_s = distance(s);
    } else {
      low = s;
      s = r;
      at_s = at_r;
      r = low + kGolden * (high - low);
      at_r = distance(r);
    }
  }
  return Real(0.5) * (low + high);
}

/// A capsule's segment.
PLUMB_HD inline bool touch_segment(const Cylinder& c, const Vec& p, const Vec& d, Real radius, Real margin, Real tie,
                                   Manifold& out) {
  out.count = 0;
  const Vec q = p + d;
  Real s = nearest_on_segment(c, p, d);
  // Its ends are met exactly, and so is the middle of what lies level.
  Nearest near = nearest(c, p + s * d);
  for (int k = 0; k < 2; ++k) {
    const auto end = static_cast<Real>(k);
    if (const Nearest at_end = nearest(c, p + end * d); at_end.distance <= near.distance + tie) {
      near = at_end;
      s = end;
    }
  }
  if (near.distance - radius > margin) return false;
  out.normal = near.normal;
  Real separation = near.distance;
  if (!(separation > tie)) {  // through the surface: the shortest way out for the whole of it
    separation = -kHuge;
    const auto take = [&](const Vec& n) {
      const Real gap = min(dot(n, p), dot(n, q)) - c.reach(n);
      if (gap > separation + tie) {
        separation = gap;
        out.normal = n;
      }
    };
    take({0, 1, 0});
    take({0, -1, 0});
    take(radial(p));
    take(radial(q));
    const Vec across = normalized_or({-d.z, 0, d.x}, {1, 0, 0});
    take(across);
    take(-across);
  }
  const Real rise = abs(dot(out.normal, d));
  if (rise <= Real(0.05) * length(d))
    touch_edge(c, out.normal, p, d, radius, separation - radius, margin, out);
  else
    touch_edge(c, out.normal, dot(out.normal, d) < 0 ? q : p, {0, 0, 0}, radius, separation - radius, margin, out);
  return out.count != 0;
}

/// Another cylinder, seen from the first one's frame.
struct Other {
  Cylinder c;
  Mat turn;
  Vec shift;

  PLUMB_HD Vec local(const Vec& n) const { return multiply_transposed(turn, n); }
  PLUMB_HD Vec placed(const Vec& p) const { return turn * p + shift; }
};

/// The point of a rim that is nearest to a cylinder: the best of twelve, then golden section between its neighbours.
/// The rim is about `centre`, which x and z span.
PLUMB_HD inline Vec nearest_of_rim(const Cylinder& c, const Vec& centre, const Vec& x, const Vec& z) {
  const auto at = [&](int i) {
    constexpr Real cosines[] = {Real(1), Real(0.8660254037844386), Real(0.5), Real(0)};
    const int k = i % 12, turn = k / 3, rest = k - 3 * turn;
    const Real u = cosines[rest], v = cosines[3 - rest];
    const Real a = turn == 0 ? u : turn == 1 ? -v : turn == 2 ? -u : v;
    const Real b = turn == 0 ? v : turn == 1 ? u : turn == 2 ? -v : -u;
    return a * x + b * z;
  };
  int best = 0;
  Real least = kHuge;
  for (int i = 0; i < 12; ++i)
    if (const Real distance = nearest(c, centre + at(i)).distance; distance < least) {
      least = distance;
      best = i;
    }
  const Vec from = at(best + 11), to = at(best + 1);
  const Real radius = length(x);
  const auto between = [&](Real s) {
    const Vec chord = (1 - s) * from + s * to;
    return centre + (radius / length(chord)) * chord;
  };
  Real low = 0, high = 1, s = 1 - kGolden, r = kGolden;
  Real at_s = nearest(c, between(s)).distance, at_r = nearest(c, between(r)).distance;
  for (int i = 0; i < kSections; ++i) {
    if (at_s < at_r) {
      high = r;
      r = s;
      at_r = at_s;
      s = high - kGolden * (high - low);
      at_s = nearest(c, between(s)).distance;
    } else {
      low = s;
      s = r;
      at_s = at_r;
      r = low + kGolden * (high - low);
      at_r = nearest(c, between(r)).distance;
    }
  }
  return between(Real(0.5) * (low + high));
}

/// The best axis of two cylinders: known directions, those from either to the nearest point of the other's rims, and
/// from the best of all a search over the sphere by steps that halve, which rims that overlap need.
PLUMB_HD inline bool find_axis_of_two(const Cylinder& c, const Other& b, Real margin, Real tie, Axis& best) {
  const Vec &axis = b.turn.y, &t = b.shift;
  const auto gap = [&](const Vec& n) { return dot(n, t) - c.reach(n) - b.c.reach(b.local(n)); };
  bool apart = false;
  const auto take = [&](const Vec& n, Real least_gain) {
    const Real s = gap(n);
    apart = apart || s > margin;
    if (s > best.separation + least_gain) best = {n, s, Axis::Kind::kFace, 0};
  };
  const auto take_either = [&](const Vec& way) { take(dot(way, t) < 0 ? -way : way, tie); };
  take_either({0, 1, 0});
  take_either(axis);
  const Vec across = cross(Vec{0, 1, 0}, axis);
  if (length_squared(across) > kParallel * kParallel) take_either(normalized_or(across, {1, 0, 0}));
  take_either(radial(t));
  take_either(normalized_or(t - dot(axis, t) * axis, perpendicular(axis)));
  if (apart) return false;

  // What is found by search is worth to leave a known direction for only if it is better by more than its rounding.
  const Real gain = 8 * tie + Real(1e-6) * min(c.radius, b.c.radius);
  Vec of_rims = best.normal;
  Real best_of_rims = -kHuge;
  const auto note = [&](const Vec& n) {
    if (const Real s = gap(n); s > best_of_rims) {
      best_of_rims = s;
      of_rims = n;
    }
  };
  const Vec back = -b.local(t);  // this one's centre, seen from the other
  const Vec own_axis = b.local({0, 1, 0}), own_x = b.local({c.radius, 0, 0}), own_z = b.local({0, 0, c.radius});
  for (int cap = 0; cap < 2; ++cap) {
    const Real side = cap == 0 ? Real(-1) : Real(1);
    const Vec theirs = nearest_of_rim(c, t + (side * b.c.half) * axis, b.c.radius * b.turn.x, b.c.radius * b.turn.z);
    const Vec n_theirs = nearest(c, theirs).normal;
    take(n_theirs, gain);
    const Vec own = nearest_of_rim(b.c, back + (side * c.half) * own_axis, own_x, own_z);
    const Vec n_own = -(b.turn * nearest(b.c, own).normal);
    take(n_own, gain);
    note(n_theirs);
    note(n_own);
  }
  if (apart) return false;

  // From the best, and from between the best and what the rims told: where two rims cross, it lies between them.
  const Vec seeds[3] = {best.normal, normalized_or(best.normal + of_rims, best.normal), of_rims};
  for (const Vec& seed : seeds) {
    Vec n = seed;
    Real at = gap(n), step = Real(0.25);
    for (int i = 0; i < 60 && step > 64 * kEpsilon; ++i) {
      const Vec u = perpendicular(n), v = cross(n, u);
      const Vec ways[8] = {u, -u, v, -v, u + v, u - v, v - u, -u - v};
      bool better = false;
      for (int k = 0; k < 8 && !better; ++k) {
        const Vec trial = normalized_or(n + step * ways[k], n);
        if (const Real s = gap(trial); s > at) {
          at = s;
          n = trial;
          better = true;
        }
      }
      if (!better) step *= Real(0.5);
    }
    take(n, gain);
  }
  return !apart;
}

/// Two caps that look at each other: where their rims lie over the other disc, and where they cross.
PLUMB_HD inline void touch_caps(const Cylinder& c, const Other& b, const Vec& n, Real separation, Real margin, Real tie,
                                Manifold& out) {
  const ContactPlane plane(n);
  const Real own_y = cap_height(c, n);
  const Vec n_b = b.local(-n);
  const Real other_y = cap_height(b.c, n_b);
  Overlap overlap;
  overlap.deepest = separation;
  overlap.margin = margin;
  overlap.tie = tie;
  // Along n from a point of one cap to the plane of the other.
  const auto add = [&](const Vec& p, Real gap, std::uint32_t feature) {
    const Vec flat = plane.flatten(p);
    overlap.add(flat.x, flat.y, gap, feature);
  };
  const Vec cap_b = b.turn.y;  // the other's caps are across this
  const Real height_b = dot(cap_b, b.placed({0, other_y, 0}));
  const auto own_point = [&](const Vec& p, std::uint32_t feature) {
    const Real gap = (height_b - dot(cap_b, p)) / dot(cap_b, n);
    const Vec q = multiply_transposed(b.turn, p + gap * n - b.shift);
    if (q.x * q.x + q.z * q.z <= b.c.radius * b.c.radius * (1 + kClipSlack)) add(p, gap, feature);
  };
  const auto other_point = [&](const Vec& q, std::uint32_t feature) {
    const Real gap = (q.y - own_y) / n.y;
    const Vec p = q - gap * n;
    if (p.x * p.x + p.z * p.z <= c.radius * c.radius * (1 + kClipSlack)) add(p, gap, feature);
  };
  const auto rim = [&](const Vec& normal, const Cylinder& of, Real y, const auto& each, std::uint32_t first) {
    const Real tilt = sqrt(normal.x * normal.x + normal.z * normal.z);
    const bool level = tilt <= kLevel;
    const Real ux = level ? of.radius : of.radius * normal.x / tilt, uz = level ? Real(0) : of.radius * normal.z / tilt;
    each(Vec{ux, y, uz}, first);
    each(Vec{-uz, y, ux}, first + 1);
    each(Vec{-ux, y, -uz}, first + 2);
    each(Vec{uz, y, -ux}, first + 3);
  };
  rim(n, c, own_y, own_point, 1);
  rim(
      n_b, b.c, other_y, [&](const Vec& p, std::uint32_t feature) { other_point(b.placed(p), feature); }, 5);
  const Vec to = b.placed({0, other_y, 0});
  const Real apart2 = to.x * to.x + to.z * to.z;
  if (apart2 > 0) {  // both circles as seen from above: on the line through where they cross
    const Real apart = sqrt(apart2);
    const Real along = (apart2 + c.radius * c.radius - b.c.radius * b.c.radius) / (2 * apart);
    if (const Real square = c.radius * c.radius - along * along; square > 0) {
      const Real side = sqrt(square), ux = to.x / apart, uz = to.z / apart;
      own_point({along * ux - side * uz, own_y, along * uz + side * ux}, 9);
      own_point({along * ux + side * uz, own_y, along * uz - side * ux}, 10);
    }
  }
  // Rims that cross beside both discs' middles are deepest where neither's foremost point lies over the other disc.
  Real least = kHuge;
  for (int i = 0; i < overlap.count; ++i) least = min(least, overlap.at[i].separation);
  if (overlap.count != 0 && least > separation + kClipSlack * min(c.radius, b.c.radius))
    add(rim_point(c, n), separation, 11);
  const int count = choose_points(overlap.at, overlap.count, tie);
  out.count = static_cast<std::uint32_t>(count);
  for (int i = 0; i < count; ++i) {
    const Candidate& at = overlap.at[i];
    // On the cylinder's own cap below (x, y), and half of the gap up.
    const Vec flat = plane.unflatten({at.x, at.y, 0});
    const Real rise = (own_y - flat.y) / n.y;
    out.points[i] = {flat + (rise + Real(0.5) * at.separation) * n, at.separation, at.feature};
  }
}

PLUMB_HD inline bool touch_other(const Cylinder& c, const Other& b, Real margin, Real tie, Manifold& out) {
  out.count = 0;
  Axis axis;
  if (!find_axis_of_two(c, b, margin, tie, axis)) return false;
  const Vec n = out.normal = axis.normal;
  const Vec n_b = b.local(-n);
  const Part3 own = part_along(n), other = part_along(n_b);
  if (own == Part3::kCap && other == Part3::kCap) touch_caps(c, b, n, axis.separation, margin, tie, out);
  if (out.count != 0) return true;
  if (own == Part3::kRim || other != Part3::kRim) {
    if (own == Part3::kSide && other == Part3::kCap) {  // its line over the other's disc: the same seen from there
      const Vec u = c.radius * radial(n);
      const Vec from = b.local(Vec{u.x, -c.half, u.z} - b.shift), to = b.local(Vec{u.x, c.half, u.z} - b.shift);
      touch_edge(b.c, n_b, from, to - from, 0, axis.separation, margin, out);
      for (std::uint32_t i = 0; i < out.count; ++i) out.points[i].position = b.placed(out.points[i].position);
      return out.count != 0;
    }
    const Vec u = b.c.radius * radial(n_b);
    const Vec from = b.placed({u.x, -b.c.half, u.z}), to = b.placed({u.x, b.c.half, u.z});
    touch_edge(c, n, from, to - from, 0, axis.separation, margin, out);
    return out.count != 0;
  }
  touch_edge(c, n, b.placed(rim_point(b.c, n_b)), {0, 0, 0}, 0, axis.separation, margin, out);
  return out.count != 0;
}

}  // namespace cylinder

PLUMB_HD inline bool collide_sphere_cylinder(const ShapePair& pair, const Hulls&, Manifold& out) {
  const cylinder::Nearest near = cylinder::nearest(cylinder::of(pair.b), rotate_back(pair.qb, -pair.d));
  return touch_ball(pair.a.size.x, rotate(pair.qb, -near.normal), near.distance, pair.margin, out);
}

PLUMB_HD inline bool collide_box_cylinder(const ShapePair& pair, const Hulls&, Manifold& out) {
  const polyhedra::Placement at = {to_matrix(conjugate(pair.qb) * pair.qa), rotate_back(pair.qb, -pair.d)};
  if (!cylinder::touch_polyhedron(cylinder::of(pair.b), BoxView{pair.a.size}, at, pair.margin,
                                  kTie * (pair.a.reach + pair.b.reach), out))
    return false;
  round_polyhedron::put_second(pair.qb, pair.d, out);
  return true;
}

PLUMB_HD inline bool collide_hull_cylinder(const ShapePair& pair, const Hulls& hulls, Manifold& out) {
  const polyhedra::Placement at = {to_matrix(conjugate(pair.qb) * pair.qa), rotate_back(pair.qb, -pair.d)};
  if (!cylinder::touch_polyhedron(cylinder::of(pair.b), HullView(hulls, pair.a.hull), at, pair.margin,
                                  kTie * (pair.a.reach + pair.b.reach), out))
    return false;
  round_polyhedron::put_second(pair.qb, pair.d, out);
  return true;
}

PLUMB_HD inline bool collide_capsule_cylinder(const ShapePair& pair, const Hulls&, Manifold& out) {
  const Vec half = rotate_back(pair.qb, half_segment(pair.a, pair.qa)), centre = rotate_back(pair.qb, -pair.d);
  const Real tie = kTie * (pair.a.reach + pair.b.reach);
  if (!cylinder::touch_segment(cylinder::of(pair.b), centre - half, half + half, pair.a.size.x, pair.margin, tie, out))
    return false;
  round_polyhedron::put_second(pair.qb, pair.d, out);
  return true;
}

PLUMB_HD inline bool collide_cylinder_cylinder(const ShapePair& pair, const Hulls&, Manifold& out) {
  const cylinder::Other other = {cylinder::of(pair.b), to_matrix(conjugate(pair.qa) * pair.qb),
                                 rotate_back(pair.qa, pair.d)};
  if (!cylinder::touch_other(cylinder::of(pair.a), other, pair.margin, kTie * (pair.a.reach + pair.b.reach), out))
    return false;
  round_polyhedron::place(pair.qa, {0, 0, 0}, out);
  return true;
}

}  // namespace plumb::impulse
