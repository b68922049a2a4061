// The frame around a backend's snapshot, by which foreign and torn ones are known.
#pragma once

#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "plumb/backend/checks.hpp"
#include "plumb/backend/state_hash.hpp"

namespace plumb::backend {

struct SnapshotHeader {
  char magic[8];          ///< "PLUMBSNP"
  std::uint32_t version;  ///< of this frame
  std::uint32_t reserved;
  std::uint64_t format;   ///< hash of the format's name: the backend's build, or what several share
  std::uint64_t objects;  ///< hash of the handles that live in the world
  std::uint64_t payload_size;
  std::uint64_t payload_hash;
};

inline std::uint64_t hash_bytes(std::span<const std::byte> bytes) {
  StateHash hash;
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, 8);
    hash.add_word(word);
  }
  std::uint64_t tail = bytes.size();
  for (; at < bytes.size(); ++at) tail = (tail << 8) ^ static_cast<std::uint64_t>(bytes[at]);
  hash.add_word(tail);
  return hash.value();
}

inline SnapshotHeader snapshot_header(std::span<const std::byte> payload, std::string_view format,
                                      std::span<const std::uint64_t> bodies, std::span<const std::uint64_t> joints) {
  SnapshotHeader header{{'P', 'L', 'U', 'M', 'B', 'S', 'N', 'P'}, 1, 0, 0, 0, payload.size(), hash_bytes(payload)};
  header.format = hash_bytes(std::as_bytes(std::span(format)));
  StateHash objects;
  for (const std::uint64_t handle : bodies) objects.add_word(handle);
  objects.add_word(bodies.size());
  for (const std::uint64_t handle : joints) objects.add_word(handle);
  header.objects = objects.value();
  return header;
}

inline std::vector<std::byte> frame_snapshot(std::span<const std::byte> payload, std::string_view format,
                                             std::span<const std::uint64_t> bodies,
                                             std::span<const std::uint64_t> joints) {
  const SnapshotHeader header = snapshot_header(payload, format, bodies, joints);
  std::vector<std::byte> framed(sizeof header + payload.size());
  std::memcpy(framed.data(), &header, sizeof header);
  std::copy(payload.begin(), payload.end(), framed.begin() + sizeof header);
  return framed;
}

/// The payload; throws PLUMB_E_CORRUPT and says what is wrong.
inline std::span<const std::byte> unframe_snapshot(std::span<const std::byte> framed, std::string_view format,
                                                   std::span<const std::uint64_t> bodies,
                                                   std::span<const std::uint64_t> joints) {
  SnapshotHeader found{};
  if (framed.size() < sizeof found) refuse(PLUMB_E_CORRUPT, "the snapshot is shorter than its header");
  std::memcpy(&found, framed.data(), sizeof found);
  const std::span<const std::byte> payload = framed.subspan(sizeof found);
  const SnapshotHeader expected = snapshot_header(payload, format, bodies, joints);
  if (std::memcmp(found.magic, expected.magic, sizeof found.magic) != 0)
    refuse(PLUMB_E_CORRUPT, "this is no Plumb snapshot");
  if (found.version != expected.version)
    refuse(PLUMB_E_CORRUPT, "the snapshot has another version of the format; save it anew");
  if (found.format != expected.format)
    refuse(PLUMB_E_CORRUPT, "the snapshot comes from another build or backend; save it anew");
  if (found.payload_size != payload.size() || found.payload_hash != expected.payload_hash)
    refuse(PLUMB_E_CORRUPT, "the snapshot is torn or changed");
  if (found.objects != expected.objects)
    refuse(PLUMB_E_CORRUPT, "other bodies or joints live in the world than when the snapshot was saved");
  return payload;
}

}  // namespace plumb::backend
