// A step is gone over again because rows of joints have let go that were counted on (energy_bound.hpp). Islands in
// which none has would come out of it as they did, to the bit: these are settled. What has become of them is set aside
// before the world is put back; contacts are found again where they were; then the solver leaves settled islands out,
// which are of no level of sub-steps (bodies/body_level.hpp), and at the end all of them is put where it was.
#pragma once

#include "joints/joint_loops.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// State of a body before a step, or after it.
struct KeptBody {
  Position position;
  Quat orientation;
  Velocity velocity;
  Real least_moment;
};

PLUMB_HD inline KeptBody state_of(const JointView& view, std::uint32_t body) {
  const Bodies& all = view.bodies;
  return {all.position[body], all.orientation[body], all.velocity[body], view.least_moment[body]};
}
/// displacement: since the step began.
PLUMB_HD inline void put_state(const MovableBodies& all, const JointView& view, std::uint32_t body,
                               const KeptBody& state, const Displacement& displacement) {
  all.position[body] = state.position;
  all.orientation[body] = state.orientation;
  all.velocity[body] = state.velocity;
  view.least_moment[body] = state.least_moment;
  view.solver.displacement[body] = displacement;
}

struct SettledBody {
  bool is_settled;
  KeptBody state;
  Displacement displacement;
};

struct SettledJoint {
  JointImpulse impulse;
  JointReaction reaction;
};

/// Where it is set aside. A joint and a contact belong to the island of that of their bodies that can be pushed.
struct SettledIslands {
  SettledBody* bodies;
  SettledJoint* joints;      ///< as JointSet numbers them
  CachedManifold* contacts;  ///< by row of the cache

  PLUMB_HD bool hold(const JointView& view, std::uint32_t a, std::uint32_t b) const {
    return bodies[view.inverse_mass(b) > 0 ? b : a].is_settled;
  }

  PLUMB_HD void set_body_aside(const JointView& view, std::uint32_t i, bool is_settled) const {
    bodies[i].is_settled = is_settled;
    if (is_settled) bodies[i] = {true, state_of(view, i), view.solver.displacement[i]};
  }
  PLUMB_HD void put_body(const MovableBodies& all, const JointView& view, std::uint32_t i) const {
    if (bodies[i].is_settled) put_state(all, view, i, bodies[i].state, bodies[i].displacement);
  }
  PLUMB_HD void set_joint_aside(const JointSet& of, std::uint32_t j) const {
    const Joint& joint = of.view.joints[j];
    if (hold(of.view, joint.body_a, joint.body_b))
      joints[j] = {of.view.impulses[joint.slot], of.axes.reactions[joint.slot]};
  }
  PLUMB_HD void put_joint(const JointSet& of, std::uint32_t j) const {
    const Joint& joint = of.view.joints[j];
    if (!hold(of.view, joint.body_a, joint.body_b)) return;
    of.view.impulses[joint.slot] = joints[j].impulse;
    of.axes.reactions[joint.slot] = joints[j].reaction;
  }
  PLUMB_HD void set_contact_aside(const JointView& view, const ContactCache& cache, const Proxy* proxies,
                                  std::uint32_t row) const {
    const Pair pair = cache.pairs[cache.candidate[row]];
    if (hold(view, proxies[pair.a].body, proxies[pair.b].body)) contacts[row] = cache.kept[row];
  }
  PLUMB_HD void put_contact(const JointView& view, const ContactCache& cache, const Proxy* proxies,
                            std::uint32_t row) const {
    const Pair pair = cache.pairs[cache.candidate[row]];
    if (hold(view, proxies[pair.a].body, proxies[pair.b].body)) cache.kept[row] = contacts[row];
  }
};

}  // namespace plumb::impulse
