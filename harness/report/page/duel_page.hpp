// A duel as one HTML file without network: a table of the scenes that tell two engines apart, and a card for each with
// all metrics, times, and both replays at the moment where they part.
#pragma once

#include <iosfwd>
#include <map>
#include <string>

#include "report/findings/duel.hpp"
#include "report/page/parts/page_options.hpp"

namespace plumb::harness {

/// Where the replays of a pair begin.
struct DuelMoment {
  double seconds;
  std::string text;  ///< what one sees there
};

struct DuelPageOptions {
  PageOptions page;                           ///< replays: of a pair's title, by the engines' names
  std::map<std::string, DuelMoment> moments;  ///< by a pair's title
  std::string command;                        ///< that writes the page again
};

/// Colours of the two engines, numbers of the page's style: those of their names, but never the same.
[[nodiscard]] std::array<std::size_t, 2> duel_colours(const std::array<std::string, 2>& names);

void write_duel_page(std::ostream& out, const Duel& duel, const DuelPageOptions& options);

}  // namespace plumb::harness
