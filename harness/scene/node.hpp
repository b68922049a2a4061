// A value of a scene file with its place in it: reads it as what is expected, or fails with file, line and remedy.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/expressions.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

class Node {
 public:
  /// All three must outlive the node; value lies within file.json.
  Node(const SceneFile& file, const nlohmann::json& value, Expressions& expressions)
      : file_(&file), value_(&value), expressions_(&expressions) {}

  /// Throws UsageError "file:line: bodies[1].density: sentence".
  [[noreturn]] void fail(const std::string& sentence) const;
  /// Likewise: `unknown <what> "<word>"` with the nearest known one.
  [[noreturn]] void fail_unknown(const std::string& what, const std::string& word,
                                 const std::vector<std::string>& known) const;

  [[nodiscard]] const nlohmann::json& json() const { return *value_; }
  [[nodiscard]] Expressions& expressions() const { return *expressions_; }

  /// An object with these keys only.
  void only(const std::vector<std::string>& keys) const;
  [[nodiscard]] std::optional<Node> find(const char* key) const;
  [[nodiscard]] Node at(const char* key) const;  ///< fails when it is missing
  [[nodiscard]] std::vector<std::pair<std::string, Node>> members() const;
  [[nodiscard]] std::vector<Node> elements() const;

  [[nodiscard]] double number() const;
  [[nodiscard]] std::int64_t integer(std::int64_t minimum, std::int64_t maximum) const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string name() const;  ///< text with its {} replaced, fit to be shown
  /// A text that people read: some characters, none of which controls a terminal.
  [[nodiscard]] std::string title() const;
  [[nodiscard]] PlumbVec3 vector() const;
  [[nodiscard]] PlumbQuat orientation() const;
  /// Index of the text in a list of words.
  [[nodiscard]] std::size_t word(const std::string& what, const std::vector<std::string>& known) const;
  /// Bits of an array of words: bit i for known[i].
  [[nodiscard]] std::uint64_t bits(const std::string& what, const std::vector<std::string>& known) const;

  /// Fails where the name is none that expressions can have, or is one that they have already. A word that is only
  /// compared with may be called as a function is.
  void check_new_name(const std::string& name) const;
  void check_new_word(const std::string& word) const;
  /// Fails where a name cannot be shown: it is empty, of many characters, or some of them control a terminal.
  void check_shown_name(const std::string& name) const;

  // The same for members that may be left out.
  [[nodiscard]] double number_or(const char* key, double otherwise) const;
  [[nodiscard]] PlumbVec3 vector_or(const char* key, const PlumbVec3& otherwise) const;
  [[nodiscard]] PlumbQuat orientation_or(const char* key, const PlumbQuat& otherwise) const;

 private:
  [[noreturn]] void fail_in(const Node& whole, const std::string& sentence) const;

  const SceneFile* file_;
  const nlohmann::json* value_;
  Expressions* expressions_;
};

}  // namespace plumb::harness
