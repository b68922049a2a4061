// Save and restore: MuJoCo's coordinates, their rates and its warm start are all that a step begins with, so the same
// steps give the same bits again.
#include "articulated/snapshot_rows.hpp"
#include "world.hpp"

namespace plumb::mujoco {
namespace {

struct Coordinates {
  std::vector<mjtNum> position, rate, warm;

  explicit Coordinates(const mjModel& m)
      : position(static_cast<std::size_t>(m.nq)), rate(static_cast<std::size_t>(m.nv)), warm(rate.size()) {}
};

}  // namespace

PlumbResult World::save(std::span<const std::byte>& data) {
  prepare();
  const mjModel& m = *model_.model;
  const mjData& d = *model_.data;
  snapshot_.clear();
  articulated::append(snapshot_, &gravity_, 1);
  articulated::append(snapshot_, d.qpos, static_cast<std::size_t>(m.nq));
  articulated::append(snapshot_, d.qvel, static_cast<std::size_t>(m.nv));
  articulated::append(snapshot_, d.qacc_warmstart, static_cast<std::size_t>(m.nv));
  articulated::append_bodies(snapshot_, bodies_);
  articulated::append_touching(snapshot_, touches_.touching());
  data = snapshot_;
  return PLUMB_OK;
}

PlumbResult World::restore(std::span<const std::byte> data) {
  prepare();
  mjData& d = *model_.data;
  Coordinates saved(*model_.model);
  PlumbVec3 gravity{};
  articulated::take(data, &gravity, 1);
  articulated::take(data, saved.position.data(), saved.position.size());
  articulated::take(data, saved.rate.data(), saved.rate.size());
  articulated::take(data, saved.warm.data(), saved.warm.size());
  const std::vector<articulated::BodyState> states = articulated::take_bodies(data, bodies_);
  std::vector<articulated::Touching> touching = articulated::take_touching(data);
  set_gravity(gravity);
  auto state = states.begin();
  for (const auto& body : bodies_) {
    if (!body) continue;
    articulated::put_back(*state++, *body);
    body->written = body->is(PLUMB_STATIC);
  }
  write_state();  // of what stands still
  std::copy(saved.position.begin(), saved.position.end(), d.qpos);
  std::copy(saved.rate.begin(), saved.rate.end(), d.qvel);
  std::copy(saved.warm.begin(), saved.warm.end(), d.qacc_warmstart);
  touches_.touching() = std::move(touching);
  pending_events_.clear();
  contacts_.clear();
  return PLUMB_OK;
}

}  // namespace plumb::mujoco
