#include "report/page/parts/blocks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace plumb::harness {

Json drawn_number(double value) { return std::isfinite(value) ? Json::parse(fmt::format("{:.5g}", value)) : Json(); }

Json cell(std::string html, std::optional<double> value, std::string style) {
  if (!value && style.empty()) return html;
  return Json::array({std::move(html), value ? Json(*value) : Json(), std::move(style)});
}

Table::Table(std::string label, std::string style)
    : data_{{"label", std::move(label)},
            {"style", std::move(style)},
            {"columns", Json::array()},
            {"rows", Json::array()}} {}

void Table::column(const Column& column) {
  static constexpr const char* kinds[]{"number", "text", "name"};
  Json out{{"title", column.title}, {"width", column.width}, {"kind", kinds[static_cast<std::size_t>(column.kind)]}};
  if (column.engine) out["engine"] = *column.engine;
  if (column.repeats) out["repeats"] = true;
  if (!column.about.empty()) out["about"] = column.about;
  data_["columns"].push_back(std::move(out));
}

void Table::row(Json cells, std::string key, std::optional<std::size_t> engine) {
  Json out{{"c", std::move(cells)}};
  if (!key.empty()) out["k"] = std::move(key);
  if (engine) out["e"] = *engine;
  data_["rows"].push_back(std::move(out));
}

Json figure_data(const FigureData& figure) {
  Json out{{"title", figure.title}, {"plots", Json::array()}, {"notes", figure.notes}, {"legend", figure.legend}};
  if (!figure.key.empty()) out["k"] = figure.key;
  for (const Plot& plot : figure.plots) {
    if (Json data = plot_data(plot); !data.is_null()) out["plots"].push_back(std::move(data));
  }
  if (!figure.beaten.empty()) out["beaten"] = figure.beaten;
  return out["plots"].empty() ? Json() : out;
}

Json words_block(std::string html) { return {{"words", std::move(html)}}; }

Json figures_block(Json figures) { return {{"figures", std::move(figures)}}; }

Json group_block(std::string title, std::string small, bool open, Json blocks) {
  return {{"group", std::move(title)}, {"small", std::move(small)}, {"open", open}, {"blocks", std::move(blocks)}};
}

}  // namespace plumb::harness
