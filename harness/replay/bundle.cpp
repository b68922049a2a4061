#include "replay/bundle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <set>

#include "replay/badge.hpp"
#include "replay/bytes.hpp"
#include "replay/fineness.hpp"
#include "replay/lists.hpp"
#include "replay/motion.hpp"

namespace plumb::harness {

namespace {

constexpr double fewest_frames_a_second = 15;
constexpr std::size_t fewest_frames = 90;
constexpr int mantissa_bits = 10;     // of depths, forces and gaps: three digits
constexpr float least_depth = 1e-9f;  // m: below it the viewer's colours do not begin
constexpr double step_of_normal = 1.0 / 256;
constexpr int digits_of_header = 7;
const std::set<std::string> not_drawn{"contacts/depth", "contacts/engine_depth", "boxes/tree"};

/// The same JSON with numbers as short as a float32 needs.
Json shortened(const Json& json) {
  if (json.is_number_float())
    return std::strtod(fmt::format("{:.{}g}", json.get<double>(), digits_of_header).c_str(), nullptr);
  Json result = json;
  if (json.is_structured())
    for (Json& entry : result) entry = shortened(entry);
  return result;
}

struct Choice {
  std::size_t stride = 1;  ///< every so many frames, and the last
  std::set<std::string> left_out;
};

class BundleMaker {
 public:
  BundleMaker(const Trajectory& trajectory, const Choice& choice)
      : from_(trajectory), left_out_(choice.left_out), step_(step_of_positions(trajectory)) {
    const std::size_t count = trajectory.frames.size();
    for (std::size_t i = 0; i < count; i += choice.stride) frames_.push_back(i);
    if (count > 0 && frames_.back() != count - 1) frames_.push_back(count - 1);
  }

  Bundle make() {
    add_header();
    add_times();
    add_poses();
    for (std::size_t i = 0; i < from_.layers.size(); ++i) {
      const LayerSpec& spec = from_.layers[i];
      if (left_out_.contains(spec.name)) continue;
      if (spec.name == "series") {
        add_accounts(i);
      } else if (spec.rows == LayerRows::one) {
        for (std::size_t c = 0; c < spec.columns.size(); ++c)
          add_series(spec.columns[c].name, numbers(i, c), unit_of(spec.columns[c].name), "");
      } else if (spec.rows == LayerRows::moving) {
        add_columns(i);
      } else {
        add_list(i);
      }
    }
    return std::move(bundle_);
  }

 private:
  [[nodiscard]] std::size_t bodies() const { return from_.moving.size(); }

  [[nodiscard]] std::string unit_of(const std::string& column) const {
    return from_.header.value("units", Json::object()).value(column, "");
  }

  /// The layer as it was last looked at; null before the first time.
  [[nodiscard]] const LayerData* layer_at(std::size_t layer, std::size_t frame) const {
    for (std::size_t f = frame + 1; f-- > 0;)
      if (const auto& data = from_.frames[f].layers[layer]) return &*data;
    return nullptr;
  }

  void add_header() {
    Json& header = bundle_.header;
    header = from_.header;
    for (const char* key : {"layers", "driven", "closed", "units"}) header.erase(key);
    for (const char* key : {"shapes", "bodies", "joints"})
      if (header.contains(key)) header[key] = shortened(header[key]);
    if (!frames_.empty() && header.contains("bodies"))
      for (const std::size_t body : from_.moving) header["bodies"].at(body).erase("start");
    const bool ended = from_.outcome.is_object();
    header["status"] = ended ? from_.outcome.value("status", "") : "crashed";
    header["reason"] = ended ? from_.outcome.value("reason", "") : "the recording breaks off: its process ended";
    if (const Json badge = badge_of(from_.outcome); !badge.is_null()) header["badge"] = badge;
    header["frames"] = frames_.size();
    header["series"] = Json::object();
    header["bounds"] = {{"position", step_}, {"angle", angle_bound}};
  }

  void add_times() {
    std::string bytes;
    const double dt = from_.header.value("dt", 1.0);
    for (const std::size_t frame : frames_) put(bytes, static_cast<float>(from_.frames[frame].step * dt));
    add_by_frame("times", "f32", 1, bytes, {});
  }

  void add_poses() {
    std::vector<std::vector<PoseRow>> poses;
    for (const std::size_t frame : frames_) poses.push_back(from_.frames[frame].poses);
    bundle_.sections["positions"] = coded_positions(poses, step_);
    bundle_.sections["orientations"] = coded_orientations(poses);
  }

  /// A section of `width` numbers for each frame, which are held against those of the frame before.
  void add_by_frame(const std::string& name, const std::string& type, std::size_t width, const std::string& bytes,
                    const Exactness& exactness) {
    std::vector<std::size_t> shape{frames_.size()};
    if (width != 1) shape.push_back(width);
    bundle_.sections[name] =
        coded_column(type, shape, bytes, 1, rows_earlier(frames_.size() * width, width), width, exactness);
  }

  /// What a column is rounded to: lengths in space to steps of positions, directions, the others to digits.
  [[nodiscard]] Exactness exactness_of(const std::string& column) const {
    if (column == "point" || column == "lower" || column == "upper") return {step_, 0, 0};
    if (column == "normal" || column == "axis") return {step_of_normal, 0, 0};
    const bool is_force = column == "force";
    return {0, mantissa_bits, is_force ? 0 : least_depth};
  }

  void add_series(const std::string& name, const std::vector<double>& values, const std::string& unit,
                  const char* doc) {
    std::string bytes;
    for (const double value : values) put(bytes, static_cast<float>(value));
    bundle_.header["series"][name] = {{"unit", unit}, {"doc", doc}};
    add_by_frame("series/" + name, "f32", 1, bytes, {});
  }

  /// One column of a layer of one row over the frames, the part-th number of those that it is wide.
  [[nodiscard]] std::vector<double> numbers(std::size_t layer, std::size_t column, std::size_t part = 0) const {
    const std::string& type = from_.layers[layer].columns[column].type;
    std::vector<double> values;
    for (const std::size_t frame : frames_) {
      const LayerData* data = layer_at(layer, frame);
      double value = NAN;
      if (data != nullptr && type == "f64") value = data->get<double>(column, part);
      if (data != nullptr && type == "f32") value = static_cast<double>(data->get<float>(column, part));
      if (data != nullptr && type == "u32") value = data->get<std::uint32_t>(column, part);
      values.push_back(value);
    }
    return values;
  }

  /// Energy and momentum as people ask for them, from the layer "series" of a scene.
  void add_accounts(std::size_t layer) {
    const std::vector<double> kinetic = numbers(layer, 0), potential = numbers(layer, 1), momenta = numbers(layer, 3);
    std::vector<double> energy, energy_drift, momentum_drift;
    double kinetic_most = 0, potential_least = INFINITY, potential_most = -INFINITY, momenta_most = 0;
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      energy.push_back(kinetic[f] + potential[f]);
      kinetic_most = std::max(kinetic_most, kinetic[f]);
      potential_least = std::min(potential_least, potential[f]);
      potential_most = std::max(potential_most, potential[f]);
      momenta_most = std::max(momenta_most, momenta[f]);
    }
    add_series("energy", energy, "J", "kinetic and potential, by the referee");
    // What hardly moves has hardly any range: there the energy itself, above y = 0, is the measure.
    double reference = kinetic_most + (potential_most - potential_least);
    for (const double value : energy) reference = std::max(reference, std::abs(value));
    if (reference > 0 && !from_.header.value("driven", false)) {
      for (const double value : energy) energy_drift.push_back((value - energy.front()) / reference);
      add_series(
          "energy_drift", energy_drift, "1",
          "change of the energy since the start, of the largest kinetic energy and potential range, or of the energy");
    }
    if (momenta_most > 0 && from_.header.value("closed", false)) {
      const std::vector<double> x = numbers(layer, 2, 0), y = numbers(layer, 2, 1), z = numbers(layer, 2, 2);
      for (std::size_t f = 0; f < frames_.size(); ++f)
        momentum_drift.push_back(std::hypot(x[f] - x[0], y[f] - y[0], z[f] - z[0]) / momenta_most);
      add_series("momentum_drift", momentum_drift, "1",
                 "change of the momentum since the start, of the largest sum of all momenta");
    }
    add_series("contacts", numbers(layer, 4), "1", "points, by the engine's count");
  }

  void add_columns(std::size_t layer) {
    const LayerSpec& spec = from_.layers[layer];
    for (std::size_t c = 0; c < spec.columns.size(); ++c) {
      const LayerColumn& column = spec.columns[c];
      std::string bytes;
      std::vector<double> deepest;
      for (const std::size_t frame : frames_) {
        const LayerData* data = layer_at(layer, frame);
        bytes += data != nullptr ? data->columns[c] : std::string(bodies() * bytes_of(column), '\0');
        if (column.name != "penetration") continue;
        deepest.push_back(0);
        for (std::size_t b = 0; data != nullptr && b < bodies(); ++b)
          deepest.back() = std::max(deepest.back(), static_cast<double>(data->get<float>(c, b)));
      }
      if (column.name == "penetration")
        add_series("max_penetration", deepest, "m", "deepest overlap of any two bodies, by the referee");
      add_by_frame(column.name, column.type, bodies(), bytes, exactness_of(column.name));
    }
  }

  void add_list(std::size_t layer) {
    const LayerSpec& spec = from_.layers[layer];
    std::vector<std::uint32_t> start{0};
    std::vector<std::string> columns(spec.columns.size());
    for (const std::size_t frame : frames_) {
      const LayerData* data = layer_at(layer, frame);
      start.push_back(start.back() + (data != nullptr ? data->rows : 0));
      for (std::size_t c = 0; data != nullptr && c < columns.size(); ++c) columns[c] += data->columns[c];
    }
    std::string start_bytes;
    for (const std::uint32_t row : start) put(start_bytes, row);
    bundle_.sections[spec.name + "/start"] =
        coded_column("u32", {start.size()}, start_bytes, 1, rows_earlier(start.size(), 1), 1, {});
    add_rows(spec, start, columns);
  }

  /// Rows in the order of their keys: who is meant is told from the row above, the rest from the same ones in the frame
  /// before.
  void add_rows(const LayerSpec& spec, const std::vector<std::uint32_t>& start, std::vector<std::string>& columns) {
    static const std::set<std::string> names_of_keys{"body_a", "body_b", "body", "joint"};
    Json key_names = Json::array();
    std::vector<std::vector<std::uint32_t>> keys;
    std::vector<std::uint32_t> ids;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const bool is_key = names_of_keys.contains(spec.columns[c].name);
      if (!is_key && spec.columns[c].name != "id") continue;
      std::vector<std::uint32_t> numbers(start.back());
      std::memcpy(numbers.data(), columns[c].data(), columns[c].size());
      if (is_key) key_names.push_back(spec.columns[c].name);
      if (is_key)
        keys.push_back(std::move(numbers));
      else
        ids = std::move(numbers);
    }
    const MatchedRows matched = match_rows(start, keys, ids);
    const Before above = rows_earlier(start.back(), 1);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const LayerColumn& column = spec.columns[c];
      if (not_drawn.contains(spec.name + "/" + column.name)) continue;
      std::string sorted;
      for (const std::size_t row : matched.order) sorted.append(columns[c], row * bytes_of(column), bytes_of(column));
      std::vector<std::size_t> shape{start.back()};
      if (column.width > 1) shape.push_back(column.width);
      const bool is_key = names_of_keys.contains(column.name);
      bundle_.sections[spec.name + "/" + column.name] =
          coded_column(column.type, shape, sorted, column.width, is_key ? above : matched.before,
                       is_key ? Json(1) : Json(key_names), exactness_of(column.name));
    }
  }

  const Trajectory& from_;
  const std::set<std::string>& left_out_;
  double step_;
  std::vector<std::size_t> frames_;
  Bundle bundle_;
};

double seconds_of(const Trajectory& trajectory) {
  return trajectory.frames.empty() ? 0 : trajectory.frames.back().step * trajectory.header.value("dt", 1.0);
}

std::string note_of(const Trajectory& trajectory, const Choice& choice) {
  std::vector<std::string> parts;
  const Json recorded = trajectory.header.value("recorded", Json::object());
  const Json looks = recorded.value("every", Json::object());
  for (const auto& [layer, every] : looks.items()) {
    if (every.get<std::size_t>() > choice.stride && !choice.left_out.contains(layer))
      parts.push_back(fmt::format("{} of every {}th recorded frame, held in between", layer, every.get<std::size_t>()));
  }
  if (choice.stride > 1) parts.push_back(fmt::format("to keep it small, every {}th recorded frame", choice.stride));
  if (!choice.left_out.empty()) parts.push_back(fmt::format("and without {}", fmt::join(choice.left_out, ", ")));
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string packed(const Trajectory& trajectory, const Choice& choice) {
  Bundle bundle = BundleMaker(trajectory, choice).make();
  if (const std::string note = note_of(trajectory, choice); !note.empty()) bundle.header["note"] = note;
  return pack(bundle);
}

}  // namespace

Bundle whole_bundle(const Trajectory& trajectory) { return BundleMaker(trajectory, {}).make(); }

std::string bounded_bundle(const Trajectory& trajectory, std::size_t most_bytes) {
  Choice choice;
  std::string bytes = packed(trajectory, choice);
  const auto halve_frames = [&](std::size_t least) {
    while (bytes.size() > most_bytes && trajectory.frames.size() / (2 * choice.stride) >= least) {
      choice.stride *= 2;
      bytes = packed(trajectory, choice);
    }
  };
  halve_frames(std::max(fewest_frames, static_cast<std::size_t>(fewest_frames_a_second * seconds_of(trajectory))));
  for (const char* layer : {"boxes", "axes", "constraints", "contacts", "penetration"}) {
    const bool has = std::any_of(trajectory.layers.begin(), trajectory.layers.end(),
                                 [&](const LayerSpec& spec) { return spec.name == layer; });
    if (bytes.size() <= most_bytes || !has) continue;
    choice.left_out.insert(layer);
    bytes = packed(trajectory, choice);
  }
  halve_frames(2);
  return bytes;
}

}  // namespace plumb::harness
