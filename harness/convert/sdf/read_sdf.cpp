#include "convert/sdf/read_sdf.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Physics.hh>
#include <sdf/Root.hh>
#include <sdf/World.hh>

#include "base/packed_file.hpp"
#include "base/shown.hpp"
#include "convert/sdf/sdf_console.hpp"
#include "convert/sdf/sdf_joints.hpp"
#include "convert/sdf/sdf_shapes.hpp"
#include "convert/sdf/sdf_types.hpp"
#include "convert/sdf/standard_models.hpp"
#include "convert/upright.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;

/// Reads models one by one; names of models within others begin with those of the others.
class SdfReader {
 public:
  SdfReader(const ModelFolders& folders, Remarks remarks) : folders_(folders) {
    imported_.remarks = std::move(remarks);
  }

  void read_world(const sdf::World& world) {
    Scene& scene = imported_.scene;
    scene.gravity = referee::plain(upright().rotation * vec_of(world.Gravity()));
    if (const sdf::Physics* physics = world.PhysicsDefault()) scene.dt = physics->MaxStepSize();
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      const sdf::Model& model = *world.ModelByIndex(i);
      ignition::math::Pose3d pose;
      check_sdf("model \"" + model.Name() + "\"", model.SemanticPose().Resolve(pose));
      read_outermost(model, upright() * pose_of(pose), model.Name() + "::");
    }
    if (world.LightCount() + world.ActorCount() > 0)
      imported_.remarks.add("lights and actors are left out", world.Name());
  }

  /// A model and those within it: nothing of it touches the rest of it unless it says so.
  void read_outermost(const sdf::Model& model, const Pose& place, const std::string& scope) {
    --group_;
    read_model(model, place, scope, model.Static());
  }

  [[nodiscard]] Imported take() { return std::move(imported_); }

 private:
  void read_model(const sdf::Model& model, const Pose& place, const std::string& scope, bool is_static) {
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i)
      read_link(*model.LinkByIndex(i), model, place, scope, is_static);
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const sdf::Model& nested = *model.ModelByIndex(i);
      ignition::math::Pose3d pose;
      check_sdf("model \"" + nested.Name() + "\"", nested.SemanticPose().Resolve(pose, "__model__"));
      read_model(nested, place * pose_of(pose), scope + nested.Name() + "::", is_static || nested.Static());
    }
    for (std::uint64_t i = 0; i < model.JointCount(); ++i) read_joint(*model.JointByIndex(i), place, scope);
  }

  void read_link(const sdf::Link& from, const sdf::Model& model, const Pose& place, const std::string& scope,
                 bool is_static) {
    Link link;
    link.name = scene_name(scope + from.Name());
    ignition::math::Pose3d pose;
    check_sdf("link \"" + link.name + "\"", from.SemanticPose().Resolve(pose, "__model__"));
    link.pose = place * pose_of(pose);
    link.moves = !is_static;
    if (link.moves) link.mass = mass_of(from, link.name);
    link.shapes = shapes_of(from, link.moves, link.name, folders_, imported_.remarks);
    link.filter.category = link.filter.mask = bitmask_of(from, link.name, imported_.remarks);
    link.filter.group = model.SelfCollide() || is_static ? 0 : group_;
    bodies_[scope + from.Name()] = add_link(imported_, link);
  }

  LinkMass mass_of(const sdf::Link& link, const std::string& name) {
    const auto& inertial = link.Inertial();
    if (!link.Element() || !link.Element()->HasElement("inertial"))
      imported_.remarks.add("links without a mass have 1 kg and 1 kg m2, as SDF says", name);
    if (!(inertial.MassMatrix().Mass() > 0))
      throw UsageError(fmt::format("link \"{}\" has a mass of {} kg; give it one above 0, or make its model static",
                                   name, inertial.MassMatrix().Mass()));
    return {inertial.MassMatrix().Mass(), vec_of(inertial.Pose().Pos()), matrix_of(inertial.Moi())};
  }

  void read_joint(const sdf::Joint& from, const Pose& place, const std::string& scope) {
    const std::string name = scene_name(scope + from.Name());
    std::string parent, child;
    check_sdf("joint \"" + name + "\"", from.ResolveParentLink(parent));
    check_sdf("joint \"" + name + "\"", from.ResolveChildLink(child));
    std::optional<std::size_t> held;
    if (parent != "world") held = bodies_.at(scope + parent);
    add_sdf_joint(from, name, place, {held, bodies_.at(scope + child)}, imported_);
  }

  const ModelFolders& folders_;
  Imported imported_;
  std::map<std::string, std::size_t> bodies_;  ///< by the link's name with those of the models around it
  std::int32_t group_ = 0;
};

/// What libsdformat could not read it tells by its errors, and what it left out by its console.
sdf::Root load(const ModelFolders& folders, Remarks& remarks) {
  StandardModels standard;
  sdf::ParserConfig config;
  config.SetFindCallback([&](const std::string& uri) {
    try {
      return folders.find(uri).string();
    } catch (const UsageError&) {
      return standard.find(uri);  // where that knows none, libsdformat says which include it could not find
    }
  });
  const SdfConsole console;
  sdf::Root root;
  const sdf::Errors errors = is_packed(folders.file) ? root.LoadSdfString(text_of_file(folders.file), config)
                                                     : root.Load(folders.file.string(), config);
  const std::vector<std::string> said = console.lines();
  if (!errors.empty()) {
    std::string message = fmt::format("{}: {}", folders.file.string(), errors.front().Message());
    if (!said.empty()) message += fmt::format(" ({})", fmt::join(said, "; "));
    throw UsageError(shortened(message, 1000));
  }
  for (const std::string& line : said) remarks.add("libsdformat", line);
  return root;
}

}  // namespace

Imported read_sdf(const ModelFolders& folders) {
  Remarks remarks;
  const sdf::Root root = load(folders, remarks);
  SdfReader reader(folders, std::move(remarks));
  for (std::uint64_t i = 0; i < root.WorldCount(); ++i) reader.read_world(*root.WorldByIndex(i));
  if (root.Model() != nullptr) reader.read_outermost(*root.Model(), upright() * pose_of(root.Model()->RawPose()), "");
  Imported imported = reader.take();
  if (root.WorldCount() == 0) imported.scene.dt = 0;
  return imported;
}

}  // namespace plumb::harness
