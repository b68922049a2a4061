// plumb export: a recorded trajectory for other programs, as glTF, a page of its own, a picture, or the frames of a
// film.
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/manual/examples.hpp"
#include "cli/options/numbers.hpp"
#include "cli/output/draft_file.hpp"
#include "cli/verbs/verbs.hpp"
#include "replay/bundle.hpp"
#include "replay/gltf.hpp"
#include "replay/title.hpp"
#include "report/page/parts/bundled_scripts.hpp"
#include "report/page/sections/sections.hpp"

extern char** environ;

namespace plumb::harness {

namespace {

struct ExportOptions {
  std::vector<std::string> files;
  std::string gltf, page, png, frames;
  std::string size = "1280x720", layers, theme;
  std::optional<double> at, fps;
};

std::string page_of(const std::vector<Trajectory>& trajectories) {
  if (!has_viewer())
    throw UsageError(
        "this program was built without node and has no viewer of replays: build it where node and npm are; "
        "--gltf needs neither");
  constexpr std::size_t no_bound = std::size_t{1} << 40;
  std::vector<PageReplay> replays;
  for (const Trajectory& trajectory : trajectories)
    replays.push_back({replay_title(trajectories.front().header), trajectory.header.value("label", ""),
                       bounded_bundle(trajectory, no_bound)});
  return replay_page(replays);
}

/// A page that is gone when its pictures are made.
class TemporaryPage {
 public:
  explicit TemporaryPage(const std::string& text) {
    std::string name = (std::filesystem::temp_directory_path() / "plumb-XXXXXX.html").string();
    const int descriptor = mkstemps(name.data(), 5);
    if (descriptor < 0) throw UsageError("cannot make a file in " + std::filesystem::temp_directory_path().string());
    close(descriptor);
    file_ = name;
    DraftFile(file_).write(text);
  }
  ~TemporaryPage() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  TemporaryPage(const TemporaryPage&) = delete;
  TemporaryPage& operator=(const TemporaryPage&) = delete;
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string file_;
};

/// The script that takes pictures: beside its packages where the build put them, or where $PLUMB_VIEWER says.
std::string still_script() {
  const char* named = std::getenv("PLUMB_VIEWER");
  const std::filesystem::path folder = named != nullptr ? named : PLUMB_VIEWER_FOLDER;
  if (!std::filesystem::exists(folder / "still.mjs"))
    throw UsageError((folder / "still.mjs").string() +
                     " is not there, which takes the pictures; build plumb where node and npm are, or set PLUMB_VIEWER "
                     "to the folder viewer of such a build");
  return (folder / "still.mjs").string();
}

void run_node(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "node");
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  pid_t pid = -1;
  if (const int failure = posix_spawnp(&pid, "node", nullptr, nullptr, pointers.data(), environ); failure != 0)
    throw UsageError(fmt::format("cannot start node, which takes the pictures: {}; install nodejs and chromium",
                                 std::strerror(failure)));
  int status = 0;
  waitpid(pid, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw UsageError("no picture was made: see what node said above");
}

void take_pictures(const ExportOptions& options, const std::string& page) {
  const std::string script = still_script();
  const TemporaryPage file(page);
  std::vector<std::string> common{script, file.file(), "--size", options.size};
  if (!options.layers.empty()) common.insert(common.end(), {"--layers", options.layers});
  if (!options.theme.empty()) common.insert(common.end(), {"--theme", options.theme});
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), more.begin(), more.end());
    run_node(arguments);
  };
  if (!options.png.empty()) run({"--at", fmt::format("{}", options.at.value_or(0)), "--png", options.png});
  if (!options.frames.empty()) run({"--frames", options.frames, "--fps", fmt::format("{}", options.fps.value_or(30))});
}

/// node writes the pictures; whether it can is found out before anything is read.
void check_places_of_pictures(const ExportOptions& options) {
  if (!options.png.empty()) const DraftFile picture(options.png);
  if (options.frames.empty()) return;
  std::error_code failure;
  std::filesystem::create_directories(options.frames, failure);
  if (failure) throw UsageError("--frames " + options.frames + ": " + failure.message());
  const DraftFile frame(options.frames + "/frame");
}

void export_files(const ExportOptions& options) {
  if (options.gltf.empty() && options.page.empty() && options.png.empty() && options.frames.empty())
    throw UsageError("say what to make: --gltf FILE.glb, --page FILE.html, --png FILE --at SECONDS, or --frames DIR");
  std::optional<DraftFile> gltf_file, page_file;
  if (!options.gltf.empty()) gltf_file.emplace(options.gltf);
  if (!options.page.empty()) page_file.emplace(options.page);
  check_places_of_pictures(options);
  std::vector<Trajectory> trajectories;
  for (const std::string& file : options.files) trajectories.push_back(read_trajectory(file));
  if (gltf_file) {
    if (trajectories.size() != 1)
      throw UsageError("--gltf takes one trajectory, not " + std::to_string(trajectories.size()));
    gltf_file->write(binary_gltf(trajectories.front()));
  }
  if (options.page.empty() && options.png.empty() && options.frames.empty()) return;
  const std::string page = page_of(trajectories);
  if (page_file) page_file->write(page);
  if (!options.png.empty() || !options.frames.empty()) take_pictures(options, page);
}

}  // namespace

void add_export(CLI::App& program, int& status) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* verb = program.add_subcommand("export", "Make recorded trajectories into glTF, a page, or pictures");
  verb->add_option("FILE", options->files, "Trajectories (.plt) that --record wrote; several are shown side by side")
      ->required();
  verb->add_option("--gltf", options->gltf, "Binary glTF 2.0 with the motion as animation, to this file (.glb)")
      ->type_name("FILE");
  verb->add_option("--page", options->page, "A page that plays them, to this file (.html)")->type_name("FILE");
  CLI::Option* png =
      verb->add_option("--png", options->png, "A picture, to this file; needs node and chromium")->type_name("FILE");
  verb->add_option("--at", options->at, "Seconds of the scene that --png shows; 0 when not given")
      ->type_name("SECONDS")
      ->check(number_from_0())
      ->needs(png);
  CLI::Option* frames =
      verb->add_option("--frames", options->frames, "The pictures of a film, to this folder; needs node and chromium")
          ->type_name("DIR");
  verb->add_option("--fps", options->fps, "Frames a second of --frames; 30 when not given")
      ->check(number_above_0())
      ->needs(frames);
  verb->add_option("--size", options->size, "Of pictures, in pixels")->type_name("WIDTHxHEIGHT")->capture_default_str();
  verb->add_option("--show", options->layers, "Layers to switch on in pictures: contacts,boxes,axes,islands,...")
      ->type_name("LAYERS");
  verb->add_option("--theme", options->theme, "Of pictures: light or dark")->check(CLI::IsMember({"light", "dark"}));
  add_examples(*verb,
               {{"plumb export results/trajectories/D12-*.plt --page d12.html", "several side by side, to be played"},
                {"plumb export run.plt --gltf run.glb", "for other 3D programs"},
                {"plumb export run.plt --png end.png --at 5 --show contacts", "a picture, with contact forces"}});
  verb->callback([options, &status] {
    export_files(*options);
    status = 0;
  });
}

}  // namespace plumb::harness
