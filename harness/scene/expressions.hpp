// Numeric expressions of scene files: parameters, indices of repeats, pi, and the functions that the schema lists.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace mu {
class Parser;
}

namespace plumb::harness {

/// Names that expressions know by themselves: functions, constants, and the times that thresholds may use.
[[nodiscard]] const std::vector<std::string>& expression_words();

/// Evaluates expressions over named numbers and words. Texts are compiled once for a set of names.
class Expressions {
 public:
  Expressions();
  ~Expressions();
  Expressions(const Expressions&) = delete;
  Expressions& operator=(const Expressions&) = delete;

  /// Gives a name its value; the name may be there already.
  void set(const std::string& name, double value);
  /// A word parameter: comparable with the names of its choices, and replaceable by its word in names.
  void set_word(const std::string& name, const std::string& word);
  /// Makes the word one that others may be compared with.
  void add_word(const std::string& word);
  void erase(const std::string& name);
  [[nodiscard]] bool has(const std::string& name) const { return values_.contains(name); }

  /// All names with their values; those of words have values that tell them apart.
  [[nodiscard]] const std::map<std::string, double>& values() const { return values_; }
  /// Whether the expression uses the name, which need not be known. False for what is no expression.
  [[nodiscard]] static bool uses(const std::string& text, const std::string& name);

  /// Throws std::invalid_argument with a sentence that names the fault and the nearest known name.
  [[nodiscard]] double evaluate(const std::string& text);
  /// Replaces every {expression} by its whole number and {parameter} by its word. Throws std::invalid_argument.
  [[nodiscard]] std::string interpolate(const std::string& text);

 private:
  std::map<std::string, double> values_;  ///< nodes do not move: the parsers point at them
  std::map<std::string, std::string> words_;
  std::map<std::string, mu::Parser> compiled_;
};

}  // namespace plumb::harness
