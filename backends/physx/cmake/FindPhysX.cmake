# PhysX 5.6 or newer (github.com/NVIDIA-Omniverse/PhysX) as the target PhysX::PhysX: its static libraries as its own
# CMake installs them, under any prefix of CMAKE_PREFIX_PATH, or the package of vcpkg (vcpkg install physx).
#
# PhysX's scripts fetch packages of their own, but its CMake does not need them. From its folder physx:
#
#   cmake -S compiler/public -B build -DCMAKE_BUILD_TYPE=release -DTARGET_BUILD_PLATFORM=linux -DPHYSX_ROOT_DIR=$PWD \
#     -DPX_OUTPUT_LIB_DIR=$PWD/out -DPX_OUTPUT_BIN_DIR=$PWD/out -DPX_GENERATE_STATIC_LIBRARIES=TRUE
#   cmake --build build --target PhysX PhysXExtensions PhysXCooking PhysXCommon PhysXFoundation PhysXPvdSDK
#   cp -r include PREFIX/include/physx
#   cp out/bin/linux.x86_64/release/*.a PREFIX/lib
#
# Warnings are errors there: compilers that it does not know may want -Werror taken out of source/compiler/cmake/linux.
# For physx-cuda add -DPX_GENERATE_GPU_PROJECTS=ON -DCMAKE_CUDA_ARCHITECTURES=... and the target PhysXGpu, and copy
# libPhysXGpu_64.so to PREFIX/lib, too: PhysX_GPU_LIBRARY is where it was found.
#
# Sets PhysX_FOUND, PhysX_VERSION and PhysX_GPU_LIBRARY.
find_package(unofficial-omniverse-physx-sdk CONFIG QUIET)
find_path(PhysX_INCLUDE_DIR PxPhysicsAPI.h PATH_SUFFIXES physx)
mark_as_advanced(PhysX_INCLUDE_DIR)
set(PhysX_VERSION "")
if(PhysX_INCLUDE_DIR)
  set(numbers "")
  file(STRINGS ${PhysX_INCLUDE_DIR}/foundation/PxPhysicsVersion.h lines REGEX "define PX_PHYSICS_VERSION_(MAJOR|MINOR|BUGFIX) ")
  foreach(line ${lines})
    string(REGEX MATCH "[0-9]+" number "${line}")
    list(APPEND numbers ${number})
  endforeach()
  list(JOIN numbers "." PhysX_VERSION)
endif()

# Each needs those after it.
set(parts PhysXExtensions PhysX PhysXPvdSDK PhysXCooking PhysXCommon PhysXFoundation)
set(PhysX_LIBRARIES "")
foreach(part ${parts})
  find_library(PhysX_${part}_LIBRARY NAMES ${part}_static_64 ${part}_static)
  mark_as_advanced(PhysX_${part}_LIBRARY)
  if(PhysX_${part}_LIBRARY)
    list(APPEND PhysX_LIBRARIES ${PhysX_${part}_LIBRARY})
  endif()
endforeach()
find_library(PhysX_GPU_LIBRARY PhysXGpu_64)
mark_as_advanced(PhysX_GPU_LIBRARY)

include(FindPackageHandleStandardArgs)
set(needed PhysX_INCLUDE_DIR)
if(NOT TARGET unofficial::omniverse-physx-sdk::sdk)
  list(TRANSFORM parts REPLACE "(.+)" "PhysX_\\1_LIBRARY" OUTPUT_VARIABLE libraries)
  list(APPEND needed ${libraries})
endif()
find_package_handle_standard_args(PhysX REQUIRED_VARS ${needed} VERSION_VAR PhysX_VERSION)

if(PhysX_FOUND AND NOT TARGET PhysX::PhysX)
  find_package(Threads REQUIRED)
  add_library(PhysX::PhysX INTERFACE IMPORTED)
  target_include_directories(PhysX::PhysX SYSTEM INTERFACE ${PhysX_INCLUDE_DIR})
  # Its headers want one of NDEBUG and _DEBUG, as the libraries were built.
  target_compile_definitions(PhysX::PhysX INTERFACE NDEBUG PX_PHYSX_STATIC_LIB)
  if(TARGET unofficial::omniverse-physx-sdk::sdk)
    target_link_libraries(PhysX::PhysX INTERFACE unofficial::omniverse-physx-sdk::sdk)
  else()
    target_link_libraries(PhysX::PhysX INTERFACE ${PhysX_LIBRARIES})
  endif()
  target_link_libraries(PhysX::PhysX INTERFACE Threads::Threads ${CMAKE_DL_LIBS})
endif()
