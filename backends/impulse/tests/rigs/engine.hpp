// The engine behind its interface, linked in, with the host that a test wants.
#pragma once

#include "tests/hashes/scene.hpp"

namespace plumb::impulse::test {

/// host: for the worlds made from now on; may be null.
Backend engine(const PlumbHost* host = nullptr);

}  // namespace plumb::impulse::test
