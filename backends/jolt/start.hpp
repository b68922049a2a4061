// What Jolt needs once in a process before anything of it is made.
#pragma once

namespace plumb::jolt {

/// Making one starts Jolt where it has not been started: a member before all that is Jolt's.
struct Started {
  Started();
};

}  // namespace plumb::jolt
