#include "replay/container.hpp"

#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "base/deflate.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::harness {

namespace {

constexpr char magic[] = "PLRP";
constexpr std::uint32_t version = 2;
constexpr std::size_t alignment = 8;

void pad(std::string& bytes, char with) {
  while (bytes.size() % alignment != 0) bytes += with;
}

std::size_t size_of(const std::string& type, const std::vector<std::size_t>& shape) {
  std::size_t size = bytes_of_number(type);
  for (const std::size_t side : shape) size *= side;
  return size;
}

[[noreturn]] void corrupt(const std::string& why) { throw Error(PLUMB_E_CORRUPT, "this is no replay bundle: " + why); }

}  // namespace

std::size_t bytes_of_number(const std::string& type) {
  static const std::map<std::string, std::size_t> sizes{{"f32", 4}, {"f64", 8}, {"u16", 2}, {"i16", 2},
                                                        {"u32", 4}, {"i32", 4}, {"u8", 1}};
  const auto found = sizes.find(type);
  if (found == sizes.end()) corrupt("numbers of the unknown type " + type);
  return found->second;
}

std::string pack(const Bundle& bundle) {
  Json header = bundle.header;
  header["sections"] = Json::object();
  std::string body;
  for (const auto& [name, section] : bundle.sections) {
    if (section.coding.is_null() && section.bytes.size() != size_of(section.type, section.shape))
      throw std::logic_error("section " + name + " has not the bytes of its shape");
    Json& entry = header["sections"][name];
    entry = {{"offset", body.size()}, {"type", section.type}, {"shape", section.shape}};
    if (!section.coding.is_null()) {
      entry["coding"] = section.coding;
      entry["length"] = section.bytes.size();
    }
    body += section.bytes;
    pad(body, '\0');
  }
  std::string bytes(magic, 4);
  std::string text = line_of(header);
  while ((3 * sizeof(std::uint32_t) + text.size()) % alignment != 0) text += ' ';
  for (const std::uint32_t number : {version, static_cast<std::uint32_t>(text.size())})
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  return deflated(bytes + text + body);
}

Bundle unpack(const std::string& packed) {
  const std::string bytes = inflated(packed);
  if (bytes.size() < 12 || bytes.compare(0, 4, magic) != 0) corrupt("it does not begin with PLRP");
  std::uint32_t numbers[2];
  std::memcpy(numbers, bytes.data() + 4, sizeof numbers);
  if (numbers[0] < 1 || numbers[0] > version) corrupt("its version is " + std::to_string(numbers[0]));
  if (numbers[1] > bytes.size() - 12) corrupt("its header is cut short");
  Bundle bundle;
  bundle.header = Json::parse(bytes.data() + 12, bytes.data() + 12 + numbers[1], nullptr, false);
  if (!bundle.header.is_object() || !bundle.header.contains("sections")) corrupt("its header is not JSON");
  const std::size_t start = 12 + numbers[1];
  for (const auto& [name, entry] : bundle.header["sections"].items()) {
    BundleSection section{
        entry.at("type"), entry.at("shape").get<std::vector<std::size_t>>(), {}, entry.value("coding", Json())};
    const std::size_t size = section.coding.is_null() ? size_of(section.type, section.shape)
                                                      : entry.at("length").get<std::size_t>(),
                      at = start + entry.at("offset").get<std::size_t>();
    if (at > bytes.size() || size > bytes.size() - at) corrupt("section " + name + " is cut short");
    section.bytes = bytes.substr(at, size);
    bundle.sections[name] = std::move(section);
  }
  bundle.header.erase("sections");
  return bundle;
}

}  // namespace plumb::harness
