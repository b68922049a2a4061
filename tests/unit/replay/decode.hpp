// Opens coded sections of a bundle as harness/replay/motion.hpp and lists.hpp describe them, written from that
// description and not from the program: what the tests hold against the truth.
#pragma once

#include <cmath>
#include <cstring>

#include "replay/container.hpp"

namespace plumb::harness {

inline std::vector<std::int32_t> unplaned(const std::string& bytes, std::size_t offset, std::size_t planes,
                                          std::size_t count) {
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t zigzag = 0;
    for (std::size_t plane = 0; plane < planes; ++plane)
      zigzag |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(offset + plane * count + i)))
                << (8 * plane);
    numbers.push_back(static_cast<std::int32_t>(zigzag >> 1) ^ -static_cast<std::int32_t>(zigzag & 1));
  }
  return numbers;
}

/// [frame][body][axis], m.
inline std::vector<std::vector<std::array<double, 3>>> decoded_positions(const BundleSection& section) {
  const std::size_t frames = section.shape[0], bodies = section.shape[1];
  const auto raw = section.coding.at("raw").get<std::vector<std::size_t>>();
  const std::size_t planes = section.coding.at("planes"), count = 3 * frames * (bodies - raw.size());
  const double step = section.coding.at("step");
  std::vector<std::vector<std::array<double, 3>>> out(frames, std::vector<std::array<double, 3>>(bodies));
  const std::vector<std::int32_t> numbers = unplaned(section.bytes, bodies, planes, count);
  std::size_t at = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t body = 0; body < bodies; ++body) {
      if (std::find(raw.begin(), raw.end(), body) != raw.end()) continue;
      std::vector<std::int32_t> line;
      for (std::size_t f = 0; f < frames; ++f) {
        std::int32_t guess = f == 0 ? 0 : line[f - 1];
        if (f >= 2 && section.bytes[body] == 2) guess = 2 * line[f - 1] - line[f - 2];
        line.push_back(guess + numbers[at++]);
        out[f][body][axis] = line.back() * step;
      }
    }
  }
  const char* rest = section.bytes.data() + bodies + planes * count;
  for (std::size_t f = 0; f < frames; ++f) {
    for (const std::size_t body : raw) {
      for (std::size_t axis = 0; axis < 3; ++axis, rest += sizeof(float)) {
        float number = 0;
        std::memcpy(&number, rest, sizeof number);
        out[f][body][axis] = number;
      }
    }
  }
  return out;
}

/// [frame][body] x y z w.
inline std::vector<std::vector<std::array<double, 4>>> decoded_orientations(const BundleSection& section) {
  const std::size_t frames = section.shape[0], bodies = section.shape[1];
  const std::vector<std::int32_t> numbers =
      unplaned(section.bytes, bodies + bodies * frames, section.coding.at("planes"), 3 * frames * bodies);
  std::vector<std::vector<std::array<double, 4>>> out(frames, std::vector<std::array<double, 4>>(bodies));
  for (std::size_t body = 0; body < bodies; ++body) {
    std::array<std::int64_t, 4> last{0, 0, 0, 8192}, before = last;
    unsigned left_out = 0;
    for (std::size_t f = 0; f < frames; ++f) {
      left_out ^= static_cast<unsigned char>(section.bytes[bodies + body * frames + f]);
      std::array<std::int64_t, 4> now = last;
      if (f >= 2 && section.bytes[body] == 2)
        for (std::size_t i = 0; i < 4; ++i) now[i] = 2 * last[i] - before[i];
      const int sign = now[left_out] < 0 ? -1 : 1;
      std::int64_t rest = 8192 * 8192;
      for (std::size_t i = 0, k = 0; i < 4; ++i) {
        if (i == left_out) continue;
        now[i] = sign * now[i] + numbers[(body * 3 + k++) * frames + f];
        rest -= now[i] * now[i];
        out[f][body][i] = static_cast<double>(now[i]) / 8192;
      }
      const double exact = std::sqrt(static_cast<double>(std::max<std::int64_t>(rest, 0)));
      out[f][body][left_out] = exact / 8192;
      now[left_out] = static_cast<std::int64_t>(std::floor(exact + 0.5));
      std::int64_t dot = 0;
      for (std::size_t i = 0; i < 4; ++i) dot += now[i] * last[i];
      if (dot < 0)
        for (std::int64_t& part : now) part = -part;
      before = last;
      last = now;
    }
  }
  return out;
}

/// A column of a bundle's section, by row and then its width; start and keys of its list where it was matched by them.
inline std::vector<double> decoded_column(const Bundle& bundle, const std::string& name) {
  const BundleSection& section = bundle.sections.at(name);
  const Json& before = section.coding.at("before");
  std::size_t count = 1;
  for (const std::size_t extent : section.shape) count *= extent;
  std::vector<std::int64_t> row_before;
  if (before.is_number()) {
    const auto distance = before.get<std::int64_t>();
    for (std::int64_t row = 0; row < static_cast<std::int64_t>(count); ++row)
      row_before.push_back(std::max<std::int64_t>(row - distance, -1));
  } else {
    const std::string list = name.substr(0, name.find('/'));
    const std::vector<double> start = decoded_column(bundle, list + "/start");
    std::vector<std::vector<double>> keys;
    for (const Json& key : before) keys.push_back(decoded_column(bundle, list + "/" + key.get<std::string>()));
    row_before.assign(section.shape[0], -1);
    const auto same = [&](std::size_t a, std::size_t b) {
      return std::all_of(keys.begin(), keys.end(), [&](const auto& key) { return key[a] == key[b]; });
    };
    for (std::size_t f = 1; f + 1 < start.size(); ++f) {
      std::vector<bool> taken(count, false);
      for (auto row = static_cast<std::size_t>(start[f]); row < static_cast<std::size_t>(start[f + 1]); ++row) {
        for (auto old = static_cast<std::size_t>(start[f - 1]); old < static_cast<std::size_t>(start[f]); ++old) {
          if (taken[old] || !same(old, row)) continue;
          taken[old] = true;
          row_before[row] = static_cast<std::int64_t>(old);
          break;
        }
      }
    }
  }
  const std::size_t rows = row_before.size(), width = rows == 0 ? 1 : count / rows;
  std::vector<std::int32_t> numbers = unplaned(section.bytes, 0, section.coding.at("planes"), count);
  std::vector<double> out(count);
  for (std::size_t column = 0; column < width; ++column) {
    for (std::size_t row = 0; row < rows; ++row) {
      std::int32_t& number = numbers[column * rows + row];
      if (row_before[row] >= 0)
        number = static_cast<std::int32_t>(
            static_cast<std::uint32_t>(number) +
            static_cast<std::uint32_t>(numbers[column * rows + static_cast<std::size_t>(row_before[row])]));
      double& value = out[row * width + column];
      if (section.coding.contains("step")) {
        value = number * section.coding["step"].get<double>();
      } else if (section.coding.contains("bits")) {
        const auto magnitude = static_cast<std::uint32_t>(std::abs(number)) << (23 - section.coding["bits"].get<int>());
        float size = 0;
        std::memcpy(&size, &magnitude, sizeof size);
        value = number < 0 ? -static_cast<double>(size) : static_cast<double>(size);
      } else {
        value = section.type == "u32" ? static_cast<std::uint32_t>(number) : number;
      }
    }
  }
  return out;
}

}  // namespace plumb::harness
