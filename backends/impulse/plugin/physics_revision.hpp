// The revision of the engine's results: raised whenever a change alters them on purpose, by however little.
#pragma once

#define PLUMB_IMPULSE_PHYSICS_REVISION 22

#define PLUMB_IMPULSE_TEXT_OF(number) #number
#define PLUMB_IMPULSE_TEXT(number) PLUMB_IMPULSE_TEXT_OF(number)
/// The same as a literal, for the name of the build.
#define PLUMB_IMPULSE_PHYSICS_REVISION_TEXT PLUMB_IMPULSE_TEXT(PLUMB_IMPULSE_PHYSICS_REVISION)
