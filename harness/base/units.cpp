#include "base/units.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "base/shown.hpp"
#include "plumb/nearest.hpp"

namespace plumb::harness {
namespace {

/// A factor and the powers of metre, kilogram, second and radian.
struct Unit {
  double factor = 1;
  std::array<int, 4> powers{};
};

/// The unit for a word that people write in its place; "" where there is none.
std::string unit_for(const std::string& word) {
  static const std::map<std::string, const char*> words{
      {"degree", "deg"},  {"degrees", "deg"},   {"radian", "rad"},     {"radians", "rad"},   {"second", "s"},
      {"seconds", "s"},   {"sec", "s"},         {"minute", "min"},     {"minutes", "min"},   {"hour", "h"},
      {"hours", "h"},     {"metre", "m"},       {"metres", "m"},       {"meter", "m"},       {"meters", "m"},
      {"kilogram", "kg"}, {"kilograms", "kg"},  {"gram", "g"},         {"grams", "g"},       {"newton", "N"},
      {"newtons", "N"},   {"joule", "J"},       {"joules", "J"},       {"watt", "W"},        {"hertz", "Hz"},
      {"percent", "%"},   {"centimetre", "cm"}, {"centimetres", "cm"}, {"millimetre", "mm"}, {"millimetres", "mm"}};
  const auto found = words.find(word);
  return found == words.end() ? "" : found->second;
}

const std::map<std::string, Unit, std::less<>>& atoms() {
  static const std::map<std::string, Unit, std::less<>> table{
      {"1", {1, {}}},
      {"%", {0.01, {}}},
      {"mm", {1e-3, {1, 0, 0, 0}}},
      {"cm", {1e-2, {1, 0, 0, 0}}},
      {"m", {1, {1, 0, 0, 0}}},
      {"km", {1e3, {1, 0, 0, 0}}},
      {"g", {1e-3, {0, 1, 0, 0}}},
      {"kg", {1, {0, 1, 0, 0}}},
      {"t", {1e3, {0, 1, 0, 0}}},
      {"ms", {1e-3, {0, 0, 1, 0}}},
      {"s", {1, {0, 0, 1, 0}}},
      {"min", {60, {0, 0, 1, 0}}},
      {"h", {3600, {0, 0, 1, 0}}},
      {"Hz", {1, {0, 0, -1, 0}}},
      {"rad", {1, {0, 0, 0, 1}}},
      {"deg", {std::numbers::pi / 180, {0, 0, 0, 1}}},
      {"N", {1, {1, 1, -2, 0}}},
      {"kN", {1e3, {1, 1, -2, 0}}},
      {"J", {1, {2, 1, -2, 0}}},
      {"W", {1, {2, 1, -3, 0}}},
      {"Pa", {1, {-1, 1, -2, 0}}},
  };
  return table;
}

Unit parse(const std::string& text) {
  Unit unit;
  int sign = 1;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == ' ') {
      ++at;
      continue;
    }
    if (text[at] == '/') {
      sign = -1;
      ++at;
      continue;
    }
    std::size_t end = text.find_first_of(" /", at);
    if (end == std::string::npos) end = text.size();
    std::string word = text.substr(at, end - at);
    int power = 1;
    if (word.size() > 1 && word.back() >= '2' && word.back() <= '4') {
      power = word.back() - '0';
      word.pop_back();
    }
    const auto atom = atoms().find(word);
    if (atom == atoms().end()) {
      std::vector<std::string> known;
      for (const auto& [name, ignored] : atoms()) known.push_back(name);
      const std::string meant = unit_for(word);
      throw std::invalid_argument(
          fmt::format("unknown unit \"{}\"{}", shortened(word),
                      meant.empty() ? suggestion(shortened(word), known) : "; did you mean \"" + meant + "\"?"));
    }
    for (int i = 0; i < power; ++i) {
      unit.factor = sign > 0 ? unit.factor * atom->second.factor : unit.factor / atom->second.factor;
      for (std::size_t d = 0; d < unit.powers.size(); ++d) unit.powers[d] += sign * atom->second.powers[d];
    }
    at = end;
  }
  return unit;
}

}  // namespace

bool is_unit(std::string_view text) {
  try {
    parse(std::string(text));
    return !text.empty();
  } catch (const std::invalid_argument&) {
    return false;
  }
}

double conversion(const std::string& from, const std::string& to) {
  const Unit source = parse(from);
  const Unit target = parse(to);
  if (source.powers != target.powers)
    throw std::invalid_argument(fmt::format("unit \"{}\" does not measure what \"{}\" does", from, to));
  return source.factor / target.factor;
}

}  // namespace plumb::harness
