#include "measure/instruments/step_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "measure/instruments/mechanics.hpp"
#include "referee/contact_patch.hpp"

namespace plumb::harness {
namespace {

using referee::BodyState;
using referee::vec;

std::string obstacle_in(const Scene& scene, const std::vector<referee::ShapePtr>& shapes) {
  if (!scene.joints.empty()) return "it has joints";
  if ((scene.needs & PLUMB_NEED_COLLISION) == 0) return "nothing collides in it";
  if ((scene.needs & PLUMB_NEED_SURFACE_VELOCITY) != 0) return "it has moving surfaces";
  if ((scene.needs & PLUMB_NEED_ROLLING_FRICTION) != 0) return "it has rolling friction";
  if ((scene.needs & PLUMB_NEED_KINEMATIC) != 0) return "it has kinematic bodies";
  if ((scene.needs & PLUMB_NEED_FORCES) != 0) return "the host pushes bodies";
  if ((scene.needs & PLUMB_NEED_DAMPING) != 0) return "it has damping";
  for (const SceneBody& body : scene.bodies) {
    if (body.desc.gravity_scale != 1 || body.desc.locks != 0)
      return "body " + body.name + " has its own gravity, or locked axes";
    if (body.shape && !referee::has_patches(*shapes[*body.shape]))
      return "body " + body.name + " is a plane, a cylinder, a mesh or a height field";
  }
  for (const SceneShape& shape : scene.shapes)
    for (const SceneShape::Child& child : shape.children)
      if (child.material) return "parts of shape " + shape.name + " have materials of their own";
  return "";
}

}  // namespace

StepContacts::StepContacts(const Scene& scene) : scene_(&scene) {
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) shapes_.push_back(shape_of(scene, i));
  obstacle_ = obstacle_in(scene, shapes_);
  if (!obstacle_.empty()) return;
  double smallest = INFINITY;
  for (const SceneBody& body : scene.bodies) {
    const referee::Shape* shape = body.shape ? shapes_[*body.shape].get() : nullptr;
    masses_.push_back(referee::mass_of(body.desc, shape));
    const referee::Aabb bounds = shape != nullptr ? shape->bounds({}) : referee::Aabb{};
    const referee::Vec3 furthest =
        (bounds.high - masses_.back().centre).cwiseAbs().cwiseMax((bounds.low - masses_.back().centre).cwiseAbs());
    radii_.push_back(shape != nullptr ? furthest.norm() : 0);
    if (shape != nullptr && masses_.back().mass > 0) smallest = std::min(smallest, radii_.back());
  }
  flat_ = std::isfinite(smallest) ? 0.01 * smallest : 0;
}

reference::StepForces StepContacts::forces() const {
  return {vec(scene_->gravity), scene_->dt, (scene_->needs & PLUMB_NEED_GYROSCOPIC) != 0};
}

bool StepContacts::may_meet(std::size_t a, std::size_t b) const {
  const SceneBody &first = scene_->bodies[a], &second = scene_->bodies[b];
  return first.shape && second.shape && (masses_[a].mass > 0 || masses_[b].mass > 0) &&
         ((first.desc.flags | second.desc.flags) & PLUMB_BODY_SENSOR) == 0 &&
         may_touch(first.desc.filter, second.desc.filter);
}

std::vector<FoundContact> StepContacts::find(std::span<const BodyState> before) const {
  std::vector<FoundContact> found;
  const double dt = scene_->dt;
  const referee::Vec3 fall = dt * vec(scene_->gravity);
  const auto speed_of = [&](std::size_t body) {
    return before[body].linear.norm() + before[body].angular.norm() * radii_[body] + fall.norm();
  };
  for (std::size_t a = 0; a < before.size(); ++a) {
    for (std::size_t b = a + 1; b < before.size(); ++b) {
      if (!may_meet(a, b)) continue;
      const double reach = flat_ + dt * (speed_of(a) + speed_of(b));
      const SceneBody &first = scene_->bodies[a], &second = scene_->bodies[b];
      const referee::Shape &shape_a = *shapes_[*first.shape], &shape_b = *shapes_[*second.shape];
      referee::Aabb around = shape_a.bounds(before[a].pose);
      around.low.array() -= reach;
      around.high.array() += reach;
      if (!around.overlaps(shape_b.bounds(before[b].pose))) continue;
      const PlumbMaterial &one = first.desc.material, &other = second.desc.material;
      for (const referee::PatchPoint& at :
           referee::contact_patch(shape_a, before[a].pose, shape_b, before[b].pose, flat_, reach)) {
        const referee::Vec3 relative = before[b].velocity_at(at.point) - before[a].velocity_at(at.point);
        const double speed = at.normal.dot(relative);
        const double pull = at.normal.dot(fall) * ((masses_[b].mass > 0 ? 1 : 0) - (masses_[a].mass > 0 ? 1 : 0));
        found.push_back({{a, b, at.point, at.normal, std::sqrt(one.friction * other.friction), 0},
                         at.gap,
                         speed,
                         speed + pull,
                         std::max(one.restitution, other.restitution)});
      }
    }
  }
  return found;
}

reference::StepProblem StepContacts::problem(std::span<const BodyState> before) const {
  std::vector<reference::StepContact> contacts;
  for (FoundContact& found : find(before)) {
    found.contact.bias = found.gap > 0 ? found.gap / scene_->dt : found.restitution * std::min(0.0, found.speed);
    contacts.push_back(found.contact);
  }
  return {before, std::move(contacts), forces()};
}

}  // namespace plumb::harness
