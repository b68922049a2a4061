// Trajectories on disk: a few bytes a body and frame, precise enough to look at, not to judge by; and layers beside
// the poses: whatever else is known of a frame.
//
// A .plt file, little endian:
//   8 bytes   "PLUMBTR2"
//   u32       length of the header
//   header    JSON: what a replay must know (record/trajectory_header.hpp), "moving": indices of the bodies that have
//             poses, and "layers": [{"name","rows":"one"|"moving"|"list","columns":[{"name","type","width"}]}]
//   blocks    until the end of the file: u32 frames, u32 length, then as many bytes: one zstd frame; where frames is 0,
//             JSON that says how it ended, uncompressed, and nothing follows
// Uncompressed, a block is its frames one after another: u32 step, then 18 bytes for every moving body:
//   3 x f32   position minus the body's start position, m
//   48 bits   orientation: the number of the component of largest size (2 bits), then the other three in order with
//             15 bits each over -1/sqrt(2)..1/sqrt(2), the largest made positive (within 3e-5 a component)
// then for every layer u8: 1 where it was looked at in this frame, and if so u32 rows ("list" only), and its columns
// one after another, each of rows * width numbers of its type.
// A torn last block, which a kill leaves behind, is no error to a reader.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "simulation/simulation.hpp"

namespace plumb::harness {

/// 6 bytes for a unit quaternion, and back.
[[nodiscard]] std::uint64_t pack_orientation(const PlumbQuat& orientation);
[[nodiscard]] PlumbQuat unpack_orientation(std::uint64_t packed);

struct LayerColumn {
  std::string name;
  std::string type;  ///< "f64", "f32", "u32", "i32", "u8"
  std::uint32_t width = 1;
};
[[nodiscard]] std::size_t bytes_of(const LayerColumn& column);  ///< of one row

enum class LayerRows { one, moving, list };  ///< one a frame, one for each moving body, or any number
struct LayerSpec {
  std::string name;
  LayerRows rows = LayerRows::list;
  std::vector<LayerColumn> columns;
};

/// A layer's columns in one frame, as bytes.
struct LayerData {
  explicit LayerData(const LayerSpec& spec) : columns(spec.columns.size()) {}
  std::uint32_t rows = 0;
  std::vector<std::string> columns;

  template <class Number>
  void put(std::size_t column, Number number) {
    columns[column].append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void put(std::size_t column, const PlumbVec3& v) {
    for (const double x : {v.x, v.y, v.z}) put(column, static_cast<float>(x));
  }
  template <class Number>
  [[nodiscard]] Number get(std::size_t column, std::size_t index) const {
    Number number;
    std::memcpy(&number, columns.at(column).data() + index * sizeof number, sizeof number);
    return number;
  }
};
using FrameLayers = std::vector<std::optional<LayerData>>;  ///< none: not looked at in the frame

class TrajectoryWriter {
 public:
  /// header has "bodies" and "moving". Throws Error when the file cannot be written.
  TrajectoryWriter(const std::filesystem::path& file, Json header, std::vector<LayerSpec> layers);
  /// poses: of the moving bodies. layers: one entry for each of the writer's.
  void add_frame(std::uint32_t step, std::span<const PoseRow> poses, const FrameLayers& layers);
  void finish();
  [[nodiscard]] const std::vector<LayerSpec>& layers() const { return layers_; }

 private:
  void flush();

  std::ofstream out_;
  std::filesystem::path file_;
  std::vector<LayerSpec> layers_;
  std::vector<PlumbVec3> starts_;
  std::uint32_t frames_ = 0;  ///< in block_
  std::string block_;
};

/// Adds how it ended, {"status","reason",...}, to a file that is otherwise complete.
void end_trajectory(const std::filesystem::path& file, const Json& outcome);

struct TrajectoryFrame {
  std::uint32_t step;
  std::vector<PoseRow> poses;
  FrameLayers layers;
};
struct Trajectory {
  Json header;
  std::vector<std::size_t> moving;
  std::vector<LayerSpec> layers;
  std::vector<TrajectoryFrame> frames;
  Json outcome;  ///< null where whoever wrote it came to no end
};

/// Throws Error (PLUMB_E_CORRUPT) for what is not a trajectory, or one of an older program.
[[nodiscard]] Trajectory read_trajectory(const std::filesystem::path& file);
/// Its header alone; throws likewise.
[[nodiscard]] Json read_trajectory_header(const std::filesystem::path& file);

}  // namespace plumb::harness
