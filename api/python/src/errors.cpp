// Failed calls as plumb.Error, and the loader's helpers for error messages.
#include "core.hpp"
#include "plumb/nearest.hpp"

namespace plumb::python {

void bind_errors(py::module_& module) {
  // The class is written in Python, where its members have types and docstrings.
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      const py::object type = py::module_::import("plumb._errors").attr("Error");
      const py::object value = type(error.code(), error.what());
      PyErr_SetObject(type.ptr(), value.ptr());
    }
  });
  module.def("suggestion",
             [](const std::string& word, const std::vector<std::string>& known) { return suggestion(word, known); });
}

}  // namespace plumb::python
