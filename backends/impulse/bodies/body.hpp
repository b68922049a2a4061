// Bodies and their shapes in the world, as kernels see them. Rows are indexed by body slot; a row whose body is gone
// has inverse mass 0 and no proxy.
#pragma once

#include <cstdint>

#include "broadphase/pairs.hpp"
#include "geometry/shape.hpp"
#include "geometry/surface.hpp"
#include "math/box.hpp"
#include "math/mat33.hpp"

namespace plumb::impulse {

constexpr std::uint32_t kNone = 0xffffffffu;  ///< no row

/// What the solver reads and writes: 32 bytes in float. Rows with inverse mass 0 are never written.
struct alignas(4 * sizeof(Real)) Velocity {
  Vec linear;  ///< of the centre of mass, m/s
  Real inverse_mass;
  Vec angular;  ///< rad/s, world axes
  Real unused;
};

/// How far a body has moved since the step began: small numbers, so that float is enough far from the origin too.
struct alignas(4 * sizeof(Real)) Displacement {
  Vec linear;
  Real unused;
  Quat rotation;
};

/// I^-1 in world axes.
struct alignas(8 * sizeof(Real)) WorldInertia {
  Sym inverse;
  Real tumbles;  ///< in this step: 1, else 0
  Real unused;
};

enum BodyFlag : std::uint32_t {
  kBodyDynamic = 1u << 0,
  kBodyTurns = 1u << 1,       ///< has inertia: its orientation changes
  kBodyGyroscopic = 1u << 2,  ///< turns, and its principal moments differ: a free one tumbles
  kBodyMoves = 1u << 3,       ///< dynamic or kinematic
  kBodyNeverSleeps = 1u << 4,
  kBodyLocked = 1u << 5,         ///< some of the locks are set
  kLockLinear = 1u << 6,         ///< along x; y and z follow
  kLockAngular = 1u << 9,        ///< about x; y and z follow
  kBodyContinuous = 1u << 12,    ///< must not pass through others however fast it is
  kBodySweeps = 1u << 13,        ///< kinematic, and must find those in time who must not pass through it
  kBodyShowsContacts = 1u << 14  ///< its manifolds are shown to the host before they are solved
};

/// What is given once for a body.
struct BodyMass {
  Vec inverse_inertia;  ///< principal, 1/(kg m2)
  Real gravity_scale;
  Vec inertia;  ///< principal, kg m2
  Real linear_damping;
  Real angular_damping;
  std::uint32_t flags;  ///< BodyFlag
};

/// Whether the host moves it.
PLUMB_HD inline bool is_kinematic(const BodyMass& mass) {
  return (mass.flags & (kBodyDynamic | kBodyMoves)) == kBodyMoves;
}

/// How large a moment of a contact may be along its tangents and about its normal, relative to its normal force, m.
struct RollingFriction {
  Real rolling, spinning;
};

/// What the host makes act on a body in the next step.
struct BodyForce {
  Vec force, torque;  ///< N, N m at the centre of mass, world axes
};

/// All rows of all bodies, to be read. position is of the centre of mass, orientation of the principal axes.
struct Bodies {
  const Position* position;
  const Quat* orientation;
  const Velocity* velocity;
  const BodyForce* force;
  const BodyMass* mass;
  bool turn;  ///< whether any dynamic one may; else the angular velocities of those are 0 and stay so
};

/// The same rows, to be moved: the access of the stages of a step that solve and clamp. All others get Bodies, and so
/// cannot move anybody.
struct MovableBodies {
  Position* position;
  Quat* orientation;
  Velocity* velocity;
  const BodyForce* force;
  const BodyMass* mass;
  bool turn;
  bool operator==(const MovableBodies&) const = default;

  // NOLINTNEXTLINE(google-explicit-constructor): who may move bodies may read them
  PLUMB_HD operator Bodies() const { return {position, orientation, velocity, force, mass, turn}; }
};

/// From the frame in which the engine works to the body's own, which the interface speaks of.
struct BodyFrame {
  Position centre_of_mass;  ///< in the body's frame, m
  Quat4<double> principal;  ///< from the principal axes to the body's frame
};

/// A shape on a body.
struct Proxy {
  std::uint32_t body;
  std::uint32_t shape;       ///< row of the shapes
  std::uint32_t first_step;  ///< the step before which it was made: older contacts of this row are somebody else's
  Material material;
  Frame frame;  ///< of the shape in the body's principal frame
};

struct Proxies {
  const Proxy* rows;
  const Shape* shapes;
  Hulls hulls;
  Surfaces surfaces{};
  bool operator==(const Proxies&) const = default;
};

/// A shape's placement: the turn in world axes, and where its origin is from the body's centre of mass.
struct ShapePose {
  Vec offset;
  Quat orientation;
};
PLUMB_HD inline ShapePose shape_pose(const Proxy& proxy, const Quat& body) {
  return {rotate(body, proxy.frame.position), body * proxy.frame.orientation};
}

}  // namespace plumb::impulse
