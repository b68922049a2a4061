#include "measure/instruments/mechanics.hpp"

#include <cmath>

namespace plumb::harness {

referee::ShapePtr shape_of(const Scene& scene, std::size_t index) {
  const SceneShape& shape = scene.shapes[index];
  if (shape.children.empty()) return referee::Shape::make(shape.descriptor());
  std::vector<PlumbCompoundChild> rows;
  std::vector<referee::ShapePtr> children;
  for (const SceneShape::Child& child : shape.children) {
    PlumbCompoundChild row{};
    row.pose = child.pose;
    rows.push_back(row);
    children.push_back(shape_of(scene, child.shape));
  }
  PlumbShapeDesc desc = shape.descriptor();
  desc.children = rows.data();
  desc.child_count = static_cast<std::uint32_t>(rows.size());
  return referee::Shape::make(desc, children);
}

referee::Mass mass_of_body(const Scene& scene, std::size_t body) {
  const SceneBody& described = scene.bodies[body];
  const referee::ShapePtr shape = described.shape ? shape_of(scene, *described.shape) : nullptr;
  return referee::mass_of(described.desc, shape.get());
}

referee::BodyState state_of(Simulation& simulation, std::size_t body, const referee::Mass& mass) {
  return referee::body_state(mass, simulation.poses()[body], simulation.velocities()[body]);
}

void compare_biased(MeasureContext& context, const std::string& name, double value, double truth, double scale,
                    double semi_implicit, const std::string& note) {
  context.add({name, value, truth, std::abs(value - truth) / scale, std::abs(value - semi_implicit) / scale, note});
}

}  // namespace plumb::harness
