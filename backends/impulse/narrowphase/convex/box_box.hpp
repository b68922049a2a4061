// Two boxes: the separating axis test over 15 axes in A's frame (Gottschalk 1996; Ericson, Real-Time Collision
// Detection, 4.4), then the overlap of the two faces that look at each other.
//
// The axis that separates the boxes most gives the normal. Both faces are projected along it into the plane of A's
// face, whichever box the axis belongs to, and every edge of B's face is clipped against A's rectangle
// (Sutherland-Hodgman edge by edge, which for two convex faces finds the same corners without a list of vertices).
// Because A's and B's roles never change, nor do the ids of the points when the axis passes from one box to the other.
// An edge axis close to a face normal keeps the faces' points too: two boxes that are turned against each other and
// tremble do not fall back to one point.
#pragma once

#include "geometry/shape.hpp"
#include "math/mat33.hpp"
#include "narrowphase/convex/candidates.hpp"
#include "narrowphase/feature.hpp"

namespace plumb::impulse {

namespace box_box {

/// Both boxes in A's frame.
struct BoxPair {
  Vec a, b;  ///< half extents
  Mat r;     ///< B's axes
  Vec t;     ///< B's centre
};

struct BoxAxis {
  Vec normal;  ///< unit, from A to B, in A's frame
  Real separation;
  int a, b;  ///< the edges' axes of an edge pair; a face axis of A has b = -1, of B a = -1
};

PLUMB_HD inline Real sign_of(Real x) { return x < 0 ? Real(-1) : Real(1); }
PLUMB_HD inline int widest(const Vec& v) {
  const Vec m = abs(v);
  return m.x >= m.y ? (m.x >= m.z ? 0 : 2) : (m.y >= m.z ? 1 : 2);
}

/// Of the smallest half extent, the overlap or gap within which boxes are level with each other.
constexpr Real kLevel = Real(0.01);

/// Whether boxes are level along a face axis across the normal, and so overlap by next to nothing along the normal,
/// too, or are apart there: an edge grazes an edge, as where a box slides from one tile of a floor onto the next. The
/// tile's side, which lies below the floor by no more than what a resting box sinks in, would stop it. by_a, by_b:
/// separations along the axes of either.
PLUMB_HD inline bool edges_graze(const BoxPair& p, const Vec& by_a, const Vec& by_b, const Vec& normal) {
  const Vec along_a = abs(normal), along_b = abs(multiply_transposed(p.r, normal));
  const Real level = kLevel * min(min(min(p.a.x, p.a.y), p.a.z), min(min(p.b.x, p.b.y), p.b.z));
  for (int k = 0; k < 3; ++k) {
    if (along_a[k] < Real(0.5) && abs(by_a[k]) < level) return true;
    if (along_b[k] < Real(0.5) && abs(by_b[k]) < level) return true;
  }
  return false;
}

/// The axis of greatest separation. False as soon as one separates by more than margin, by out.separation, and where
/// edges graze, unless margin is 0: who asks for no points ahead of time, as queries do, asks for overlap however
/// small.
PLUMB_HD inline bool find_axis(const BoxPair& p, Real margin, Real tie, BoxAxis& out) {
  const Mat m = {abs(p.r.x), abs(p.r.y), abs(p.r.z)};
  const Vec by_a = abs(p.t) - p.a - m * p.b;
  out.separation = max(max(by_a.x, by_a.y), by_a.z);
  if (out.separation > margin) return false;
  const Vec along_b = multiply_transposed(p.r, p.t);
  const Vec by_b = abs(along_b) - p.b - multiply_transposed(m, p.a);
  out.separation = max(max(by_b.x, by_b.y), by_b.z);
  if (out.separation > margin) return false;

  Real best = by_a.x;
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (by_a[i] > best + tie) {
      best = by_a[i];
      axis = i;
    }
  for (int j = 0; j < 3; ++j)
    if (by_b[j] > best + tie) {
      best = by_b[j];
      axis = 3 + j;
    }

  // The axis e_i x b_j as computed is at right angles to e_i and b_j, and every length along it is formed from the
  // axis itself: so it separates truly even where the edges are nearly parallel and its direction is mostly rounding.
  Real best_edge = -kHuge;
  int edge = -1;
  for (int j = 0; j < 3; ++j) {
    const Vec u = p.r[j];
    const Vec square = scale(u, u);
    const int j1 = j == 2 ? 0 : j + 1, j2 = j == 0 ? 2 : j - 1;
    const Vec &v = p.r[j1], &w = p.r[j2];
    for (int i = 0; i < 3; ++i) {
      const int i1 = i == 2 ? 0 : i + 1, i2 = i == 0 ? 2 : i - 1;
      const Real sine2 = square[i1] + square[i2];
      if (sine2 <= kParallel * kParallel) continue;
      const Real reach = p.a[i1] * m[j][i2] + p.a[i2] * m[j][i1] + p.b[j1] * abs(v[i2] * u[i1] - v[i1] * u[i2]) +
                         p.b[j2] * abs(w[i2] * u[i1] - w[i1] * u[i2]);
      const Real s = (abs(p.t[i2] * u[i1] - p.t[i1] * u[i2]) - reach) / sqrt(sine2);
      if (s > margin) {
        out.separation = s;
        return false;
      }
      if (s > best_edge + tie) {
        best_edge = s;
        edge = 3 * i + j;
      }
    }
  }

  if (edge >= 0 && best_edge > best + tie) {
    const int i = edge / 3, j = edge - 3 * i;
    const int i1 = i == 2 ? 0 : i + 1, i2 = i == 0 ? 2 : i - 1;
    const Vec u = p.r[j];
    Vec n = {0, 0, 0};
    n[i1] = -u[i2];
    n[i2] = u[i1];
    const Real scale_to_unit = (dot(n, p.t) < 0 ? Real(-1) : Real(1)) / length(n);
    out = {scale_to_unit * n, best_edge, i, j};
    return !(margin > 0 && edges_graze(p, by_a, by_b, out.normal));
  }
  if (axis < 3) {
    Vec n = {0, 0, 0};
    n[axis] = sign_of(p.t[axis]);
    out = {n, best, axis, -1};
  } else {
    out = {sign_of(along_b[axis - 3]) * p.r[axis - 3], best, -1, axis - 3};
  }
  return !(margin > 0 && edges_graze(p, by_a, by_b, out.normal));
}

/// Where the two edges of an edge axis come closest: one point; none where they pass each other by.
PLUMB_HD inline void touch_edges(const BoxPair& p, const BoxAxis& axis, Manifold& out) {
  Vec on_a = {0, 0, 0}, on_b = p.t;
  std::uint32_t mask_a = 0, mask_b = 0;
  for (int k = 0; k < 3; ++k) {
    if (k != axis.a) {
      const bool positive = axis.normal[k] > 0;
      on_a[k] = positive ? p.a[k] : -p.a[k];
      mask_a |= positive ? 1U << k : 0U;
    }
    if (k != axis.b) {
      const bool positive = dot(axis.normal, p.r[k]) < 0;
      on_b += (positive ? p.b[k] : -p.b[k]) * p.r[k];
      mask_b |= positive ? 1U << k : 0U;
    }
  }
  // Closest points of the lines on_a + s e and on_b + r u, kept on the edges (Ericson 5.1.9). The square of the sine
  // from u's other components: 1 - cosine * cosine is 0 long before the edges are parallel.
  const Vec u = p.r[axis.b], w = on_b - on_a;
  const Real u0 = u[axis.a == 0 ? 1 : 0], u1 = u[axis.a == 2 ? 1 : 2];
  const Real cosine = u[axis.a], sine2 = u0 * u0 + u1 * u1, along_a = w[axis.a], along_b = dot(u, w);
  const Real half_a = p.a[axis.a], half_b = p.b[axis.b];
  const Real free_s = (along_a - cosine * along_b) / sine2, free_r = (cosine * along_a - along_b) / sine2;
  if (axis.separation > 0 && (abs(free_s) > half_a * (1 + kClipSlack) || abs(free_r) > half_b * (1 + kClipSlack)))
    return;
  const Real r = clamp(cosine * clamp(free_s, -half_a, half_a) - along_b, -half_b, half_b);
  on_a[axis.a] = clamp(along_a + cosine * r, -half_a, half_a);
  on_b += r * u;
  out.count = 1;
  out.points[0] = {Real(0.5) * (on_a + on_b), axis.separation,
                   feature_id(Part::kEdge, box_edge(axis.a, mask_a), Part::kEdge, box_edge(axis.b, mask_b))};
}

/// The rectangle of A's face and the parallelogram of B's, both in the plane of A's face: projected along the normal.
struct BoxFaces {
  int f, u, v;          ///< A's face lies across axis f and spans u and v
  Real side_a;          ///< +1, -1: on which side of A
  Real half_x, half_y;  ///< of the rectangle
  int g, h, k;          ///< the same of B
  Real side_b;
  Vec centre, along_h, along_k;  ///< x, y and separation of the parallelogram's centre, and its half sides
};

PLUMB_HD inline BoxFaces project_faces(const BoxPair& p, const BoxAxis& axis) {
  const Vec& n = axis.normal;
  BoxFaces o;
  o.f = axis.a >= 0 && axis.b < 0 ? axis.a : widest(n);
  o.u = o.f == 2 ? 0 : o.f + 1;
  o.v = o.f == 0 ? 2 : o.f - 1;
  o.side_a = sign_of(n[o.f]);
  o.half_x = p.a[o.u];
  o.half_y = p.a[o.v];
  const Vec along_b = multiply_transposed(p.r, n);
  o.g = axis.a < 0 ? axis.b : widest(along_b);
  o.h = o.g == 2 ? 0 : o.g + 1;
  o.k = o.g == 0 ? 2 : o.g - 1;
  o.side_b = -sign_of(along_b[o.g]);
  const Real stretch = 1 / abs(n[o.f]);
  const auto project = [&](const Vec& w, Real height) {
    const Real t = (o.side_a * w[o.f] - height) * stretch;
    return Vec{w[o.u] - t * n[o.u], w[o.v] - t * n[o.v], t};
  };
  o.centre = project(p.t + (o.side_b * p.b[o.g]) * p.r[o.g], p.a[o.f]);
  o.along_h = project(p.b[o.h] * p.r[o.h], 0);
  o.along_k = project(p.b[o.k] * p.r[o.k], 0);
  return o;
}

constexpr int kMostPoints = 12;  // two a side of B's face and the corners of A's

/// Clips the parameter range [s0, s1] of a side's coordinate p + s d to |.| <= limit. The plane that cut an end goes to
/// cut0, cut1: 0 for -limit, 1 for +limit, plus `plane`.
PLUMB_HD inline bool clip_slab(Real p, Real d, Real limit, int plane, Real& s0, Real& s1, int& cut0, int& cut1) {
  const Real q = p + d;
  const int below = p < q ? plane : plane + 1, above = p < q ? plane + 1 : plane;  // entered through, left through
  const Real enter = p < q ? -limit : limit;
  const bool starts_outside = p < q ? p < -limit : p > limit;
  const bool ends_outside = p < q ? q > limit : q < -limit;
  if (p < q ? (q < -limit || p > limit) : (q > limit || p < -limit)) return false;
  if (starts_outside) {
    const Real s = (enter - p) / d;
    if (s > s0) {
      s0 = s;
      cut0 = below;
    }
  }
  if (ends_outside) {
    const Real s = (-enter - p) / d;
    if (s < s1) {
      s1 = s;
      cut1 = above;
    }
  }
  return s0 <= s1;
}

PLUMB_HD inline int overlap_faces(const BoxFaces& o, Real deepest, Real margin, Candidate* at) {
  int count = 0;
  const auto add = [&](Real x, Real y, Real separation, std::uint32_t feature) {
    if (separation <= margin) at[count++] = {x, y, max(separation, deepest), feature};
  };
  const std::uint32_t mask_a = o.side_a > 0 ? 1U << o.f : 0U, mask_b = o.side_b > 0 ? 1U << o.g : 0U;
  const std::uint32_t face_a = box_face(o.f, o.side_a > 0), face_b = box_face(o.g, o.side_b > 0);
  const auto edge_of_a = [&](int plane) {  // planes: -x, +x, -y, +y
    const int across = plane < 2 ? o.u : o.v, along = plane < 2 ? o.v : o.u;
    return box_edge(along, mask_a | (static_cast<std::uint32_t>(plane & 1) << across));
  };

  // Sides of B's face in turn, from the corner (+h, +k): towards -h, -k, +h, +k.
  const Real limit_x = o.half_x * (1 + kClipSlack), limit_y = o.half_y * (1 + kClipSlack);
  for (int side = 0; side < 4; ++side) {
    const bool from_h = side == 0 || side == 3, from_k = side < 2;
    const Vec from = o.centre + (from_h ? o.along_h : -o.along_h) + (from_k ? o.along_k : -o.along_k);
    const Vec half = side == 0 ? -o.along_h : side == 1 ? -o.along_k : side == 2 ? o.along_h : o.along_k;
    const Vec d = half + half;
    Real s0 = 0, s1 = 1;
    int cut0 = -1, cut1 = -1;
    if (!clip_slab(from.x, d.x, limit_x, 0, s0, s1, cut0, cut1) ||
        !clip_slab(from.y, d.y, limit_y, 2, s0, s1, cut0, cut1))
      continue;
    const int across = (side & 1) == 0 ? o.k : o.h, along = (side & 1) == 0 ? o.h : o.k;
    const bool positive = side == 0 || side == 3;  // +k, -h, -k, +h
    const std::uint32_t edge_b = box_edge(along, mask_b | (positive ? 1U << across : 0U));
    if (cut0 < 0) {
      const std::uint32_t corner = mask_b | (from_h ? 1U << o.h : 0U) | (from_k ? 1U << o.k : 0U);
      add(from.x, from.y, from.z, feature_id(Part::kFace, face_a, Part::kVertex, corner));
    } else {
      const Vec c = from + s0 * d;
      add(c.x, c.y, c.z, feature_id(Part::kEdge, edge_of_a(cut0), Part::kEdge, edge_b));
    }
    if (cut1 >= 0) {
      const Vec c = from + s1 * d;
      add(c.x, c.y, c.z, feature_id(Part::kEdge, edge_of_a(cut1), Part::kEdge, edge_b));
    }
  }

  // Corners of A that lie within B's face, well enough that none of its sides has given the same point.
  const Real area = o.along_h.x * o.along_k.y - o.along_h.y * o.along_k.x;
  const Real inside = abs(area) * (1 - kClipSlack);
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    const Real x = (corner & 1U) != 0 ? o.half_x : -o.half_x, y = (corner & 2U) != 0 ? o.half_y : -o.half_y;
    const Real dx = x - o.centre.x, dy = y - o.centre.y;
    const Real h = dx * o.along_k.y - dy * o.along_k.x, k = dy * o.along_h.x - dx * o.along_h.y;
    if (!(abs(h) < inside) || !(abs(k) < inside)) continue;
    const std::uint32_t mask = mask_a | ((corner & 1U) << o.u) | ((corner >> 1U) << o.v);
    add(x, y, o.centre.z + (h / area) * o.along_h.z + (k / area) * o.along_k.z,
        feature_id(Part::kVertex, mask, Part::kFace, face_b));
  }
  return count;
}

/// Boxes overlap but tolerances have left no point (they graze): the corner of B's face that is deepest.
PLUMB_HD inline Candidate deepest_corner(const BoxFaces& o, Real separation) {
  const bool h = o.along_h.z < 0, k = o.along_k.z < 0;
  const Vec c = o.centre + (h ? o.along_h : -o.along_h) + (k ? o.along_k : -o.along_k);
  const std::uint32_t corner = (o.side_b > 0 ? 1U << o.g : 0U) | (h ? 1U << o.h : 0U) | (k ? 1U << o.k : 0U);
  return {clamp(c.x, -o.half_x, o.half_x), clamp(c.y, -o.half_y, o.half_y), separation,
          feature_id(Part::kFace, box_face(o.f, o.side_a > 0), Part::kVertex, corner)};
}

PLUMB_HD inline void touch_faces(const BoxPair& p, const BoxAxis& axis, Real margin, Real tie, Manifold& out) {
  const BoxFaces o = project_faces(p, axis);
  Candidate at[kMostPoints];
  int count = overlap_faces(o, axis.separation, margin, at);
  if (count == 0 && axis.separation <= 0) at[count++] = deepest_corner(o, axis.separation);
  count = choose_points(at, count, tie);
  // What is deepest along the axis is a candidate, but for the slack of clipping. Its last digits are left as they are:
  // rounded as the other points' are, or a level face would lean towards one corner, and a tower of them with it.
  if (axis.separation <= 0 && at[0].separation > axis.separation + tie) at[0].separation = axis.separation;
  out.count = static_cast<std::uint32_t>(count);
  for (int i = 0; i < count; ++i) {
    Vec position = {0, 0, 0};
    position[o.f] = o.side_a * p.a[o.f];
    position[o.u] = at[i].x;
    position[o.v] = at[i].y;
    out.points[i] = {position + (Real(0.5) * at[i].separation) * axis.normal, at[i].separation, at[i].feature};
  }
}

}  // namespace box_box

PLUMB_HD inline bool collide_box_box(const ShapePair& pair, const Hulls&, Manifold& out) {
  using namespace box_box;
  out.count = 0;
  const BoxPair p = {pair.a.size, pair.b.size, to_matrix(conjugate(pair.qa) * pair.qb), rotate_back(pair.qa, pair.d)};
  const Real tie = kTie * (pair.a.reach + pair.b.reach);
  BoxAxis axis;
  if (!find_axis(p, pair.margin, tie, axis)) {
    out.gap = axis.separation;
    return false;
  }
  const bool edges = axis.a >= 0 && axis.b >= 0;
  const Real near_a = abs(axis.normal[widest(axis.normal)]);
  const Vec along_b = multiply_transposed(p.r, axis.normal);
  if (edges && near_a < kNearFace && abs(along_b[widest(along_b)]) < kNearFace)
    touch_edges(p, axis, out);
  else
    touch_faces(p, axis, pair.margin, tie, out);
  out.normal = rotate(pair.qa, axis.normal);
  for (std::uint32_t i = 0; i < out.count; ++i) out.points[i].position = rotate(pair.qa, out.points[i].position);
  return out.count != 0;
}

}  // namespace plumb::impulse
