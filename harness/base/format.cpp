#include "base/format.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace plumb::harness {
namespace {

/// 3.10e-05 as 3.1e-5: an exponent needs neither its zeros nor its plus, nor a mantissa its trailing zeros.
std::string tidy_exponent(std::string text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  std::string mantissa = text.substr(0, e);
  if (mantissa.find('.') != std::string::npos) {
    while (mantissa.back() == '0') mantissa.pop_back();
    if (mantissa.back() == '.') mantissa.pop_back();
  }
  return fmt::format("{}e{}", mantissa, std::stoi(text.substr(e + 1)));
}

/// Bytes of the UTF-8 code point at text[at]; 0 where there is no whole valid one.
std::size_t code_point_bytes(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(at);
  const std::size_t bytes = lead < 0x80                   ? 1
                            : lead >= 0xC2 && lead < 0xE0 ? 2
                            : lead >= 0xE0 && lead < 0xF0 ? 3
                            : lead >= 0xF0 && lead < 0xF5 ? 4
                                                          : 0;
  if (bytes == 0 || at + bytes > text.size()) return 0;
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(at + i) & 0xC0) != 0x80) return 0;
  }
  if (bytes == 3) {
    const int code = ((lead & 0x0F) << 12) | ((byte(at + 1) & 0x3F) << 6);
    if (code < 0x800 || (code >= 0xD800 && code < 0xE000)) return 0;  // over-long, or half of a UTF-16 pair
  }
  if (bytes == 4 && ((lead == 0xF0 && byte(at + 1) < 0x90) || (lead == 0xF4 && byte(at + 1) > 0x8F))) return 0;
  return bytes;
}

}  // namespace

std::string short_number(double value, int digits) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  if (value == 0) return "0";
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
  const int exponent = std::stoi(scientific.substr(scientific.find('e') + 1));  // after rounding: 9.999 is 10.0
  if (exponent < -3 || exponent >= 6) return tidy_exponent(scientific);
  return fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent));
}

std::string short_number(std::optional<double> value, int digits) {
  return value ? short_number(*value, digits) : std::string(no_value);
}

std::string limit_text(double value) {
  std::string text = short_number(value);
  if (text.find('e') != std::string::npos || text.find('.') == std::string::npos) return text;
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string shortest_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return tidy_exponent(fmt::format("{}", value == 0 ? 0.0 : value));
}

std::string dt_text(std::optional<double> dt) {
  if (!dt) return std::string(no_value);
  if (*dt > 0 && *dt < 1) {
    const double rate = std::round(1 / *dt);
    if (rate < 1e6 && std::abs(rate * *dt - 1) < 1e-6) return fmt::format("1/{:.0f}", rate);
  }
  const std::string text = shortest_number(*dt);
  constexpr std::size_t readable = 8;  // characters; a refined step lies between others and has no short number
  return text.size() > readable && *dt > 0 ? fmt::format("1/{:.4g}", 1 / *dt) : text;
}

std::string ratio_text(double ratio) { return short_number(ratio) + "\u00d7"; }

std::size_t text_width(std::string_view text) {
  std::size_t width = 0;
  for (const char c : text) width += (static_cast<std::uint8_t>(c) & 0xC0) != 0x80;
  return width;
}

std::string clipped(std::string_view text, std::size_t width) {
  if (text_width(text) <= width) return std::string(text);
  if (width == 0) return "";
  std::size_t at = 0, shown = 0;
  while (at < text.size()) {
    if ((static_cast<std::uint8_t>(text[at]) & 0xC0) != 0x80 && ++shown == width) break;
    ++at;
  }
  return std::string(text.substr(0, at)) + "\u2026";
}

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = code_point_bytes(text, at);
    const auto lead = static_cast<std::uint8_t>(text[at]);
    const bool control = bytes == 1 ? lead < 0x20 || lead == 0x7F
                                    : bytes == 2 && lead == 0xC2 && static_cast<std::uint8_t>(text[at + 1]) < 0xA0;
    if (bytes == 0) {
      out += "\uFFFD";
    } else if (control) {
      out += ' ';
    } else {
      out += text.substr(at, bytes);
    }
    at += bytes == 0 ? 1 : bytes;
  }
  return out;
}

bool natural_less(std::string_view a, std::string_view b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const auto run = [&](std::string_view s, std::size_t& at) {
        while (at < s.size() && s[at] == '0') ++at;
        const std::size_t first = at;
        while (at < s.size() && digit(s[at])) ++at;
        return s.substr(first, at - first);
      };
      const std::string_view x = run(a, i), y = run(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  if (i < a.size() || j < b.size()) return i == a.size();
  return a < b;  // "01" and "1" read alike, yet are two names
}

std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return shortest_number(value.get<double>());
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace plumb::harness
