// A replay bundle's outer form: a JSON header and named arrays of numbers, packed into one run of bytes.
//
// The bytes are zlib (RFC 1950), so that DecompressionStream("deflate") opens them, of, little endian: u32 'PLRP', u32
// version, u32 length of the header, the header (JSON, filled up with spaces so that what follows is at a multiple of
// 8), then the sections, each at a multiple of 8. The header's "sections" has {"offset" from the first section, "type",
// "shape"} by name, and from version 2 on, where the bytes are not just numbers of the type, "coding"
// (replay/motion.hpp and replay/lists.hpp say which there are) and "length" in bytes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/json.hpp"

namespace plumb::harness {

struct BundleSection {
  std::string type;  ///< "f32", "f64", "u16", "i16", "u32", "i32", "u8"
  std::vector<std::size_t> shape;
  std::string bytes;
  Json coding = nullptr;  ///< null: numbers of the type, as they lie in memory
};

struct Bundle {
  Json header = Json::object();  ///< without "sections"
  std::map<std::string, BundleSection> sections;
};

[[nodiscard]] std::size_t bytes_of_number(const std::string& type);

/// Throws std::logic_error where a section without coding has not as many bytes as its shape says.
[[nodiscard]] std::string pack(const Bundle& bundle);

/// Reads version 1, too. Throws plumb::Error (PLUMB_E_CORRUPT).
[[nodiscard]] Bundle unpack(const std::string& bytes);

}  // namespace plumb::harness
