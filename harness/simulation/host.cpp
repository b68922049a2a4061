#include "simulation/host.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include "simulation/simulation.hpp"

namespace plumb::harness {
namespace {

/// First b, then a.
PlumbQuat product(const PlumbQuat& a, const PlumbQuat& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

}  // namespace

Host::Host(const Scene& scene) : scene_(scene) {
  for (const SceneAction& action : scene.host) {
    actors_.push_back({&action, std::make_unique<Expressions>()});
    for (const auto& [name, value] : action.names) actors_.back().names->set(name, value);
  }
  for (std::size_t i = 0; i < scene.joints.size(); ++i)
    if (std::isfinite(scene.joints[i].cut)) cuts_.push_back({i, scene.joints[i].cut});
  std::stable_sort(cuts_.begin(), cuts_.end(), [](const Cut& a, const Cut& b) { return a.time > b.time; });
}

std::vector<double> Host::Actor::numbers(double time) const {
  names->set("t", time);
  std::vector<double> values;
  for (const SceneAction::Number& number : action->numbers) {
    try {
      values.push_back(number.text.empty() ? number.constant : names->evaluate(number.text));
    } catch (const std::invalid_argument& error) {
      throw Error(PLUMB_E_INVALID_ARGUMENT,
                  "the host's action on " + action->name + " at " + std::to_string(time) + " s: " + error.what());
    }
  }
  return values;
}

void Host::act(Simulation& simulation, const Actor& actor) const {
  const SceneAction& action = *actor.action;
  const double dt = scene_.dt, begin = simulation.time(), middle = begin + dt / 2;
  const auto push = [&](PlumbField field, std::span<const double> row) {
    if (std::any_of(row.begin(), row.end(), [](double number) { return number != 0; }))
      simulation.write(field, action.target, row);
  };
  if (action.kind == SceneAction::path) {
    const std::vector<double> to = actor.numbers(begin + dt);
    const double half = to[3] / 2, sine = std::sin(half);
    const PlumbQuat turn{action.axis.x * sine, action.axis.y * sine, action.axis.z * sine, std::cos(half)};
    const PlumbQuat q = product(turn, scene_.bodies[action.target].desc.pose.orientation);
    simulation.write(PLUMB_FIELD_KINEMATIC_TARGET, action.target, std::array{to[0], to[1], to[2], q.x, q.y, q.z, q.w});
  } else if (action.kind == SceneAction::impulse) {
    if (action.begin < begin - dt * 1e-6 || action.begin >= begin + dt * (1 - 1e-6)) return;
    const std::vector<double> row = actor.numbers(action.begin);
    push(PLUMB_FIELD_IMPULSE, std::span(row).first(3));
    push(PLUMB_FIELD_ANGULAR_IMPULSE, std::span(row).last(3));
  } else {
    if (middle < action.begin || middle > action.end) return;
    const std::vector<double> row = actor.numbers(middle);
    if (action.is_of_joint()) {
      const PlumbJoint id = simulation.joint_handle(action.target);
      const PlumbJointField field = action.kind == SceneAction::motors ? PLUMB_JOINT_MOTOR : PLUMB_JOINT_SPRING_REST;
      const ConstRows rows(reinterpret_cast<const std::byte*>(row.data()), 1, row.size() * sizeof(double), PLUMB_F64);
      check(simulation.world(), simulation.world().joints()->write_joints(field, {&id, 1}, rows));
    } else {
      push(PLUMB_FIELD_FORCE, std::span(row).first(3));
      push(PLUMB_FIELD_TORQUE, std::span(row).last(3));
    }
  }
}

void Host::before_step(Simulation& simulation) {
  while (!cuts_.empty() && cuts_.back().time <= simulation.time() + scene_.dt * 1e-6) {
    const PlumbJoint id = simulation.joint_handle(cuts_.back().joint);
    check(simulation.world(), simulation.world().joints()->destroy_joints({&id, 1}));
    cuts_.pop_back();
  }
  for (const Actor& actor : actors_) {
    const bool gone =
        actor.action->is_of_joint() && simulation.time() >= scene_.joints[actor.action->target].cut - scene_.dt * 1e-6;
    if (!gone) act(simulation, actor);
  }
}

}  // namespace plumb::harness
