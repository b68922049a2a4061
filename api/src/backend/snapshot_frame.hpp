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
  std::uint32_t exceptions;  ///< pairs between this and who lives
  std::uint64_t format;      ///< hash of the format's name: the backend's build, or what several share
  std::uint64_t objects;     ///< hash of the handles that live in the world, and of what the bodies are made of
  std::uint64_t world_size;  ///< of who lives, between the pairs and the payload; 0: of what moves only
  std::uint64_t payload_size;
  std::uint64_t hash;  ///< of the header without it, and of all that follows
};

inline constexpr std::uint32_t kSnapshotVersion = 6;

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

inline std::uint64_t snapshot_hash(SnapshotHeader header, std::span<const std::byte> contents) {
  header.hash = 0;
  StateHash hash;
  hash.add_word(hash_bytes(std::as_bytes(std::span(&header, 1))));
  hash.add_word(hash_bytes(contents));
  return hash.value();
}

/// What a snapshot holds beside its header: the pairs that the host keeps apart, who lives (of a whole world), and what
/// the backend saved.
struct SnapshotContents {
  std::span<const PlumbBodyPair> exceptions;
  std::span<const std::byte> world, payload;
};

/// objects: SnapshotHeader's.
inline std::vector<std::byte> frame_snapshot(const SnapshotContents& contents, std::string_view format,
                                             std::uint64_t objects) {
  SnapshotHeader header{{'P', 'L', 'U', 'M', 'B', 'S', 'N', 'P'}, kSnapshotVersion, 0, 0, objects, 0, 0, 0};
  header.exceptions = static_cast<std::uint32_t>(contents.exceptions.size());
  header.format = hash_bytes(std::as_bytes(std::span(format.data(), format.size())));
  header.world_size = contents.world.size();
  header.payload_size = contents.payload.size();
  std::vector<std::byte> framed(sizeof header);
  for (const std::span<const std::byte> part : {std::as_bytes(contents.exceptions), contents.world, contents.payload})
    framed.insert(framed.end(), part.begin(), part.end());
  header.hash = snapshot_hash(header, std::span<const std::byte>(framed).subspan(sizeof header));
  std::memcpy(framed.data(), &header, sizeof header);
  return framed;
}

/// A snapshot that is whole and of this format. It may be of other bodies: then objects differs.
struct UnframedSnapshot {
  std::vector<PlumbBodyPair> exceptions;
  std::span<const std::byte> world, payload;
  std::uint64_t objects;
};
/// Throws PLUMB_E_CORRUPT and says what is wrong.
inline UnframedSnapshot unframe_snapshot(std::span<const std::byte> framed, std::string_view format) {
  SnapshotHeader found{};
  if (framed.size() < sizeof found) refuse(PLUMB_E_CORRUPT, "the snapshot is shorter than its header");
  std::memcpy(&found, framed.data(), sizeof found);
  if (std::memcmp(found.magic, "PLUMBSNP", sizeof found.magic) != 0)
    refuse(PLUMB_E_CORRUPT, "this is no Plumb snapshot");
  if (found.version != kSnapshotVersion)
    refuse(PLUMB_E_CORRUPT, "the snapshot has another version of the format; save it anew");
  if (found.format != hash_bytes(std::as_bytes(std::span(format.data(), format.size()))))
    refuse(PLUMB_E_CORRUPT, "the snapshot comes from another build or backend; save it anew");
  const std::span<const std::byte> contents = framed.subspan(sizeof found);
  const std::uint64_t pair_bytes = std::uint64_t{found.exceptions} * sizeof(PlumbBodyPair);
  const bool fits = pair_bytes <= contents.size() && found.world_size <= contents.size() - pair_bytes &&
                    found.payload_size == contents.size() - pair_bytes - found.world_size;
  if (!fits || found.hash != snapshot_hash(found, contents)) refuse(PLUMB_E_CORRUPT, "the snapshot is torn or changed");
  UnframedSnapshot saved{std::vector<PlumbBodyPair>(found.exceptions), {}, {}, found.objects};
  if (pair_bytes != 0)
    std::memcpy(saved.exceptions.data(), contents.data(), saved.exceptions.size() * sizeof(PlumbBodyPair));
  const auto rest = contents.subspan(static_cast<std::size_t>(pair_bytes));
  saved.world = rest.first(static_cast<std::size_t>(found.world_size));
  saved.payload = rest.subspan(saved.world.size());
  return saved;
}

}  // namespace plumb::backend
