#include "record/trajectory.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>

#include "plumb/assert.hpp"

namespace plumb::harness {

namespace {

static_assert(std::endian::native == std::endian::little, "the file's numbers are written as they lie in memory");

constexpr char magic[] = "PLUMBTR2";
constexpr char older_magic[] = "PLUMBTR1";
constexpr std::uint32_t frames_a_block = 64;
constexpr std::size_t largest_block = 4 << 20;  // of bytes uncompressed: what a crash may lose, and a reader unpacks
constexpr std::uint32_t largest_packed_block = 1u << 29;
constexpr unsigned long long most_unpacked = 1ull << 30;
constexpr double steps_of_component = 32767;  // 15 bits
constexpr int compression_level = 5;
constexpr const char* words_of_rows[] = {"one", "moving", "list"};

template <class Number>
void put(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

[[noreturn]] void corrupt(const std::filesystem::path& file, const std::string& why) {
  throw Error(PLUMB_E_CORRUPT, file.string() + " is not a trajectory: " + why);
}

Json read_header(std::istream& in, const std::filesystem::path& file) {
  char start[8] = {};
  std::uint32_t size = 0;
  in.read(start, sizeof start).read(reinterpret_cast<char*>(&size), sizeof size);
  if (std::memcmp(start, older_magic, sizeof start) == 0)
    corrupt(file, "it begins with PLUMBTR1, as an older program wrote it; record the cell again");
  if (!in || std::memcmp(start, magic, sizeof start) != 0) corrupt(file, "it does not begin with PLUMBTR2");
  if (size > std::filesystem::file_size(file)) corrupt(file, "its header is cut short");
  std::string text(size, '\0');
  if (!in.read(text.data(), static_cast<std::streamsize>(size))) corrupt(file, "its header is cut short");
  Json header = Json::parse(text, nullptr, false);
  if (!header.is_object() || !header.contains("moving")) corrupt(file, "its header is not JSON, or of something else");
  return header;
}

std::vector<PlumbVec3> starts_of(const Json& header, const std::vector<std::size_t>& moving) {
  std::vector<PlumbVec3> starts;
  for (const std::size_t body : moving) {
    const Json& start = header.at("bodies").at(body).at("start");
    const auto at = [&](std::size_t i) { return start.at(i).is_number() ? start[i].get<double>() : NAN; };
    starts.push_back({at(0), at(1), at(2)});
  }
  return starts;
}

Json json_of(const std::vector<LayerSpec>& layers) {
  Json json = Json::array();
  for (const LayerSpec& layer : layers) {
    Json columns = Json::array();
    for (const LayerColumn& column : layer.columns)
      columns.push_back({{"name", column.name}, {"type", column.type}, {"width", column.width}});
    json.push_back({{"name", layer.name}, {"rows", words_of_rows[static_cast<int>(layer.rows)]}, {"columns", columns}});
  }
  return json;
}

std::vector<LayerSpec> layers_of(const Json& json) {
  std::vector<LayerSpec> layers;
  for (const Json& entry : json) {
    LayerSpec layer{entry.at("name"), LayerRows::list, {}};
    if (entry.at("rows") == "one") layer.rows = LayerRows::one;
    if (entry.at("rows") == "moving") layer.rows = LayerRows::moving;
    for (const Json& column : entry.at("columns"))
      layer.columns.push_back({column.at("name"), column.at("type"), column.at("width")});
    layers.push_back(std::move(layer));
  }
  return layers;
}

/// Takes numbers and bytes from an uncompressed block, and throws where it is shorter than it says.
class BlockReader {
 public:
  BlockReader(const std::string& bytes, const std::filesystem::path& file)
      : at_(bytes.data()), end_(at_ + bytes.size()), file_(file) {}
  template <class Number>
  Number take() {
    Number number;
    std::memcpy(&number, skip(sizeof number), sizeof number);
    return number;
  }
  const char* skip(std::size_t size) {
    if (size > static_cast<std::size_t>(end_ - at_)) corrupt(file_, "a block is shorter than its frames");
    const char* here = at_;
    at_ += size;
    return here;
  }

 private:
  const char* at_;
  const char* end_;
  const std::filesystem::path& file_;
};

LayerData read_layer(BlockReader& block, const LayerSpec& spec, std::size_t moving) {
  LayerData data(spec);
  data.rows = 1;
  if (spec.rows == LayerRows::moving) data.rows = static_cast<std::uint32_t>(moving);
  if (spec.rows == LayerRows::list) data.rows = block.take<std::uint32_t>();
  for (std::size_t c = 0; c < spec.columns.size(); ++c) {
    const std::size_t size = data.rows * bytes_of(spec.columns[c]);
    data.columns[c].assign(block.skip(size), size);
  }
  return data;
}

TrajectoryFrame read_frame(BlockReader& block, const std::vector<PlumbVec3>& starts,
                           const std::vector<LayerSpec>& layers) {
  TrajectoryFrame frame{block.take<std::uint32_t>(), {}, {}};
  frame.poses.reserve(starts.size());
  for (const PlumbVec3& start : starts) {
    const auto x = block.take<float>(), y = block.take<float>(), z = block.take<float>();
    std::uint64_t packed = 0;
    std::memcpy(&packed, block.skip(6), 6);
    frame.poses.push_back(
        {{start.x + static_cast<double>(x), start.y + static_cast<double>(y), start.z + static_cast<double>(z)},
         unpack_orientation(packed)});
  }
  for (const LayerSpec& layer : layers) {
    frame.layers.emplace_back();
    if (block.take<std::uint8_t>() != 0) frame.layers.back() = read_layer(block, layer, starts.size());
  }
  return frame;
}

std::string unpacked(const std::string& bytes, const std::filesystem::path& file) {
  const unsigned long long length = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  // Of corrupt bytes the length may be anything; no writer makes blocks as large as that.
  if (length > most_unpacked) corrupt(file, "a block does not unpack");
  std::string raw(length, '\0');
  if (ZSTD_decompress(raw.data(), raw.size(), bytes.data(), bytes.size()) != raw.size())
    corrupt(file, "a block does not unpack");
  return raw;
}

}  // namespace

std::size_t bytes_of(const LayerColumn& column) {
  static const std::map<std::string, std::size_t> sizes{{"f64", 8}, {"f32", 4}, {"u32", 4}, {"i32", 4}, {"u8", 1}};
  const auto found = sizes.find(column.type);
  if (found == sizes.end()) throw Error(PLUMB_E_CORRUPT, "a layer's column has the unknown type " + column.type);
  return found->second * column.width;
}

std::uint64_t pack_orientation(const PlumbQuat& orientation) {
  const std::array<double, 4> q{orientation.x, orientation.y, orientation.z, orientation.w};
  const auto size_less = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto largest = static_cast<std::size_t>(std::max_element(q.begin(), q.end(), size_less) - q.begin());
  const double sign = q[largest] < 0 ? -1 : 1;
  std::uint64_t packed = largest;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == largest) continue;
    const double unit = std::clamp((sign * q[i] * std::sqrt(2.0) + 1) / 2, 0.0, 1.0);
    const double whole = std::isfinite(unit) ? std::round(unit * steps_of_component) : 0;
    packed = packed << 15 | static_cast<std::uint64_t>(whole);
  }
  return packed;
}

PlumbQuat unpack_orientation(std::uint64_t packed) {
  const std::size_t largest = packed >> 45 & 3;
  std::array<double, 4> q{};
  double rest = 1;
  int shift = 30;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == largest) continue;
    const double unit = static_cast<double>(packed >> shift & 0x7fff) / steps_of_component;
    q[i] = (2 * unit - 1) / std::sqrt(2.0);
    rest -= q[i] * q[i];
    shift -= 15;
  }
  q[largest] = std::sqrt(std::max(0.0, rest));
  return {q[0], q[1], q[2], q[3]};
}

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& file, Json header, std::vector<LayerSpec> layers)
    : file_(file), layers_(std::move(layers)) {
  starts_ = starts_of(header, header.at("moving").get<std::vector<std::size_t>>());
  header["layers"] = json_of(layers_);
  out_.open(file, std::ios::binary | std::ios::trunc);
  const std::string text = line_of(header);
  std::string bytes(magic, 8);
  put(bytes, static_cast<std::uint32_t>(text.size()));
  out_ << bytes << text;
  if (!out_) throw Error(PLUMB_E_INVALID_ARGUMENT, "cannot write " + file.string());
}

void TrajectoryWriter::add_frame(std::uint32_t step, std::span<const PoseRow> poses, const FrameLayers& layers) {
  PLUMB_ASSERT(poses.size() == starts_.size() && layers.size() == layers_.size());
  put(block_, step);
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    const PoseRow& row = poses[i];
    put(block_, static_cast<float>(row.position.x - starts_[i].x));
    put(block_, static_cast<float>(row.position.y - starts_[i].y));
    put(block_, static_cast<float>(row.position.z - starts_[i].z));
    const std::uint64_t packed = pack_orientation(row.orientation);
    block_.append(reinterpret_cast<const char*>(&packed), 6);
  }
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const std::optional<LayerData>& data = layers[i];
    put(block_, static_cast<std::uint8_t>(data.has_value()));
    if (!data) continue;
    PLUMB_ASSERT(data->columns.size() == layers_[i].columns.size());
    if (layers_[i].rows == LayerRows::list) put(block_, data->rows);
    for (const std::string& column : data->columns) block_ += column;
  }
  if (++frames_ == frames_a_block || block_.size() > largest_block) flush();
}

void TrajectoryWriter::finish() {
  flush();
  out_.close();
  if (!out_) throw Error(PLUMB_E_INVALID_ARGUMENT, "cannot write " + file_.string());
}

void TrajectoryWriter::flush() {
  if (frames_ == 0) return;
  std::string compressed(ZSTD_compressBound(block_.size()), '\0');
  compressed.resize(
      ZSTD_compress(compressed.data(), compressed.size(), block_.data(), block_.size(), compression_level));
  std::string head;
  put(head, frames_);
  put(head, static_cast<std::uint32_t>(compressed.size()));
  out_ << head << compressed << std::flush;  // what is there when an engine crashes is worth a look
  block_.clear();
  frames_ = 0;
}

void end_trajectory(const std::filesystem::path& file, const Json& outcome) {
  std::ofstream out(file, std::ios::binary | std::ios::app);
  const std::string text = line_of(outcome);
  std::string head;
  put(head, std::uint32_t{0});
  put(head, static_cast<std::uint32_t>(text.size()));
  out << head << text;
  if (!out.flush()) throw Error(PLUMB_E_INVALID_ARGUMENT, "cannot write " + file.string());
}

Json read_trajectory_header(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(PLUMB_E_INVALID_ARGUMENT, "cannot open " + file.string());
  return read_header(in, file);
}

Trajectory read_trajectory(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(PLUMB_E_INVALID_ARGUMENT, "cannot open " + file.string());
  Trajectory trajectory;
  trajectory.header = read_header(in, file);
  std::vector<PlumbVec3> starts;
  try {
    trajectory.moving = trajectory.header.at("moving").get<std::vector<std::size_t>>();
    starts = starts_of(trajectory.header, trajectory.moving);
    trajectory.layers = layers_of(trajectory.header.at("layers"));
  } catch (const Json::exception& error) {
    corrupt(file, std::string("its header does not say what it must: ") + error.what());
  }
  std::uint32_t head[2];
  while (in.read(reinterpret_cast<char*>(head), sizeof head)) {
    const auto [frames, size] = head;
    if (frames > frames_a_block || size > largest_packed_block) break;
    std::string bytes(size, '\0');
    if (!in.read(bytes.data(), static_cast<std::streamsize>(size))) break;
    if (frames == 0) {
      trajectory.outcome = Json::parse(bytes, nullptr, false);
      break;
    }
    const std::string raw = unpacked(bytes, file);
    BlockReader block(raw, file);
    for (std::uint32_t i = 0; i < frames; ++i)
      trajectory.frames.push_back(read_frame(block, starts, trajectory.layers));
  }
  return trajectory;
}

}  // namespace plumb::harness
