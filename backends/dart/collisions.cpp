#include "collisions.hpp"

#include <dart/collision/ode/OdeCollisionDetector.hpp>

namespace plumb::dart6 {

using ::dart::collision::CollisionObject;
using ::dart::collision::Contact;

class Collisions::Filter final : public ::dart::collision::CollisionFilter {
 public:
  Filter(const Skeletons& skeletons, May may) : skeletons_(skeletons), may_(std::move(may)) {}
  bool ignoresCollision(const CollisionObject* a, const CollisionObject* b) const override {
    return !may_(skeletons_.geom(*a), skeletons_.geom(*b));
  }

 private:
  const Skeletons& skeletons_;
  May may_;
};

Collisions::Collisions() : detector_(::dart::collision::OdeCollisionDetector::create()) {}
Collisions::~Collisions() = default;

void Collisions::forget() {
  result_.clear();
  group_.reset();
  filter_.reset();
}

void Collisions::take(const Skeletons& skeletons, May may) {
  filter_ = std::make_shared<Filter>(skeletons, std::move(may));
  group_ = detector_->createCollisionGroup();
  group_->setAutomaticUpdate(false);
  for (const auto& skeleton : skeletons.all) group_->addShapeFramesOf(skeleton.get());
}

std::vector<Contact*> Collisions::find() {
  std::vector<Contact*> found;
  result_.clear();
  if (!group_) return found;
  // ODE has memory of its own for each thread that collides, and a detector takes it where it is made.
  thread_local const auto of_this_thread = ::dart::collision::OdeCollisionDetector::create();
  constexpr std::size_t all = 1'000'000;
  group_->collide(::dart::collision::CollisionOption(true, all, filter_), &result_);
  for (std::size_t i = 0; i < result_.getNumContacts(); ++i) {
    Contact& contact = result_.getContact(i);
    if (!Contact::isZeroNormal(contact.normal) && contact.penetrationDepth >= 0) found.push_back(&contact);
  }
  return found;
}

}  // namespace plumb::dart6
