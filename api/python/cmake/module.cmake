# The extension module plumb._core, and beside it the package's own files.
pybind11_add_module(plumb_python MODULE NO_EXTRAS
  src/module.cpp src/errors.cpp src/dtypes.cpp src/backend.cpp src/world.cpp src/shapes.cpp src/numbers.cpp
  src/core_calls.cpp src/extensions.cpp src/queries.cpp src/state.cpp src/lent_rows.cpp src/worlds.cpp
  src/cuda_order.cpp)
set_target_properties(plumb_python PROPERTIES OUTPUT_NAME _core CXX_VISIBILITY_PRESET hidden)
target_compile_features(plumb_python PRIVATE cxx_std_20)
target_compile_options(plumb_python PRIVATE $<$<CONFIG:Release>:-O1>)  # it hands on: what takes time is in the engines
target_link_libraries(plumb_python PRIVATE plumb::loader plumb::helpers ${CMAKE_DL_LIBS})

if(alone)
  # Where backends and the program lie: this package goes elsewhere.
  cmake_path(GET plumb_DIR PARENT_PATH prefix)  # lib/cmake
  cmake_path(GET prefix PARENT_PATH prefix)
  cmake_path(GET prefix PARENT_PATH prefix)
  target_compile_definitions(plumb_python PRIVATE PLUMB_PYTHON_PREFIX="${prefix}")
  target_precompile_headers(plumb_python PRIVATE src/core.hpp)
  return()
endif()

target_compile_definitions(plumb_python PRIVATE PLUMB_PYTHON_PREFIX="")
target_link_libraries(plumb_python PRIVATE plumb_private)
plumb_precompile(plumb_python ${CMAKE_CURRENT_SOURCE_DIR}/src/core.hpp)
plumb_compile_together(plumb_python 7)
set(package ${CMAKE_BINARY_DIR}/lib/python/plumb)
set_target_properties(plumb_python PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${package})
file(GLOB files CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/plumb plumb/*.py plumb/*.pyi plumb/py.typed)
foreach(file ${files})
  configure_file(plumb/${file} ${package}/${file} COPYONLY)
endforeach()
install(TARGETS plumb_python LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/python/plumb)
list(TRANSFORM files PREPEND plumb/)
install(FILES ${files} DESTINATION ${CMAKE_INSTALL_LIBDIR}/python/plumb)
