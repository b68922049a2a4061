// A trajectory as a replay bundle: what the page's viewer plays, small enough for a page.
#pragma once

#include "record/trajectory.hpp"
#include "replay/container.hpp"

namespace plumb::harness {

/// The bundle of a trajectory at full rate, with all layers. Lists and columns that were not looked at in a frame are
/// those of the last frame in which they were.
///
/// Header: the trajectory's with seven digits, without the starts of bodies that move where there are frames, and
/// "status", "reason", "badge" (replay/badge.hpp), "frames", "series" ({name: {"unit","doc"}}), "note", and "bounds":
/// {"position" (m, of every coordinate; replay/fineness.hpp), "angle" (rad)}, within which poses come back. Sections:
/// times, positions and orientations (replay/motion.hpp), series/NAME (exact), penetration, asleep, islands, and the
/// lists joints, contacts, boxes, axes, constraints as NAME/start and NAME/COLUMN (replay/lists.hpp): points within 1.5
/// steps of positions, directions within 0.4 degrees, depths, forces and gaps within .15 %, rows in any order.
[[nodiscard]] Bundle whole_bundle(const Trajectory& trajectory);

/// The packed bundle, no larger than most_bytes as far as that can be: frames are left out down to about 15 a second,
/// then the layers beside the poses, heaviest first, then further frames; the header's note says so.
[[nodiscard]] std::string bounded_bundle(const Trajectory& trajectory, std::size_t most_bytes);

}  // namespace plumb::harness
