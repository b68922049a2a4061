#include "scene/node.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "base/locate.hpp"
#include "base/shown.hpp"
#include "plumb/nearest.hpp"

namespace plumb::harness {
namespace {

constexpr std::size_t longest_name = 200;

Eigen::Quaterniond rotation(const Node& node) {
  node.only({"axis", "degrees", "radians", "x_axis"});
  const auto direction = [&](const char* key) {
    const PlumbVec3 v = node.at(key).vector();
    const Eigen::Vector3d axis(v.x, v.y, v.z);
    if (axis.norm() == 0) node.at(key).fail("a direction must not be 0 0 0");
    return Eigen::Vector3d(axis.normalized());
  };
  if (node.find("x_axis")) {
    if (node.json().size() != 1) node.fail("x_axis stands alone in a rotation");
    return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), direction("x_axis"));
  }
  const auto in_degrees = node.find("degrees");
  const auto in_radians = node.find("radians");
  if (in_degrees.has_value() == in_radians.has_value()) node.fail("a rotation has either degrees or radians");
  const double angle = in_degrees ? in_degrees->number() * std::numbers::pi / 180 : in_radians->number();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, direction("axis")));
}

}  // namespace

void Node::fail(const std::string& sentence) const { fail_in(*this, sentence); }

// The line is this value's, and the key that of a whole which it may be a part of.
void Node::fail_in(const Node& whole, const std::string& sentence) const {
  const std::size_t line = line_of(file_->text, path_to(file_->json, value_));
  const std::string key = text_of(path_to(file_->json, whole.value_));
  throw UsageError(
      fmt::format("{}:{}: {}{}{}", file_->path.string(), line, shortened(key), key.empty() ? "" : ": ", sentence));
}

void Node::fail_unknown(const std::string& what, const std::string& word, const std::vector<std::string>& known) const {
  fail(fmt::format("unknown {} \"{}\"{}", what, shortened(word), suggestion(shortened(word), known)));
}

void Node::only(const std::vector<std::string>& keys) const {
  if (!value_->is_object()) fail(fmt::format("expected an object, found {}", value_->type_name()));
  for (const auto& [key, member] : value_->items())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      Node(*file_, member, *expressions_)
          .fail_in(*this, fmt::format("unknown key \"{}\"{}", shortened(key), suggestion(shortened(key), keys)));
}

std::optional<Node> Node::find(const char* key) const {
  if (!value_->is_object()) fail(fmt::format("expected an object, found {}", value_->type_name()));
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return Node(*file_, *found, *expressions_);
}

Node Node::at(const char* key) const {
  const auto found = find(key);
  if (!found) fail(fmt::format("the key \"{}\" is missing here", key));
  return *found;
}

std::vector<std::pair<std::string, Node>> Node::members() const {
  if (!value_->is_object()) fail(fmt::format("expected an object, found {}", value_->type_name()));
  std::vector<std::pair<std::string, Node>> all;
  for (const auto& [key, member] : value_->items()) all.emplace_back(key, Node(*file_, member, *expressions_));
  return all;
}

std::vector<Node> Node::elements() const {
  if (!value_->is_array()) fail(fmt::format("expected an array, found {}", value_->type_name()));
  std::vector<Node> all;
  for (const auto& element : *value_) all.emplace_back(*file_, element, *expressions_);
  return all;
}

double Node::number() const {
  if (value_->is_number()) return value_->get<double>();
  if (!value_->is_string()) fail(fmt::format("expected a number or an expression, found {}", value_->type_name()));
  try {
    return expressions_->evaluate(value_->get_ref<const std::string&>());
  } catch (const std::invalid_argument& error) {
    fail(error.what());
  }
}

std::int64_t Node::integer(std::int64_t minimum, std::int64_t maximum) const {
  const double value = number();
  if (value != std::rint(value) || value < static_cast<double>(minimum) || value > static_cast<double>(maximum))
    fail(fmt::format("expected a whole number from {} to {}, found {:g}", minimum, maximum, value));
  return static_cast<std::int64_t>(value);
}

bool Node::boolean() const {
  if (!value_->is_boolean()) fail(fmt::format("expected true or false, found {}", value_->type_name()));
  return value_->get<bool>();
}

std::string Node::text() const {
  if (!value_->is_string()) fail(fmt::format("expected a string, found {}", value_->type_name()));
  return value_->get<std::string>();
}

std::string Node::name() const {
  std::string name;
  try {
    name = expressions_->interpolate(text());
  } catch (const std::invalid_argument& error) {
    fail(error.what());
  }
  check_shown_name(name);
  return name;
}

std::string Node::title() const {
  std::string shown = text();
  if (shown.empty()) fail("a few words are missing here");
  if (has_control_characters(shown)) fail("there is a control character in this text; take it out");
  return shown;
}

void Node::check_new_name(const std::string& name) const {
  check_new_word(name);
  const auto& words = expression_words();
  if (std::find(words.begin(), words.end(), name) != words.end())
    fail(fmt::format("\"{}\" has a meaning in expressions; choose another name", name));
}

void Node::check_new_word(const std::string& word) const {
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";
  const bool begins = !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0;
  if (!begins || word.find_first_not_of(letters) != std::string::npos || word.size() > longest_name)
    fail(fmt::format("\"{}\" is no name for expressions: those begin with a letter and go on with letters, digits or _",
                     shortened(word)));
  if (expressions_->has(word)) fail(fmt::format("\"{}\" is the name of something else already", word));
}

void Node::check_shown_name(const std::string& name) const {
  if (name.empty()) fail("a name has one character or more");
  if (name.size() > longest_name)
    fail(fmt::format("the name \"{}\" has more than {} characters", shortened(name), longest_name));
  if (has_control_characters(name))
    fail(fmt::format("there is a control character in the name \"{}\"; take it out", shortened(name)));
}

PlumbVec3 Node::vector() const {
  if (!value_->is_array() || value_->size() != 3) fail("expected an array of three numbers");
  const auto e = elements();
  return {e[0].number(), e[1].number(), e[2].number()};
}

PlumbQuat Node::orientation() const {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  if (value_->is_object()) {
    q = rotation(*this);
  } else if (value_->is_array() && !value_->empty() && value_->front().is_object()) {
    for (const Node& element : elements()) q = q * rotation(element);
  } else if (value_->is_array() && value_->size() == 4) {
    const auto e = elements();
    q = Eigen::Quaterniond(e[3].number(), e[0].number(), e[1].number(), e[2].number());
    if (q.norm() == 0) fail("a quaternion must not be 0 0 0 0");
    if (std::abs(q.squaredNorm() - 1) > 1e-15) q.normalize();
  } else {
    fail("expected an orientation: [x, y, z, w], {axis, degrees}, {x_axis} or a list of rotations");
  }
  return {q.x(), q.y(), q.z(), q.w()};
}

std::size_t Node::word(const std::string& what, const std::vector<std::string>& known) const {
  const std::string given = name();
  const auto found = std::find(known.begin(), known.end(), given);
  if (found == known.end()) fail_unknown(what, given, known);
  return static_cast<std::size_t>(found - known.begin());
}

std::uint64_t Node::bits(const std::string& what, const std::vector<std::string>& known) const {
  std::uint64_t set = 0;
  for (const Node& element : elements()) set |= std::uint64_t{1} << element.word(what, known);
  return set;
}

double Node::number_or(const char* key, double otherwise) const {
  const auto found = find(key);
  return found ? found->number() : otherwise;
}

PlumbVec3 Node::vector_or(const char* key, const PlumbVec3& otherwise) const {
  const auto found = find(key);
  return found ? found->vector() : otherwise;
}

PlumbQuat Node::orientation_or(const char* key, const PlumbQuat& otherwise) const {
  const auto found = find(key);
  return found ? found->orientation() : otherwise;
}

}  // namespace plumb::harness
