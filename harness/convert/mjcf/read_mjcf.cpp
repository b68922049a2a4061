#include "convert/mjcf/read_mjcf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/packed_file.hpp"
#include "convert/mjcf/mjcf_joints.hpp"
#include "convert/mjcf/mjcf_shapes.hpp"
#include "convert/mjcf/mjcf_text.hpp"
#include "convert/upright.hpp"

namespace plumb::harness {
namespace {

using referee::Mat3;
using referee::Pose;
using referee::Vec3;

struct DeleteFiles {
  void operator()(mjVFS* files) const {
    mj_deleteVFS(files);
    delete files;
  }
};

/// MuJoCo finds meshes beside the model's name, and the model itself among files that are held in memory.
ModelPtr load_text(const std::string& text, std::filesystem::path name, std::array<char, 1000>& error) {
  if (is_packed(name)) name.replace_extension();
  const std::unique_ptr<mjVFS, DeleteFiles> files(new mjVFS);
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), name.filename().c_str(), static_cast<int>(text.size() + 1));
  std::copy(text.begin(), text.end(), static_cast<char*>(files->filedata[0]));
  return ModelPtr(mj_loadXML(name.c_str(), files.get(), error.data(), static_cast<int>(error.size())));
}

/// What MuJoCo refuses as it is, it is given as it would take it.
ModelPtr load(const std::filesystem::path& file) {
  std::array<char, 1000> error{}, other{};
  ModelPtr model;
  if (!is_packed(file)) model.reset(mj_loadXML(file.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
  if (model) return model;
  model = load_text(mjcf_text(file), file, other);
  if (!model) throw UsageError(fmt::format("{}: {}", file.string(), is_packed(file) ? other.data() : error.data()));
  return model;
}

/// Joints that would begin beyond a limit begin at it. Where a body has several, what one begins at turns the axes of
/// others, so they are left as they are.
DataPtr start_of(const mjModel& model, Remarks& remarks) {
  DataPtr data(mj_makeData(&model));
  for (int joint = 0; joint < model.njnt; ++joint) {
    const int type = model.jnt_type[joint];
    const bool alone = model.body_jntnum[model.jnt_bodyid[joint]] == 1;
    if (!alone || model.jnt_limited[joint] == 0 || (type != mjJNT_HINGE && type != mjJNT_SLIDE)) continue;
    mjtNum& at = data->qpos[model.jnt_qposadr[joint]];
    const mjtNum within = std::clamp(at, model.jnt_range[2 * joint], model.jnt_range[2 * joint + 1]);
    if (within == at) continue;
    at = within;
    remarks.add("joints that would begin beyond a limit begin at it",
                scene_name(name_of(model, mjOBJ_JOINT, joint, "joint")));
  }
  mj_kinematics(&model, data.get());
  return data;
}

/// Of all bodies, in the scene's world.
std::vector<Pose> poses_of(const mjModel& model, const mjData& data) {
  std::vector<Pose> poses;
  for (int body = 0; body < model.nbody; ++body)
    poses.push_back(upright() * Pose{rotation_at(data.xquat, body), vec_at(data.xpos, body)});
  return poses;
}

Mat3 about(const Mat3& inertia, double mass, const Vec3& offset) {
  return inertia + mass * (offset.squaredNorm() * Mat3::Identity() - offset * offset.transpose());
}

/// Two masses in one frame as one.
LinkMass together(const LinkMass& a, const LinkMass& b) {
  LinkMass all;
  all.mass = a.mass + b.mass;
  if (all.mass == 0) return all;
  all.centre = (a.mass * a.centre + b.mass * b.centre) / all.mass;
  all.inertia = about(a.inertia, a.mass, a.centre - all.centre) + about(b.inertia, b.mass, b.centre - all.centre);
  return all;
}

/// Which geoms collide is a rule of two bit sets in MuJoCo that asks for one of two; in scenes, for both. Each pair of
/// sets gets a bit of its own, so that both say the same.
class Classes {
 public:
  explicit Classes(const mjModel& model) : model_(model) {
    for (int geom = 0; geom < model.ngeom; ++geom)
      if (collides(model, geom)) all_.insert(of(geom));
    if (all_.size() > 32) throw UsageError("more than 32 pairs of contype and conaffinity: scenes have 32 bits");
  }
  [[nodiscard]] PlumbFilter filter(int geom) const {
    const auto mine = of(geom);
    if (all_.size() == 1 && collide(mine, mine)) return body_desc(PLUMB_DYNAMIC).filter;
    PlumbFilter filter{};
    std::uint32_t bit = 1;
    for (const auto& other : all_) {
      if (other == mine) filter.category = bit;
      if (collide(mine, other)) filter.mask |= bit;
      bit <<= 1;
    }
    return filter;
  }

 private:
  using Class = std::pair<int, int>;  ///< contype, conaffinity
  [[nodiscard]] static bool collide(const Class& a, const Class& b) {
    return (a.first & b.second) != 0 || (b.first & a.second) != 0;
  }
  [[nodiscard]] Class of(int geom) const { return {model_.geom_contype[geom], model_.geom_conaffinity[geom]}; }

  const mjModel& model_;
  std::set<Class> all_;
};

/// Bodies that nothing moves against each other are one link.
class MjcfReader {
 public:
  explicit MjcfReader(const mjModel& model)
      : model_(model),
        start_(start_of(model, imported_.remarks)),
        poses_(poses_of(model, *start_)),
        classes_(model),
        bodies_(static_cast<std::size_t>(model.nbody)) {}

  Imported read() {
    if ((model_.opt.disableflags & mjDSBL_GRAVITY) != 0)
      imported_.scene.gravity = {0, 0, 0};
    else
      imported_.scene.gravity = referee::plain(upright().rotation * vec_at(model_.opt.gravity, 0));
    imported_.scene.dt = model_.opt.timestep;
    for (int body = 0; body < model_.nbody; ++body)
      if (model_.body_weldid[body] == body) read_link(body);
    for (int body = 1; body < model_.nbody; ++body)
      if (model_.body_weldid[body] == body)
        add_joints(model_, *start_, body, {of(model_.body_parentid[body]), *of(body)}, imported_);
    std::vector<std::optional<std::size_t>> bodies;
    for (int body = 0; body < model_.nbody; ++body) bodies.push_back(of(body));
    add_equalities(model_, poses_, bodies, imported_);
    remark_left_out();
    return std::move(imported_);
  }

 private:
  [[nodiscard]] const Pose& pose(int body) const { return poses_[static_cast<std::size_t>(body)]; }
  /// The scene's body that it is part of; none: the world.
  [[nodiscard]] std::optional<std::size_t> of(int body) const {
    const int root = model_.body_weldid[body];
    return root == 0 ? std::nullopt : bodies_[static_cast<std::size_t>(root)];
  }

  void read_link(int root) {
    Link link;
    link.moves = root != 0;
    link.name = scene_name(link.moves ? name_of(model_, mjOBJ_BODY, root, "body") : "worldbody");
    link.pose = pose(root);
    for (int body = root; body < model_.nbody; ++body) {
      if (model_.body_weldid[body] != root) continue;
      const Pose within = pose(body).seen_from(link.pose);
      if (link.moves) link.mass = together(link.mass, mass_of(body, within));
      for (LinkShape& shape : shapes_of(model_, body, link.moves, imported_.remarks)) {
        shape.pose = within * shape.pose;
        link.shapes.push_back(std::move(shape));
      }
    }
    if (!link.moves && link.shapes.empty()) return;
    if (!link.shapes.empty()) link.filter = filter_of(root, link.name);
    bodies_[static_cast<std::size_t>(root)] = add_link(imported_, link);
  }

  [[nodiscard]] LinkMass mass_of(int body, const Pose& within) const {
    const Pose inertial = within * Pose{rotation_at(model_.body_iquat, body), vec_at(model_.body_ipos, body)};
    const Vec3 moments = vec_at(model_.body_inertia, body);
    return {model_.body_mass[body], inertial.position,
            inertial.rotation * moments.asDiagonal() * inertial.rotation.transpose()};
  }

  PlumbFilter filter_of(int root, const std::string& name) {
    std::optional<PlumbFilter> first;
    for (int geom = 0; geom < model_.ngeom; ++geom) {
      if (!collides(model_, geom) || model_.body_weldid[model_.geom_bodyid[geom]] != root) continue;
      const PlumbFilter filter = classes_.filter(geom);
      if (first && filter.category != first->category)
        imported_.remarks.add("of several contypes of a body the first is taken", name);
      if (!first) first = filter;
    }
    return *first;
  }

  void remark_left_out() {
    Remarks& remarks = imported_.remarks;
    for (int i = 0; i < model_.nu; ++i)
      remarks.add("actuators are left out", name_of(model_, mjOBJ_ACTUATOR, i, "actuator"));
    for (int i = 0; i < model_.ntendon; ++i)
      remarks.add("tendons are left out", name_of(model_, mjOBJ_TENDON, i, "tendon"));
    for (int i = 0; i < model_.nexclude; ++i)
      remarks.add("exclusions of pairs of bodies are left out", name_of(model_, mjOBJ_EXCLUDE, i, "exclude"));
    for (int i = 0; i < model_.npair; ++i)
      remarks.add("pairs of geoms that are named to collide are left out", name_of(model_, mjOBJ_PAIR, i, "pair"));
    const mjOption& medium = model_.opt;
    if (medium.density != 0 || medium.viscosity != 0) remarks.add("drag of a medium is left out", "option");
    if (model_.nskin > 0) remarks.add("skins are left out", name_of(model_, mjOBJ_SKIN, 0, "skin"));
  }

  const mjModel& model_;
  Imported imported_;
  DataPtr start_;
  std::vector<Pose> poses_;
  Classes classes_;
  std::vector<std::optional<std::size_t>> bodies_;  ///< of weld roots
};

}  // namespace

Imported read_mjcf(const ModelFolders& folders) {
  const ModelPtr model = load(folders.file);
  return MjcfReader(*model).read();
}

}  // namespace plumb::harness
