#include "truth/limit_analysis.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plumb/assert.hpp"

namespace plumb::truth {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Least |A x - b| over x >= 0: the residual. Lawson & Hanson 1974, algorithm NNLS.
Eigen::VectorXd nonnegative_residual(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  constexpr double tolerance = 1e-13;
  PLUMB_ASSERT(a.rows() == b.size());
  const Eigen::Index n = a.cols();
  std::vector<Eigen::Index> passive;
  std::vector<bool> is_passive(static_cast<std::size_t>(n));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), residual = b;
  const auto leave = [&](Eigen::Index j) {
    is_passive[static_cast<std::size_t>(j)] = false;
    passive.erase(std::find(passive.begin(), passive.end(), j));
    x[j] = 0;
  };
  for (Eigen::Index round = 0; round < 10 * n; ++round) {
    const Eigen::VectorXd gradient = a.transpose() * residual;
    Eigen::Index best = -1;
    for (Eigen::Index j = 0; j < n; ++j)
      if (!is_passive[static_cast<std::size_t>(j)] && gradient[j] > tolerance &&
          (best < 0 || gradient[j] > gradient[best]))
        best = j;
    if (best < 0) break;
    passive.push_back(best);
    is_passive[static_cast<std::size_t>(best)] = true;
    while (!passive.empty()) {
      const Eigen::VectorXd z = a(Eigen::all, passive).colPivHouseholderQr().solve(b);
      double step = 1;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double now = x[passive[k]], then = z[static_cast<Eigen::Index>(k)];
        if (then <= 0) step = std::min(step, now / (now - then + 1e-300));
      }
      for (std::size_t k = 0; k < passive.size(); ++k)
        x[passive[k]] += step * (z[static_cast<Eigen::Index>(k)] - x[passive[k]]);
      if (step >= 1) break;
      const std::vector<Eigen::Index> tried = passive;
      for (const Eigen::Index j : tried)
        if (x[j] <= 1e-15) leave(j);
    }
    residual = b - a * x;
  }
  return residual;
}

}  // namespace

void PlaneStructure::add_face(int from, int to, const Vector2d& one_end, const Vector2d& other_end,
                              const Vector2d& normal, double friction) {
  contacts.push_back({from, to, one_end, normal, friction});
  contacts.push_back({from, to, other_end, normal, friction});
}

double unbalance(const PlaneStructure& structure) {
  const auto rows = static_cast<Eigen::Index>(3 * structure.blocks.size());
  const auto columns = static_cast<Eigen::Index>(2 * structure.contacts.size());
  double weight = 0, size = 0;
  for (const PlaneBlock& block : structure.blocks) {
    weight += block.weight;
    for (const PlaneBlock& other : structure.blocks) size = std::max(size, (block.centre - other.centre).norm());
  }
  for (const PlaneContact& contact : structure.contacts)
    for (const PlaneBlock& block : structure.blocks) size = std::max(size, (contact.point - block.centre).norm());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    const PlaneContact& contact = structure.contacts[static_cast<std::size_t>(c / 2)];
    const Vector2d along(-contact.normal.y(), contact.normal.x());
    const Vector2d force = contact.normal + (c % 2 == 0 ? 1 : -1) * contact.friction * along;
    const auto add = [&](int block, double sign) {
      if (block == PlaneContact::ground) return;
      PLUMB_ASSERT(block >= 0 && static_cast<std::size_t>(block) < structure.blocks.size());
      const Vector2d arm = contact.point - structure.blocks[static_cast<std::size_t>(block)].centre;
      a.block<2, 1>(3 * block, c) = sign * force;
      a(3 * block + 2, c) = sign * cross(arm, force) / size;
    };
    add(contact.to, 1);
    add(contact.from, -1);
  }
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows);
  for (std::size_t i = 0; i < structure.blocks.size(); ++i)
    b[static_cast<Eigen::Index>(3 * i + 1)] = structure.blocks[i].weight / weight;
  return nonnegative_residual(a, b).norm();
}

bool can_stand(const PlaneStructure& structure) { return unbalance(structure) < 1e-11; }

PlaneBlock polygon_block(std::span<const Vector2d> corners, double weight) {
  double area = 0;
  Vector2d moment = Vector2d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d &p = corners[i], &q = corners[(i + 1) % corners.size()];
    area += cross(p, q) / 2;
    moment += cross(p, q) / 6 * (p + q);
  }
  return {moment / area, area * weight};
}

PlaneStructure voussoir_arch(const ArchShape& shape, double friction) {
  PlaneStructure arch;
  const auto corner = [&](double radius, std::size_t i) -> Vector2d {
    const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(shape.stones);
    return radius * Vector2d(std::cos(angle), std::sin(angle));
  };
  for (std::size_t i = 0; i <= shape.stones; ++i) {
    const Vector2d inner = corner(shape.inner, i), outer = corner(shape.outer, i),
                   across = (outer - inner).normalized();
    const int stone = static_cast<int>(i);
    const bool last = i == shape.stones;
    arch.add_face(stone - 1, last ? PlaneContact::ground : stone, inner, outer, {-across.y(), across.x()}, friction);
    if (last) break;
    const Vector2d corners[] = {inner, outer, corner(shape.outer, i + 1), corner(shape.inner, i + 1)};
    arch.blocks.push_back(polygon_block(corners));
  }
  return arch;
}

PlaneStructure harmonic_stack(std::size_t blocks, double height, double share, double friction) {
  PlaneStructure stack;
  double tip = 0;  // of the block below, from which on nothing carries
  double centre = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const double end_below = i == 0 ? 0 : centre + 0.5;
    tip = end_below + share / (2 * static_cast<double>(blocks - i));
    centre = tip - 0.5;
    const double y = static_cast<double>(i) * height;
    stack.add_face(static_cast<int>(i) - 1, static_cast<int>(i), {tip - 1, y}, {end_below, y}, {0, 1}, friction);
    stack.blocks.push_back({{centre, y + height / 2}, height});
  }
  return stack;
}

const double CattoArch::inner[CattoArch::corners][2] = {{4, 0},
                                                        {3.734509, 1.2834},
                                                        {3.449679, 2.56232},
                                                        {3.140632, 3.835268},
                                                        {2.800102, 5.099641},
                                                        {2.416303, 6.350925},
                                                        {1.96795, 7.579483},
                                                        {1.4088, 8.759552},
                                                        {0.601484, 9.773885}};
const double CattoArch::outer[CattoArch::corners][2] = {{6, 0},
                                                        {5.584049, 1.50575},
                                                        {5.137342, 3.002411},
                                                        {4.652137, 4.486758},
                                                        {4.116923, 5.95342},
                                                        {3.513313, 7.392698},
                                                        {2.808878, 8.78444},
                                                        {1.938142, 10.076127},
                                                        {0.754233, 11.072229}};

PlaneStructure catto_arch(std::size_t boxes, bool wide, double friction) {
  PlaneStructure arch;
  constexpr int keystone = 16;  // stones 0..7 on the right, 8..15 on the left, from the ground up
  const auto corner = [](const double(&at)[2], double side) { return Vector2d(side * at[0], at[1]); };
  for (const double side : {1.0, -1.0}) {
    const int first = side > 0 ? 0 : 8;
    for (std::size_t i = 0; i < CattoArch::corners; ++i) {
      const Vector2d inner = corner(CattoArch::inner[i], side), outer = corner(CattoArch::outer[i], side);
      const Vector2d across = (outer - inner).normalized();
      const bool top = i + 1 == CattoArch::corners;
      arch.add_face(i == 0 ? PlaneContact::ground : first + static_cast<int>(i) - 1,
                    top ? keystone : first + static_cast<int>(i), inner, outer,
                    side * Vector2d(-across.y(), across.x()), friction);
      if (top) continue;
      std::vector<Vector2d> corners{inner, outer, corner(CattoArch::outer[i + 1], side),
                                    corner(CattoArch::inner[i + 1], side)};
      if (side < 0) std::reverse(corners.begin(), corners.end());
      arch.blocks.push_back(polygon_block(corners));
    }
  }
  constexpr std::size_t last = CattoArch::corners - 1;
  const Vector2d key[] = {corner(CattoArch::inner[last], -1), corner(CattoArch::inner[last], 1),
                          corner(CattoArch::outer[last], 1), corner(CattoArch::outer[last], -1)};
  arch.blocks.push_back(polygon_block(key));
  const double top = CattoArch::outer[last][1], half_key = CattoArch::outer[last][0];
  for (std::size_t i = 0; i < boxes; ++i) {
    const double y = top + static_cast<double>(i), length = wide ? 2 : 0.7,
                 half = i == 0 ? std::min(half_key, length) : length;
    const int box = keystone + 1 + static_cast<int>(i);
    arch.add_face(box - 1, box, {-half, y}, {half, y}, {0, 1}, friction);
    if (i == 0 && wide) {
      arch.contacts.push_back({7, box, {half_key, y}, {0, 1}, friction});
      arch.contacts.push_back({15, box, {-half_key, y}, {0, 1}, friction});
    }
    arch.blocks.push_back({{0, y + 0.5}, 4});
  }
  return arch;
}

PlaneStructure card_frame(double lean, double friction) {
  PlaneStructure frame;
  const Vector2d top(0, std::cos(lean)), foot(std::sin(lean), 0);
  frame.blocks = {{(top - foot) / 2, 1}, {(top + foot) / 2, 1}};
  frame.contacts = {{PlaneContact::ground, 0, -foot, {0, 1}, friction},
                    {PlaneContact::ground, 1, foot, {0, 1}, friction},
                    {0, 1, top, {1, 0}, friction}};
  return frame;
}

double card_frame_friction(double lean) { return std::tan(lean) / 2; }

PlaneStructure ladder(double length, double radius, double slope, double friction) {
  PlaneStructure leaning;
  const Vector2d foot(0, radius), head = foot + length * Vector2d(std::cos(slope), std::sin(slope));
  leaning.blocks = {{(foot + head) / 2, 1}};
  leaning.contacts = {{PlaneContact::ground, 0, foot - Vector2d(0, radius), {0, 1}, friction},
                      {PlaneContact::ground, 0, head + Vector2d(radius, 0), {-1, 0}, friction}};
  return leaning;
}

double ladder_slope(double length, double radius, double friction) {
  // a cos x - sin x = c with a = cot of the angle that cos and sin are mixed by.
  const double a = (1 - friction * friction) / (2 * friction), c = radius / length * (1 + friction);
  return std::atan2(a, 1) - std::asin(c / std::hypot(a, 1));
}

}  // namespace plumb::truth
