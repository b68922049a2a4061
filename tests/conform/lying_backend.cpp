// A backend that hands every call on to the honest one in the file PLUMB_HONEST, but for the one lie PLUMB_LIE.
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "honest.hpp"

namespace plumb::lying {
namespace {

constexpr struct {
  std::string_view word;
  void (*tell)();
} lies[] = {
#define PLUMB_LIE(word, check) {#word, &word},
#include "lies.inl"
#undef PLUMB_LIE
};

const void* extension(const char* name) {
  const void* truth = honest.core.extension(name);
  if (truth == nullptr) return nullptr;
  const std::string_view wanted = name;
  if (wanted == PLUMB_EXT_JOINTS) return &liar.joints;
  if (wanted == PLUMB_EXT_QUERIES) return &liar.queries;
  if (wanted == PLUMB_EXT_SETTINGS) return &liar.settings;
  if (wanted == PLUMB_EXT_SNAPSHOT) return &liar.snapshot;
  if (wanted == PLUMB_EXT_COLLIDE) return &liar.collide;
  if (wanted == PLUMB_EXT_DEBUG) return &liar.debug;
  if (wanted == PLUMB_EXT_EXCEPTIONS) return &liar.exceptions;
  if (wanted == PLUMB_EXT_MODIFY) return &liar.modify;
  if (wanted == PLUMB_EXT_MANIFOLDS) return &liar.manifolds;
  if (wanted == PLUMB_EXT_WORLDS) return &liar.worlds;
  if (wanted == PLUMB_EXT_CLOSEST) return &liar.closest;
  if (wanted == PLUMB_EXT_COOKING) return &liar.cooking;
  return truth;
}

template <class Table>
void take(Table& table, const char* name) {
  if (const void* truth = honest.core.extension(name)) table = *static_cast<const Table*>(truth);
}

void take_tables(const PlumbBackendTable& table) {
  honest.core = table;
  honest.info = *table.info();
  take(honest.joints, PLUMB_EXT_JOINTS);
  take(honest.queries, PLUMB_EXT_QUERIES);
  take(honest.settings, PLUMB_EXT_SETTINGS);
  take(honest.snapshot, PLUMB_EXT_SNAPSHOT);
  take(honest.collide, PLUMB_EXT_COLLIDE);
  take(honest.debug, PLUMB_EXT_DEBUG);
  take(honest.exceptions, PLUMB_EXT_EXCEPTIONS);
  take(honest.modify, PLUMB_EXT_MODIFY);
  take(honest.manifolds, PLUMB_EXT_MANIFOLDS);
  take(honest.worlds, PLUMB_EXT_WORLDS);
  take(honest.closest, PLUMB_EXT_CLOSEST);
  take(honest.cooking, PLUMB_EXT_COOKING);
  liar = honest;
  liar.core.extension = &extension;
  liar.core.info = []() -> const PlumbBackendInfo* { return &liar.info; };
}

PlumbResult refuse(PlumbOpenReply* reply, const char* why, const char* what) {
  std::snprintf(reply->message, sizeof reply->message, "%s: %s", why, what);
  return PLUMB_E_INVALID_ARGUMENT;
}

}  // namespace
}  // namespace plumb::lying

extern "C" PLUMB_EXPORT PlumbResult plumb_backend_open(const PlumbOpenRequest* request, PlumbOpenReply* reply) {
  using namespace plumb::lying;
  const char *file = std::getenv("PLUMB_HONEST"), *lie = std::getenv("PLUMB_LIE");
  if (file == nullptr || lie == nullptr) return refuse(reply, "set", "PLUMB_HONEST and PLUMB_LIE");
  void* library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return refuse(reply, "no honest backend", dlerror());
  const auto open = reinterpret_cast<PlumbOpenFunction>(dlsym(library, PLUMB_OPEN_SYMBOL));
  if (open == nullptr) return refuse(reply, "no backend", file);
  const PlumbResult result = open(request, reply);
  if (result < 0) return result;
  take_tables(*reply->table);
  for (const auto& [word, tell] : lies) {
    if (word != lie) continue;
    tell();
    reply->table = &liar.core;
    return result;
  }
  return refuse(reply, "no such lie", lie);
}
