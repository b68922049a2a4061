// plumb measures: what a scene file's measure.kind may be.
#include <iostream>
#include <memory>
#include <optional>

#include "cli/manual/examples.hpp"
#include "cli/output/layout.hpp"
#include "cli/output/output.hpp"
#include "cli/verbs/verbs.hpp"
#include "measure/quantities/quantities.hpp"
#include "measure/registry/registry.hpp"

namespace plumb::harness {

namespace {

Json json_of(const MeasureEntry& measure) {
  Json json{{"name", measure.name}, {"doc", measure.doc}, {"arguments", Json::array()}};
  for (const MeasureArgument& argument : measure.args)
    json["arguments"].push_back(
        {{"name", argument.name}, {"type", word_of(argument.type)}, {"optional", argument.optional}});
  return json;
}

/// "body: body, length: number, [floor: number]".
std::string arguments_of(const MeasureEntry& measure) {
  std::string text;
  for (const MeasureArgument& argument : measure.args) {
    const std::string one = std::string(argument.name) + ": " + word_of(argument.type);
    text += (text.empty() ? "" : ", ") + (argument.optional ? "[" + one + "]" : one);
  }
  return text.empty() ? "no arguments" : text;
}

std::string text_of(const MeasureEntry& measure) {
  return entry(measure.name, measure.doc, name_columns, text_width()) +
         entry("", arguments_of(measure), name_columns, text_width());
}

bool is_quantities(const MeasureEntry& measure) { return measure.run == measure_quantities; }

/// What the entries of the argument "quantities" may say.
Json json_of_quantities() {
  Json json{{"quantities", Json::array()}, {"take", Json::object()}};
  for (const QuantitySpec& spec : quantity_specs())
    json["quantities"].push_back({{"of", word_of(spec.of)},
                                  {"name", spec.name},
                                  {"unit", spec.unit},
                                  {"directed", spec.takes_direction()},
                                  {"doc", spec.doc}});
  for (std::size_t i = 0; i < take_words().size(); ++i) json["take"][take_words()[i]] = take_docs()[i];
  return json;
}

std::string text_of_quantities() {
  const std::size_t width = text_width();
  std::string text =
      "\n" +
      wrapped(
          "For each metric an object: quantity; body, joint or pair, or none of them for all; truth; and where "
          "wanted along, since_start, at, take, over, level, smooth, scale. scene.schema.json tells of each.",
          2, width) +
      "\n";
  std::optional<Observed> of;
  for (const QuantitySpec& spec : quantity_specs()) {
    if (of != spec.of) text += std::string("\nquantity, of ") + word_of(spec.of) + ":\n";
    of = spec.of;
    const std::string directed = spec.takes_direction() ? ", takes along" : "";
    text += entry(spec.name, std::string(spec.doc) + "; " + spec.unit + directed, name_columns, width);
  }
  text += "\ntake:\n";
  for (std::size_t i = 0; i < take_words().size(); ++i)
    text += entry(take_words()[i], take_docs()[i], name_columns, width);
  return text;
}

}  // namespace

void add_measures(CLI::App& program, int& status) {
  const auto json = std::make_shared<bool>(false);
  const auto asked = std::make_shared<std::vector<std::string>>();
  CLI::App* verb =
      program.add_subcommand("measures", "List the kinds of measures that scene files may name, with their arguments");
  verb->add_option("KIND", *asked, "Names of measures; none: all");
  verb->add_flag("--json", *json, "One object a measure, one a line");
  add_examples(*verb, {{"plumb measures", "what a scene's measure.kind may be"},
                       {"plumb measures quantities", "what can be measured without a line of code"}});
  verb->callback([json, asked, &status] {
    std::vector<MeasureEntry> measures;
    for (const std::string& name : *asked) measures.push_back(find_measure(name));
    if (asked->empty()) measures.assign(all_measures().begin(), all_measures().end());
    for (const MeasureEntry& measure : measures) {
      const bool whole = is_quantities(measure) && !asked->empty();
      Json row = json_of(measure);
      if (whole) row.update(json_of_quantities());
      std::cout << (*json ? line_of(row) + "\n" : text_of(measure));
      if (whole && !*json) std::cout << text_of_quantities();
    }
    status = 0;
  });
}

}  // namespace plumb::harness
