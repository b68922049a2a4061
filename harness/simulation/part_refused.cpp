#include "simulation/part_refused.hpp"

#include <charconv>
#include <optional>

namespace plumb::harness {

namespace {

struct Element {
  std::size_t index;
  std::string said;  ///< without the element: "mass is ..."
};

/// An engine calls what it is given descs, the guard before it by the list's own name.
std::optional<Element> element_in(const std::string& text, const std::string& list) {
  const auto open = text.find('['), close = text.find(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return std::nullopt;
  const std::string array = text.substr(0, open);
  if (array != "descs" && array != list) return std::nullopt;
  Element element{0, ""};
  const char* end = text.data() + close;
  const auto [stop, failure] = std::from_chars(text.data() + open + 1, end, element.index);
  if (failure != std::errc{} || stop != end) return std::nullopt;
  const auto said = text.find_first_not_of(". ", close + 1);
  element.said = said == std::string::npos ? "refused" : text.substr(said);
  return element;
}

std::string one_of(const std::string& list) { return list == "bodies" ? "body" : list.substr(0, list.size() - 1); }

}  // namespace

PartRefused::PartRefused(PlumbResult code, const std::string& list, const std::string& name, const std::string& said)
    : Error(code, one_of(list) + " \"" + name + "\": " + said), list_(list), name_(name) {}

void naming_parts(const char* list, const std::function<std::string(std::size_t)>& name_of,
                  const std::function<void()>& make) {
  try {
    make();
  } catch (const Error& error) {
    const std::optional<Element> element = element_in(error.what(), list);
    if (!element) throw;
    throw PartRefused(error.code(), list, name_of(element->index), element->said);
  }
}

}  // namespace plumb::harness
