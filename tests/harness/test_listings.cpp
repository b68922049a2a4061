// plumb backends, scenes and measures in the terminal tell what their JSON tells.
#include <gtest/gtest.h>

#include <sstream>

#include "program.hpp"

namespace plumb::harness::testing {
namespace {

/// The text with all runs of blanks as one, so that broken lines are found.
std::string flat(const std::string& text) {
  std::istringstream in(text);
  std::string out;
  for (std::string word; in >> word;) out += word + " ";
  return out;
}

void expect_sheet(const std::string& backend) {
  const Json json = plumb({"backends", backend, "--json"}).rows().at(0);
  const Finished finished = plumb({"backends", backend});
  ASSERT_EQ(finished.status, 0) << finished.err;
  const std::string sheet = flat(finished.out);
  const auto expect = [&](const std::string& part) { EXPECT_NE(sheet.find(part), std::string::npos) << part; };
  expect(std::string(json["name"]) + " " + std::string(json["version"]));
  expect(flat(json["description"]));
  for (const Json& setting : json["settings"]) {
    expect(" " + std::string(setting["name"]) + " ");
    expect(flat(setting["doc"]));
    expect("role " + std::string(setting["role"]));
    if (setting.contains("choices"))
      for (const Json& choice : setting["choices"]) expect(choice);
  }
  for (const auto& [path, note] : json["capabilities"]["notes"].items()) expect(flat(note));
  for (const auto& [need, degree] : json["capabilities"]["needs"].items())
    if (json["capabilities"]["needs"].size() > 1) expect(degree);
  std::istringstream lines(finished.out);
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(line.size() <= 100 || line.find('/') != std::string::npos) << line;
}

TEST(Listings, ABackendTellsItsSettingsAndCapabilitiesWithNotes) {
  expect_sheet(SAMPLE_BACKEND);
  expect_sheet(MISBEHAVING_BACKEND);
}

TEST(Listings, AMisspeltBackendIsToldTheNearest) {
  const Finished finished = plumb({"backends", "misbehavin"},
                                  {{"PLUMB_BACKEND_PATH", std::filesystem::path(MISBEHAVING_BACKEND).parent_path()}});
  EXPECT_EQ(finished.status, 2);
  EXPECT_NE(finished.err.find("\"misbehaving\""), std::string::npos) << finished.err;
}

TEST(Listings, MeasuresTellTheirArguments) {
  const std::vector<Json> rows = plumb({"measures", "--json"}).rows();
  EXPECT_GT(rows.size(), 70u);
  const std::string text = flat(plumb({"measures"}).out);
  for (const Json& row : rows) {
    EXPECT_NE(text.find(std::string(row["name"]) + " " + flat(row["doc"])), std::string::npos) << row["name"];
    for (const Json& argument : row["arguments"])
      EXPECT_NE(text.find(std::string(argument["name"]) + ": " + std::string(argument["type"])), std::string::npos)
          << row["name"] << argument["name"];
  }
}

TEST(Listings, TheGeneralMeasureTellsItsQuantities) {
  const Json row = plumb({"measures", "quantities", "--json"}).rows().at(0);
  const std::string text = flat(plumb({"measures", "quantities"}).out);
  EXPECT_GT(row["quantities"].size(), 25u);
  for (const Json& quantity : row["quantities"])
    EXPECT_NE(text.find(std::string(quantity["name"]) + " " + flat(quantity["doc"]).substr(0, 8)), std::string::npos)
        << quantity["name"];
  for (const auto& [take, doc] : row["take"].items()) EXPECT_NE(text.find(take + " "), std::string::npos) << take;
}

TEST(Listings, ASceneInItsOwnWordsTellsItsTruths) {
  const std::string text = flat(plumb({"scenes", QUANTITY_SCENES "/X1-projectile.json"}).out);
  EXPECT_NE(text.find("truth speed / g; in s; passes up to an error of 0.01"), std::string::npos) << text;
  EXPECT_NE(text.find("truth speed * t - g * t^2 / 2; in cm"), std::string::npos) << text;
}

}  // namespace
}  // namespace plumb::harness::testing
