// Measure of friction that sets in motion: a box on a conveyor belt.
#include <array>
#include <cmath>

#include "measure/friction/friction.hpp"
#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "truth/contacts.hpp"

namespace plumb::harness {

void measure_conveyor(MeasureContext& context) {
  Scene scene = context.scene();
  const std::size_t belt = arg_body(scene, "belt"), box = arg_body(scene, "box");
  const double friction = arg_number(scene, "friction"), speed = arg_number(scene, "speed"),
               heading = arg_number(scene, "heading");
  const bool moves = scene.bodies[belt].desc.motion == PLUMB_KINEMATIC;
  scene.needs |= moves ? PLUMB_NEED_KINEMATIC : PLUMB_NEED_SURFACE_VELOCITY;
  const referee::Vec3 along(std::cos(heading), 0, std::sin(heading));
  const referee::Vec3 place = referee::vec(scene.bodies[belt].desc.pose.position);
  Simulation simulation = context.simulate(scene);
  const referee::Vec3 start = referee::vec(simulation.poses()[box].position);
  Series slip_speed;
  slip_speed.add(0, speed);
  double aside = 0;
  referee::Vec3 way = referee::Vec3::Zero();
  while (true) {
    if (moves) {
      const referee::Vec3 next = place + (simulation.time() + scene.dt) * speed * along;
      const std::array<double, 7> target{next.x(), next.y(), next.z(), 0, 0, 0, 1};
      simulation.write(PLUMB_FIELD_KINEMATIC_TARGET, belt, target);
    }
    if (!simulation.advance()) break;
    slip_speed.add(simulation.time(), speed - referee::vec(simulation.velocities()[box].linear).dot(along));
    way = referee::vec(simulation.poses()[box].position) - start;
    way.y() = 0;
    aside = largest(aside, (way - way.dot(along) * along).norm());
  }
  const truth::BeltSlip truth = truth::belt_slip(-scene.gravity.y, friction, speed);
  context.compare("slip_time", slip_speed.end_of_fall().value_or(not_measured), truth.time, 1);
  compare_biased(context, "slip", speed * simulation.time() - way.dot(along), truth.slip, 1,
                 truth.slip - speed * scene.dt / 2);
  context.deviation("aside", aside / truth.slip);
}

}  // namespace plumb::harness
