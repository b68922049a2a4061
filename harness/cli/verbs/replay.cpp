// plumb replay: runs a recorded trace again on backends, and says where they first part from it.
#include <fmt/format.h>

#include <memory>

#include "base/json.hpp"
#include "cli/manual/examples.hpp"
#include "cli/verbs/verbs.hpp"
#include "plumb/layers.hpp"
#include "plumb/loader.hpp"
#include "scene/scene.hpp"
#include "simulation/names.hpp"

namespace plumb::harness {
namespace {

struct ReplayOptions {
  std::string trace;
  std::vector<std::string> backends;
  bool json = false;
};

Json json_of(const layers::ReplayReport& report, const PlumbBackendInfo& info, const std::string& trace) {
  Json json = {{"trace", trace},
               {"recorded",
                {{"backend", report.recorded.backend},
                 {"backend_version", report.recorded.version},
                 {"build", report.recorded.build},
                 {"device", report.recorded.device},
                 {"settings", Json::object()}}},
               {"backend", info.name},
               {"backend_version", info.version},
               {"build", info.build},
               {"same", report.same()},
               {"calls", report.calls},
               {"worlds", report.worlds},
               {"steps", report.steps},
               {"results_differ", report.results_differ},
               {"outputs_differ", report.outputs_differ},
               {"first_result", nullptr},
               {"first_output", nullptr},
               {"first_state", nullptr}};
  for (const auto& [name, value] : report.settings) json["recorded"]["settings"][name] = value;
  if (const auto& result = report.result)
    json["first_result"] = {{"call", result->call},
                            {"name", result->name},
                            {"recorded", result_word(result->recorded)},
                            {"replayed", result_word(result->replayed)},
                            {"text", result->text}};
  if (report.first_output) json["first_output"] = *report.first_output;
  if (const auto& state = report.state)
    json["first_state"] = {{"world", state->world},       {"step", state->step},       {"row_step", state->row_step},
                           {"body", state->body},         {"field", state->field},     {"recorded", state->recorded},
                           {"replayed", state->replayed}, {"largest", state->largest}, {"bodies", state->bodies}};
  return json;
}

std::string text_of(const layers::ReplayReport& report, const PlumbBackendInfo& info) {
  const auto& from = report.recorded;
  std::string text = fmt::format("{} {}: {} calls, {} worlds, {} steps recorded with {} {}: {}\n", info.name,
                                 info.version, report.calls, report.worlds, report.steps, from.backend, from.version,
                                 report.same() ? "the same" : "different");
  if (std::string(info.name) == from.backend && info.build != from.build)
    text += fmt::format("  the builds differ: recorded with {}, replayed with {}\n", from.build, info.build);
  if (const auto& result = report.result)
    text += fmt::format("  {} results differ, first of call {}, {}: recorded {}, replayed {}{}{}\n",
                        report.results_differ, result->call, result->name, result_word(result->recorded),
                        result_word(result->replayed), result->text.empty() ? "" : ": ", result->text);
  if (report.first_output)
    text += fmt::format("  {} outputs differ, first of {}\n", report.outputs_differ, *report.first_output);
  if (const auto& state = report.state) {
    text += fmt::format("  state differs from step {} of world {} on\n", state->step, state->world);
    if (state->row_step != state->step && state->row_step != 0)
      text += fmt::format("  rows are next recorded at step {}; of these:\n", state->row_step);
    if (state->body != 0)
      text +=
          fmt::format("  {} bodies differ, most of all body {} in {}: recorded {}, replayed {}, difference {:.3g}\n",
                      state->bodies, state->body, state->field, state->recorded, state->replayed, state->largest);
  }
  return text;
}

int replay_on_all(const ReplayOptions& options) {
  std::vector<std::string> names = options.backends;
  int status = 0;
  try {
    if (names.empty()) names.push_back(layers::trace_header(options.trace).backend);
    for (const std::string& name : names) {
      const Backend backend = open_backend(name);
      const layers::ReplayReport report = layers::replay(options.trace, &backend.table());
      const std::string answer = options.json ? line_of(json_of(report, backend.info(), options.trace)) + "\n"
                                              : text_of(report, backend.info());
      fmt::print("{}", answer);
      if (!report.same()) status = 1;
    }
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  return status;
}

}  // namespace

void add_replay(CLI::App& program, int& status) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* verb = program.add_subcommand("replay", "Run a recorded trace again and find the first step that differs");
  verb->add_option("TRACE", options->trace, "File that a trace was recorded to")->required();
  verb->add_option("--backend", options->backends,
                   "Name or file of a backend to replay on; the one it was recorded with when not given")
      ->type_name("BACKEND");
  verb->add_flag("--json", options->json, "Print one JSON object a backend, one a line");
  add_examples(*verb, {{"plumb replay results/traces/D1.trace", "on the backend that it was recorded with"},
                       {"plumb replay results/traces/D1.trace --backend ode --json", "on another"}});
  verb->callback([options, &status] { status = replay_on_all(*options); });
}

}  // namespace plumb::harness
