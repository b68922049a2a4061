#include "run/trajectory.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "run/names.hpp"
#include "scene/build.hpp"

namespace plumb::harness {

namespace {

static_assert(std::endian::native == std::endian::little, "the file's numbers are written as they lie in memory");

constexpr char magic[] = "PLUMBTR1";
constexpr double frames_a_second = 60;
constexpr std::uint32_t frames_a_block = 64;
constexpr std::size_t bytes_a_body = 18;
constexpr double steps_of_component = 32767;  // 15 bits
constexpr int compression_level = 3;

template <class Number>
void put(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

template <class Number>
Number take(const char*& at) {
  Number number;
  std::memcpy(&number, at, sizeof number);
  at += sizeof number;
  return number;
}

Json json_of(const SceneShape& shape) {
  const PlumbShapeDesc& desc = shape.desc;
  Json json{{"type", word_of(shape_words(), desc.type)}};
  switch (desc.type) {
    case PLUMB_SPHERE: json["radius"] = desc.radius; break;
    case PLUMB_BOX: json["half_extents"] = {desc.half_extents.x, desc.half_extents.y, desc.half_extents.z}; break;
    case PLUMB_CAPSULE:
    case PLUMB_CYLINDER:
      json["radius"] = desc.radius;
      json["half_height"] = desc.half_height;
      break;
    case PLUMB_HEIGHT_FIELD:
      json["rows"] = desc.rows;
      json["columns"] = desc.columns;
      json["spacing"] = {desc.spacing.x, desc.spacing.z};
      json["heights"] = shape.heights;
      break;
    default: break;
  }
  if (!shape.vertices.empty()) json["vertices"] = shape.vertices;
  if (!shape.indices.empty()) json["indices"] = shape.indices;
  for (const SceneShape::Child& child : shape.children) {
    const auto& [p, q] = child.pose;
    json["children"].push_back({{"shape", child.shape}, {"pose", {p.x, p.y, p.z, q.x, q.y, q.z, q.w}}});
  }
  return json;
}

Json header_of(const Simulation& simulation, const std::string& backend) {
  const Scene& scene = simulation.scene();
  Json header{{"scene", scene.id},
              {"backend", backend},
              {"dt", scene.dt},
              {"shapes", Json::array()},
              {"bodies", Json::array()}};
  for (const SceneShape& shape : scene.shapes) header["shapes"].push_back(json_of(shape));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    const auto& [p, q] = simulation.poses()[i];
    header["bodies"].push_back({{"name", body.name},
                                {"shape", body.shape ? Json(*body.shape) : Json(nullptr)},
                                {"motion", word_of(motion_words(), body.desc.motion)},
                                {"start", {p.x, p.y, p.z, q.x, q.y, q.z, q.w}}});
  }
  return header;
}

[[noreturn]] void corrupt(const std::filesystem::path& file, const std::string& why) {
  throw Error(PLUMB_E_CORRUPT, file.string() + " is not a trajectory: " + why);
}

std::string file_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(PLUMB_E_INVALID_ARGUMENT, "cannot open " + file.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<PlumbVec3> starts_of(const Json& header) {
  std::vector<PlumbVec3> starts;
  for (const Json& body : header.at("bodies")) {
    const auto at = [&](std::size_t i) {
      return body.at("start").at(i).is_number() ? body["start"][i].get<double>() : NAN;
    };
    starts.push_back({at(0), at(1), at(2)});
  }
  return starts;
}

void read_block(const std::string& raw, std::uint32_t frames, const std::vector<PlumbVec3>& starts,
                Trajectory& trajectory) {
  const char* at = raw.data();
  for (std::uint32_t i = 0; i < frames; ++i) {
    TrajectoryFrame frame{take<std::uint32_t>(at), {}};
    for (const PlumbVec3& start : starts) {
      const auto x = take<float>(at), y = take<float>(at), z = take<float>(at);
      std::uint64_t packed = 0;
      std::memcpy(&packed, at, 6);
      at += 6;
      frame.poses.push_back(
          {{start.x + static_cast<double>(x), start.y + static_cast<double>(y), start.z + static_cast<double>(z)},
           unpack_orientation(packed)});
    }
    trajectory.frames.push_back(std::move(frame));
  }
}

}  // namespace

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

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& file, const Simulation& simulation,
                                   const std::string& backend)
    : file_(file) {
  out_.open(file, std::ios::binary | std::ios::trunc);
  const std::string header = line_of(header_of(simulation, backend));
  std::string bytes(magic, 8);
  put(bytes, static_cast<std::uint32_t>(header.size()));
  out_ << bytes << header;
  if (!out_) throw Error(PLUMB_E_INVALID_ARGUMENT, "cannot write " + file.string());
  for (const PoseRow& row : simulation.poses()) starts_.push_back(row.position);
  stride_ = static_cast<std::uint64_t>(std::max(1.0, std::round(1 / (frames_a_second * simulation.scene().dt))));
  add_frame(simulation);
}

void TrajectoryWriter::stepped(const Simulation& simulation) {
  if (simulation.steps() % stride_ == 0) add_frame(simulation);
}

void TrajectoryWriter::finish() {
  flush();
  out_.flush();
  if (!out_) throw Error(PLUMB_E_INVALID_ARGUMENT, "cannot write " + file_.string());
}

void TrajectoryWriter::add_frame(const Simulation& simulation) {
  put(block_, static_cast<std::uint32_t>(simulation.steps()));
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    const PoseRow& row = simulation.poses()[i];
    put(block_, static_cast<float>(row.position.x - starts_[i].x));
    put(block_, static_cast<float>(row.position.y - starts_[i].y));
    put(block_, static_cast<float>(row.position.z - starts_[i].z));
    const std::uint64_t packed = pack_orientation(row.orientation);
    block_.append(reinterpret_cast<const char*>(&packed), 6);
  }
  if (++frames_ == frames_a_block) flush();
}

void TrajectoryWriter::flush() {
  if (frames_ == 0) return;
  std::string compressed(ZSTD_compressBound(block_.size()), '\0');
  compressed.resize(
      ZSTD_compress(compressed.data(), compressed.size(), block_.data(), block_.size(), compression_level));
  std::string head;
  put(head, frames_);
  put(head, static_cast<std::uint32_t>(compressed.size()));
  out_ << head << compressed;
  block_.clear();
  frames_ = 0;
}

Trajectory read_trajectory(const std::filesystem::path& file) {
  const std::string bytes = file_bytes(file);
  if (bytes.size() < 12 || bytes.compare(0, 8, magic) != 0) corrupt(file, "it does not begin with PLUMBTR1");
  const char* at = bytes.data() + 8;
  const char* const end = bytes.data() + bytes.size();
  const auto header_size = take<std::uint32_t>(at);
  if (header_size > static_cast<std::size_t>(end - at)) corrupt(file, "its header is cut short");
  Trajectory trajectory;
  trajectory.header = Json::parse(at, at + header_size, nullptr, false);
  if (!trajectory.header.is_object() || !trajectory.header.contains("bodies")) corrupt(file, "its header is not JSON");
  at += header_size;
  const std::vector<PlumbVec3> starts = starts_of(trajectory.header);
  while (end - at >= 8) {
    const auto frames = take<std::uint32_t>(at), size = take<std::uint32_t>(at);
    if (size > static_cast<std::size_t>(end - at) || frames > frames_a_block) break;
    std::string raw(frames * (4 + bytes_a_body * starts.size()), '\0');
    if (ZSTD_decompress(raw.data(), raw.size(), at, size) != raw.size()) corrupt(file, "a block does not unpack");
    at += size;
    read_block(raw, frames, starts, trajectory);
  }
  return trajectory;
}

}  // namespace plumb::harness
