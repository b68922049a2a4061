// Loops over all joints, one by one in the order of their colours: sequential impulses.
#pragma once

#include "exec/executor.hpp"
#include "joints/joint_axis_solve.hpp"
#include "joints/joint_system.hpp"

namespace plumb::impulse {

constexpr std::uint32_t kJointColours = 32;

/// Joints of one colour share no body that they push. The last colour may hold any: its joints go one after the other.
/// Of each colour those come first that are not in the system.
struct JointColours {
  const std::uint32_t* joints;  ///< by colour
  const std::uint32_t* first;   ///< of each colour, and of the end behind the last
  const std::uint32_t* system;  ///< of each colour the first that is in the system
  std::uint32_t count;
  bool last_is_overflow;
};

/// The joints of a step: in any order one by one, or as a system whose joints are the last.
struct JointSet {
  JointView view;
  std::uint32_t count;
  JointColours colours;
  JointSystem system;
  AxisParts axes;    ///< of a set that has them
  bool any_couples;  ///< the number of some row is its way (is_of_way)
};

/// What of joints a step's code can do: a step that needs less is a kernel of its own, for what joints take of a GPU's
/// registers and code costs contacts dearly.
enum class JointCode {
  kContacts,  ///< none
  kPlain,     ///< rows that always hold
  kAll        ///< limits, motors, springs, universal and generic joints, and reactions
};

template <class F>
PLUMB_DEVICE void for_joints_of_colour(Team& team, const JointColours& colours, std::uint32_t colour,
                                       std::uint32_t first, std::uint32_t end, const F& f) {
  const std::uint32_t* list = colours.joints;
  if (first == end) return;
  if (colours.last_is_overflow && colour + 1 == colours.count)
    each_by_rows(team, 1, [=](std::uint32_t) {
      for (std::uint32_t i = first; i < end; ++i) {
        f(list[i]);
        lanes_meet();
      }
    });
  else
    each_by_rows(team, end - first, [=](std::uint32_t i) { f(list[first + i]); });
}

/// f(j) for every joint, colour after colour.
template <class F>
PLUMB_DEVICE void for_joints(Team& team, const JointSet& joints, const F& f) {
  for (std::uint32_t colour = 0; colour < joints.colours.count; ++colour)
    for_joints_of_colour(team, joints.colours, colour, joints.colours.first[colour], joints.colours.first[colour + 1],
                         f);
}
/// f(j) for every joint that is not in the system and has sub-steps of that level.
template <class F>
PLUMB_DEVICE void for_single_joints(Team& team, const JointSet& joints, std::uint32_t level, const F& f) {
  if (joints.system.base == 0) return;
  const JointView view = joints.view;
  for (std::uint32_t colour = 0; colour < joints.colours.count; ++colour)
    for_joints_of_colour(team, joints.colours, colour, joints.colours.first[colour], joints.colours.system[colour],
                         [=](std::uint32_t j) {
                           if (view.level(view.joints[j]) == level) f(j);
                         });
}
/// Likewise, in any order.
template <class F>
PLUMB_DEVICE void each_single_joint(Team& team, const JointSet& joints, std::uint32_t level, const F& f) {
  const JointView view = joints.view;
  each_by_rows(team, joints.system.base, [=](std::uint32_t j) {
    if (view.level(view.joints[j]) == level) f(j);
  });
}

}  // namespace plumb::impulse
