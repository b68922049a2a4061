// plumb.wire/1: frames, as WIRE.md describes them: a header, a text, and numbers.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plumb/types.h"

namespace plumb::wire {

/// What a frame asks for; a reply repeats it. New calls get new numbers; those here never change.
enum class Call : std::uint32_t {
  kDescribe = 1,
  kCreateWorld = 2,
  kSetGravity = 3,
  kSetSetting = 4,
  kCreateShapes = 5,
  kDestroyShapes = 6,
  kCreateBodies = 7,
  kDestroyBodies = 8,
  kRead = 9,
  kWrite = 10,
  kStep = 11,
  kContacts = 12,
  kCreateJoints = 13,
  kDestroyJoints = 14,
  kWriteMotors = 15,
  kReactions = 16,
  kRays = 17,
  kCasts = 18,
  kOverlaps = 19,
  kExceptions = 20
};
[[nodiscard]] const char* call_name(Call call);

inline constexpr std::uint32_t kMagic = 0x31574c50;  // "PLW1" as bytes
inline constexpr std::uint32_t kMostText = 1u << 26, kMostNumbers = 1u << 27;

/// Little-endian, as all numbers on the wire.
struct FrameHeader {
  std::uint32_t magic, call, sequence;
  PlumbResult result;  ///< 0 in a request; below 0 in a reply that failed, whose text says why
  std::uint32_t text_bytes, number_count;
};
static_assert(sizeof(FrameHeader) == 24);

/// Bytes that follow the header: the text is padded to whole numbers.
[[nodiscard]] constexpr std::size_t padded(std::size_t text_bytes) { return (text_bytes + 7) / 8 * 8; }
[[nodiscard]] constexpr std::size_t body_bytes(const FrameHeader& header) {
  return padded(header.text_bytes) + std::size_t{header.number_count} * sizeof(double);
}

struct Frame {
  FrameHeader header;
  std::string text;
  std::vector<double> numbers;
};

[[nodiscard]] std::vector<std::byte> encode(Call call, std::uint32_t sequence, const std::string& text,
                                            std::span<const double> numbers);
/// body has body_bytes(header).
[[nodiscard]] Frame decode(const FrameHeader& header, std::span<const std::byte> body);

}  // namespace plumb::wire
