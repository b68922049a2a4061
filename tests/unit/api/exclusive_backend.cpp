// A backend of an exclusion group; built twice, under two names.
#include "fake_world.hpp"

extern "C" PLUMB_EXPORT PlumbResult plumb_backend_open(const PlumbOpenRequest* request, PlumbOpenReply* reply) {
  const PlumbResult result = plumb::backend::open<plumb::test::FakeWorld>(request, reply);
  if (result < 0) return result;
  static PlumbBackendInfo info = plumb::test::FakeWorld::info();
  static PlumbBackendTable table = *reply->table;
  info.name = EXCLUSIVE_NAME;
  info.exclusion_group = "test.one-at-a-time";
  table.info = [] { return static_cast<const PlumbBackendInfo*>(&info); };
  reply->table = &table;
  return result;
}
