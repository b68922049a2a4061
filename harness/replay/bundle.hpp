// A trajectory as a replay bundle: what the page's viewer plays, small enough for a page.
#pragma once

#include "replay/container.hpp"
#include "run/trajectory.hpp"

namespace plumb::harness {

/// The bundle of a trajectory at full rate, with all layers. Lists and columns that were not looked at in a frame are
/// those of the last frame in which they were.
///
/// Header: the trajectory's, and "status", "reason", "frames", "series" ({name: {"unit","doc"}}), "lower" and "upper"
/// for positions in 16 bits, "note". Sections: times, positions (u16, or f32 where 16 bits would be coarser),
/// orientations (i16), series/NAME, penetration, asleep, islands, and the lists contacts, boxes, axes, constraints as
/// NAME/start and NAME/COLUMN.
[[nodiscard]] Bundle whole_bundle(const Trajectory& trajectory);

/// The packed bundle, no larger than most_bytes as far as that can be: frames are left out down to about 15 a second,
/// then the layers beside the poses, heaviest first, then further frames; the header's note says so.
[[nodiscard]] std::string bounded_bundle(const Trajectory& trajectory, std::size_t most_bytes);

}  // namespace plumb::harness
