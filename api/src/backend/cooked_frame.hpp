// The frame around a cooked shape, by which foreign, torn and changed bytes are known, and what the guard itself found
// out about the shape.
#pragma once

#include <algorithm>
#include <array>

#include "plumb/backend/cooking.hpp"
#include "plumb/backend/state_hash.hpp"
#include "shape_record.hpp"

namespace plumb::backend {

/// Of numbers alone, without padding.
struct CookedHeader {
  char magic[8];                 ///< "PLUMBCKD"
  std::uint32_t byte_order;      ///< kCookedByteOrder, as the machine that cooked has it
  std::uint32_t frame;           ///< version of this frame
  char format[32];               ///< CookedFormat::name, 0 behind it
  std::uint32_t format_version;  ///< CookedFormat::version
  PlumbDataType precision;       ///< of the backend
  PlumbShapeType type;
  std::uint32_t is_native;  ///< 1: the payload is the class's own; 0: the descriptor
  PlumbNeeds needs;         ///< that materials by triangle ask a world for
  std::uint64_t content;    ///< shape_content()
  MassProperties unit_mass;
  std::uint64_t has_mass;      ///< 0 or 1
  std::uint64_t reason_size;   ///< of ShapeRecord::no_mass_because, which follows this
  std::uint64_t payload_size;  ///< of what follows the reason
  std::uint64_t hash;          ///< of the header without it, and of all that follows
};
static_assert(sizeof(CookedHeader) == 80 + sizeof(MassProperties) + 32 && sizeof(MassProperties) == 12 * 8);

inline constexpr char kCookedMagic[8] = {'P', 'L', 'U', 'M', 'B', 'C', 'K', 'D'};
inline constexpr std::uint32_t kCookedByteOrder = 0x01020304U, kCookedFrame = 1;

/// Four hashes side by side, for each waits for its last word, and meshes are large.
inline std::uint64_t hash_of_cooked(std::span<const std::byte> bytes) {
  constexpr std::size_t kLanes = 4, kBlock = kLanes * 8;
  std::array<StateHash, kLanes> lanes;
  const auto add_block = [&](const std::byte* from) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      std::uint64_t word = 0;
      std::memcpy(&word, from + 8 * k, 8);
      lanes[k].add_word(word);
    }
  };
  std::size_t at = 0;
  for (; at + kBlock <= bytes.size(); at += kBlock) add_block(bytes.data() + at);
  std::byte last[kBlock] = {};
  std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end(), last);
  add_block(last);
  StateHash all;
  all.add_word(bytes.size());
  for (const StateHash& lane : lanes) all.add_word(lane.value());
  return all.value();
}

inline std::uint64_t cooked_hash(CookedHeader header, std::span<const std::byte> contents) {
  header.hash = 0;
  StateHash hash;
  hash.add_word(hash_of_cooked(std::as_bytes(std::span(&header, 1))));
  hash.add_word(hash_of_cooked(contents));
  return hash.value();
}

/// What the bytes of a backend are known by.
[[nodiscard]] inline CookedFormat format_of(const BackendFacts& facts) {
  return facts.cooked_format == nullptr ? CookedFormat{facts.info->name, 0} : facts.cooked_format();
}

/// A shape between its header and its bytes.
struct CookedContents {
  ShapeRecord record;
  PlumbNeeds needs;
  bool is_native;
  std::span<const std::byte> payload;
};

inline std::vector<std::byte> frame_cooked(const BackendFacts& facts, const CookedContents& contents) {
  CookedHeader header;
  std::memset(static_cast<void*>(&header), 0, sizeof header);
  const CookedFormat format = format_of(facts);
  std::copy(std::begin(kCookedMagic), std::end(kCookedMagic), header.magic);
  header.byte_order = kCookedByteOrder;
  header.frame = kCookedFrame;
  std::memcpy(header.format, format.name, std::min(std::strlen(format.name), sizeof header.format - 1));
  header.format_version = format.version;
  header.precision = facts.info->precision;
  header.type = contents.record.type;
  header.is_native = contents.is_native ? 1 : 0;
  header.needs = contents.needs;
  header.content = contents.record.content;
  if (contents.record.unit_mass) header.unit_mass = *contents.record.unit_mass;
  header.has_mass = contents.record.unit_mass ? 1 : 0;
  header.reason_size = contents.record.no_mass_because.size();
  header.payload_size = contents.payload.size();
  std::vector<std::byte> framed(sizeof header);
  framed.reserve(sizeof header + contents.record.no_mass_because.size() + contents.payload.size());
  const auto reason = std::as_bytes(std::span<const char>(contents.record.no_mass_because));
  framed.insert(framed.end(), reason.begin(), reason.end());
  framed.insert(framed.end(), contents.payload.begin(), contents.payload.end());
  header.hash = cooked_hash(header, std::span<const std::byte>(framed).subspan(sizeof header));
  std::memcpy(framed.data(), &header, sizeof header);
  return framed;
}

/// "impulse 1 in double"
[[nodiscard]] inline std::string cooked_format_text(const std::string& name, std::uint32_t version,
                                                    PlumbDataType precision) {
  return name + " " + std::to_string(version) + " in " + (precision == PLUMB_F64 ? "double" : "float");
}

/// Bytes that are whole and of this backend; the payload is part of them. Throws PLUMB_E_CORRUPT, and says what is
/// wrong with `name`.
inline CookedContents unframe_cooked(const BackendFacts& facts, const std::string& name,
                                     std::span<const std::byte> framed) {
  const auto corrupt = [&](const std::string& text) { refuse(PLUMB_E_CORRUPT, name + " " + text); };
  CookedHeader found;
  if (framed.size() < sizeof found)
    corrupt("has " + std::to_string(framed.size()) + " bytes, less than the header of a cooked shape, which has " +
            std::to_string(sizeof found) + "; give all that cook gave");
  std::memcpy(static_cast<void*>(&found), framed.data(), sizeof found);
  if (!std::equal(std::begin(kCookedMagic), std::end(kCookedMagic), found.magic))
    corrupt("does not begin as a cooked shape does, with PLUMBCKD; give what cook gave");
  if (found.byte_order != kCookedByteOrder)
    corrupt("was cooked on a machine of another byte order; cook the shape on one of this order");
  if (found.frame != kCookedFrame)
    corrupt("has version " + std::to_string(found.frame) + " of the frame, and this library reads version " +
            std::to_string(kCookedFrame) + "; cook the shape with this library");
  const std::span<const std::byte> contents = framed.subspan(sizeof found);
  if (found.reason_size > contents.size() || found.payload_size != contents.size() - found.reason_size)
    corrupt("has " + std::to_string(framed.size()) +
            " bytes, but its header tells of another number; give all that "
            "cook gave");
  if (found.hash != cooked_hash(found, contents))
    corrupt("was changed since it was cooked: its checksum is another; cook the shape anew");
  const CookedFormat format = format_of(facts);
  found.format[sizeof found.format - 1] = '\0';
  const std::string theirs = cooked_format_text(found.format, found.format_version, found.precision),
                    ours = cooked_format_text(format.name, format.version, facts.info->precision);
  if (theirs != ours) corrupt("was cooked by " + theirs + ", and this is " + ours + "; cook the shape with this one");
  CookedContents cooked{{}, found.needs, found.is_native != 0, {}};
  const double* mass = &found.unit_mass.mass;
  const bool is_mass =
      std::all_of(mass, mass + 12, [](double number) { return std::isfinite(number); }) && found.unit_mass.mass > 0;
  if (found.type >= PLUMB_COMPOUND || found.is_native > 1 || found.has_mass > 1 ||
      (found.has_mass != 0 ? !is_mass : is_convex(found.type)))
    corrupt("is of no shape that cook gives; cook the shape anew");
  cooked.record.type = found.type;
  cooked.record.content = found.content;
  if (found.has_mass != 0) cooked.record.unit_mass = found.unit_mass;
  const auto reason = contents.first(static_cast<std::size_t>(found.reason_size));
  cooked.record.no_mass_because.assign(reinterpret_cast<const char*>(reason.data()), reason.size());
  cooked.payload = contents.subspan(reason.size());
  return cooked;
}

}  // namespace plumb::backend
