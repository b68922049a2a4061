// Limit analysis of plane structures of rigid blocks with dry friction: whether any admissible contact forces carry the
// weights (the static theorem; Heyman, The Stone Skeleton, 1966; Livesley 1978). Admissible forces are combinations of
// the edges of the friction cones with factors >= 0, so the question is one of linear programming. What has no such
// forces must move. With friction the converse is what one expects, not a theorem.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace plumb::truth {

/// A block under gravity along -y.
struct PlaneBlock {
  Eigen::Vector2d centre;  ///< of mass, m
  double weight;           ///< N
};

/// A point at which two blocks press and rub, or a block and the ground.
struct PlaneContact {
  static constexpr int ground = -1;
  int from, to;            ///< indices of blocks
  Eigen::Vector2d point;   ///< m
  Eigen::Vector2d normal;  ///< unit, from `from` to `to`
  double friction;
};

struct PlaneStructure {
  std::vector<PlaneBlock> blocks;
  std::vector<PlaneContact> contacts;

  /// Two contacts at the ends of a face between two blocks. normal: from `from` to `to`.
  void add_face(int from, int to, const Eigen::Vector2d& one_end, const Eigen::Vector2d& other_end,
                const Eigen::Vector2d& normal, double friction);
};

/// The part of the weights and their moments that the best admissible forces leave unbalanced, relative to all weights:
/// 0 (up to about 1e-12) when the structure can stand. Non-negative least squares (Lawson & Hanson 1974, chapter 23).
[[nodiscard]] double unbalance(const PlaneStructure& structure);
[[nodiscard]] bool can_stand(const PlaneStructure& structure);

/// The value between `fails` and `stands` at which a family of structures begins to stand.
template <class Family>
[[nodiscard]] double critical_value(double fails, double stands, const Family& family) {
  for (int i = 0; i < 36; ++i) {
    const double middle = (fails + stands) / 2;
    (can_stand(family(middle)) ? stands : fails) = middle;
  }
  return (fails + stands) / 2;
}

// --- structures ---

/// A plane quadrilateral or other polygon of unit thickness and density, corners counter-clockwise: its centroid and
/// its area times `weight`.
[[nodiscard]] PlaneBlock polygon_block(std::span<const Eigen::Vector2d> corners, double weight = 1);

/// A semicircular arch of equal wedges with straight sides, from the ground to the ground about the origin.
struct ArchShape {
  std::size_t stones;
  double inner, outer;  ///< radii of the corners, m
};
[[nodiscard]] PlaneStructure voussoir_arch(const ArchShape& shape, double friction);

/// Blocks 1 m x height, each shifted over the one below by share / (2 k), k from the top, on a table whose edge is at
/// x = 0 (the harmonic stack).
[[nodiscard]] PlaneStructure harmonic_stack(std::size_t blocks, double height, double share, double friction);

/// Corners of Catto's arch (Solver2D, sample "Arch"): the inner and outer curve of its right half from the ground up,
/// m. Its 17 stones are eight on either side and the keystone.
struct CattoArch {
  static constexpr std::size_t corners = 9;
  static const double inner[corners][2], outer[corners][2];
};
/// With a pile of boxes on the keystone, 1 m high, each of the weight of 4 m x 1 m of stone. wide: they are 4 m long,
/// as in the sample; the lowest then rests on the corners of the keystone's neighbours too, which end at one height
/// with it. Else they are 1.4 m long and rest on the keystone alone.
[[nodiscard]] PlaneStructure catto_arch(std::size_t boxes, bool wide, double friction);

/// Two equal thin cards that lean on each other at the angle `lean` from the vertical, without thickness.
[[nodiscard]] PlaneStructure card_frame(double lean, double friction);
/// The least friction with which it stands: tan(lean) / 2.
[[nodiscard]] double card_frame_friction(double lean);

/// A ladder against a wall, a capsule of the given length between the centres of its ends and radius, at the angle
/// `slope` from the ground.
[[nodiscard]] PlaneStructure ladder(double length, double radius, double slope, double friction);
/// The slope below which it slides, with the same friction at wall and floor:
/// (1 - mu^2) / (2 mu) cos = sin + (radius / length) (1 + mu).
[[nodiscard]] double ladder_slope(double length, double radius, double friction);

}  // namespace plumb::truth
