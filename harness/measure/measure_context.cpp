// The part of MeasureContext that is the same for every context: how a number becomes an error; and the words.
#include <cmath>

#include "measure/measure.hpp"

namespace plumb::harness {

void MeasureContext::compare(const std::string& name, double value, double truth, double scale,
                             const std::string& note) {
  add({name, value, truth, std::abs(value - truth) / scale, std::nullopt, note});
}

void MeasureContext::deviation(const std::string& name, double value, const std::string& note) {
  add({name, value, 0.0, std::abs(value), std::nullopt, note});
}

void MeasureContext::expect(const std::string& name, bool value, bool truth, const std::string& note) {
  add({name, value ? 1.0 : 0.0, truth ? 1.0 : 0.0, value == truth ? 0.0 : 1.0, std::nullopt, note});
}

const char* word_of(ArgumentType type) {
  static constexpr const char* words[] = {"number", "numbers", "word", "body", "bodies", "joint", "object"};
  return words[static_cast<std::size_t>(type)];
}

}  // namespace plumb::harness
