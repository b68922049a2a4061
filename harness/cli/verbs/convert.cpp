// plumb convert: machines that other programs' files describe, as scenes, and scenes as worlds for those programs.
#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <iostream>
#include <map>
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
#include "convert/write/gltf/write_gltf.hpp"
#include "convert/write/left_out.hpp"
#include "convert/write/urdf/write_urdf.hpp"
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
  add_joint_metrics(json, imported.scene);
  out.write(scene_text(json));
}

void write_with_meshes(const std::filesystem::path& to, const std::string& text,
                       const std::map<std::string, std::string>& meshes, DraftFile& out) {
  for (const auto& [name, mesh] : meshes) DraftFile((to.parent_path() / name).string()).write(mesh);
  out.write(text);
}

enum class Format { scene, sdf, mjcf, urdf, gltf, glb };

/// What a file is, which its name's end says.
Format format_of(const std::string& file) {
  static const std::map<std::string, Format> formats{
      {".json", Format::scene}, {".sdf", Format::sdf},   {".world", Format::sdf}, {".xml", Format::mjcf},
      {".mjcf", Format::mjcf},  {".urdf", Format::urdf}, {".gltf", Format::gltf}, {".glb", Format::glb}};
  const auto found = formats.find(std::filesystem::path(file).extension().string());
  if (found != formats.end()) return found->second;
  throw UsageError(
      fmt::format("cannot write {}: a scene's file ends with .json, an SDF world's with .sdf or .world, "
                  "an MJCF model's with .xml or .mjcf, a URDF robot's with .urdf, a glTF file with .gltf or .glb",
                  shortened(file, 200)));
}

void write(const ConvertOptions& options, Format format, Imported& imported, DraftFile& out) {
  const std::filesystem::path to(options.to);
  const std::string slug = slug_of(to);
  if (format != Format::scene) leave_gears_out(imported);
  switch (format) {
    case Format::scene: return write_scene(options, imported, slug, out);
    case Format::mjcf: return out.write(write_mjcf(imported.scene, slug, imported.remarks));
    case Format::gltf:
    case Format::glb: return out.write(write_gltf(imported.scene, format == Format::glb, imported.remarks));
    case Format::sdf: {
      const SdfFiles files = write_sdf(imported.scene, slug, imported.remarks);
      return write_with_meshes(to, files.world, files.meshes, out);
    }
    case Format::urdf: {
      const UrdfFiles files = write_urdf(imported, slug);
      return write_with_meshes(to, files.robot, files.meshes, out);
    }
  }
}

int convert(const ConvertOptions& options) {
  const Format format = format_of(options.to);
  if (format == Format::scene && !is_machine(options.from))
    throw UsageError(
        options.from +
        " is a scene already; a world is written to a file that ends with .sdf, a model to .xml, a robot to "
        ".urdf, nodes with physics to .gltf or .glb");
  DraftFile out(options.to);
  Imported imported = read(options);
  set_up(imported, options.set_up);
  Scene& scene = imported.scene;
  if (options.seconds) scene.seconds = *options.seconds;
  if (options.dt) scene.dt = *options.dt;
  if (scene.dt == 0) scene.dt = Scene{}.dt;
  write(options, format, imported, out);
  std::cout << fmt::format("{}: {} bodies, {} joints, {} shapes\n", options.to, scene.bodies.size(),
                           scene.joints.size(), scene.shapes.size());
  for (const std::string& remark : imported.remarks.lines()) std::cout << "note: " << shortened(remark, 500) << "\n";
  return 0;
}

}  // namespace

void add_convert(CLI::App& program, int& status) {
  const auto options = std::make_shared<ConvertOptions>();
  CLI::App* verb = program.add_subcommand(
      "convert", "Make a scene of a machine in URDF, SDF, MJCF or glTF, or such a file of a scene");
  verb->add_option("FROM", options->from,
                   "File to read, its kind told by its outermost element, of glTF by its name; or a scene")
      ->required();
  verb->add_option(
          "TO", options->to,
          "File to write: a scene, as in arm.json; SDF, as in arm.sdf; MJCF, as in arm.xml; one robot in URDF, as in "
          "arm.urdf; or glTF with KHR_physics_rigid_bodies, as in arm.gltf or arm.glb")
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
              {"plumb convert I14 ragdoll.xml", "a ragdoll for MuJoCo"},
              {"plumb convert I14 ragdoll.glb", "the same for engines of games and the web"},
              {"plumb convert I23 arm.urdf", "a robot's arm for ROS"}});
  verb->callback([options, &status] { status = convert(*options); });
}

}  // namespace plumb::harness
