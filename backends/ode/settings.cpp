// One row a setting: what the host is told, and which member it moves.
#include "settings.hpp"

#include <cstring>
#include <string>
#include <vector>

namespace plumb::ode {
namespace {

constexpr const char* stepper_words[] = {"quickstep", "step"};
constexpr const char* friction_words[] = {"pyramid", "constant"};
constexpr const char* direction_words[] = {"normal", "sliding"};
constexpr const char* space_words[] = {"hash", "sap", "quadtree", "simple"};
constexpr const char* axes_words[] = {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"};
constexpr int axes_values[] = {dSAP_AXES_XYZ, dSAP_AXES_XZY, dSAP_AXES_YXZ,
                               dSAP_AXES_YZX, dSAP_AXES_ZXY, dSAP_AXES_ZYX};

struct Row {
  PlumbSettingInfo info;
  double (*get)(const Settings&);
  void (*set)(Settings&, double);
};

template <auto Member>
double get(const Settings& settings) {
  return static_cast<double>(settings.*Member);
}
template <auto Member>
void set(Settings& settings, double value) {
  settings.*Member = static_cast<std::remove_reference_t<decltype(settings.*Member)>>(value);
}

PlumbSettingInfo info(const char* name, PlumbSettingType type, PlumbSettingRole role, std::uint32_t flags,
                      const char* unit, const char* doc) {
  PlumbSettingInfo i{};
  i.name = name;
  i.unit = unit;
  i.doc = doc;
  i.type = type;
  i.role = role;
  i.flags = flags;
  i.default_value.type = type;
  return i;
}

template <auto Member>
Row number(const char* name, PlumbSettingType type, PlumbSettingRole role, std::uint32_t flags, double least,
           double most, double standard, const char* unit, const char* doc) {
  Row row{info(name, type, role, flags, unit, doc), get<Member>, set<Member>};
  row.info.minimum = least;
  row.info.maximum = most;
  row.info.default_value.number = standard;
  return row;
}

template <auto Member>
Row choice(const char* name, PlumbSettingRole role, std::uint32_t flags, std::span<const char* const> words,
           const char* doc) {
  Row row{info(name, PLUMB_SETTING_CHOICE, role, flags, "", doc), get<Member>, set<Member>};
  row.info.choices = words.data();
  row.info.choice_count = static_cast<std::uint32_t>(words.size());
  row.info.default_value.choice = words[0];
  return row;
}

template <auto Member>
Row flag(const char* name, bool standard, const char* doc) {
  Row row{info(name, PLUMB_SETTING_BOOL, PLUMB_ROLE_BEHAVIOUR, 0, "", doc), get<Member>, set<Member>};
  row.info.maximum = 1;
  row.info.default_value.number = standard ? 1 : 0;
  return row;
}

const std::vector<Row>& rows() {
  using S = Settings;
  constexpr auto real = PLUMB_SETTING_FLOAT, whole = PLUMB_SETTING_INT;
  constexpr auto quality = PLUMB_ROLE_QUALITY, speed = PLUMB_ROLE_SPEED, behaviour = PLUMB_ROLE_BEHAVIOUR;
  constexpr std::uint32_t once = PLUMB_SETTING_CREATION_ONLY;
  static const std::vector<Row> all = {
      choice<&S::stepper>(
          "stepper", behaviour, 0, stepper_words,
          "quickstep: iterative; step: direct (Dantzig), exact on wild mass ratios and joints, cubic in "
          "the island's size, and blows up on redundant contacts such as those of a tower"),
      number<&S::iterations>("iterations", whole, quality, 0, 1, 10000, 20, "1", "of quickstep's SOR solver"),
      number<&S::sor_w>("sor_w", real, quality, 0, 0.01, 1.99, 1.3, "1", "over-relaxation of quickstep's solver"),
      number<&S::substeps>("substeps", whole, quality, 0, 1, 1024, 1, "1", "collide and solve so often in each step"),
      number<&S::erp>("erp", real, quality, 0, 0, 1, 0.2, "1", "share of the position error mended in a step"),
      number<&S::cfm>("cfm", real, quality, 0, 0, 1, 1e-10, "s/kg", "constraint force mixing: softness of constraints"),
      number<&S::contact_erp>("contact_erp", real, quality, 0, -1, 1, -1, "1",
                              "erp of contacts; below 0: that of the world"),
      number<&S::contact_cfm>("contact_cfm", real, quality, 0, -1, 1, -1, "s/kg",
                              "cfm of contacts; below 0: that of the world"),
      number<&S::contact_surface_layer>("contact_surface_layer", real, quality, 0, 0, 1, 0, "m",
                                        "depth to which contacts may sink without being pushed out"),
      number<&S::contact_max_correcting_vel>("contact_max_correcting_vel", real, quality, 0, 0, 1e6, 0, "m/s",
                                             "fastest that a contact pushes bodies apart; 0: no limit"),
      number<&S::max_contacts>("max_contacts", whole, quality, 0, 1, 256, 8, "1", "points of a pair of geoms"),
      choice<&S::friction_model>("friction_model", behaviour, 0, friction_words,
                                 "pyramid: mu times the normal force along each of two directions (dContactApprox1); "
                                 "constant: ODE's other model, mu newtons whatever the normal force"),
      choice<&S::friction_directions>(
          "friction_directions", behaviour, 0, direction_words,
          "normal: the two directions follow from the contact's normal, as in ODE; sliding: "
          "the first is that of sliding where the contact slides (always so on conveyors)"),
      number<&S::bounce_vel>("bounce_vel", real, behaviour, 0, 0, 1000, 0.1, "m/s", "slower impacts do not bounce"),
      flag<&S::gyroscopic>("gyroscopic", true, "gyroscopic torque, where the world declares the need"),
      flag<&S::finite_rotation>("finite_rotation", false,
                                "orientations by whole rotations instead of a first order step"),
      number<&S::sleep_linear>("auto_disable_linear_threshold", real, behaviour, 0, 0, 100, 0.01, "m/s",
                               "a slower body may sleep"),
      number<&S::sleep_angular>("auto_disable_angular_threshold", real, behaviour, 0, 0, 100, 0.01, "rad/s",
                                "a slower body may sleep"),
      number<&S::sleep_steps>("auto_disable_steps", whole, behaviour, 0, 0, 100000, 10, "1",
                              "sub-steps that a body must be idle before it sleeps"),
      number<&S::sleep_time>("auto_disable_time", real, behaviour, 0, 0, 1000, 0, "s",
                             "time that a body must be idle before it sleeps"),
      choice<&S::space>("space", speed, once, space_words, "broad phase"),
      number<&S::hash_min_level>("hash_min_level", whole, speed, once, -20, 0, -3, "1", "smallest cell: 2^level m"),
      number<&S::hash_max_level>("hash_max_level", whole, speed, once, 0, 20, 10, "1", "largest cell: 2^level m"),
      number<&S::quadtree_extent>("quadtree_extent", real, speed, once, 1, 1e6, 200, "m",
                                  "half side of the quadtree around the origin"),
      number<&S::quadtree_depth>("quadtree_depth", whole, speed, once, 1, 10, 6, "1", "levels of the quadtree"),
      choice<&S::sap_axes>("sap_axes", speed, once, axes_words, "order of the axes of sweep and prune"),
      number<&S::threads>(
          "threads", whole, speed, once, 1, 64, 1, "1",
          "ODE's own thread pool; measured 2 to 4 times slower at 2 threads, and an engine error on one "
          "of its threads ends the process"),
      number<&S::random_seed>("random_seed", whole, behaviour, once, 0, 2147483647, 0, "1",
                              "of the order in which quickstep visits its rows"),
  };
  return all;
}

const Row& row_named(const char* name) {
  for (const Row& row : rows())
    if (std::strcmp(row.info.name, name) == 0) return row;
  throw Error(PLUMB_E_INTERNAL, std::string("there is no setting ") + name);
}

}  // namespace

std::span<const PlumbSettingInfo> setting_infos() {
  static const std::vector<PlumbSettingInfo> infos = [] {
    std::vector<PlumbSettingInfo> all;
    for (const Row& row : rows()) all.push_back(row.info);
    return all;
  }();
  return infos;
}

// Every member is set by its row of the list.
Settings::Settings(const WorldInit& init) {  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t i = 0; i < init.infos.size(); ++i) assign_setting(*this, init.infos[i].name, init.values[i]);
}

void assign_setting(Settings& settings, const char* name, const PlumbSettingValue& value) {
  const Row& row = row_named(name);
  double number = value.number;
  for (std::uint32_t i = 0; i < row.info.choice_count; ++i)
    if (std::strcmp(row.info.choices[i], value.choice) == 0) number = i;
  row.set(settings, number);
}

PlumbSettingValue setting_value(const Settings& settings, const char* name) {
  const Row& row = row_named(name);
  PlumbSettingValue value{};
  value.type = row.info.type;
  const double number = row.get(settings);
  if (row.info.type == PLUMB_SETTING_CHOICE) {
    value.choice = row.info.choices[static_cast<std::size_t>(number)];
  } else {
    value.number = number;
  }
  return value;
}

dSpaceID make_space(const Settings& settings) {
  const dVector3 origin = {0, 0, 0};
  const double extent = settings.quadtree_extent;
  const dVector3 extents = {extent, extent, extent};
  switch (settings.space) {
    case Space::sap: return dSweepAndPruneSpaceCreate(nullptr, axes_values[settings.sap_axes]);
    case Space::quadtree: return dQuadTreeSpaceCreate(nullptr, origin, extents, settings.quadtree_depth);
    case Space::simple: return dSimpleSpaceCreate(nullptr);
    case Space::hash: break;
  }
  const dSpaceID space = dHashSpaceCreate(nullptr);
  dHashSpaceSetLevels(space, settings.hash_min_level, settings.hash_max_level);
  return space;
}

void apply_to_world(const Settings& settings, dWorldID world) {
  dWorldSetERP(world, settings.erp);
  dWorldSetCFM(world, settings.cfm);
  dWorldSetQuickStepNumIterations(world, settings.iterations);
  dWorldSetQuickStepW(world, settings.sor_w);
  dWorldSetContactSurfaceLayer(world, settings.contact_surface_layer);
  const double fastest = settings.contact_max_correcting_vel;
  dWorldSetContactMaxCorrectingVel(world, fastest == 0 ? dInfinity : fastest);
}

}  // namespace plumb::ode
