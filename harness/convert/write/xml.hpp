// XML as it is written: elements that close themselves, numbers to the last bit.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tinyxml2.h>

#include <string>
#include <vector>

#include "referee/pose.hpp"

namespace plumb::harness {

/// Numbers as the text of an element or attribute.
[[nodiscard]] inline std::string numbers_text(std::vector<double> values) {
  for (double& value : values) value += 0.0;  // no "-0"
  return fmt::format("{}", fmt::join(values, " "));
}

class Xml {
 public:
  /// An element as long as it lives.
  class Element {
   public:
    Element(Xml& xml, const char* name, const std::vector<std::pair<const char*, std::string>>& attributes = {})
        : xml_(xml) {
      xml_.printer_.OpenElement(name);
      for (const auto& [key, value] : attributes) xml_.printer_.PushAttribute(key, value.c_str());
    }
    ~Element() { xml_.printer_.CloseElement(); }
    Element(const Element&) = delete;
    Element& operator=(const Element&) = delete;

   private:
    Xml& xml_;
  };

  void text(const char* name, const std::string& value) {
    const Element inside(*this, name);
    printer_.PushText(value.c_str());
  }
  void numbers(const char* name, std::vector<double> values) { text(name, numbers_text(std::move(values))); }
  [[nodiscard]] std::string str() const { return printer_.CStr(); }

 private:
  tinyxml2::XMLPrinter printer_;
};

}  // namespace plumb::harness
