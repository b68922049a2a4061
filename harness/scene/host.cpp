// What the host does in a scene while it runs: paths of kinematic bodies, forces, impulses, motors and the
// targets of springs over time.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/build.hpp"

namespace plumb::harness {
namespace {

constexpr const char* time_name = "t";

/// The time, known to an action's expressions as long as this lives.
class KnownTime {
 public:
  explicit KnownTime(const Node& action) : expressions_(action.expressions()) {
    action.check_new_name(time_name);
    at(0);
  }
  ~KnownTime() { expressions_.erase(time_name); }
  KnownTime(const KnownTime&) = delete;
  KnownTime& operator=(const KnownTime&) = delete;

  void at(double time) { expressions_.set(time_name, time); }

 private:
  Expressions& expressions_;
};

class ActionReader {
 public:
  ActionReader(const Node& node, const SceneBuilder& builder) : node_(node), builder_(builder), time_(node) {}

  SceneAction read() {
    SceneAction action;
    const auto body = node_.find("body"), joint = node_.find("joint");
    if (body.has_value() == joint.has_value()) node_.fail("an action is of one body or one joint");
    find_kind(action, body.has_value());
    action.target =
        body ? find_name(*body, "body", builder_.body_index) : find_name(*joint, "joint", builder_.joint_index);
    action.name = (body ? *body : *joint).name();
    read_window(action);
    switch (action.kind) {
      case SceneAction::path: read_path(action); break;
      case SceneAction::force: read_push(action, "force", "torque"); break;
      case SceneAction::impulse: read_push(action, "impulse", "angular_impulse"); break;
      case SceneAction::motors: read_motors(action); break;
      case SceneAction::targets: read_targets(action); break;
    }
    action.names = node_.expressions().values();
    action.names.erase(time_name);
    return action;
  }

 private:
  /// Which of the kinds' keys stand here: those of one kind only.
  void find_kind(SceneAction& action, bool of_body) {
    static const std::vector<std::pair<SceneAction::Kind, std::vector<const char*>>> kinds{
        {SceneAction::path, {"position", "turn"}},
        {SceneAction::force, {"force", "torque"}},
        {SceneAction::impulse, {"impulse", "angular_impulse"}},
        {SceneAction::motors, {"motors"}},
        {SceneAction::targets, {"targets"}}};
    std::optional<SceneAction::Kind> found;
    for (const auto& [kind, keys] : kinds)
      for (const char* key : keys) {
        const auto value = node_.find(key);
        if (!value) continue;
        if (found && *found != kind) value->fail(fmt::format("an action does one thing: put {} into another", key));
        found = action.kind = kind;
        if (action.is_of_joint() == of_body)
          value->fail(
              fmt::format("a {} has no {}; name a {}", of_body ? "body" : "joint", key, of_body ? "joint" : "body"));
      }
    if (!found)
      node_.fail(of_body ? "what does it do? a body takes position and turn, force and torque, or impulse and "
                           "angular_impulse"
                         : "what does it do? a joint takes motors, or targets");
    if (action.kind == SceneAction::path) need(PLUMB_NEED_KINEMATIC, "kinematic");
    if (action.kind == SceneAction::force || action.kind == SceneAction::impulse) need(PLUMB_NEED_FORCES, "forces");
  }

  void need(PlumbNeeds needs, const char* word) {
    if ((builder_.scene.needs & needs) == 0)
      node_.fail(fmt::format("this is for scenes that need \"{}\": add it to needs", word));
  }

  void read_window(SceneAction& action) {
    const double end = builder_.scene.seconds;
    const bool once = action.kind == SceneAction::impulse;
    for (const char* key : {"at", "over"})
      if (const auto stray = node_.find(key); stray && (key == std::string("at")) != once)
        stray->fail(once ? "an impulse has the time \"at\"" : "this lasts: give it the times \"over\", [begin, end]");
    action.end = end;
    if (once) {
      action.begin = action.end = constant(node_.at("at"));
      check_time(node_.at("at"), action.begin);
    } else if (const auto over = node_.find("over")) {
      if (action.kind == SceneAction::path) over->fail("a path is for the whole run; give its expressions the times");
      const auto times = over->elements();
      if (times.size() != 2) over->fail("over must be a window of two times: [begin, end]");
      action.begin = constant(times[0]);
      action.end = constant(times[1]);
      for (const Node& time : times) check_time(time, constant(time));
      if (!(action.begin < action.end))
        over->fail(fmt::format("the window from {:g} to {:g} s is empty", action.begin, action.end));
    }
  }

  void check_time(const Node& node, double time) const {
    const double end = builder_.scene.seconds;
    if (!(time >= 0 && time <= end)) node.fail(fmt::format("{:g} s is not within the run, 0 to {:g} s", time, end));
  }

  double constant(const Node& node) const {
    if (node.json().is_string() && Expressions::uses(node.text(), time_name)) node.fail("this may not use the time t");
    return node.number();
  }

  /// A number over time; judged at both ends of the action.
  SceneAction::Number number(const SceneAction& action, const Node& node) {
    SceneAction::Number number;
    for (const double time : {action.end, action.begin}) {
      time_.at(time);
      number.constant = node.number();
    }
    if (node.json().is_string() && Expressions::uses(node.text(), time_name)) number.text = node.text();
    return number;
  }

  std::vector<SceneAction::Number> vector(const SceneAction& action, const char* key) {
    const auto node = node_.find(key);
    if (!node) return std::vector<SceneAction::Number>(3);
    if (!node->json().is_array() || node->json().size() != 3) node->fail("expected an array of three numbers");
    std::vector<SceneAction::Number> numbers;
    for (const Node& element : node->elements()) numbers.push_back(number(action, element));
    return numbers;
  }

  void read_path(SceneAction& action) {
    const PlumbBodyDesc& desc = builder_.scene.bodies[action.target].desc;
    if (desc.motion != PLUMB_KINEMATIC) node_.at("body").fail("only a kinematic body follows a path");
    const PlumbVec3 start = desc.pose.position;
    if (const auto position = node_.find("position")) {
      action.numbers = vector(action, "position");
      const std::array<double, 3> there{start.x, start.y, start.z};
      for (std::size_t i = 0; i < 3; ++i)
        if (std::abs(action.numbers[i].constant - there[i]) > 1e-9 * (1 + std::abs(there[i])))
          position->elements()[i].fail(
              fmt::format("the path begins at {:g}, and the body at {:g}", action.numbers[i].constant, there[i]));
    } else {
      action.numbers = {{start.x, ""}, {start.y, ""}, {start.z, ""}};
    }
    action.axis = {0, 1, 0};
    SceneAction::Number angle;
    if (const auto turn = node_.find("turn")) {
      turn->only(scene_keys().at("turn"));
      action.axis = turn->at("axis").vector();
      const double length = std::hypot(action.axis.x, action.axis.y, action.axis.z);
      if (length == 0) turn->at("axis").fail("an axis must not be 0 0 0");
      action.axis = {action.axis.x / length, action.axis.y / length, action.axis.z / length};
      angle = number(action, turn->at("radians"));
      if (std::abs(angle.constant) > 1e-9)
        turn->at("radians").fail(fmt::format("the turn begins at {:g}, and the body at 0", angle.constant));
    }
    action.numbers.push_back(angle);
  }

  void read_push(SceneAction& action, const char* linear, const char* angular) {
    if (builder_.scene.bodies[action.target].desc.motion != PLUMB_DYNAMIC)
      node_.at("body").fail("only a dynamic body can be pushed");
    action.numbers = vector(action, linear);
    const auto more = vector(action, angular);
    action.numbers.insert(action.numbers.end(), more.begin(), more.end());
  }

  void read_motors(SceneAction& action) {
    const PlumbJointDesc& desc = builder_.scene.joints[action.target].desc;
    for (const PlumbMotor& motor : desc.motors) {
      action.numbers.push_back({motor.target_velocity, ""});
      action.numbers.push_back({motor.max_force, ""});
    }
    for_each_axis(node_.at("motors"), [&](std::size_t axis, const Node& motor) {
      motor.only(scene_keys().at("motor_over_time"));
      if (desc.motors[axis].enabled == 0) motor.fail("the joint has no motor on this axis; give it one of force 0");
      const auto speed = motor.find("target_velocity"), most = motor.find("max_force");
      if (!speed && !most) motor.fail("a motor changes its target_velocity or its max_force");
      if (speed) action.numbers[2 * axis] = number(action, *speed);
      if (!most) return;
      action.numbers[2 * axis + 1] = number(action, *most);
      if (action.numbers[2 * axis + 1].constant < 0) most->fail("max_force is below 0");
    });
  }

  void read_targets(SceneAction& action) {
    const PlumbJointDesc& desc = builder_.scene.joints[action.target].desc;
    const bool rod = desc.type == PLUMB_JOINT_DISTANCE;
    for (const PlumbSpring& spring : desc.springs) action.numbers.push_back({spring.rest, ""});
    if (rod) action.numbers[0].constant = desc.rest_length;
    for_each_axis(node_.at("targets"), [&](std::size_t axis, const Node& target) {
      if (desc.springs[axis].enabled == 0 && !(rod && axis == 0)) target.fail("the joint has no spring on this axis");
      action.numbers[axis] = number(action, target);
      if (rod && action.numbers[axis].constant < 0) target.fail("the length of a distance joint is below 0");
    });
  }

  const Node& node_;
  const SceneBuilder& builder_;
  KnownTime time_;
};

}  // namespace

void read_host(const Node& host, SceneBuilder& builder) {
  for (const Node& node : host.elements()) {
    node.only(scene_keys().at("action"));
    for_each_repeat(node, [&] { builder.scene.host.push_back(ActionReader(node, builder).read()); });
  }
}

}  // namespace plumb::harness
