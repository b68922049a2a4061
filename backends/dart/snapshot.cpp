// Save and restore: the skeletons' coordinates and their rates are all that a step begins with, so the same steps give
// the same bits again.
#include <cstring>

#include "world.hpp"

namespace plumb::dart6 {
namespace {

struct BodyState {
  PlumbPose pose, target;
  PlumbVec3 velocity, spin, force, torque;
  std::uint64_t moving;
};

using Touching = backend::TouchTracker::Pair;

template <class Value>
void append(std::vector<std::byte>& bytes, const Value* values, std::size_t count) {
  const auto* from = reinterpret_cast<const std::byte*>(values);
  bytes.insert(bytes.end(), from, from + count * sizeof(Value));
}

template <class Value>
void take(std::span<const std::byte>& data, Value* values, std::size_t count) {
  const std::size_t size = count * sizeof(Value);
  if (data.size() < size) throw Error(PLUMB_E_CORRUPT, "the snapshot ends too early");
  if (size != 0) std::memcpy(values, data.data(), size);
  data = data.subspan(size);
}

}  // namespace

PlumbResult World::save(std::span<const std::byte>& data) {
  prepare();
  snapshot_.clear();
  append(snapshot_, &gravity_, 1);
  for (const auto& skeleton : skeletons_.all) {
    const Eigen::VectorXd position = skeleton->getPositions(), rate = skeleton->getVelocities();
    append(snapshot_, position.data(), skeleton->getNumDofs());
    append(snapshot_, rate.data(), skeleton->getNumDofs());
  }
  for (const auto& body : bodies_) {
    if (!body) continue;
    const BodyState state{body->pose,
                          body->target,
                          body->velocity,
                          body->spin,
                          body->force,
                          body->torque,
                          static_cast<std::uint64_t>(body->moving)};
    append(snapshot_, &state, 1);
  }
  for (const Touching& pair : touches_.touching()) {
    const std::uint64_t row[3] = {pair.a, pair.b, pair.sensor};
    append(snapshot_, row, 3);
  }
  data = snapshot_;
  return PLUMB_OK;
}

PlumbResult World::restore(std::span<const std::byte> data) {
  prepare();
  PlumbVec3 gravity{};
  take(data, &gravity, 1);
  std::vector<Eigen::VectorXd> saved;  // position and rate of each skeleton
  for (const auto& skeleton : skeletons_.all)
    for (int i = 0; i < 2; ++i) {
      saved.emplace_back(static_cast<Eigen::Index>(skeleton->getNumDofs()));
      take(data, saved.back().data(), skeleton->getNumDofs());
    }
  std::vector<BodyState> states;
  for (const auto& body : bodies_)
    if (body) take(data, &states.emplace_back(), 1);
  std::vector<Touching> touching;
  while (!data.empty()) {
    std::uint64_t row[3];
    take(data, row, 3);
    touching.push_back({row[0], row[1], row[2]});
  }
  set_gravity(gravity);
  auto state = states.begin();
  for (const auto& body : bodies_) {
    if (!body) continue;
    body->pose = state->pose, body->target = state->target;
    body->velocity = state->velocity, body->spin = state->spin;
    body->force = state->force, body->torque = state->torque;
    body->moving = static_cast<Body::Moving>(state->moving);
    body->written = body->is(PLUMB_STATIC) || !body->turns();
    ++state;
  }
  write_state();  // of what is not all in coordinates
  for (std::size_t i = 0; i < skeletons_.all.size(); ++i) {
    skeletons_.all[i]->setPositions(saved[2 * i]);
    skeletons_.all[i]->setVelocities(saved[2 * i + 1]);
  }
  touches_.touching() = std::move(touching);
  pending_events_.clear();
  meeting_.rows.clear();
  return PLUMB_OK;
}

}  // namespace plumb::dart6
