// The scene as somebody would write it straight against ODE.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "scenes.hpp"

namespace plumb::ode_test {

class NativeProgram {
 public:
  explicit NativeProgram(const Scene& scene);
  NativeProgram(const NativeProgram&) = delete;
  NativeProgram& operator=(const NativeProgram&) = delete;
  ~NativeProgram();

  void step();
  void read(StateRows& rows) const;

 private:
  static void near(void* self, dGeomID one, dGeomID two);

  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  std::vector<dBodyID> bodies_;
};

}  // namespace plumb::ode_test
