// Records a trace of a falling particle: record_trace BACKEND FILE [fail]. With `fail`, the backend refuses a call that
// it can do, so that a replay differs.
#include <cstdio>

#include "plumb/layers.hpp"
#include "plumb/loader.hpp"

int main(int argc, char** argv) {
  using namespace plumb;
  if (argc < 3) return std::fputs("record_trace BACKEND FILE [fail]\n", stderr), 2;
  const PlumbBackendTable* backend = &open_backend(argv[1]).table();
  if (argc == 4) backend = layers::inject(backend, {"set_gravity", 1, PLUMB_E_UNSUPPORTED});
  const PlumbBackendTable* traced = layers::trace(backend, argv[2]);
  {
    const auto world = Backend(traced).create_world(world_desc(0));
    PlumbBodyDesc body = body_desc();
    body.flags = PLUMB_BODY_NO_ROTATION;
    body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    body.mass = 1;
    body.material = {};
    PlumbBody id = 0;
    check(*world, world->create_bodies({&body, 1}, {&id, 1}));
    PlumbStepReport report{};
    for (int step = 0; step < 30; ++step) {
      if (step == 12) static_cast<void>(world->set_gravity({0, 0, 1}));
      check(*world, world->step(0.01));
      check(*world, world->wait(report));
    }
  }
  layers::end_trace(traced);
}
