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

  /// Throws UsageError "file:line: sentence".
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
  [[nodiscard]] std::string name() const;  ///< text with its {} replaced
  [[nodiscard]] PlumbVec3 vector() const;
  [[nodiscard]] PlumbQuat orientation() const;
  /// Index of the text in a list of words.
  [[nodiscard]] std::size_t word(const std::string& what, const std::vector<std::string>& known) const;
  /// Bits of an array of words: bit i for known[i].
  [[nodiscard]] std::uint64_t bits(const std::string& what, const std::vector<std::string>& known) const;

  // The same for members that may be left out.
  [[nodiscard]] double number_or(const char* key, double otherwise) const;
  [[nodiscard]] PlumbVec3 vector_or(const char* key, const PlumbVec3& otherwise) const;
  [[nodiscard]] PlumbQuat orientation_or(const char* key, const PlumbQuat& otherwise) const;

 private:
  const SceneFile* file_;
  const nlohmann::json* value_;
  Expressions* expressions_;
};

}  // namespace plumb::harness
