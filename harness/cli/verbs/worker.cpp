#include "worker/worker.hpp"

#include <memory>

#include "cli/verbs/verbs.hpp"

namespace plumb::harness {

void add_worker(CLI::App& program, int& status) {
  const auto file = std::make_shared<std::string>();
  CLI::App* verb = program.add_subcommand("worker", "Serves one backend to the program that started it");
  verb->group("");  // not in the help
  verb->add_option("--backend", *file, "The library to open")->required();
  verb->callback([file, &status] { status = serve_as_worker(*file); });
}

}  // namespace plumb::harness
