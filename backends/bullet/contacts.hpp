// A point of Bullet's as the interface has contacts.
#pragma once

#include "body.hpp"

namespace plumb::bullet {

[[nodiscard]] PlumbContact contact_of(const btManifoldPoint& point, const Body& a, const Body& b, bool with_impulses);

}  // namespace plumb::bullet
