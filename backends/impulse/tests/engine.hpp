// The engine behind its interface, linked in, with the host that a test wants.
#pragma once

#include "hashes/scene.hpp"
#include "plugin/world.hpp"
#include "plumb/backend/tables.hpp"

namespace plumb::impulse::test {

/// host: for the worlds made from now on; may be null.
inline Backend engine(const PlumbHost* host = nullptr) {
  backend::Tables<World>::host = host;
  return Backend(negotiate(&backend::open<World>, "impulse"));
}

}  // namespace plumb::impulse::test
