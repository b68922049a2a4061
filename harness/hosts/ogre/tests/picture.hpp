// What a picture shows, as far as its colours tell.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plumb::ogre::tests {

struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> pixels;  ///< 0xrrggbb, row by row from the top
};

[[nodiscard]] Picture read_picture(const std::string& file);

/// To sixteenths of each channel.
[[nodiscard]] std::size_t distinct_colours(const Picture& picture);

/// Pixels of a colour in whatever light, and the mean of their rows.
struct Seen {
  std::size_t pixels = 0;
  double row = 0;
};
[[nodiscard]] Seen look_for(const Picture& picture, std::uint32_t colour);

}  // namespace plumb::ogre::tests
