/* plumb.settings/1: an engine's knobs by name, so that a host can list and sweep them without knowing the engine. */
#ifndef PLUMB_SETTINGS_H
#define PLUMB_SETTINGS_H

#include "plumb/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PLUMB_EXT_SETTINGS "plumb.settings/1"

typedef uint32_t PlumbSettingType;
enum { PLUMB_SETTING_BOOL = 0, PLUMB_SETTING_INT = 1, PLUMB_SETTING_FLOAT = 2, PLUMB_SETTING_CHOICE = 3 };

typedef uint32_t PlumbSettingRole;
enum {
  PLUMB_ROLE_QUALITY = 0,  /* more of it costs time and buys accuracy */
  PLUMB_ROLE_SPEED = 1,    /* changes time, not results (within the engine's determinism) */
  PLUMB_ROLE_BEHAVIOUR = 2 /* another model, not more or less of the same */
};

/* PlumbSettingInfo.flags */
enum { PLUMB_SETTING_CREATION_ONLY = 1u << 0 /* only through PlumbWorldDesc.settings */ };

/* number holds bool (0 or 1), int and float; choice is the word of a choice, null otherwise. */
typedef struct PlumbSettingValue {
  PlumbSettingType type;
  uint32_t reserved;
  double number;
  const char* choice; /* [any] a value read from a backend lives as long as the process */
} PlumbSettingValue;

typedef struct PlumbSetting {
  const char* name;
  PlumbSettingValue value;
} PlumbSetting;

typedef struct PlumbSettingInfo {
  const char* name; /* snake_case */
  const char* unit; /* "m", "1", "m/s" ...; "" for bool and choice */
  const char* doc;  /* one line */
  PlumbSettingType type;
  PlumbSettingRole role;
  uint32_t flags;
  uint32_t choice_count;
  const char* const* choices;
  double minimum, maximum; /* of int and float, both allowed */
  PlumbSettingValue default_value;
} PlumbSettingInfo;

typedef struct PlumbSettingsTable {
  uint32_t struct_size;
  uint32_t count; /* how many settings there are */
  /* [any] Lives as long as the process; null when index >= count. */
  const PlumbSettingInfo* (*describe)(uint32_t index);
  /* [world] */
  PlumbResult (*get)(PlumbWorld* world, const char* name, PlumbSettingValue* value);
  /* [world] Takes effect in the next step. */
  PlumbResult (*set)(PlumbWorld* world, const char* name, const PlumbSettingValue* value);
} PlumbSettingsTable;

#ifdef __cplusplus
}
#endif
#endif
