// The extension module plumb._core: what of the interface Python calls, over plumb.h's tables.
//
// Here is only what needs C: descriptors as bytes, the lock, the GIL, lent memory. What a call means in Python, and
// what it says of wrong arguments, is in the package's own files.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "plumb/loader.hpp"

namespace plumb::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_dtypes(py::module_& module);
void bind_backend(py::module_& module);
void bind_shapes(py::module_& module);
void bind_state(py::module_& module);

class World;
using WorldClass = py::class_<World>;
void bind_core(WorldClass& world);
void bind_extensions(WorldClass& world);
void bind_queries(WorldClass& world);
void bind_worlds(py::module_& module);  // after the class of its worlds

}  // namespace plumb::python
