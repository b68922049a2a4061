// The energy bound: what no step may do to an island in which there are joints.
//
// After a step the kinetic energy of an island can be no more than what it had, what gravity and the host's forces put
// in, what motors and springs can give, and what bodies and surfaces that the host moves can hand on. Where it is, the
// solver has made the energy, and the step is taken back, to be gone in parts: contacts are found anew in each, and
// what contacts see of mechanisms is no older than that, which more sub-steps would not change. In the shortest parts
// the gain is taken out: all bodies of the island are slowed by the same share, at which joints hold as well as before.
// An island that gained many times what it had stays where it was instead, and goes on at half the speed that it had:
// that is the last resort, and neither right nor smooth.
//
// A step in which a limit or a motor let go that contacts had counted on (joints/joint_axis_solve.hpp) is taken
// back by the same means, before energies are looked at, and solved again whole: in islands of which a joint let go
// nothing is counted on then, and others are settled (settled_islands.hpp). So none depends on what happens in another.
//
// So is, next, a step that opened a joint (opened_joints.hpp): its island has more sub-steps then
// (choose_substeps.hpp), and others are settled likewise. Where that does not keep it shut the step is gone in parts,
// as above.
//
// The bound is generous (kMostGain): it tells what flies apart from what does not, and is no measure of drift. Worlds
// without joints, and solvers other than the default, are not watched.
#pragma once

#include "bodies/step_counters.hpp"
#include "bodies/step_parameters.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "joints/joint_loops.hpp"
#include "joints/joint_store.hpp"
#include "narrowphase/contact_cache.hpp"
#include "narrowphase/manifold_change.hpp"
#include "solver/settled_islands.hpp"

namespace plumb::impulse {

/// A step in which an island's kinetic energy exceeds what it may have by this factor is taken back; in the shortest
/// parts an island that does by the second is held.
inline constexpr Real kMostGain = Real(1.1), kMostGainAtLast = 16;
/// Of an island that is held, and of the impulses of its joints, what is left.
inline constexpr Real kHeldShare = Real(0.5);
/// What each island may gain from what is no source at all, such as overlap that is taken back: as much as its weight
/// gives over this way, m, and as its mass has at this speed, m/s.
inline constexpr Real kFreeWay = Real(1e-3), kFreeSpeed = Real(0.1);
/// What went its way in the step by so much faster than it may have gone, m/s, made energy, too, however slow it is in
/// the end. Errors of joints and overlap are taken back without speed that stays, but not as fast.
inline constexpr Real kFreeSpeedOfWay = 20;

/// State of a joint before the step.
struct KeptJoint {
  JointImpulse impulse;
  Vec force, torque;  ///< of its reaction, where there are any
  Real held_for[kJointRows];
  Real way;
};

/// Of a body, and at the root of an island of the island.
struct IslandEnergy {
  std::uint32_t parent, root;
  std::uint32_t speed, spin;  ///< the fastest that the host moves what touches it, m/s, rad/s: bits of floats
  std::uint32_t mover;        ///< one of those that do, and 1; or 0
  std::uint32_t peak;         ///< the largest term of the sums, J: bits of a float
  std::uint32_t joined;       ///< at the root: a joint holds one of its bodies
  std::uint32_t let_go;       ///< likewise: one of which rows have not held as predicted does
  std::uint32_t opened;       ///< likewise: the step has opened one that does
  bool again;                 ///< likewise: it goes over the step again, with more sub-steps
  bool is_held;               ///< it stays where it was before the step
  Real keeps;                 ///< of its velocities the share that is left
  // Sums in whole numbers of a share of the peak, which do not depend on the order:
  std::int64_t kinetic;   ///< after the step
  std::int64_t may_have;  ///< before it, with what sources can give
  std::int64_t work;      ///< of gravity and the host's forces over the way that was gone
};

/// What the bound works on, and with.
struct EnergyWork {
  ContactCache cache;
  Proxies proxies;
  const Vec* surface_velocities;  ///< by proxy, or null
  ManifoldChanges changes;
  MovableBodies bodies;
  JointSet joints;  ///< with the world's bodies
  JointCode code;
  std::uint32_t body_count, pair_capacity;
  const StepParameters* parameters;
  StepCounters* counters;
  BodyPace* paces;
  const BodyLevel* levels;  ///< null: paces are nobody's
  const SubstepLevels* substeps;
  bool settles;  ///< islands may be settled
};

class EnergyBound {
 public:
  /// predicts: rows of joints may be counted on, and be found to have let go.
  void reserve(std::size_t bodies, std::size_t joints, std::size_t contacts, bool predicts) {
    bodies_.grow(bodies);
    islands_.grow(bodies);
    tried_.grow(bodies);
    joints_.grow(joints);
    given_.grow(joints);
    if (!predicts) return;
    settled_bodies_.grow(bodies);
    settled_joints_.grow(joints);
    settled_contacts_.grow(contacts);
  }
  /// Before the step is solved.
  void keep(Executor& executor, const EnergyWork& work);
  /// After it: takes the step back where rows of joints have not held as predicted; else counts the islands that gained
  /// too much, and takes the step back or holds them.
  void judge(Executor& executor, const EnergyWork& work, Count contacts);
  /// By body: those of which islands are settled, in a step that is gone over again.
  [[nodiscard]] const SettledBody* settled_bodies() const { return settled_bodies_.data(); }

 private:
  Buffer<KeptBody> bodies_;
  Buffer<IslandEnergy> islands_;
  Buffer<bool> tried_;        // by body, from one attempt at a step to the next: its island has had more sub-steps
  Buffer<KeptJoint> joints_;  // as JointSet numbers them, and so
  Buffer<Real> given_;        // what their motors and springs can have given, J
  Buffer<SettledBody> settled_bodies_;  // these as SettledIslands
  Buffer<SettledJoint> settled_joints_;
  Buffer<CachedManifold> settled_contacts_;
};

}  // namespace plumb::impulse
