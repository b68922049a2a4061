#include "convert/mjcf/mjcf_text.hpp"

#include <fmt/format.h>
#include <tinyxml2.h>

#include "base/packed_file.hpp"
#include "base/usage_error.hpp"

namespace plumb::harness {
namespace {

namespace fs = std::filesystem;

constexpr int most_includes = 1000;

/// The file of that name, or what gzip made of it.
fs::path packed_or_not(const fs::path& place) {
  fs::path packed = place;
  packed += ".gz";
  return !fs::exists(place) && fs::exists(packed) ? packed : place;
}

void parse(const fs::path& file, tinyxml2::XMLDocument& document) {
  const std::string text = text_of_file(file);
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS || document.RootElement() == nullptr)
    throw UsageError(fmt::format("{}: {}", file.string(), document.ErrorStr()));
}

/// What stands in the included file's outermost element takes the place of the element that includes it.
void include(tinyxml2::XMLElement& element, const fs::path& file) {
  tinyxml2::XMLDocument included;
  parse(file, included);
  tinyxml2::XMLNode* after = &element;
  for (const auto* part = included.RootElement()->FirstChild(); part != nullptr; part = part->NextSibling())
    after = element.Parent()->InsertAfterChild(after, part->DeepClone(element.GetDocument()));
}

/// includes: how many there were, as files may include each other.
void mend(tinyxml2::XMLElement& within, const fs::path& folder, int& includes) {
  for (auto* element = within.FirstChildElement(); element != nullptr;) {
    const std::string name = element->Name();
    const char* file = name == "include" ? element->Attribute("file") : nullptr;
    if (file != nullptr) {
      if (++includes > most_includes)
        throw UsageError(fmt::format("{}: files there include each other", folder.string()));
      include(*element, packed_or_not(folder / file));
    }
    if (name == "material") element->DeleteAttribute("texture");
    mend(*element, folder, includes);
    auto* next = element->NextSiblingElement();  // of an include the first that was included
    if (file != nullptr || name == "texture") within.DeleteChild(element);
    element = next;
  }
}

}  // namespace

std::string mjcf_text(const fs::path& file) {
  tinyxml2::XMLDocument document;
  parse(file, document);
  tinyxml2::XMLElement& root = *document.RootElement();
  int includes = 0;
  mend(root, file.parent_path(), includes);
  tinyxml2::XMLElement* compiler = document.NewElement("compiler");  // the file's own come after it
  compiler->SetAttribute("autolimits", true);
  root.InsertFirstChild(compiler);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace plumb::harness
