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
  char magic[8];             ///< "PLUMBSNP"
  std::uint32_t version;     ///< of this frame
  std::uint32_t exceptions;  ///< pairs between this and the payload
  std::uint64_t format;      ///< hash of the format's name: the backend's build, or what several share
  std::uint64_t objects;     ///< hash of the handles that live in the world
  std::uint64_t payload_size;
  std::uint64_t payload_hash;  ///< of the pairs too
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

/// What a snapshot holds beside its header: the pairs that the host keeps apart, and what the backend saved.
struct SnapshotContents {
  std::vector<PlumbBodyPair> exceptions;
  std::span<const std::byte> payload;
};

/// contents: pairs and payload as they lie.
inline SnapshotHeader snapshot_header(std::span<const std::byte> contents, std::size_t exceptions,
                                      std::string_view format, std::span<const std::uint64_t> bodies,
                                      std::span<const std::uint64_t> joints) {
  SnapshotHeader header{{'P', 'L', 'U', 'M', 'B', 'S', 'N', 'P'}, 2, 0, 0, 0, 0, hash_bytes(contents)};
  header.exceptions = static_cast<std::uint32_t>(exceptions);
  header.payload_size = contents.size() - exceptions * sizeof(PlumbBodyPair);
  header.format = hash_bytes(std::as_bytes(std::span(format.data(), format.size())));
  StateHash objects;
  for (const std::uint64_t handle : bodies) objects.add_word(handle);
  objects.add_word(bodies.size());
  for (const std::uint64_t handle : joints) objects.add_word(handle);
  header.objects = objects.value();
  return header;
}

inline std::vector<std::byte> frame_snapshot(std::span<const std::byte> payload, std::string_view format,
                                             std::span<const std::uint64_t> bodies,
                                             std::span<const std::uint64_t> joints,
                                             std::span<const PlumbBodyPair> exceptions) {
  const auto pairs = std::as_bytes(exceptions);
  std::vector<std::byte> framed(sizeof(SnapshotHeader));
  framed.insert(framed.end(), pairs.begin(), pairs.end());
  framed.insert(framed.end(), payload.begin(), payload.end());
  const SnapshotHeader header = snapshot_header(std::span<const std::byte>(framed).subspan(sizeof(SnapshotHeader)),
                                                exceptions.size(), format, bodies, joints);
  std::memcpy(framed.data(), &header, sizeof header);
  return framed;
}

/// Throws PLUMB_E_CORRUPT and says what is wrong.
inline SnapshotContents unframe_snapshot(std::span<const std::byte> framed, std::string_view format,
                                         std::span<const std::uint64_t> bodies, std::span<const std::uint64_t> joints) {
  SnapshotHeader found{};
  if (framed.size() < sizeof found) refuse(PLUMB_E_CORRUPT, "the snapshot is shorter than its header");
  std::memcpy(&found, framed.data(), sizeof found);
  const std::span<const std::byte> contents = framed.subspan(sizeof found);
  const bool has_pairs = found.exceptions <= contents.size() / sizeof(PlumbBodyPair);
  const SnapshotHeader expected = snapshot_header(contents, has_pairs ? found.exceptions : 0, format, bodies, joints);
  if (std::memcmp(found.magic, expected.magic, sizeof found.magic) != 0)
    refuse(PLUMB_E_CORRUPT, "this is no Plumb snapshot");
  if (found.version != expected.version)
    refuse(PLUMB_E_CORRUPT, "the snapshot has another version of the format; save it anew");
  if (found.format != expected.format)
    refuse(PLUMB_E_CORRUPT, "the snapshot comes from another build or backend; save it anew");
  if (!has_pairs || found.payload_size != expected.payload_size || found.payload_hash != expected.payload_hash)
    refuse(PLUMB_E_CORRUPT, "the snapshot is torn or changed");
  if (found.objects != expected.objects)
    refuse(PLUMB_E_CORRUPT, "other bodies or joints live in the world than when the snapshot was saved");
  SnapshotContents saved{std::vector<PlumbBodyPair>(found.exceptions), {}};
  const std::size_t pair_bytes = saved.exceptions.size() * sizeof(PlumbBodyPair);
  if (pair_bytes != 0) std::memcpy(saved.exceptions.data(), contents.data(), pair_bytes);
  saved.payload = contents.subspan(pair_bytes);
  return saved;
}

}  // namespace plumb::backend
