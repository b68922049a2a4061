// How the engine is opened, whichever library it stands in.
#pragma once

#include "plumb/plumb.h"

namespace plumb::impulse {

/// As plumb_backend_open. Every call that comes in through the tables runs in the rounding that results rely on, in
/// whatever mode the host's thread is, and leaves the host's mode as it was.
PlumbResult open(const PlumbOpenRequest* request, PlumbOpenReply* reply);

}  // namespace plumb::impulse
