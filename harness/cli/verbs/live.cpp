// plumb live: a page in which scenes run in the reader's browser, by the engine's WebAssembly.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cell/cell.hpp"
#include "cli/live/engine_file.hpp"
#include "cli/live/page_worlds.hpp"
#include "cli/manual/examples.hpp"
#include "cli/options/numbers.hpp"
#include "cli/output/draft_file.hpp"
#include "cli/verbs/verbs.hpp"
#include "report/page/parts/bundled_scripts.hpp"
#include "report/page/sections/sections.hpp"
#include "schedule/plan.hpp"

namespace plumb::harness {

namespace {

struct LiveOptions {
  RunRequest request;
  std::string html, wasm;
};

PageWorlds worlds_of(const LiveOptions& options) {
  PageWorlds worlds;
  const std::filesystem::path file = options.wasm.empty() ? find_engine_file() : std::filesystem::path(options.wasm);
  if (file.empty()) throw UsageError(how_to_get_engine());
  worlds.engine = read_engine(file);
  for (const CellBlock& block : make_plan(options.request).blocks)
    for (const Cell& cell : block.cells) {
      const Scene scene = instantiate_with(*cell.scene, cell.parameters, cell.dt, cell.seconds);
      const Json about{{"title", cell.scene->title}, {"params", json_of(cell.shown)}};
      worlds.list.push_back(page_world(scene, about, cell.settings));
    }
  return worlds;
}

void write_live_page(const LiveOptions& options) {
  if (!has_viewer())
    throw UsageError(
        "this program was built without node and has no viewer that runs scenes: build it where node and "
        "npm are");
  DraftFile file(options.html);
  const std::string page = live_page(worlds_of(options));
  file.write(page);
  fmt::print(stderr, "wrote {} ({:.1f} MB)\n", options.html, 1e-6 * static_cast<double>(page.size()));
}

}  // namespace

void add_live(CLI::App& program, int& status) {
  const auto options = std::make_shared<LiveOptions>();
  RunRequest& request = options->request;
  request.backends = {"impulse"};
  CLI::App* verb =
      program.add_subcommand("live", "Make a page in which scenes run in the browser, by impulse's WebAssembly");
  verb->add_option("SCENE", request.scenes, "Scenes: ids (D1), slugs (tower), groups or files; the page offers each")
      ->required();
  verb->add_option("--param", request.parameters, "Value of a scene's parameter, name=value, repeatable")
      ->type_name("NAME=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb->add_option("--set", request.settings, "A setting to begin with, name=value, repeatable; the page has them all")
      ->type_name("NAME=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb->add_option("--dt", request.dt, "Step in s to begin with, instead of the scene's: 1/240 or 0.004")
      ->type_name("SECONDS")
      ->transform(evaluated);
  verb->add_option("--html", options->html, "The page: one file that needs no network")->type_name("FILE")->required();
  verb->add_option("--wasm", options->wasm,
                   "The engine; when not given, plumb-impulse.wasm beside the backends or of ./dev platforms wasm")
      ->type_name("FILE");
  add_examples(*verb,
               {{"plumb live tower --param H=20 --html tower.html", "push a cube, change gravity, watch it fall"},
                {"plumb live D1 E1 I1 --html live.html", "several scenes, each variant"}});
  verb->callback([options, &status] {
    write_live_page(*options);
    status = 0;
  });
}

}  // namespace plumb::harness
