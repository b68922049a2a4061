// From candidate pairs to contact joints: filters, materials, friction directions, and what is told of it afterwards.
#pragma once

#include <ode/ode.h>

#include <deque>
#include <span>
#include <vector>

#include "bodies.hpp"
#include "events.hpp"
#include "plumb/backend/world_init.hpp"
#include "settings.hpp"

namespace plumb::ode {

class ContactPass {
 public:
  ContactPass(const WorldInit& init, dWorldID world);
  ContactPass(const ContactPass&) = delete;
  ContactPass& operator=(const ContactPass&) = delete;

  void configure(const Settings& settings);

  /// Forgets the step before.
  void begin_step();
  void begin_substep();
  /// One sub-step's detection: a contact joint for every point, in the group that end_substep empties. Where contacts
  /// are modified they are held back for respond().
  void detect(dSpaceID space);
  /// What is held back and the host is to see.
  [[nodiscard]] std::span<const PlumbManifold> shown() const { return shown_; }
  /// The contact joints of what is held back. changes: of rows of shown().
  void respond(std::span<const PlumbManifoldChange> changes);
  /// Two geoms that touch where they are, at their deepest point.
  struct Touch {
    Body *a, *b;
    PlumbVec3 normal;  ///< unit, from a to b
    double depth;      ///< m
  };
  /// What a detection would find now, sensors left out. It leaves nothing behind.
  [[nodiscard]] std::vector<Touch> look(dSpaceID space);
  /// After the solver: reads the impulses that its forces made in h seconds, and takes the contact joints away.
  void end_substep(double h);
  /// Merges the sub-steps' contacts and hands pairs to the events.
  void end_step(PairEvents& events);
  /// Before the world goes. Not called when ODE is not to be trusted any more.
  void destroy() { dJointGroupDestroy(group_); }

  [[nodiscard]] std::span<const PlumbContact> contacts() const { return contacts_; }
  [[nodiscard]] std::uint32_t pair_count() const { return pairs_; }
  [[nodiscard]] std::uint32_t point_count() const { return points_; }
  [[nodiscard]] dJointGroupID group() const { return group_; }

 private:
  struct Pair;
  struct Surface;
  struct Coefficients {
    double friction, restitution;
  };
  static void near(void* self, dGeomID first, dGeomID second);
  void meet(dGeomID first, dGeomID second);
  [[nodiscard]] static bool shows(const Pair& pair);
  /// Whether the second is the interface's body_a.
  [[nodiscard]] static bool is_swapped(const Pair& pair);
  [[nodiscard]] static std::uint32_t child_of(const GeomTag& tag, const dContactGeom& point);
  [[nodiscard]] static bool has_materials(const Pair& pair);  ///< by triangle
  [[nodiscard]] static Coefficients coefficients_at(const GeomTag& tag, const dContactGeom& point);
  [[nodiscard]] PlumbVec3 belts_of(const Pair& pair, const PlumbManifoldChange* change) const;
  [[nodiscard]] bool may_meet(const GeomTag& one, const GeomTag& two) const;
  void respond(const Pair& pair, std::span<dContact> points, const PlumbManifoldChange* change);
  void hold_back(const Pair& pair, int count);
  [[nodiscard]] PlumbManifold show(const Pair& pair, std::span<const dContact> points) const;
  [[nodiscard]] static PlumbContact contact_of(const Pair& pair, const dContactGeom& point);
  void record(const Pair& pair, const dContactGeom& point, dJointID joint);
  void merge_substeps();
  void aim_friction(const Pair& pair, dContact& contact, const PlumbVec3& belts) const;

  /// Where the impulse of a recorded contact comes from.
  struct Source {
    const dJointFeedback* feedback;  ///< null: asleep, or not asked for
    bool b_is_first;                 ///< ODE's first body is body_b
  };

  dWorldID world_;
  dJointGroupID group_;
  /// What the world needs.
  const struct Needs {
    bool collision, filters, sensors, sleeping, surface_velocity, modification;
    bool contacts, impulses, events;
  } needs_;
  int mode_ = 0;
  bool sliding_directions_ = false;
  int substeps_ = 1;
  std::vector<dContact> scratch_;  ///< with what no pair changes filled in
  std::uint32_t pairs_ = 0, points_ = 0;
  std::vector<PlumbContact> contacts_;
  std::vector<Source> sources_;
  std::vector<std::size_t> substep_starts_;  ///< in contacts_
  std::deque<dJointFeedback> feedbacks_;
  std::size_t feedbacks_used_ = 0;
  std::vector<BodyPair> touching_, sensed_;

  /// A pair that waits for the host.
  struct Held {
    const GeomTag *first, *second;
    bool awake;
    std::size_t first_point, point_count;  ///< of held_points_
    bool is_shown;
    std::size_t shown;  ///< row of shown_
  };
  std::vector<Held> held_;
  std::vector<dContact> held_points_;
  std::vector<PlumbManifold> shown_;
};

}  // namespace plumb::ode
