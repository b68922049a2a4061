/* Fails to compile when the layout of a struct or the value of a constant is not as it was recorded. */
#include <assert.h>
#include <stddef.h>

#include "plumb/plumb.h"

#define SIZE(type, size) static_assert(sizeof(type) == (size), #type " has changed its size");
#define AT(type, member, offset) static_assert(offsetof(type, member) == (offset), #type "." #member " has moved");
#define IS(name, value) static_assert((name) == (value), #name " has another value");

static_assert(sizeof(void*) == 8, "the recorded layout is that of 64-bit machines");
#include "layout.inl"

/* names by which tables and the symbol are asked for: as long as they were */
static_assert(sizeof(PLUMB_EXT_CLOSEST) == sizeof("plumb.closest/1"), "PLUMB_EXT_CLOSEST has changed");
static_assert(sizeof(PLUMB_EXT_COLLIDE) == sizeof("plumb.collide/1"), "PLUMB_EXT_COLLIDE has changed");
static_assert(sizeof(PLUMB_EXT_COOKING) == sizeof("plumb.cooking/1"), "PLUMB_EXT_COOKING has changed");
static_assert(sizeof(PLUMB_EXT_DEBUG) == sizeof("plumb.debug/1"), "PLUMB_EXT_DEBUG has changed");
static_assert(sizeof(PLUMB_EXT_JOINTS) == sizeof("plumb.joints/1"), "PLUMB_EXT_JOINTS has changed");
static_assert(sizeof(PLUMB_EXT_MANIFOLDS) == sizeof("plumb.manifolds/1"), "PLUMB_EXT_MANIFOLDS has changed");
static_assert(sizeof(PLUMB_EXT_MODIFY) == sizeof("plumb.modify/1"), "PLUMB_EXT_MODIFY has changed");
static_assert(sizeof(PLUMB_EXT_QUERIES) == sizeof("plumb.queries/1"), "PLUMB_EXT_QUERIES has changed");
static_assert(sizeof(PLUMB_EXT_SETTINGS) == sizeof("plumb.settings/1"), "PLUMB_EXT_SETTINGS has changed");
static_assert(sizeof(PLUMB_EXT_SNAPSHOT) == sizeof("plumb.snapshot/1"), "PLUMB_EXT_SNAPSHOT has changed");
static_assert(sizeof(PLUMB_EXT_STATE) == sizeof("plumb.state/1"), "PLUMB_EXT_STATE has changed");
static_assert(sizeof(PLUMB_EXT_WORLDS) == sizeof("plumb.worlds/1"), "PLUMB_EXT_WORLDS has changed");
static_assert(sizeof(PLUMB_OPEN_SYMBOL) == sizeof("plumb_backend_open"), "the symbol has changed");
