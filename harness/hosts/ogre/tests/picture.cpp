#include "hosts/ogre/tests/picture.hpp"

#include <OgreDataStream.h>
#include <OgreImage.h>
#include <OgreLogManager.h>
#include <OgreRoot.h>

#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <set>
#include <stdexcept>

namespace plumb::ogre::tests {
namespace {

std::array<double, 3> channels_of(std::uint32_t pixel) {
  return {static_cast<double>((pixel >> 16) & 0xff), static_cast<double>((pixel >> 8) & 0xff),
          static_cast<double>(pixel & 0xff)};
}

/// Whether one is the other in more or less light.
bool is_shade_of(std::uint32_t pixel, std::uint32_t colour) {
  const auto a = channels_of(pixel), b = channels_of(colour);
  const double length_a = std::hypot(a[0], a[1], a[2]), length_b = std::hypot(b[0], b[1], b[2]);
  if (length_a < 60) return false;
  const double cosine = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / (length_a * length_b);
  return cosine > 0.995;
}

}  // namespace

Picture read_picture(const std::string& file) {
  if (Ogre::Root::getSingletonPtr() == nullptr) {  // without a log or a window, for its codecs
    (new Ogre::LogManager)->createLog("test", true, false, true);
    (new Ogre::Root("", "", ""))->loadPlugin(PLUMB_OGRE_PLUGINS "/Codec_STBI");
  }
  auto* stream = new std::ifstream(file, std::ios::binary);
  if (!*stream) throw std::runtime_error("there is no picture " + file);
  Ogre::Image image;
  image.load(Ogre::DataStreamPtr(new Ogre::FileStreamDataStream(file, stream, true)), "png");
  Picture picture{image.getWidth(), image.getHeight(), {}};
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x)
      picture.pixels.push_back(image.getColourAt(x, y, 0).getAsARGB() & 0xffffffU);
  return picture;
}

std::size_t distinct_colours(const Picture& picture) {
  std::set<std::uint32_t> colours;
  for (const std::uint32_t pixel : picture.pixels) colours.insert(pixel & 0xf0f0f0U);
  return colours.size();
}

Seen look_for(const Picture& picture, std::uint32_t colour) {
  Seen seen;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    if (is_shade_of(picture.pixels[i], colour)) {
      const std::size_t row = i / picture.width;
      ++seen.pixels;
      seen.row += static_cast<double>(row);
    }
  if (seen.pixels > 0) seen.row /= static_cast<double>(seen.pixels);
  return seen;
}

}  // namespace plumb::ogre::tests
