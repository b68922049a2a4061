// The door of the engine's own library, behind that of the plugin.
#pragma once

#include "plumb/plumb.h"

/// As plumb_backend_open.
extern "C" PLUMB_EXPORT PlumbResult plumb_impulse_open(const PlumbOpenRequest* request, PlumbOpenReply* reply);
