// plumb backends: what can be loaded, and of one backend all that it says of itself.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "cli/manual/examples.hpp"
#include "cli/output/backend_sheet.hpp"
#include "cli/output/layout.hpp"
#include "cli/output/output.hpp"
#include "cli/verbs/verbs.hpp"
#include "schedule/plan.hpp"

namespace plumb::harness {

namespace {

void print_nothing_found() {
  std::string folders;
  for (const auto& folder : backend_path()) folders += "\n  " + folder;
  fmt::print(stderr, "no backend found{}\n",
             folders.empty() ? "; set PLUMB_BACKEND_PATH to the folder of some" : ", looked in" + folders);
}

std::string line_for(const BackendDescription& backend) {
  const std::string name = column(backend.name, 14);
  if (!backend.error.empty()) return fmt::format("{} {}: {}", name, backend.status, backend.error);
  return fmt::format("{} {} {} {} {} settings  {}", name, column(backend.version, 10), column(backend.device, 6),
                     backend.json.value("precision", ""), column(std::to_string(backend.settings.size()), 2),
                     backend.json.value("description", ""));
}

}  // namespace

void add_backends(CLI::App& program, int& status) {
  const auto json = std::make_shared<bool>(false);
  const auto asked = std::make_shared<std::vector<std::string>>();
  CLI::App* verb = program.add_subcommand("backends", "List the backends, what they can do, and their settings");
  verb->add_option("BACKEND", *asked, "Names or files, of which all is told; none: a line for each on the search path");
  verb->add_flag("--json", *json, "One object a backend, one a line");
  add_examples(*verb, {{"plumb backends", "what can be loaded"},
                       {"plumb backends impulse", "its settings, and its capabilities with notes"},
                       {"plumb backends ./plumb-mine.so --json", "all that a file says of itself"}});
  verb->callback([json, asked, &status] {
    catch_signals();
    const auto files = backend_files(*asked);
    if (files.empty()) print_nothing_found();
    bool first = true;
    for (const auto& [name, file] : files) {
      RunRequest defaults;
      WorkerLimits limits = defaults.limits();
      limits.engine_seconds = 60;
      const BackendDescription backend = ask_description(name, file, limits);
      if (*json)
        std::cout << line_of(backend.json) << std::endl;
      else if (asked->empty() || !backend.error.empty())
        std::cout << line_for(backend) << std::endl;
      else
        std::cout << (first ? "" : "\n") << backend_sheet(backend, text_width()) << std::flush;
      first = false;
    }
    status = 0;
  });
}

}  // namespace plumb::harness
