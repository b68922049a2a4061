// Links that hang together by joints, and the host's setting of where they are and how they move.
#pragma once

#include <vector>

#include "hosts/gazebo/world/entities.hpp"

namespace plumb::gazebo {

/// Links that joints connect with one, itself first; not beyond links that stand still, and not across `without`.
/// to_world, where given: whether a joint holds any of them to the world or to what stands still.
[[nodiscard]] std::vector<Link*> connected(Link& link, const Joint* without = nullptr, bool* to_world = nullptr);

/// The link whose frame is that of all links of a model as one: the first that is no joint's child; null without links.
[[nodiscard]] Link* root_of(Model& model);
/// The root of the links that hang together with one.
[[nodiscard]] Link* root_of(Link& link);
/// All links of a model, and what hangs on them. held: whether something holds any of them to the world.
[[nodiscard]] std::vector<Link*> links_as_one(Model& model, bool* held = nullptr);

/// Moves links as one by a motion of the world, with their velocities where these are seen from `seen_from`.
void carry(const std::vector<Link*>& links, const Placement& motion, const Link* seen_from);

/// Brings a coordinate or a rate to a value by moving what hangs on the child.
void set_coordinate(Joint& joint, std::size_t axis, double value);
void set_rate(Joint& joint, std::size_t axis, double value);

/// Brings the child to where its joint's frames, which have changed, say, at the same coordinates as before.
void set_frames(Joint& joint, const Placement& in_parent, const Placement& in_child);

/// Positions and rates of its axes by its links, without counting turns.
void refresh(Joint& joint);

}  // namespace plumb::gazebo
