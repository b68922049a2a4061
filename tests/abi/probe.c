/* Takes every struct of the wall, and every member of one, by pointer in an exported function of its own: abidw
 * describes only types that an export reaches. Growing structs are exempt from the comparison, not their members. */
#include "plumb/plumb.h"

#define SIZE(type, size)                       \
  PLUMB_EXPORT void probe_##type(type* value); \
  void probe_##type(type* value) { (void)value; }
#define AT(type, member, offset)                                                    \
  PLUMB_EXPORT void probe_##type##_##member(__typeof__(((type*)0)->member)* value); \
  void probe_##type##_##member(__typeof__(((type*)0)->member)* value) { (void)value; }
#define IS(name, value)

#include "layout.inl"
