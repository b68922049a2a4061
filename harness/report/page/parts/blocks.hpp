// What sections are made of, as data: tables, figures and groups of them. The page's script draws a block when it comes
// into sight, and no more of a table than one sees.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "report/page/parts/plot.hpp"

namespace plumb::harness {

/// Five digits, more than a picture shows; null where it is not finite.
[[nodiscard]] Json drawn_number(double value);

struct Column {
  std::string title;  ///< HTML
  double width = 5;   ///< em, the least; what is left is shared in proportion
  enum class Kind { number, text, name } kind = Kind::number;
  std::optional<std::size_t> engine = {};  ///< goes when the engine is switched off
  bool repeats = false;                    ///< shown once where lines below each other say the same
  std::string about = {};                  ///< plain text, on the header
};

/// A cell: HTML, the value that it is sorted by where its text does not say, and a style.
[[nodiscard]] Json cell(std::string html, std::optional<double> value = std::nullopt, std::string style = {});

class Table {
 public:
  explicit Table(std::string label, std::string style = {});  ///< label: plain text, for those who cannot see it

  void column(const Column& column);
  /// key: what the filter finds it by; engine: whose it is, where it is one's.
  void row(Json cells, std::string key = {}, std::optional<std::size_t> engine = std::nullopt);
  [[nodiscard]] bool empty() const { return data_["rows"].empty(); }
  [[nodiscard]] Json block() const { return {{"table", data_}}; }

 private:
  Json data_;
};

struct FigureData {
  std::string title;             ///< plain text
  std::string key = {};          ///< what the filter finds it by
  std::vector<Plot> plots = {};  ///< beside or below each other
  std::string notes = {};        ///< HTML below
  bool legend = true;            ///< its series by name
  Json beaten = Json::array();   ///< [row, row that beats it, how many times dearer]
};
/// null when nothing in it can be drawn.
[[nodiscard]] Json figure_data(const FigureData& figure);

[[nodiscard]] Json words_block(std::string html);
[[nodiscard]] Json figures_block(Json figures);
/// Of so many figures at most a group is open from the start.
inline constexpr std::size_t open_figures = 12;
/// Folds. small: plain text beside the title.
[[nodiscard]] Json group_block(std::string title, std::string small, bool open, Json blocks);

}  // namespace plumb::harness
