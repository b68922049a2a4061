// How an engine looks: its hue hangs on its name alone, so that it is the same on every page, whatever is beside it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace plumb::harness {

inline constexpr std::size_t page_hues = 12;   ///< --hue0 to --hue11 in the style
inline constexpr std::size_t page_shades = 4;  ///< --hue12 to --hue23 are their darker shades, then two lighter ones

struct EngineLook {
  std::size_t hue;    ///< of the family: "bullet" and "bullet-f64" have the same
  std::size_t shade;  ///< of the member; also its marker: circle, square, triangle, diamond

  /// Number of the colour in the style.
  [[nodiscard]] std::size_t colour() const { return hue + page_hues * shade; }
};

[[nodiscard]] EngineLook look_of(std::string_view backend);
/// "bullet" of "bullet-f64" and of "node-bullet": the name up to the first hyphen, without the host that it runs in.
[[nodiscard]] std::string_view engine_family(std::string_view backend);

}  // namespace plumb::harness
