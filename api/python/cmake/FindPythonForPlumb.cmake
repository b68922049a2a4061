# Finds a Python with its headers and NumPy, and pybind11. Sets PLUMB_PYTHON_MISSING to what there is not.
#
# The first python3 of the path may be one without headers, or without NumPy (a virtual environment, pyenv); then the
# system's own may serve. -DPython_EXECUTABLE=... names one.
set(PLUMB_PYTHON_MISSING "")
set(usable [[
import os, sys, sysconfig
import numpy
sys.exit(not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")))
]])
if(NOT Python_EXECUTABLE)
  find_program(PLUMB_FIRST_PYTHON python3)
  mark_as_advanced(PLUMB_FIRST_PYTHON)
  foreach(candidate ${PLUMB_FIRST_PYTHON} /usr/bin/python3)
    execute_process(COMMAND ${candidate} -c "${usable}" RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
    if(result EQUAL 0)
      set(Python_EXECUTABLE ${candidate})
      break()
    endif()
  endforeach()
endif()
if(Python_EXECUTABLE)
  find_package(Python 3.10 QUIET COMPONENTS Interpreter Development.Module)
endif()
if(NOT Python_Development.Module_FOUND)
  set(PLUMB_PYTHON_MISSING "a python3 with headers and NumPy (Debian: python3-dev, python3-numpy)")
  return()
endif()
if(NOT pybind11_DIR)  # pip's own says where it lies
  execute_process(COMMAND ${Python_EXECUTABLE} -m pybind11 --cmakedir OUTPUT_VARIABLE pybind11_ROOT
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
find_package(pybind11 2.10 QUIET CONFIG)
if(NOT pybind11_FOUND)
  set(PLUMB_PYTHON_MISSING "pybind11 2.10 (Debian: pybind11-dev)")
endif()
