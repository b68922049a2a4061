// Trajectories on disk: a few bytes a body and frame, precise enough to look at, not to judge by.
//
// A .plt file, little endian:
//   8 bytes   "PLUMBTR1"
//   u32       length of the header
//   header    JSON: {"scene","backend","dt","shapes":[...],"bodies":[{"name","shape","motion","start":[7]}]}; shape is
//             an index into shapes or null, start is position and orientation x y z w as doubles
//   blocks    until the end of the file: u32 frames, u32 compressed length, one zstd frame
// Uncompressed, a block is its frames one after another: u32 step, then 18 bytes for every body:
//   3 x f32   position minus the body's start position, m
//   48 bits   orientation: the number of the component of largest size (2 bits), then the other three in order with
//             15 bits each over -1/sqrt(2)..1/sqrt(2), the largest made positive (within 3e-5 a component)
// A torn last block, which a kill leaves behind, is no error to a reader.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "run/json.hpp"
#include "run/simulation.hpp"

namespace plumb::harness {

/// 6 bytes for a unit quaternion, and back.
[[nodiscard]] std::uint64_t pack_orientation(const PlumbQuat& orientation);
[[nodiscard]] PlumbQuat unpack_orientation(std::uint64_t packed);

class TrajectoryWriter {
 public:
  /// Writes the header and the frame of the start. Throws Error when the file cannot be written.
  TrajectoryWriter(const std::filesystem::path& file, const Simulation& simulation, const std::string& backend);
  /// Adds a frame when one is due: about 60 a second of simulated time.
  void stepped(const Simulation& simulation);
  void finish();

 private:
  void add_frame(const Simulation& simulation);
  void flush();

  std::ofstream out_;
  std::filesystem::path file_;
  std::vector<PlumbVec3> starts_;
  std::uint64_t stride_ = 1;
  std::uint32_t frames_ = 0;  ///< in block_
  std::string block_;
};

struct TrajectoryFrame {
  std::uint32_t step;
  std::vector<PoseRow> poses;
};
struct Trajectory {
  Json header;
  std::vector<TrajectoryFrame> frames;
};

/// Throws Error (PLUMB_E_CORRUPT) for what is not a trajectory.
[[nodiscard]] Trajectory read_trajectory(const std::filesystem::path& file);

}  // namespace plumb::harness
