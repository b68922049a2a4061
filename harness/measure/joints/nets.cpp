// Measure of nets and chains of joints that start whole or stretched.
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/joints/joints.hpp"

namespace plumb::harness {

void measure_net(MeasureContext& context) {
  constexpr double closed = 0.1;  // of the length: a gap below it has settled
  constexpr double last_second = 1;
  const Scene& scene = context.scene();
  const double length = arg_number(scene, "length");
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  double gap = 0, end_gap = 0, speed = 0, settled = not_measured;
  simulation.run([&](Simulation& now) {
    const double widest = view.joint_gap(now.poses());
    gap = largest(gap, widest);
    if (now.time() > scene.seconds - last_second + scene.dt / 2) end_gap = largest(end_gap, widest);
    if (!(widest < closed * length))
      settled = not_measured;
    else if (std::isnan(settled))
      settled = now.time();
    for (const VelocityRow& velocity : now.velocities()) speed = largest(speed, referee::vec(velocity.linear).norm());
  });
  context.expect("finite", simulation.finite(), true);
  if (arg_number(scene, "stretched") == 0)
    context.deviation("gap", gap / length);
  else
    context.deviation("settling", settled);
  context.deviation("end_gap", end_gap / length);
  context.deviation("speed", speed);
}

}  // namespace plumb::harness
