#include "limit_load.hpp"

#include <glpk.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace plumb::truth {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double most_load = 1e4;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The largest f in [-most_load, most_load] with generators x = needed - f live for some x >= 0; none when there is no
/// such f.
std::optional<double> largest_factor(const MatrixXd& generators, const VectorXd& needed, const VectorXd& live) {
  const std::unique_ptr<glp_prob, void (*)(glp_prob*)> program(glp_create_prob(), glp_delete_prob);
  glp_prob* lp = program.get();
  const int rows = static_cast<int>(generators.rows()), columns = static_cast<int>(generators.cols());
  glp_set_obj_dir(lp, GLP_MAX);
  glp_add_rows(lp, rows);
  glp_add_cols(lp, columns + 1);
  for (int r = 0; r < rows; ++r) glp_set_row_bnds(lp, r + 1, GLP_FX, needed[r], needed[r]);
  std::vector<int> indices;
  std::vector<double> values;
  const auto set_column = [&](int column, const VectorXd& entries) {
    indices.assign(1, 0);  // GLPK counts from 1
    values.assign(1, 0);
    for (int r = 0; r < rows; ++r) {
      if (entries[r] == 0) continue;
      indices.push_back(r + 1);
      values.push_back(entries[r]);
    }
    glp_set_mat_col(lp, column, static_cast<int>(indices.size()) - 1, indices.data(), values.data());
  };
  for (int c = 0; c < columns; ++c) {
    glp_set_col_bnds(lp, c + 1, GLP_LO, 0, 0);
    set_column(c + 1, generators.col(c));
  }
  glp_set_col_bnds(lp, columns + 1, GLP_DB, -most_load, most_load);
  glp_set_obj_coef(lp, columns + 1, 1);
  set_column(columns + 1, live);

  glp_smcp options;
  glp_init_smcp(&options);
  options.msg_lev = GLP_MSG_OFF;
  options.tol_bnd = options.tol_dj = 1e-9;
  glp_term_out(GLP_OFF);
  if (glp_simplex(lp, &options) != 0 || glp_get_status(lp) != GLP_OPT) return std::nullopt;
  return glp_get_col_prim(lp, columns + 1);
}

/// What the sizes of a structure are, to which equations are brought.
struct Size {
  double weight = 0, length = 0;
};
template <class Structure>
Size size_of(const Structure& structure) {
  Size size;
  for (const auto& block : structure.blocks) {
    size.weight += block.weight;
    for (const auto& contact : structure.contacts)
      size.length = std::max(size.length, (contact.point - block.centre).norm());
  }
  return size;
}

std::size_t index_of(int block) { return static_cast<std::size_t>(block); }

}  // namespace

std::optional<double> largest_load(const PlaneStructure& structure, std::span<const LiveLoad> loads) {
  const Size size = size_of(structure);
  const auto rows = static_cast<Index>(3 * structure.blocks.size());
  MatrixXd generators = MatrixXd::Zero(rows, static_cast<Index>(2 * structure.contacts.size()));
  const auto add = [&](auto&& column, int block, const Vector2d& point, const Vector2d& force) {
    if (block == PlaneContact::ground) return;
    column.template segment<2>(3 * block) += force;
    column[3 * block + 2] += cross(point - structure.blocks[index_of(block)].centre, force) / size.length;
  };
  for (Index c = 0; c < generators.cols(); ++c) {
    const PlaneContact& contact = structure.contacts[static_cast<std::size_t>(c / 2)];
    const Vector2d along(-contact.normal.y(), contact.normal.x());
    const Vector2d edge = contact.normal + (c % 2 == 0 ? 1 : -1) * contact.friction * along;
    add(generators.col(c), contact.to, contact.point, edge);
    add(generators.col(c), contact.from, contact.point, -edge);
  }
  VectorXd needed = VectorXd::Zero(rows), live = VectorXd::Zero(rows);
  for (std::size_t i = 0; i < structure.blocks.size(); ++i)
    needed[static_cast<Index>(3 * i + 1)] = structure.blocks[i].weight / size.weight;
  double strength = 0;
  for (const LiveLoad& load : loads) {
    add(live, load.block, load.point, load.force);
    strength += load.force.norm();
  }
  const auto factor = largest_factor(generators, needed, live / strength);
  if (!factor) return std::nullopt;
  if (*factor > most_load * (1 - 1e-9)) return std::numeric_limits<double>::infinity();
  return *factor * size.weight / strength;
}

bool can_stand(const SpaceStructure& structure, Pyramid pyramid, int sides) {
  const Size size = size_of(structure);
  const auto rows = static_cast<Index>(6 * structure.blocks.size());
  MatrixXd generators = MatrixXd::Zero(rows, static_cast<Index>(structure.contacts.size()) * sides);
  const double reach = pyramid == Pyramid::inside ? 1 : 1 / std::cos(std::numbers::pi / sides);
  for (Index c = 0; c < generators.cols(); ++c) {
    const SpaceContact& contact = structure.contacts[static_cast<std::size_t>(c / sides)];
    const double angle = 2 * std::numbers::pi * static_cast<double>(c % sides) / sides;
    const Vector3d one = contact.normal.unitOrthogonal(), other = contact.normal.cross(one);
    const Vector3d edge = contact.normal + reach * contact.friction * (std::cos(angle) * one + std::sin(angle) * other);
    for (const auto& [block, sign] : {std::pair{contact.to, 1.0}, {contact.from, -1.0}}) {
      if (block == PlaneContact::ground) continue;
      generators.block<3, 1>(6 * block, c) = sign * edge;
      generators.block<3, 1>(6 * block + 3, c) =
          sign / size.length * (contact.point - structure.blocks[index_of(block)].centre).cross(edge);
    }
  }
  VectorXd needed = VectorXd::Zero(rows);
  for (std::size_t i = 0; i < structure.blocks.size(); ++i)
    needed[static_cast<Index>(6 * i + 1)] = structure.blocks[i].weight / size.weight;
  return largest_factor(generators, needed, VectorXd::Zero(rows)).has_value();
}

SpaceStructure four_spheres_structure(double friction) {
  SpaceStructure pile;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi * i / 3;
    pile.blocks.push_back({{std::cos(angle) / std::sqrt(3), 0.5, std::sin(angle) / std::sqrt(3)}, 1});
  }
  pile.blocks.push_back({{0, 0.5 + std::sqrt(2.0 / 3), 0}, 1});
  for (int i = 0; i < 3; ++i) {
    const Vector3d here = pile.blocks[index_of(i)].centre, next = pile.blocks[index_of((i + 1) % 3)].centre,
                   top = pile.blocks[3].centre;
    pile.contacts.push_back({PlaneContact::ground, i, here - Vector3d(0, 0.5, 0), Vector3d::UnitY(), friction});
    pile.contacts.push_back({i, 3, (here + top) / 2, top - here, friction});
    pile.contacts.push_back({i, (i + 1) % 3, (here + next) / 2, next - here, friction});
  }
  return pile;
}

}  // namespace plumb::truth
