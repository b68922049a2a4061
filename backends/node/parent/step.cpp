// A step: what acts goes along, and what happened comes back.
#include <cmath>

#include "append.hpp"
#include "plumb/backend/small_math.hpp"
#include "world.hpp"

namespace plumb::wire {

using namespace backend;

namespace {
constexpr std::uint32_t kNotKnown = 0xffffffffu;

/// A count from the wire: NaN and what is below 0 stand for "not known".
std::uint32_t count_of(double number, std::uint32_t otherwise) {
  return number >= 0 && number < 4e9 ? static_cast<std::uint32_t>(number) : otherwise;
}
}  // namespace

PlumbResult World::step(double dt) {
  aim_kinematics(dt);
  std::vector<double> row = {dt, double(pushes_.size())};
  for (const auto& [id, push] : pushes_) {
    row.push_back(slot_of(id));
    append(row, push.force);
    append(row, push.torque);
  }
  const Frame reply = call(Call::kStep, row);
  if (reply.numbers.size() < 3 || reply.numbers.size() % 2 == 0)
    throw Error(PLUMB_E_WORLD_LOST, "the child's answer to a step is not of its form; see WIRE.md");
  pushes_.clear();
  settle_kinematics();
  events_.swap(ended_);
  ended_.clear();
  report_ = {};
  report_.phase_seconds[PLUMB_PHASE_SOLVE] = reply.numbers[0];
  report_.contacts = count_of(reply.numbers[1], 0);
  report_.pairs = count_of(reply.numbers[2], kNotKnown);
  if (needs(PLUMB_NEED_EVENTS) || needs(PLUMB_NEED_SENSORS)) take_touches(std::span(reply.numbers).subspan(3));
  take_sleep();
  break_joints(dt);
  sort_events(events_);
  return PLUMB_OK;
}

PlumbResult World::wait(PlumbStepReport& report) {
  report.phase_seconds[PLUMB_PHASE_SOLVE] = report_.phase_seconds[PLUMB_PHASE_SOLVE];
  report.contacts = report_.contacts;
  report.pairs = report_.pairs;
  report.awake = report_.awake;
  return PLUMB_OK;
}

// Towards the target by velocity, so that what it carries is carried along.
void World::aim_kinematics(double dt) {
  std::vector<PlumbBody> moved = aimed_;
  std::vector<double> speeds(6 * moved.size(), 0.0);  // who has no new target stands still
  std::vector<PlumbBody> aimed;
  for (const auto& [id, target] : targets_) aimed.push_back(id);
  if (!aimed.empty()) {
    const std::vector<double> poses = read_rows(PLUMB_FIELD_POSE, aimed);
    for (std::size_t i = 0; i < aimed.size(); ++i) {
      const PlumbPose from = pose_at(&poses[7 * i]), to = targets_[aimed[i]];
      moved.push_back(aimed[i]);
      append(speeds, scale(1 / dt, sub(to.position, from.position)));
      append(speeds, scale(1 / dt, rotation_vector(multiply(to.orientation, conjugate(from.orientation)))));
    }
  }
  write_rows(PLUMB_FIELD_VELOCITY, moved, speeds);
  aimed_ = std::move(aimed);
}

void World::settle_kinematics() {
  std::vector<double> poses;
  for (const PlumbBody id : aimed_) append(poses, targets_[id]);
  write_rows(PLUMB_FIELD_POSE, aimed_, poses);
  targets_.clear();
}

void World::take_touches(std::span<const double> pairs) {
  const auto is_sensor = [&](PlumbBody id) { return (body(id).desc.flags & PLUMB_BODY_SENSOR) != 0; };
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const PlumbBody a = handle_of(pairs[i]), b = handle_of(pairs[i + 1]);
    if (is_sensor(a)) touches_.touch_sensor(a, b);
    if (is_sensor(b)) touches_.touch_sensor(b, a);
    if (!is_sensor(a) && !is_sensor(b)) touches_.touch(a, b);
  }
  touches_.finish_step(events_);
}

void World::take_sleep() {
  std::vector<PlumbBody> dynamic;
  for (const Body& one : bodies_)
    if (one.handle != 0 && one.desc.motion == PLUMB_DYNAMIC) dynamic.push_back(one.handle);
  report_.awake = static_cast<std::uint32_t>(dynamic.size());
  if (dynamic.empty() || !needs(PLUMB_NEED_SLEEPING)) return;
  const std::vector<double> awake = read_rows(PLUMB_FIELD_AWAKE, dynamic);
  report_.awake = 0;
  for (std::size_t i = 0; i < dynamic.size(); ++i) {
    Body& one = body(dynamic[i]);
    const bool now = awake[i] != 0;
    if (now) ++report_.awake;
    if (now != one.awake) events_.push_back({now ? PLUMB_EVENT_WAKE : PLUMB_EVENT_SLEEP, 0, dynamic[i], 0, 0});
    one.awake = now;
  }
}

std::span<const PlumbContact> World::contacts() {
  constexpr std::size_t columns = 16;
  const Frame reply = call(Call::kContacts, {});
  contacts_.clear();
  for (std::size_t at = 0; at + columns <= reply.numbers.size(); at += columns) {
    const double* row = &reply.numbers[at];
    PlumbContact contact{};
    contact.body_a = handle_of(row[0]);
    contact.body_b = handle_of(row[1]);
    contact.child_a = count_of(row[2], 0);
    contact.child_b = count_of(row[3], 0);
    contact.position = vec3_at(row + 4);
    contact.normal = vec3_at(row + 7);
    contact.depth = row[10];
    contact.normal_impulse = row[11];
    contact.tangent_impulse = vec3_at(row + 12);
    contact.feature = row[15] > 0 ? static_cast<std::uint64_t>(row[15]) : 0;
    contacts_.push_back(contact);
  }
  return contacts_;
}

}  // namespace plumb::wire
