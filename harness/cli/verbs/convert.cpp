// plumb convert: machines that other programs' files describe, as scenes, and scenes as worlds for those programs.
#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <regex>

#include "base/shown.hpp"
#include "cli/manual/examples.hpp"
#include "cli/options/numbers.hpp"
#include "cli/options/one_scene.hpp"
#include "cli/output/draft_file.hpp"
#include "cli/verbs/verbs.hpp"
#include "convert/read.hpp"
#include "convert/scene_text.hpp"
#include "convert/set_up.hpp"
#include "convert/write/write_mjcf.hpp"
#include "convert/write/write_sdf.hpp"

namespace plumb::harness {
namespace {

struct ConvertOptions {
  std::string from, to, id;
  std::vector<std::string> folders, parameters;
  SetUp set_up;
  std::optional<double> seconds, dt;
};

/// Letters, digits and dashes of a file's name: what a scene may be called.
std::string slug_of(const std::filesystem::path& file) {
  std::string slug;
  for (const char c : file.stem().string()) {
    const bool fits = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (fits) slug += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!fits && !slug.empty() && slug.back() != '-') slug += '-';
  }
  while (!slug.empty() && slug.back() == '-') slug.pop_back();
  if (slug.empty() || std::isalpha(static_cast<unsigned char>(slug.front())) == 0) slug.insert(0, "machine-");
  return slug.substr(0, 60);
}

/// X and six digits made of the slug, so that two machines in one results folder are told apart.
std::string id_of(const std::string& slug) {
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char c : slug) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return fmt::format("X{:06}", hash % 1000000);
}

bool is_machine(const std::filesystem::path& file) { return file.has_extension() && file.extension() != ".json"; }

Imported read(const ConvertOptions& options) {
  if (is_machine(options.from)) {
    if (!options.parameters.empty())
      throw UsageError("--param: " + options.from + " is no scene and has no parameters");
    return read_machine({options.from, {options.folders.begin(), options.folders.end()}});
  }
  Imported imported;
  imported.scene = one_scene(options.from, options.parameters);
  imported.efforts.resize(imported.scene.joints.size());
  for (auto& efforts : imported.efforts) efforts.fill(std::numeric_limits<double>::infinity());
  return imported;
}

void write_scene(const ConvertOptions& options, const Imported& imported, const std::string& slug, DraftFile& out) {
  const std::string name = std::filesystem::path(options.from).filename().string();
  std::string doc = fmt::format("Read from {}.", shortened(name, 200));
  for (const std::string& remark : imported.remarks.lines()) doc += fmt::format(" Note: {}.", shortened(remark, 500));
  Json json = scene_json(imported.scene, {options.id.empty() ? id_of(slug) : options.id, slug, shortened(name), doc});
  add_metrics(json, imported.scene);
  out.write(scene_text(json));
}

void write_world(const std::filesystem::path& to, Imported& imported, const std::string& slug, DraftFile& out) {
  const SdfFiles files = write_sdf(imported.scene, slug, imported.remarks);
  for (const auto& [name, text] : files.meshes) DraftFile((to.parent_path() / name).string()).write(text);
  out.write(files.world);
}

int convert(const ConvertOptions& options) {
  const std::filesystem::path to(options.to);
  const bool to_scene = to.extension() == ".json", to_world = to.extension() == ".sdf" || to.extension() == ".world",
             to_model = to.extension() == ".xml" || to.extension() == ".mjcf";
  if (!to_scene && !to_world && !to_model)
    throw UsageError(
        fmt::format("cannot write {}: a scene's file ends with .json, an SDF world's with .sdf or .world, "
                    "an MJCF model's with .xml or .mjcf",
                    shortened(options.to, 200)));
  if (to_scene && !is_machine(options.from))
    throw UsageError(options.from +
                     " is a scene already; a world is written to a file that ends with .sdf, a model to .xml");
  DraftFile out(options.to);
  Imported imported = read(options);
  set_up(imported, options.set_up);
  Scene& scene = imported.scene;
  if (options.seconds) scene.seconds = *options.seconds;
  if (options.dt) scene.dt = *options.dt;
  if (scene.dt == 0) scene.dt = Scene{}.dt;
  const std::string slug = slug_of(to);
  if (to_scene)
    write_scene(options, imported, slug, out);
  else if (to_model)
    out.write(write_mjcf(scene, slug, imported.remarks));
  else
    write_world(to, imported, slug, out);
  std::cout << fmt::format("{}: {} bodies, {} joints, {} shapes\n", options.to, scene.bodies.size(),
                           scene.joints.size(), scene.shapes.size());
  for (const std::string& remark : imported.remarks.lines()) std::cout << "note: " << shortened(remark, 500) << "\n";
  return 0;
}

}  // namespace

void add_convert(CLI::App& program, int& status) {
  const auto options = std::make_shared<ConvertOptions>();
  CLI::App* verb = program.add_subcommand(
      "convert", "Make a scene of a machine in URDF, SDF, MJCF or glTF, or an SDF world or MJCF model of a scene");
  verb->add_option("FROM", options->from,
                   "File to read, its kind told by its outermost element, of glTF by its name; or a scene")
      ->required();
  verb->add_option(
          "TO", options->to,
          "File to write: a scene, as in arm.json, a world, as in arm.sdf, or a model for MuJoCo, as in arm.xml")
      ->required();
  verb->add_option("--folder", options->folders,
                   "Where model:// and package:// names and meshes are looked for, beside the folders above FROM; "
                   "repeatable")
      ->type_name("DIR")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb->add_flag("--fix-base", options->set_up.fix_base,
                 "What joints hold others to, and nothing holds, does not move");
  verb->add_flag("--hold", options->set_up.hold,
                 "A motor in every joint keeps it as it is, as strong as the file allows");
  verb->add_flag("--ground", options->set_up.ground, "Put a plane below the lowest point");
  verb->add_option("--param", options->parameters, "A parameter of the scene FROM; repeatable")
      ->type_name("NAME=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb->add_option("--seconds", options->seconds, "Simulated time of the scene; left out: 10")
      ->type_name("SECONDS")
      ->transform(evaluated)
      ->check(number_above_0());
  verb->add_option("--dt", options->dt, "Its time step; left out: the file's, or 1/60")
      ->type_name("SECONDS")
      ->transform(evaluated)
      ->check(number_above_0());
  verb->add_option("--id", options->id, "The scene's id, a letter and digits; left out: made of TO's name")
      ->type_name("ID")
      ->check(CLI::Validator(
          [](std::string& id) {
            static const std::regex right("[A-Z][0-9]{1,6}[a-z]?");
            return std::regex_match(id, right) ? std::string()
                                               : "must be a letter and digits, as in X1, not " + shortened(id);
          },
          ""));
  add_examples(
      *verb, {{"plumb convert arm.urdf arm.json --fix-base", "an arm that hangs from its base"},
              {"plumb convert level.glb level.json", "what an artist exported with KHR_physics_rigid_bodies"},
              {"plumb convert robot.sdf robot.json --ground --hold", "a robot that stands still: plumb run robot.json"},
              {"plumb convert D1 tower.sdf --param H=20", "a tower for Gazebo"},
              {"plumb convert I14 ragdoll.xml", "a ragdoll for MuJoCo"}});
  verb->callback([options, &status] { status = convert(*options); });
}

}  // namespace plumb::harness
