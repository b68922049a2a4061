# The engine in float. Results do not depend on the level of the instructions, times do: lanes are twice as wide with AVX2.
# Where the dynamic linker takes the library that suits the machine (glibc-hwcaps, ld.so(8)), there is one for each level,
# and the plugin is a door before them; a build for this machine alone may do with the one.
include(CheckCXXCompilerFlag)
option(PLUMB_IMPULSE_FOR_AVX2_ONLY "Build the backend impulse for machines with AVX2 alone" OFF)
if(PLUMB_IMPULSE_FOR_AVX2_ONLY AND NOT "${CMAKE_SYSTEM_NAME} ${CMAKE_SYSTEM_PROCESSOR}" STREQUAL "Linux x86_64")
  message(FATAL_ERROR "PLUMB_IMPULSE_FOR_AVX2_ONLY=ON on ${CMAKE_SYSTEM_NAME} ${CMAKE_SYSTEM_PROCESSOR}: only Linux on x86_64 has such a build; leave it OFF")
endif()
if(NOT CMAKE_SYSTEM_NAME STREQUAL Linux)
  plumb_impulse_cpu_objects(plumb_impulse_objects)
  plumb_impulse_library(impulse plumb_impulse_objects)
  return()
endif()

# plumb_impulse_engine(OBJECTS FOLDER BUILD): the float engine as a library in a folder beside the plugin.
function(plumb_impulse_engine objects folder build)
  set(target plumb_impulse_engine${folder})
  string(MAKE_C_IDENTIFIER ${target} target)
  target_compile_definitions(${objects} PRIVATE PLUMB_IMPULSE_NAME="impulse" PLUMB_IMPULSE_BUILD="${build}")
  add_library(${target} SHARED plugin/engine.cpp)
  target_link_libraries(${target} PRIVATE ${objects} plumb_private)
  set(map ${CMAKE_CURRENT_SOURCE_DIR}/plugin/engine.map)
  target_link_options(${target} PRIVATE LINKER:--version-script=${map})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME plumb-impulse LINK_DEPENDS ${map}
    LIBRARY_OUTPUT_DIRECTORY "${PLUMB_BACKEND_DIRECTORY}${folder}" CXX_VISIBILITY_PRESET hidden)
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/plumb${folder})
endfunction()

set(wide_folder "")
if(NOT PLUMB_IMPULSE_FOR_AVX2_ONLY)
  set(wide_folder /glibc-hwcaps/x86-64-v3)
  plumb_impulse_cpu_objects(plumb_impulse_objects)
  plumb_impulse_engine(plumb_impulse_objects "" "${PLUMB_IMPULSE_BUILD}")
endif()
plumb_add_backend(impulse plugin/front.cpp)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64)
  plumb_impulse_cpu_objects(plumb_impulse_v3_objects)
  # gcc 12 joins products and sums that alternate into vfmaddsub whatever -ffp-contract says.
  target_compile_options(plumb_impulse_v3_objects PRIVATE -march=x86-64-v3 -mno-fma)
  # gcc copies lanes in halves of 16 bytes unless told otherwise, and a whole that is read after two halves were written
  # has to wait until both have reached the cache.
  check_cxx_compiler_flag("-mmove-max=256 -mstore-max=256" PLUMB_HAS_MOVE_MAX)
  if(PLUMB_HAS_MOVE_MAX)
    target_compile_options(plumb_impulse_v3_objects PRIVATE -mmove-max=256 -mstore-max=256)
  endif()
  plumb_impulse_engine(plumb_impulse_v3_objects "${wide_folder}" "${PLUMB_IMPULSE_BUILD} x86-64-v3")
  string(MAKE_C_IDENTIFIER plumb_impulse_engine${wide_folder} wide_engine)
  add_dependencies(plumb-backend-impulse ${wide_engine})
endif()
target_include_directories(plumb-backend-impulse PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(plumb-backend-impulse PRIVATE plumb_impulse_engine plumb_private)
set_target_properties(plumb-backend-impulse PROPERTIES BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN")
install(TARGETS plumb-backend-impulse LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/plumb)
