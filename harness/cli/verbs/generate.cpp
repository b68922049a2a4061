// plumb generate: scenes that chance makes, for who looks for what an engine cannot do.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <regex>

#include "base/shown.hpp"
#include "cli/manual/examples.hpp"
#include "cli/options/numbers.hpp"
#include "cli/output/draft_file.hpp"
#include "cli/output/going_on.hpp"
#include "cli/verbs/verbs.hpp"
#include "convert/scene_text.hpp"
#include "generate/random_scene.hpp"
#include "scene/limits.hpp"

namespace plumb::harness {
namespace {

struct GenerateOptions {
  std::string folder, seeds = "1-20";
  std::vector<std::string> without;
  std::uint32_t bodies = 12;
  double ratio = 100, seconds = 10, dt = 1.0 / 60;
};

constexpr std::uint32_t most_seed = 999999;

/// "17" or "1-20".
std::pair<std::uint32_t, std::uint32_t> seeds_of(const std::string& text) {
  static const std::regex right("([0-9]{1,6})(-([0-9]{1,6}))?");
  std::smatch parts;
  if (!std::regex_match(text, parts, right))
    throw UsageError(fmt::format("--seeds \"{}\": name a seed from 0 to {}, or the first and the last, as in 1-20",
                                 shortened(text), most_seed));
  const auto first = static_cast<std::uint32_t>(std::stoul(parts[1]));
  const auto last = parts[3].matched ? static_cast<std::uint32_t>(std::stoul(parts[3])) : first;
  if (last < first) throw UsageError(fmt::format("--seeds {}: the last is before the first", text));
  return {first, last};
}

int generate(const GenerateOptions& options) {
  const auto [first, last] = seeds_of(options.seeds);
  if (options.dt < least_dt || options.dt > most_dt || !(steps_of(options.seconds, options.dt) <= most_steps))
    throw UsageError(fmt::format("--seconds {:g} --dt {:g}: a step is from {:g} to {:g} s, and there are {:g} at most",
                                 options.seconds, options.dt, least_dt, most_dt, most_steps));
  RandomSceneRequest request;
  request.most_bodies = options.bodies;
  request.mass_ratio = options.ratio;
  request.seconds = options.seconds;
  request.dt = options.dt;
  for (const std::string& word : options.without) request.without.push_back(feature_of(word));
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error) throw UsageError(fmt::format("cannot make {}: {}", shortened(options.folder, 200), error.message()));
  for (std::uint32_t seed = first; seed <= last; ++seed) {
    request.seed = seed;
    const std::filesystem::path file = std::filesystem::path(options.folder) / fmt::format("R{}-random.json", seed);
    DraftFile(file.string()).write(scene_text(random_scene(request)));
  }
  std::cout << fmt::format("{} in {}: plumb compare {}/*.json\n", count_of(last - first + 1, "scene"), options.folder,
                           options.folder);
  return 0;
}

}  // namespace

void add_generate(CLI::App& program, int& status) {
  const auto options = std::make_shared<GenerateOptions>();
  CLI::App* verb = program.add_subcommand(
      "generate", "Write scenes that chance makes of joints, shapes, grounds and loads, the same from the same seed");
  verb->add_option("FOLDER", options->folder, "Where the scene files go, one a seed; it is made")
      ->type_name("DIR")
      ->required();
  verb->add_option("--seeds", options->seeds, "A seed, or the first and the last: 17 or 1-20")
      ->type_name("SEEDS")
      ->capture_default_str();
  verb->add_option("--bodies", options->bodies, "Most bodies that move; chance takes 2 or more")
      ->check(whole_number_within(2, 10000))
      ->capture_default_str();
  verb->add_option("--ratio", options->ratio, "Mass of the heaviest part over that of the lightest, at most")
      ->check(number_within(1, 1e6))
      ->capture_default_str();
  verb->add_option(
          "--without", options->without,
          fmt::format("Leave a feature out, else a scene has each with a probability of a half; repeatable: {}",
                      fmt::join(feature_words(), ", ")))
      ->type_name("FEATURE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb->add_option("--seconds", options->seconds, "Simulated time of the scenes")
      ->type_name("SECONDS")
      ->transform(evaluated)
      ->check(number_above_0())
      ->capture_default_str();
  verb->add_option("--dt", options->dt, "Their time step: 1/240 or 0.004")
      ->type_name("SECONDS")
      ->transform(evaluated)
      ->check(number_above_0())
      ->capture_default_str();
  add_examples(*verb, {{"plumb generate random", "20 scenes; then: plumb compare random/*.json"},
                       {"plumb generate random --seeds 1-200 --bodies 40 --ratio 1000", "more, and harder ones"},
                       {"plumb generate piles --without joints --without belt", "heaps of loose bodies"}});
  verb->callback([options, &status] { status = generate(*options); });
}

}  // namespace plumb::harness
