// Mechanisms as contacts see them: what a wrench on one of their bodies does to all of them while the joints hold.
//
// A contact that sees only the body that it touches pushes as if nothing were joined to it; the joints undo most of
// that, and two exact solvers in turn are one that hardly converges where masses differ. So contacts work with the
// mobility of the whole mechanism, W = M^-1 - M^-1 J^T K^-1 J M^-1 with K = J M^-1 J^T, which joints leave (the joints
// are the primary constraints of Baraff, "Linear-Time Dynamics using Lagrange Multipliers", SIGGRAPH 1996, section 7,
// contacts the auxiliary ones). W is worked out at the start of a step, for the bodies that touch something.
#pragma once

#include "bodies/body.hpp"
#include "math/angle.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

/// Mechanisms of more bodies are met body by body: W takes the square of their number.
constexpr std::uint32_t kMostInMechanism = 64;

/// A body of a mechanism. Its number among all such bodies is its place; those of a mechanism follow each other.
struct MechanismBody {
  std::uint32_t body;
  std::uint32_t first, count;                ///< places of its mechanism; count is 0 of one that is met body by body
  std::uint32_t first_column, column_count;  ///< of its mechanism, in the list of columns
  std::uint64_t mobility;  ///< first number of what a wrench on this body does: of each body in turn six rows of six
  std::uint64_t scratch;   ///< first number of what is worked with to find that
};

/// What contacts did to a body since joints were last solved.
struct ContactLoad {
  Vec linear;             ///< its velocity before
  std::uint32_t touched;  ///< in this step
  Vec angular;
  Real unused;
  Vec force, torque;  ///< N s and N m s at the centre of mass
};

/// Motion or wrench of a body: along the axes, then about them.
struct Six {
  Real at[6];
};
PLUMB_HD inline Six six(const Vec& along, const Vec& about) {
  return {{along.x, along.y, along.z, about.x, about.y, about.z}};
}

/// The columns of the joints' matrix by mechanism.
struct MechanismColumns {
  const std::uint32_t* columns;  ///< of one mechanism after the other, ascending
  const std::uint32_t* number;   ///< by column: its number in its mechanism
  Real* scratch;
};

struct Mechanisms {
  const std::uint32_t* place_of;  ///< by body: its place and one, or 0 where contacts see it alone. Null: all of them
  const MechanismBody* bodies;    ///< by place
  ContactLoad* loads;             ///< by place
  Real* mobility;
  std::uint32_t count;  ///< of places

  PLUMB_HD bool hold(std::uint32_t body) const { return place_of != nullptr && place_of[body] != 0; }
  /// Whether the body has a contact in this step.
  PLUMB_HD bool touch(std::uint32_t body) const { return hold(body) && loads[place_of[body] - 1].touched != 0; }
  PLUMB_HD const MechanismBody& of(std::uint32_t body) const {
    PLUMB_ASSERT(hold(body) && place_of[body] <= count);
    return bodies[place_of[body] - 1];
  }
  PLUMB_HD bool together(std::uint32_t a, std::uint32_t b) const {
    return hold(a) && hold(b) && of(a).first == of(b).first;
  }
  /// Of all bodies that a contact moves at once through this one the first: what stands for them in colouring.
  PLUMB_HD std::uint32_t owner(std::uint32_t body) const { return hold(body) ? bodies[of(body).first].body : body; }
  /// Six rows of six: what a wrench on body `from` does to body `to` of the same mechanism.
  PLUMB_HD const Real* block(std::uint32_t from, std::uint32_t to) const {
    const MechanismBody& source = of(from);
    PLUMB_ASSERT(together(from, to));
    return mobility + source.mobility + std::size_t{place_of[to] - 1 - source.first} * 36;
  }
  /// left^T W right, for a wrench `right` on body `from` and motion of `to`.
  PLUMB_HD Real work(std::uint32_t from, const Six& right, std::uint32_t to, const Six& left) const {
    const Real* row = block(from, to);
    Real sum = 0;
    for (int r = 0; r < 6; ++r, row += 6) {
      Real moved = 0;
      for (int c = 0; c < 6; ++c) moved = moved + row[c] * right.at[c];
      sum = sum + left.at[r] * moved;
    }
    return sum;
  }
  /// A wrench on a body moves its mechanism.
  PLUMB_HD void push(std::uint32_t body, const Vec& force, const Vec& torque, Velocity* velocities) const {
    ContactLoad& load = loads[place_of[body] - 1];
    load.force += force;
    load.torque += torque;
    for_moved(body, six(force, torque), [=](std::uint32_t other, const Vec& along, const Vec& about) {
      velocities[other].linear += along;
      velocities[other].angular += about;
    });
  }
  /// Likewise where its bodies are: a wrench times seconds moves them by what it gives them in speed times those.
  PLUMB_HD void displace(std::uint32_t body, const Vec& force, const Vec& torque, Displacement* displacements) const {
    if (!(length_squared(force) + length_squared(torque) > 0)) return;  // to the last bit where they were
    for_moved(body, six(force, torque), [=](std::uint32_t other, const Vec& along, const Vec& about) {
      Displacement& of = displacements[other];
      of.linear += along;
      of.rotation = normalized(turn_by(about) * of.rotation);
    });
  }

 private:
  /// f(body, along, about) for each body of a mechanism, with the motion that a wrench on one of them gives it.
  template <class F>
  PLUMB_HD void for_moved(std::uint32_t body, const Six& wrench, const F& f) const {
    const MechanismBody& source = bodies[place_of[body] - 1];
    const Real* row = mobility + source.mobility;
    for (std::uint32_t j = source.first; j < source.first + source.count; ++j) {
      Six moved;
      for (int r = 0; r < 6; ++r, row += 6) {
        Real sum = 0;
        for (int c = 0; c < 6; ++c) sum = sum + row[c] * wrench.at[c];
        moved.at[r] = sum;
      }
      f(bodies[j].body, Vec{moved.at[0], moved.at[1], moved.at[2]}, Vec{moved.at[3], moved.at[4], moved.at[5]});
    }
  }
};

}  // namespace plumb::impulse
