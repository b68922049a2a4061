// Save and restore: the skeletons' coordinates and their rates are all that a step begins with, so the same steps give
// the same bits again.
#include "articulated/snapshot_rows.hpp"
#include "world.hpp"

namespace plumb::dart6 {
PlumbResult World::save(std::span<const std::byte>& data) {
  prepare();
  snapshot_.clear();
  articulated::append(snapshot_, &gravity_, 1);
  for (const auto& skeleton : skeletons_.all) {
    const Eigen::VectorXd position = skeleton->getPositions(), rate = skeleton->getVelocities();
    articulated::append(snapshot_, position.data(), skeleton->getNumDofs());
    articulated::append(snapshot_, rate.data(), skeleton->getNumDofs());
  }
  articulated::append_bodies(snapshot_, bodies_);
  articulated::append_touching(snapshot_, touches_.touching());
  data = snapshot_;
  return PLUMB_OK;
}

PlumbResult World::restore(std::span<const std::byte> data) {
  prepare();
  PlumbVec3 gravity{};
  articulated::take(data, &gravity, 1);
  std::vector<Eigen::VectorXd> saved;  // position and rate of each skeleton
  for (const auto& skeleton : skeletons_.all)
    for (int i = 0; i < 2; ++i) {
      saved.emplace_back(static_cast<Eigen::Index>(skeleton->getNumDofs()));
      articulated::take(data, saved.back().data(), skeleton->getNumDofs());
    }
  const std::vector<articulated::BodyState> states = articulated::take_bodies(data, bodies_);
  std::vector<articulated::Touching> touching = articulated::take_touching(data);
  set_gravity(gravity);
  auto state = states.begin();
  for (const auto& body : bodies_) {
    if (!body) continue;
    articulated::put_back(*state++, *body);
    body->written = body->is(PLUMB_STATIC) || !body->turns();
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
