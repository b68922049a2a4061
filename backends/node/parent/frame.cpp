#include "frame.hpp"

#include <bit>
#include <cstring>

#include "plumb/physics_world.hpp"

namespace plumb::wire {

static_assert(std::endian::native == std::endian::little, "numbers would have to be turned round");

const char* call_name(Call call) {
  constexpr const char* names[] = {"",
                                   "describe",
                                   "create_world",
                                   "set_gravity",
                                   "set_setting",
                                   "create_shapes",
                                   "destroy_shapes",
                                   "create_bodies",
                                   "destroy_bodies",
                                   "read",
                                   "write",
                                   "step",
                                   "contacts",
                                   "create_joints",
                                   "destroy_joints",
                                   "write_motors",
                                   "reactions",
                                   "rays",
                                   "casts",
                                   "overlaps",
                                   "exceptions"};
  const auto number = static_cast<std::size_t>(call);
  return number < std::size(names) ? names[number] : "an unknown call";
}

std::vector<std::byte> encode(Call call, std::uint32_t sequence, const std::string& text,
                              std::span<const double> numbers) {
  if (text.size() > kMostText || numbers.size() > kMostNumbers)
    throw Error(PLUMB_E_INVALID_ARGUMENT, std::string("one ") + call_name(call) + " of " +
                                              std::to_string(numbers.size()) +
                                              " numbers is more than a frame holds; hand it over in parts");
  const FrameHeader header = {
      kMagic, static_cast<std::uint32_t>(call),        sequence,
      0,      static_cast<std::uint32_t>(text.size()), static_cast<std::uint32_t>(numbers.size())};
  std::vector<std::byte> bytes(sizeof header + body_bytes(header));
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, text.data(), text.size());
  if (!numbers.empty())
    std::memcpy(bytes.data() + sizeof header + padded(text.size()), numbers.data(), numbers.size_bytes());
  return bytes;
}

Frame decode(const FrameHeader& header, std::span<const std::byte> body) {
  Frame frame{header, std::string(header.text_bytes, '\0'), std::vector<double>(header.number_count)};
  std::memcpy(frame.text.data(), body.data(), frame.text.size());
  if (!frame.numbers.empty())
    std::memcpy(frame.numbers.data(), body.data() + padded(header.text_bytes), frame.numbers.size() * sizeof(double));
  return frame;
}

}  // namespace plumb::wire
