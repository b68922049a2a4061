// What the interface's headers give to who writes a backend: quaternions and poses, settings in a struct, the usual
// answers about capabilities.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "plumb/backend/settings_table.hpp"
#include "plumb/backend/small_math.hpp"
#include "plumb/backend/triangle_materials.hpp"
#include "plumb/backend/usual_capability.hpp"

namespace plumb::backend {
namespace {

class SmallMath : public ::testing::Test {
 protected:
  PlumbVec3 vector() { return {unit_(random_), unit_(random_), unit_(random_)}; }
  PlumbQuat turn() { return normalized(PlumbQuat{unit_(random_), unit_(random_), unit_(random_), unit_(random_)}); }

  static void expect_near(const PlumbVec3& a, const PlumbVec3& b) { EXPECT_LT(length(sub(a, b)), 1e-14); }

 private:
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> unit_{-1, 1};
};

/// The matrix of a quaternion was there before, and is worked out another way.
TEST_F(SmallMath, QuaternionsTurnAsTheirMatricesDo) {
  for (int i = 0; i < 1000; ++i) {
    const PlumbQuat p = turn(), q = turn();
    const PlumbVec3 v = vector();
    expect_near(rotate(q, v), multiply(rotation_matrix(q), v));
    expect_near(unrotate(q, rotate(q, v)), v);
    expect_near(rotate(multiply(p, q), v), multiply(multiply(rotation_matrix(p), rotation_matrix(q)), v));
  }
}

TEST_F(SmallMath, PosesNestAndGoBack) {
  for (int i = 0; i < 1000; ++i) {
    const PlumbPose a = {vector(), turn()}, b = {vector(), turn()};
    const PlumbVec3 v = vector();
    const auto place = [](const PlumbPose& pose, const PlumbVec3& at) {
      return add(pose.position, rotate(pose.orientation, at));
    };
    expect_near(place(compose(a, b), v), place(a, place(b, v)));
    expect_near(place(inverse(a), place(a, v)), v);
  }
}

TEST_F(SmallMath, ARotationVectorIsAxisTimesAngleTheShorterWay) {
  const PlumbVec3 axis = normalized(PlumbVec3{1, -2, 0.5});
  for (const double angle : {0.0, 1e-15, 1e-8, 0.3, 1.5, 3.1, 3.2, 6.2}) {
    const PlumbVec3 sine = scale(std::sin(angle / 2), axis);
    const double shorter = angle < 3.15 ? angle : angle - 2 * 3.14159265358979323846;
    expect_near(rotation_vector({sine.x, sine.y, sine.z, std::cos(angle / 2)}), scale(shorter, axis));
  }
}

enum class Colour { kRed, kGreen, kBlue };
constexpr const char* kColours[] = {"red", "green", "blue"};

struct Settings {
  int passes;
  double erp;
  bool warm;
  Colour colour;
  float untold = 3;
};
const SettingsTable<Settings>& table() {
  static const SettingsTable<Settings> all = {
      setting<&Settings::passes>(int_setting("passes", "1", PLUMB_ROLE_QUALITY, 1, 100, 10, "how often")),
      setting<&Settings::erp>(float_setting("erp", "1", PLUMB_ROLE_BEHAVIOUR, 0, 1, 0.2, "share of the error")),
      setting<&Settings::warm>(bool_setting("warm", PLUMB_ROLE_SPEED, true, "start warm", PLUMB_SETTING_CREATION_ONLY)),
      setting<&Settings::colour>(choice_setting("colour", PLUMB_ROLE_BEHAVIOUR, kColours, "of the world", 0, 1)),
  };
  return all;
}

TEST(SettingsTable, BeginsWithTheDefaultsOrWhatTheWorldAsksFor) {
  WorldInit init{};
  init.infos = table().infos();
  for (const PlumbSettingInfo& info : init.infos) init.values.push_back(info.default_value);
  Settings begun = table().values(init);
  EXPECT_EQ(begun.passes, 10);
  EXPECT_EQ(begun.erp, 0.2);
  EXPECT_TRUE(begun.warm);
  EXPECT_EQ(begun.colour, Colour::kGreen);
  EXPECT_EQ(begun.untold, 3) << "a member without a row";
  init.values[0].number = 7;
  init.values[3].choice = "blue";
  begun = table().values(init);
  EXPECT_EQ(begun.passes, 7);
  EXPECT_EQ(begun.colour, Colour::kBlue);
}

TEST(SettingsTable, GivesBackWhatWasSet) {
  Settings settings{};
  const std::string word = "red";  // another pointer than the table's
  for (const auto& [name, value] : {std::pair{"passes", PlumbSettingValue{PLUMB_SETTING_INT, 0, 42, nullptr}},
                                    {"erp", {PLUMB_SETTING_FLOAT, 0, 0.125, nullptr}},
                                    {"warm", {PLUMB_SETTING_BOOL, 0, 1, nullptr}},
                                    {"colour", {PLUMB_SETTING_CHOICE, 0, 0, word.c_str()}}}) {
    table().set(settings, name, value);
    const PlumbSettingValue back = table().get(settings, name);
    EXPECT_EQ(back.type, value.type) << name;
    EXPECT_EQ(back.number, value.number) << name;
    EXPECT_STREQ(back.choice, value.choice) << name;
  }
  EXPECT_EQ(table().get(settings, "colour").choice, kColours[0]) << "lives as long as the process";
  EXPECT_EQ(table().infos()[2].flags, PLUMB_SETTING_CREATION_ONLY);
}

TEST(SettingsTable, KnowsNoOtherNamesAndWords) {
  Settings settings{};
  EXPECT_THROW((void)table().get(settings, "sides"), Error);
  EXPECT_THROW(table().set(settings, "colour", {PLUMB_SETTING_CHOICE, 0, 0, "grey"}), Error);
}

/// A field of 3 x 4 corners, every triangle of its own material.
TEST(TriangleMaterials, OfAPlaceAreThoseOfItsTriangle) {
  const std::vector<double> heights(12, 0.0);
  std::vector<PlumbMaterial> rows;
  std::vector<std::uint32_t> of;
  for (std::uint32_t t = 0; t < 12; ++t) {
    rows.push_back({static_cast<double>(t), 0, {}});
    of.push_back(t == 7 ? PLUMB_BODY_MATERIAL : t);
  }
  PlumbShapeDesc desc = shape_desc(PLUMB_HEIGHT_FIELD);
  desc.heights = heights.data();
  desc.rows = 3;
  desc.columns = 4;
  desc.spacing = {2, 0, 5};
  EXPECT_TRUE(TriangleMaterials(desc).empty());
  EXPECT_EQ(TriangleMaterials(desc).at(0, 0), nullptr);
  desc.materials = rows.data();
  desc.material_count = 12;
  desc.triangle_materials = of.data();
  const TriangleMaterials materials(desc);
  for (std::uint32_t row = 0; row < 2; ++row)
    for (std::uint32_t column = 0; column < 3; ++column)
      for (std::uint32_t k = 0; k < 2; ++k) {
        const std::uint32_t t = 2 * (3 * row + column) + k;
        const double x = 2 * (column + (k == 0 ? 0.3 : 0.7) - 1.5), z = 5 * (row + (k == 0 ? 0.6 : 0.4) - 1);
        const PlumbMaterial* found = materials.at(x, z);
        ASSERT_EQ(found == nullptr, t == 7) << t;
        if (found != nullptr) {
          EXPECT_EQ(found->friction, t);
        }
      }
  EXPECT_EQ(materials.at(-100, -100)->friction, 0) << "the nearest";
  EXPECT_EQ(materials.at(100, 100)->friction, 11);
  EXPECT_EQ(materials.of(3)->friction, 3);
  EXPECT_EQ(materials.of(7), nullptr);
  EXPECT_EQ(materials.of(12), nullptr);
}

PlumbDegree usual(PlumbCapability kind, std::uint32_t a, std::uint32_t b = 0) {
  return usual_capability(kind, a, b).degree;
}

TEST(UsualCapability, HasNothingOutOfRange) {
  constexpr std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  for (PlumbCapability kind = 0; kind < PLUMB_CAP_COUNT + 2; ++kind) {
    if (kind == PLUMB_CAP_CHILD_MATERIAL) continue;  // asks for nothing
    EXPECT_EQ(usual(kind, most, most), PLUMB_NONE) << kind;
    EXPECT_EQ(usual(kind, most, 0), PLUMB_NONE) << kind;
  }
  EXPECT_EQ(usual(PLUMB_CAP_SHAPE, PLUMB_SPHERE, PLUMB_MOTION_COUNT), PLUMB_NONE);
  EXPECT_EQ(usual(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_HINGE, PLUMB_JOINT_FEATURE_COUNT), PLUMB_NONE);
  EXPECT_EQ(usual(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, PLUMB_SHAPE_TYPE_COUNT), PLUMB_NONE);
}

TEST(UsualCapability, IsWhatTheInterfaceMeans) {
  EXPECT_EQ(usual(PLUMB_CAP_SHAPE, PLUMB_CONVEX_HULL, PLUMB_DYNAMIC), PLUMB_NATIVE);
  EXPECT_EQ(usual(PLUMB_CAP_SHAPE, PLUMB_PLANE, PLUMB_STATIC), PLUMB_NATIVE);
  EXPECT_EQ(usual(PLUMB_CAP_SHAPE, PLUMB_PLANE, PLUMB_KINEMATIC), PLUMB_NONE);
  EXPECT_EQ(usual(PLUMB_CAP_SHAPE, PLUMB_TRIANGLE_MESH, PLUMB_KINEMATIC), PLUMB_NATIVE);
  EXPECT_EQ(usual(PLUMB_CAP_SHAPE, PLUMB_TRIANGLE_MESH, PLUMB_DYNAMIC), PLUMB_NONE);
  for (std::uint32_t a = 0; a < PLUMB_SHAPE_TYPE_COUNT; ++a)
    for (std::uint32_t b = 0; b < PLUMB_SHAPE_TYPE_COUNT; ++b)
      EXPECT_EQ(usual(PLUMB_CAP_PAIR, a, b), usual(PLUMB_CAP_PAIR, b, a)) << shape_name(a) << ", " << shape_name(b);
  EXPECT_EQ(usual(PLUMB_CAP_PAIR, PLUMB_PLANE, PLUMB_HEIGHT_FIELD), PLUMB_NONE);
  EXPECT_EQ(usual(PLUMB_CAP_PAIR, PLUMB_PLANE, PLUMB_COMPOUND), PLUMB_NATIVE);
  EXPECT_EQ(usual(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_FIXED, PLUMB_JOINT_HAS_LIMITS), PLUMB_NONE);
  EXPECT_EQ(usual(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_FIXED, PLUMB_JOINT_BREAKS), PLUMB_NATIVE);
  EXPECT_EQ(usual(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_GENERIC, PLUMB_JOINT_HAS_MOTORS), PLUMB_NATIVE);
  EXPECT_EQ(usual(PLUMB_CAP_JOINT, PLUMB_JOINT_GENERIC), PLUMB_NATIVE);
  EXPECT_EQ(usual(PLUMB_CAP_JOINT, PLUMB_JOINT_SWING_TWIST), PLUMB_NONE) << "an engine must do something for it";
  EXPECT_EQ(usual(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, PLUMB_CYLINDER), PLUMB_NATIVE);
  EXPECT_EQ(usual(PLUMB_CAP_QUERY, PLUMB_QUERY_OVERLAP, PLUMB_PLANE), PLUMB_NONE);
  EXPECT_EQ(usual(PLUMB_CAP_CLOSEST, PLUMB_CONVEX_HULL), PLUMB_NATIVE);
  EXPECT_EQ(usual(PLUMB_CAP_CLOSEST, PLUMB_COMPOUND), PLUMB_NONE);
  EXPECT_EQ(usual(PLUMB_CAP_TRIANGLE_MATERIAL, PLUMB_TRIANGLE_MESH), PLUMB_NONE)
      << "an engine must do something for it";
  EXPECT_EQ(usual(PLUMB_CAP_FIELD_READ, PLUMB_FIELD_FORCE), PLUMB_NONE) << "it acts and is spent";
  EXPECT_EQ(usual(PLUMB_CAP_FIELD_WRITE, PLUMB_FIELD_FORCE), PLUMB_NATIVE);
  EXPECT_EQ(usual(PLUMB_CAP_FIELD_WRITE, PLUMB_FIELD_MASS), PLUMB_NONE);
  EXPECT_EQ(usual(PLUMB_CAP_PHASE_TIME, PLUMB_PHASE_OUTPUT), PLUMB_NATIVE);
  EXPECT_EQ(usual(PLUMB_CAP_RESIDUAL, 0), PLUMB_NONE) << "an engine must do something for it";
  std::uint32_t own_work = 0;
  for (std::uint32_t need = 0; need < PLUMB_NEED_COUNT; ++need)
    if (usual(PLUMB_CAP_NEED, need) == PLUMB_NONE) ++own_work;
  EXPECT_EQ(own_work, 4U) << "continuous collision, snapshots, contact modification and rolling friction";
}

}  // namespace
}  // namespace plumb::backend
