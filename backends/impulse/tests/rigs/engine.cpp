// Apart from its header, so that the interface's templates are compiled once and not with every test.
#include "tests/rigs/engine.hpp"

#include "plugin/open.hpp"
#include "plugin/world.hpp"
#include "plumb/backend/tables.hpp"

namespace plumb::impulse::test {

Backend engine(const PlumbHost* host) {
  backend::Tables<World>::host = host;
  return Backend(negotiate(&open, "impulse"));
}

}  // namespace plumb::impulse::test
