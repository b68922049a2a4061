#include "rows/row_format.hpp"

#include "plumb/physics_world.hpp"

namespace plumb::harness {

namespace {

/// Why the object cannot be read as a row; "" when it can.
std::string trouble_with(const Json& row) {
  const auto format = row.find("format");
  const bool says_one = format != row.end() && format->is_number_integer() && *format > 0;
  if (says_one && *format > row_format)
    return "this row has format " + format->dump() + ", and this plumb reads " + std::to_string(row_format) +
           "; read it with the plumb that wrote it, or a newer one";
  for (const char* key : {"scene", "backend", "status", "cell"}) {
    const auto found = row.find(key);
    if (found == row.end() || !found->is_string())
      return "this is no row that plumb wrote: it has no \"" + std::string(key) + "\"; keep other things elsewhere";
  }
  if (!says_one)
    return "this row does not say its \"format\", so that nobody knows what its numbers mean; take it away and run it "
           "again";
  return "";
}

}  // namespace

Json read_row(const std::string& line, const std::filesystem::path& file, std::size_t number) {
  Json row = Json::parse(line, nullptr, false);
  if (!row.is_object()) return nullptr;
  if (const std::string trouble = trouble_with(row); !trouble.empty())
    throw Error(PLUMB_E_CORRUPT, file.string() + ":" + std::to_string(number) + ": " + trouble);
  return row;
}

}  // namespace plumb::harness
