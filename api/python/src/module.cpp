#include "core.hpp"
#include "world.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace plumb::python;
  module.doc() = "What the package plumb calls in C. Use plumb itself.";
  bind_errors(module);
  bind_dtypes(module);
  bind_backend(module);
  bind_shapes(module);
  bind_state(module);
  WorldClass world(module, "World");
  bind_core(world);
  bind_extensions(world);
  bind_queries(world);
  bind_worlds(module);
}
