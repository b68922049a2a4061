// A host in C++ on the installed package: finds a backend by name and drops a particle for a second.
#include <cstdio>

#include "plumb/loader.hpp"

int main(int argc, char** argv) {
  try {
    const plumb::Backend backend = plumb::open_backend(argc == 2 ? argv[1] : "");
    const auto world = backend.create_world(plumb::world_desc(0));
    PlumbBodyDesc body = plumb::body_desc();
    body.flags = PLUMB_BODY_NO_ROTATION;
    body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    body.mass = 1;
    body.material = {};
    PlumbBody id = 0;
    plumb::check(*world, world->create_bodies({&body, 1}, {&id, 1}));
    PlumbStepReport report{};
    for (int i = 0; i < 1000; ++i) {
      plumb::check(*world, world->step(0.001));
      plumb::check(*world, world->wait(report));
    }
    PlumbPose pose;
    plumb::check(*world, world->read(PLUMB_FIELD_POSE, {}, plumb::rows_over<PlumbPose>({&pose, 1})));
    std::printf("%s: fell %.3f m\n", backend.info().name, -pose.position.y);
  } catch (const plumb::Error& error) {
    std::fprintf(stderr, "fall: %s\n", error.what());
    return 1;
  }
}
