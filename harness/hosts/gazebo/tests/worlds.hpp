// Small worlds as texts of SDF, and the backends over which tests run.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "hosts/gazebo/tests/host.hpp"

namespace plumb::gazebo::tests {

constexpr double kG = 9.81;    // m/s2
constexpr double kDt = 0.001;  // s

inline std::string world(const std::string& content, const std::string& gravity = "0 0 -9.81") {
  return "<sdf version='1.8'><world name='w'><gravity>" + gravity + "</gravity>" + content + "</world></sdf>";
}

inline std::string model(const std::string& name, const std::string& pose, const std::string& content) {
  return "<model name='" + name + "'><pose>" + pose + "</pose>" + content + "</model>";
}

inline std::string inertia(double mass, double xx, double yy, double zz, const std::string& pose = "0 0 0 0 0 0") {
  std::ostringstream text;
  text << "<inertial><pose>" << pose << "</pose><mass>" << mass << "</mass><inertia><ixx>" << xx << "</ixx><iyy>" << yy
       << "</iyy><izz>" << zz << "</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>";
  return text.str();
}

inline std::string collision(const std::string& name, const std::string& geometry, double friction = 1,
                             const std::string& pose = "0 0 0 0 0 0") {
  return "<collision name='" + name + "'><pose>" + pose + "</pose><geometry>" + geometry +
         "</geometry><surface><friction><ode><mu>" + std::to_string(friction) +
         "</mu></ode></friction></surface></collision>";
}

inline std::string box(const std::string& size) { return "<box><size>" + size + "</size></box>"; }
inline std::string sphere(double radius) { return "<sphere><radius>" + std::to_string(radius) + "</radius></sphere>"; }

inline std::string link(const std::string& content, const std::string& name = "link",
                        const std::string& pose = "0 0 0 0 0 0") {
  return "<link name='" + name + "'><pose>" + pose + "</pose>" + content + "</link>";
}

/// A cube of an edge of .2 m and 2 kg.
inline std::string cube(const std::string& name, const std::string& pose, double friction = 1) {
  const double moment = 2 * 0.2 * 0.2 / 6;
  return model(name, pose, link(inertia(2, moment, moment, moment) + collision(name, box("0.2 0.2 0.2"), friction)));
}

/// A ball of a radius of .1 m and 1 kg.
inline std::string ball(const std::string& name, const std::string& pose) {
  return model(name, pose, link(inertia(1, 0.004, 0.004, 0.004) + collision(name, sphere(0.1))));
}

inline std::string ground(double friction = 1) {
  return model("ground", "0 0 0 0 0 0",
               "<static>true</static>" + link(collision("ground", "<plane><normal>0 0 1</normal></plane>", friction)));
}

inline void expect_near(const Vector& is, const Vector& wanted, double tolerance) {
  EXPECT_LE((is - wanted).Length(), tolerance) << "is " << is << ", wanted " << wanted;
}

/// Each test once over each backend that is built.
class OverBackends : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string built = PLUMB_TESTED_BACKENDS;
    if ((" " + built + " ").find(" " + std::string(GetParam()) + " ") == std::string::npos)
      GTEST_SKIP() << "the backend " << GetParam() << " is not built";
    host = std::make_unique<Host>(GetParam());
  }
  /// What this backend is allowed where it is known to be less exact than others, which a comment says beside it.
  static double over(const std::string& backend, double its, double others) {
    return GetParam() == backend ? its : others;
  }
  std::unique_ptr<Host> host;
};

inline std::string backend_name(const testing::TestParamInfo<const char*>& info) { return info.param; }

}  // namespace plumb::gazebo::tests
