// A backend that behaves until a test makes one of its functions misbehave.
#pragma once

#include <gtest/gtest.h>

#include "complete_backend.hpp"
#include "plumb/layers.hpp"

namespace plumb::test {

/// The well-behaved tables that the ill ones start from and may call.
struct IllTables {
  PlumbBackendTable core;
  PlumbJointsTable joints;
  PlumbQueriesTable queries;
  PlumbSettingsTable settings;
  PlumbSnapshotTable snapshot;
  PlumbCollideTable collide;
  PlumbStateTable state;
  PlumbExceptionsTable exceptions;
  PlumbModifyTable modify;
  PlumbManifoldsTable manifolds;
  PlumbClosestTable closest;
  PlumbCookingTable cooking;
};

template <class Table>
Table table_named(const char* name) {
  return *static_cast<const Table*>(complete().extension(name));
}
inline const IllTables& good() {
  static const IllTables tables = {complete(),
                                   table_named<PlumbJointsTable>(PLUMB_EXT_JOINTS),
                                   table_named<PlumbQueriesTable>(PLUMB_EXT_QUERIES),
                                   table_named<PlumbSettingsTable>(PLUMB_EXT_SETTINGS),
                                   table_named<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT),
                                   table_named<PlumbCollideTable>(PLUMB_EXT_COLLIDE),
                                   table_named<PlumbStateTable>(PLUMB_EXT_STATE),
                                   table_named<PlumbExceptionsTable>(PLUMB_EXT_EXCEPTIONS),
                                   table_named<PlumbModifyTable>(PLUMB_EXT_MODIFY),
                                   table_named<PlumbManifoldsTable>(PLUMB_EXT_MANIFOLDS),
                                   table_named<PlumbClosestTable>(PLUMB_EXT_CLOSEST),
                                   table_named<PlumbCookingTable>(PLUMB_EXT_COOKING)};
  return tables;
}

/// One set for the whole program, as layers keep what they were given.
inline IllTables& ill() {
  static IllTables tables = good();
  return tables;
}

inline const int unknown_table = 7;  // an extension that no layer knows

/// A world behind the validation layer over the ill tables.
class Validated : public ::testing::Test {
 protected:
  /// usual: whose mistakes these tests are about.
  explicit Validated(layers::FindingKind usual) : usual_(usual) {
    ill() = good();
    ill().core.extension = [](const char* name) -> const void* {
      const std::string_view wanted = name;
      if (wanted == PLUMB_EXT_JOINTS) return &ill().joints;
      if (wanted == PLUMB_EXT_QUERIES) return &ill().queries;
      if (wanted == PLUMB_EXT_SETTINGS) return &ill().settings;
      if (wanted == PLUMB_EXT_SNAPSHOT) return &ill().snapshot;
      if (wanted == PLUMB_EXT_COLLIDE) return &ill().collide;
      if (wanted == PLUMB_EXT_STATE) return &ill().state;
      if (wanted == PLUMB_EXT_EXCEPTIONS) return &ill().exceptions;
      if (wanted == PLUMB_EXT_MODIFY) return &ill().modify;
      if (wanted == PLUMB_EXT_MANIFOLDS) return &ill().manifolds;
      if (wanted == PLUMB_EXT_CLOSEST) return &ill().closest;
      if (wanted == PLUMB_EXT_COOKING) return &ill().cooking;
      if (wanted == "test.unknown/1") return &unknown_table;
      return nullptr;
    };
    table = layers::validate(&ill().core);
    static_cast<void>(layers::findings(table));
    const PlumbWorldDesc desc = world_desc(PLUMB_NEED_ALL & ~PLUMB_NEED_CCD);
    EXPECT_EQ(table->create_world(&desc, &world), PLUMB_OK) << table->error_text(nullptr);
    PlumbShapeDesc box = shape_desc(PLUMB_BOX);
    box.half_extents = {1, 1, 1};
    EXPECT_EQ(table->create_shapes(world, &box, sizeof box, 1, &shape), PLUMB_OK);
    add();
    add();
  }
  ~Validated() override {
    if (world != nullptr) table->destroy_world(world);
  }

  PlumbBodyDesc body() const {
    PlumbBodyDesc desc = body_desc();
    desc.shape = shape;
    return desc;
  }
  void add() {
    const PlumbBodyDesc desc = body();
    PlumbBody id = 0;
    EXPECT_EQ(table->create_bodies(world, &desc, sizeof desc, 1, &id), PLUMB_OK) << table->error_text(world);
    bodies.push_back(id);
  }
  template <class Table>
  const Table& extension(const char* name) {
    return *static_cast<const Table*>(table->extension(name));
  }
  /// The call ended like this, and the layer's words for it contain these; asking takes the findings.
  void expect(PlumbResult expected, PlumbResult result, const std::string& words) {
    EXPECT_EQ(result, expected) << table->error_text(world);
    const std::string text = table->error_text(world);
    EXPECT_NE(text.find(words), std::string::npos) << "\"" << text << "\" does not say \"" << words << "\"";
    expect_found(words);
  }
  void expect_found(const std::string& words) { expect_found(usual_, words); }
  void expect_found(layers::FindingKind kind, const std::string& words) {
    const std::vector<layers::Finding> found = layers::findings(table);
    const auto at = std::find_if(found.begin(), found.end(), [&](const layers::Finding& finding) {
      return finding.text.find(words) != std::string::npos;
    });
    ASSERT_NE(at, found.end()) << "no finding says \"" << words << "\"; the last of " << found.size() << " is "
                               << (found.empty() ? "" : found.back().text);
    EXPECT_EQ(at->kind, kind) << at->text;
  }

  const PlumbBackendTable* table = nullptr;
  PlumbWorld* world = nullptr;
  PlumbShape shape = 0;
  std::vector<PlumbBody> bodies;

 private:
  layers::FindingKind usual_;
};

}  // namespace plumb::test
