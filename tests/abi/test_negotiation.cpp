// Host and backend agree on a version or say which of them is too old; the host believes no answer unseen.
#include <gtest/gtest.h>

#include <dlfcn.h>
#include <cstdio>

#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

constexpr std::uint32_t version(std::uint32_t major, std::uint32_t minor) { return PLUMB_MAKE_VERSION(major, minor); }

PlumbOpenFunction sample() {
  void* library = dlopen(SAMPLE_BACKEND, RTLD_NOW | RTLD_LOCAL);
  return reinterpret_cast<PlumbOpenFunction>(dlsym(library, PLUMB_OPEN_SYMBOL));
}

PlumbResult ask(std::uint32_t min, std::uint32_t max, PlumbOpenReply& reply) {
  const PlumbOpenRequest request = {sizeof request, min, max, 0, nullptr};
  reply = {};
  reply.struct_size = sizeof reply;
  return sample()(&request, &reply);
}

/// The host refuses with this code, in these words.
void refused(PlumbOpenFunction open, PlumbResult code, const std::string& words) {
  try {
    static_cast<void>(negotiate(open, "liar"));
    FAIL() << "a broken answer was believed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

// A table to lie about.
PlumbBackendTable honest() {
  PlumbOpenReply reply;
  EXPECT_EQ(ask(PLUMB_VERSION, PLUMB_VERSION, reply), PLUMB_OK);
  return *reply.table;
}

TEST(Negotiation, BackendSaysWhoIsTooOld) {
  PlumbOpenReply reply;
  EXPECT_EQ(ask(version(9, 0), version(9, 5), reply), PLUMB_E_VERSION);
  EXPECT_NE(std::string(reply.message).find("get a newer sample"), std::string::npos) << reply.message;
  EXPECT_EQ(reply.table, nullptr);
  EXPECT_EQ(ask(version(0, 1), version(0, 8), reply), PLUMB_E_VERSION);
  EXPECT_NE(std::string(reply.message).find("get a newer host"), std::string::npos) << reply.message;
  EXPECT_EQ(ask(version(0, 1), version(9, 5), reply), PLUMB_OK);
  EXPECT_EQ(reply.version, static_cast<std::uint32_t>(PLUMB_VERSION));
  const PlumbBackendTable* first = reply.table;
  EXPECT_EQ(ask(PLUMB_VERSION, PLUMB_VERSION, reply), PLUMB_OK);
  EXPECT_EQ(reply.table, first) << "the same table for the same version";
}

TEST(Negotiation, HostPassesTheBackendsWordsOn) {
  refused(
      [](const PlumbOpenRequest*, PlumbOpenReply* reply) -> PlumbResult {
        std::snprintf(reply->message, sizeof reply->message, "this engine needs a newer host");
        return PLUMB_E_VERSION;
      },
      PLUMB_E_VERSION, "needs a newer host");
  refused([](const PlumbOpenRequest*, PlumbOpenReply*) -> PlumbResult { return PLUMB_E_INTERNAL; }, PLUMB_E_INTERNAL,
          "liar refused without saying why");
}

TEST(Negotiation, VersionsThatWereNotOffered) {
  refused(
      [](const PlumbOpenRequest* request, PlumbOpenReply* reply) -> PlumbResult {
        static PlumbBackendTable table = honest();
        reply->version = table.version = request->max_version + 1;
        reply->table = &table;
        return PLUMB_OK;
      },
      PLUMB_E_VERSION, "did not offer");
  refused(
      [](const PlumbOpenRequest* request, PlumbOpenReply* reply) -> PlumbResult {
        static PlumbBackendTable table = honest();
        reply->version = table.version = request->min_version - 1;
        reply->table = &table;
        return PLUMB_OK;
      },
      PLUMB_E_VERSION, "did not offer");
}

TEST(Negotiation, ALaterMinorVersionIsTaken) {
  const PlumbBackendTable* table = negotiate(
      [](const PlumbOpenRequest* request, PlumbOpenReply* reply) -> PlumbResult {
        static PlumbBackendTable later = honest();
        later.version = PLUMB_VERSION + 1;
        if (later.version > request->max_version) return PLUMB_E_VERSION;
        reply->version = later.version;
        reply->table = &later;
        return PLUMB_OK;
      },
      "later");
  EXPECT_EQ(table->version, PLUMB_VERSION + 1);
}

TEST(Negotiation, TablesThatAreNotThere) {
  refused(
      [](const PlumbOpenRequest* request, PlumbOpenReply* reply) -> PlumbResult {
        reply->version = request->max_version;
        return PLUMB_OK;
      },
      PLUMB_E_VERSION, "gave no table");
  refused(
      [](const PlumbOpenRequest* request, PlumbOpenReply* reply) -> PlumbResult {
        static PlumbBackendTable table = honest();
        table.version = version(0, 7);
        reply->version = request->max_version;
        reply->table = &table;
        return PLUMB_OK;
      },
      PLUMB_E_VERSION, "gave no table of it");
  refused(
      [](const PlumbOpenRequest* request, PlumbOpenReply* reply) -> PlumbResult {
        static PlumbBackendTable table = honest();
        table.struct_size = 24;
        reply->version = request->max_version;
        reply->table = &table;
        return PLUMB_OK;
      },
      PLUMB_E_VERSION, "liar");
  refused(
      [](const PlumbOpenRequest* request, PlumbOpenReply* reply) -> PlumbResult {
        static PlumbBackendTable table = honest();
        table.wait = nullptr;
        reply->version = request->max_version;
        reply->table = &table;
        return PLUMB_OK;
      },
      PLUMB_E_VERSION, "liar");
}

TEST(Negotiation, RepliesOfAnotherSize) {
  refused(
      [](const PlumbOpenRequest* request, PlumbOpenReply* reply) -> PlumbResult {
        static PlumbBackendTable table = honest();
        reply->struct_size = 8;
        reply->version = request->max_version;
        reply->table = &table;
        return PLUMB_OK;
      },
      PLUMB_E_VERSION, "struct_size");
  PlumbOpenReply reply{};
  const PlumbOpenRequest request = {sizeof request, PLUMB_VERSION, PLUMB_VERSION, 0, nullptr};
  EXPECT_LT(sample()(&request, &reply), 0) << "a reply without a size is not filled in";
  EXPECT_EQ(reply.table, nullptr);
}

}  // namespace
}  // namespace plumb::test
