#include "generate/random_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "convert/scene_text.hpp"
#include "convert/set_up.hpp"
#include "generate/random_joint.hpp"
#include "generate/random_part.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;

constexpr double least_gap = 1e-3;  // m, between the balls that hold bodies

/// Where bodies are: balls that hold them, none in another.
class Room {
 public:
  [[nodiscard]] bool is_free(const Vec3& centre, double radius) const {
    return centre.y() - radius > 0.02 && std::all_of(balls_.begin(), balls_.end(), [&](const Ball& ball) {
             return (ball.centre - centre).norm() > ball.radius + radius;
           });
  }
  void take(const Vec3& centre, double radius) { balls_.push_back({centre, radius}); }
  /// The nearest free place above this one.
  [[nodiscard]] Vec3 above(Vec3 centre, double radius) const {
    while (!is_free(centre, radius)) centre.y() += 0.1;
    return centre;
  }

 private:
  struct Ball {
    Vec3 centre;
    double radius;
  };
  std::vector<Ball> balls_;
};

/// A link that touches everything.
Link open_link() {
  Link link;
  link.filter = body_desc(PLUMB_DYNAMIC).filter;
  return link;
}

class SceneOfChance {
 public:
  explicit SceneOfChance(const RandomSceneRequest& request)
      : request_(request), chance_(request.seed), features_(Chance(~std::uint64_t{request.seed}), request.without) {}

  Imported make() {
    add_ground();
    const std::size_t count = 2 + chance_.below(request_.most_bodies - 1);
    width_ = 0.3 + 0.25 * std::sqrt(static_cast<double>(count));
    while (has(Feature::joints) && moving_ + 1 < count) {
      add_machine(2 + chance_.below(count - moving_ - 1));
      if (has(Feature::heap) && chance_.happens(0.5)) break;
    }
    while (moving_ < count) add_loose();
    if (has(Feature::load)) add_load();
    if (has(Feature::mover)) add_mover();
    if (has(Feature::targets)) lead_springs();
    set_up(imported_, {});
    if (!has(Feature::gyroscopic)) imported_.scene.needs &= ~PLUMB_NEED_GYROSCOPIC;
    imported_.scene.seconds = request_.seconds;
    imported_.scene.dt = request_.dt;
    return std::move(imported_);
  }
  [[nodiscard]] const Features& features() const { return features_; }

 private:
  struct Member {
    std::size_t body;
    Vec3 centre;
    double radius;
  };

  [[nodiscard]] bool has(Feature feature) const { return features_.has(feature); }

  PlumbMaterial material() {
    PlumbMaterial material = body_desc(PLUMB_DYNAMIC).material;
    material.friction = chance_.happens(0.2) ? 0 : chance_.between(0.1, 1);
    if (has(Feature::bounce)) material.restitution = chance_.between(0, 0.9);
    return material;
  }

  void add_fixed(const char* name, const SceneShape& shape, const Vec3& position) {
    Link link = open_link();
    link.name = name;
    link.moves = false;
    link.pose.position = position;
    link.shapes.push_back({shape, {}, material()});
    if (has(Feature::belt)) link.shapes.back().material.surface_velocity = {1.5, 0, 0};
    add_link(imported_, link);
  }

  void add_ground() {
    if (!has(Feature::terrain)) return add_fixed("ground", plane_shape(), Vec3::Zero());
    SceneShape field;
    field.desc = shape_desc(PLUMB_HEIGHT_FIELD);
    field.desc.rows = field.desc.columns = 33;
    field.desc.spacing = {0.75, 0, 0.75};
    const double depth = chance_.between(0.05, 0.4);
    for (std::size_t i = 0; i < 33 * 33; ++i) field.heights.push_back(-depth * chance_.share());
    add_fixed("ground", field, Vec3::Zero());
    add_fixed("below", plane_shape(), Vec3(0, -2, 0));
  }

  Member add_body(const char* name, const RandomPart& part, const Vec3& centre) {
    Link link = open_link();
    link.name = fmt::format("{}{}", name, moving_++);
    link.pose.position = centre;
    link.pose.rotation = chance_.rotation();
    link.shapes = part.shapes;
    link.shapes.front().material = material();
    for (LinkShape& shape : link.shapes) shape.material = link.shapes.front().material;
    const std::size_t body = add_link(imported_, link);
    PlumbBodyDesc& desc = imported_.scene.bodies[body].desc;
    desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
    desc.mass = part.mass;
    mass_ += part.mass;
    room_.take(centre, part.radius + least_gap / 2);
    top_ = std::max(top_, centre.y() + part.radius);
    return {body, centre, part.radius};
  }

  RandomPart part() { return random_part(chance_, features_, request_.mass_ratio); }

  Vec3 somewhere(double radius) {
    const Vec3 place(chance_.between(-width_, width_), radius + chance_.between(0.05, 1.5),
                     chance_.between(-width_, width_));
    return room_.above(place, radius + least_gap / 2);
  }

  void add_loose() {
    const RandomPart one = part();
    const Member body = add_body("loose", one, somewhere(one.radius));
    if (has(Feature::spin)) throw_all({body});
  }

  /// A tree that grows at bodies drawn anew, then loops.
  void add_machine(std::size_t count) {
    const RandomPart first = part();
    const bool hangs = chance_.happens(0.5);
    Vec3 place = somewhere(first.radius);
    if (hangs) place = room_.above(place + Vec3(0, 0.6 * std::sqrt(static_cast<double>(count)), 0), first.radius);
    std::vector<Member> members{add_body("part", first, place)};
    if (hangs)
      add_random_joint(imported_, chance_, features_,
                       {std::nullopt, members[0].body, place + Vec3(0, first.radius, 0)});
    for (std::size_t tries = 0; members.size() < count && tries < 20 * count; ++tries) grow(members);
    if (has(Feature::loops)) close_loops(members);
    if (has(Feature::spin) && !hangs) throw_all(members);
  }

  void grow(std::vector<Member>& members) {
    const Member parent = members[chance_.below(members.size())];
    const Vec3 direction = chance_.direction();
    const RandomPart child = part();
    const Vec3 centre = parent.centre + (parent.radius + child.radius + 2 * least_gap) * direction;
    if (!room_.is_free(centre, child.radius + least_gap / 2)) return;
    members.push_back(add_body("part", child, centre));
    add_random_joint(imported_, chance_, features_,
                     {parent.body, members.back().body, parent.centre + (parent.radius + least_gap) * direction});
  }

  void close_loops(const std::vector<Member>& members) {
    if (members.size() < 3) return;
    for (std::size_t i = 0; i < 1 + members.size() / 5; ++i) {
      const std::size_t a = chance_.below(members.size()), b = chance_.below(members.size());
      if (a != b) add_loop(imported_, chance_, members[a].body, members[b].body);
    }
  }

  /// With one motion of all, which no joint minds.
  void throw_all(const std::vector<Member>& members) {
    const Vec3 velocity = chance_.between(0, 5) * chance_.direction(),
               spin = chance_.between(0, 10) * chance_.direction();
    for (const Member& member : members) {
      PlumbBodyDesc& desc = imported_.scene.bodies[member.body].desc;
      desc.linear_velocity = referee::plain(velocity + spin.cross(member.centre - members.front().centre));
      desc.angular_velocity = referee::plain(spin);
    }
  }

  void add_load() {
    const Vec3 half(0.4, 0.15, 0.4);
    RandomPart load{{{box_shape_of(half), {}}}, half.norm(), mass_ * chance_.by_ratio(0.1, 10)};
    const Vec3 place = room_.above(Vec3(0, top_ + load.radius + 0.1, 0), load.radius);
    add_body("load", load, place);
  }

  void add_mover() {
    Link link = open_link();
    link.name = "mover";
    const Vec3 half(0.5, 0.1, 0.5);
    link.pose.position = room_.above(Vec3(width_, half.norm() + 0.05, 0), half.norm());
    link.shapes.push_back({box_shape_of(half), {}, material()});
    const std::size_t body = add_link(imported_, link);
    PlumbBodyDesc kinematic = body_desc(PLUMB_KINEMATIC);
    kinematic.pose = imported_.scene.bodies[body].desc.pose;
    kinematic.material = imported_.scene.bodies[body].desc.material;
    imported_.scene.bodies[body].desc = kinematic;
    SceneAction path;
    path.target = body;
    path.name = link.name;
    path.axis = {0, 1, 0};
    path.end = request_.seconds;
    path.numbers = {{link.pose.position.x(),
                     fmt::format("{} - {} * sin({} * t)", link.pose.position.x(), width_, chance_.between(0.5, 3))},
                    {link.pose.position.y(), ""},
                    {link.pose.position.z(), ""},
                    {0, ""}};
    imported_.scene.host.push_back(std::move(path));
  }

  void lead_springs() {
    for (std::size_t i = 0; i < imported_.scene.joints.size(); ++i) {
      const SceneJoint& joint = imported_.scene.joints[i];
      SceneAction action;
      action.kind = SceneAction::targets;
      action.target = i;
      action.name = joint.name;
      action.end = request_.seconds;
      bool leads = false;
      for (std::size_t axis = 0; axis < 6; ++axis) {
        action.numbers.push_back({joint.desc.springs[axis].rest, ""});
        if (joint.desc.springs[axis].enabled == 0 || !chance_.happens(0.6)) continue;
        action.numbers.back().text =
            fmt::format("{} * sin({} * t)", (axis < 3 ? 0.1 : 0.8) * chance_.between(-1, 1), chance_.between(0.5, 6));
        leads = true;
      }
      if (leads) imported_.scene.host.push_back(std::move(action));
    }
  }

  const RandomSceneRequest& request_;
  Chance chance_;
  Features features_;
  Imported imported_;
  Room room_;
  std::size_t moving_ = 0;
  double width_ = 1, mass_ = 0, top_ = 0;
};

/// What is fast and thin overlaps in the step in which it strikes, in every engine that does not look ahead; what stays
/// is told by a mean.
void judge_what_stays(Json& json, double seconds) {
  json["measure"]["quantities"]["overlap"] = {
      {"quantity", "overlap"}, {"take", "mean"}, {"over", {0.9 * seconds, seconds}}, {"truth", 0}};
  json["metrics"]["overlap"]["doc"] = "of the deepest two at a time, its mean over the last tenth of the time";
}

/// What joints must not do besides opening.
void add_joint_metrics(Json& json) {
  const auto add = [&](const char* quantity, const char* unit, const char* doc, double threshold) {
    json["measure"]["quantities"][quantity] = {{"quantity", quantity}, {"take", "max"}, {"truth", 0}};
    json["metrics"][quantity] = {{"unit", unit}, {"doc", doc}, {"threshold", threshold}, {"gold", threshold / 10}};
  };
  add("misalignment", "rad", "most that any joint has turned where it may not", 0.02);
  add("limit_position", "m", "most that any joint has slid beyond a limit", 0.005);
  add("limit_angle", "rad", "most that any joint has turned beyond a limit", 0.02);
}

}  // namespace

Json random_scene(const RandomSceneRequest& request) {
  SceneOfChance chance(request);
  const Imported imported = chance.make();
  const std::string doc = fmt::format("Chance made it, seed {}, at most {} bodies, masses within {} : 1. It has: {}.",
                                      request.seed, request.most_bodies, request.mass_ratio, chance.features().text());
  Json json = scene_json(imported.scene, {fmt::format("R{}", request.seed), "random", "Random scene", doc});
  add_metrics(json, imported.scene);
  judge_what_stays(json, request.seconds);
  if (!imported.scene.joints.empty()) add_joint_metrics(json);
  return json;
}

}  // namespace plumb::harness
