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
#include "math/wide.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

/// Mechanisms of more bodies are met body by body: W takes the square of their number.
constexpr std::uint32_t kMostInMechanism = 64;

/// A body of a mechanism. Its number among all such bodies is its place; those of a mechanism follow each other.
struct MechanismBody {
  std::uint32_t body;
  std::uint32_t first, count;                ///< places of its mechanism; count is 0 of one that is met body by body
  std::uint32_t first_column, column_count;  ///< of its mechanism, in the joints' matrix
  std::uint64_t mobility;  ///< first number of what a wrench on this body does: of each body in turn kMobilityNumbers
  std::uint64_t scratch;   ///< first number of what is worked with to find that
};

/// What contacts did to a body since joints were last solved.
struct ContactLoad {
  Vec linear;             ///< its velocity before
  std::uint32_t touched;  ///< in this step
  Vec angular;
  std::uint32_t mechanism_touched;  ///< of the first of a mechanism: any of its bodies is
  Vec force, torque;                ///< N s and N m s at the centre of mass
};

/// Motion or wrench of a body: along the axes, then about them.
struct Six {
  Real at[6];
};
PLUMB_HD inline Six six(const Vec& along, const Vec& about) {
  return {{along.x, along.y, along.z, about.x, about.y, about.z}};
}

PLUMB_HD inline Vec along_of(const Six& six) { return {six.at[0], six.at[1], six.at[2]}; }
PLUMB_HD inline Vec about_of(const Six& six) { return {six.at[3], six.at[4], six.at[5]}; }
PLUMB_HD inline Real dot(const Six& a, const Six& b) {
  Real sum = 0;
  for (int i = 0; i < 6; ++i) sum = sum + a.at[i] * b.at[i];
  return sum;
}

// What a wrench on one body does to another, six by six numbers of the mobility: on a GPU row after row. On a CPU a
// column is a row of velocities, and the whole of it is added at once.
#if defined(PLUMB_IMPULSE_CUDA)

constexpr std::uint32_t kMobilityNumbers = 36;

PLUMB_HD inline Six motion_by(const Real* response, const Six& wrench) {
  Six moved;
  for (int r = 0; r < 6; ++r, response += 6) {
    Real sum = 0;
    for (int c = 0; c < 6; ++c) sum = sum + response[c] * wrench.at[c];
    moved.at[r] = sum;
  }
  return moved;
}
PLUMB_HD inline void move_by(const Real* response, const Six& wrench, Velocity& velocity) {
  const Six moved = motion_by(response, wrench);
  velocity.linear += along_of(moved);
  velocity.angular += about_of(moved);
}

#else

constexpr std::uint32_t kMobilityNumbers = 6 * kLaneGroup;

inline Lanes motion_in_lanes(const Real* response, const Six& wrench) {
  Lanes sum(0);
  for (int c = 0; c < 6; ++c)
    sum = sum + load_row(reinterpret_cast<const Real(&)[kLanes]>(response[c * static_cast<int>(kLanes)])) *
                    Lanes(wrench.at[c]);
  return sum;
}
inline Six motion_by(const Real* response, const Six& wrench) {
  const Lanes moved = motion_in_lanes(response, wrench);
  return {{moved.v[0], moved.v[1], moved.v[2], moved.v[4], moved.v[5], moved.v[6]}};
}
inline void move_by(const Real* response, const Six& wrench, Velocity& velocity) {
  const Lanes before = load_row(velocity), moved = before + motion_in_lanes(response, wrench);
  store_row(velocity, Lanes(__builtin_shufflevector(moved.v, before.v, 0, 1, 2, 11, 4, 5, 6, 15)));
}

#endif

/// Of a mechanism's bodies those that one of several threads moves: every step-th. The first of them leads.
struct ShareOfBodies {
  std::uint32_t first, step;
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
  /// Whether any body of its mechanism has.
  PLUMB_HD bool touch_mechanism(std::uint32_t body) const {
    return hold(body) && loads[of(body).first].mechanism_touched != 0;
  }
  PLUMB_HD void begin_step(std::uint32_t place) const { loads[place].touched = loads[place].mechanism_touched = 0; }
  /// A contact of this step may push the body.
  PLUMB_HD void note_contact(std::uint32_t body) const {
    if (hold(body)) loads[place_of[body] - 1].touched = loads[of(body).first].mechanism_touched = 1;
  }
  PLUMB_HD const MechanismBody& of(std::uint32_t body) const {
    PLUMB_ASSERT(hold(body) && place_of[body] <= count);
    return bodies[place_of[body] - 1];
  }
  PLUMB_HD bool together(std::uint32_t a, std::uint32_t b) const {
    return hold(a) && hold(b) && of(a).first == of(b).first;
  }
  /// Of all bodies that a contact moves at once through this one the first: what stands for them in colouring.
  PLUMB_HD std::uint32_t owner(std::uint32_t body) const { return hold(body) ? bodies[of(body).first].body : body; }
  /// The motion that a wrench on body `from` gives body `to` of the same mechanism.
  PLUMB_HD Six moved(std::uint32_t from, const Six& wrench, std::uint32_t to) const {
    const MechanismBody& source = of(from);
    PLUMB_ASSERT(together(from, to));
    return motion_by(mobility + source.mobility + std::size_t{place_of[to] - 1 - source.first} * kMobilityNumbers,
                     wrench);
  }
  /// A wrench on a body moves its mechanism.
  PLUMB_HD void push(std::uint32_t body, const Vec& force, const Vec& torque, Velocity* velocities,
                     ShareOfBodies share) const {
    if (!(length_squared(force) + length_squared(torque) > 0)) return;  // most contacts of what falls or lies still
    if (share.first == 0) {
      ContactLoad& load = loads[place_of[body] - 1];
      load.force += force;
      load.torque += torque;
    }
    const Six wrench = six(force, torque);
    for_moved(body, share,
              [=](std::uint32_t other, const Real* response) { move_by(response, wrench, velocities[other]); });
  }
  /// Likewise where its bodies are: a wrench times seconds moves them by what it gives them in speed times those.
  PLUMB_HD void displace(std::uint32_t body, const Vec& force, const Vec& torque, Displacement* displacements,
                         ShareOfBodies share) const {
    if (!(length_squared(force) + length_squared(torque) > 0)) return;  // to the last bit where they were
    const Six wrench = six(force, torque);
    for_moved(body, share, [=](std::uint32_t other, const Real* response) {
      const Six moved = motion_by(response, wrench);
      Displacement& of = displacements[other];
      of.linear += along_of(moved);
      of.rotation = normalized(turn_by(about_of(moved)) * of.rotation);
    });
  }

 private:
  /// f(body, what a wrench on one body of a mechanism does to this one) for each of its bodies.
  template <class F>
  PLUMB_HD void for_moved(std::uint32_t body, ShareOfBodies share, const F& f) const {
    const MechanismBody& source = bodies[place_of[body] - 1];
    for (std::uint32_t k = share.first; k < source.count; k += share.step)
      f(bodies[source.first + k].body, mobility + source.mobility + std::size_t{k} * kMobilityNumbers);
  }
};

}  // namespace plumb::impulse
