#include <gtest/gtest.h>
#include "scene/catalogue.hpp"
TEST(SceneFile, all) { for (auto& s : plumb::harness::all_scenes()) std::printf("%s %zu\n", s.id.c_str(), s.instantiate({}).bodies.size()); }
