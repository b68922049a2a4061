# Installs BUILD to a fresh prefix, builds PROJECT against it, and runs what comes out.
set(prefix ${WORK}/prefix)
file(REMOVE_RECURSE ${WORK})
function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(result "${result}" PARENT_SCOPE)
  set(output "${output}" PARENT_SCOPE)
  if(what AND NOT result EQUAL 0)
    message(FATAL_ERROR "${what} failed with ${result}:\n${output}")
  endif()
endfunction()

run("installing" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} --config ${CONFIG})
set(flags "")
if(SANITIZE)
  set(flags "-fsanitize=${SANITIZE}")
endif()
run("configuring" ${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_BUILD_TYPE=${CONFIG}
  -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
  -DCMAKE_C_FLAGS=${flags} -DCMAKE_CXX_FLAGS=${flags} -DPLUMB_SANITIZE=${SANITIZE} -DSAMPLE_SOURCE=${SAMPLE_SOURCE})
if(NOT output MATCHES "Build files have been written")
  message(FATAL_ERROR "configuring said:\n${output}")
endif()
run("building" ${CMAKE_COMMAND} --build ${WORK}/build --config ${CONFIG})

# Nothing in the package may lead back to where it was built.
file(GLOB_RECURSE package_files ${prefix}/lib/cmake/*)
foreach(file ${package_files})
  file(STRINGS ${file} lines REGEX "${BUILD}")
  if(lines)
    message(SEND_ERROR "${file} names the build folder: ${lines}")
  endif()
endforeach()

# Manual pages and completions lie where man and the shells look.
foreach(file man/man1/plumb.1 man/man1/plumb-run.1 bash-completion/completions/plumb zsh/site-functions/_plumb
             fish/vendor_completions.d/plumb.fish)
  if(NOT EXISTS ${prefix}/share/${file})
    message(SEND_ERROR "share/${file} is not installed")
  endif()
endforeach()

# The backend that was made outside, found by name on the path.
file(GLOB outside ${WORK}/build/plumb-outside.so)
set(ENV{PLUMB_BACKEND_PATH} ${WORK}/build)
run("the C++ host" ${WORK}/build/fall outside)
if(NOT output MATCHES "sample: fell 4.910 m")  # g dt^2 n(n+1)/2, semi-implicit Euler
  message(FATAL_ERROR "the C++ host printed: ${output}")
endif()
message(STATUS "${output}")
run("" ${WORK}/build/fall outsid)
if(result EQUAL 0 OR NOT output MATCHES "outside")
  message(FATAL_ERROR "a misspelt backend was answered with ${result}: ${output}")
endif()

# It has no boxes: the C host must say so and stop.
run("" ${WORK}/build/tower ${outside})
if(NOT result EQUAL 3)
  message(FATAL_ERROR "the C host ended with ${result} on a backend without collision: ${output}")
endif()
message(STATUS "${output}")

# The host that the README shows is the one that was built here.
file(READ ${PROJECT}/drop.cpp shown)
file(READ ${PROJECT}/../../../README.md readme)
string(FIND "${readme}" "${shown}" place)
if(place EQUAL -1)
  message(SEND_ERROR "README.md does not show tests/install/project/drop.cpp as it is")
endif()
if(EXISTS ${prefix}/lib/plumb/plumb-impulse.so)
  set(ENV{PLUMB_BACKEND_PATH} ${prefix}/lib/plumb)
  run("the README's host" ${WORK}/build/drop)
  if(NOT output MATCHES "rests at 0\\.(49|50)")
    message(SEND_ERROR "the README's host printed: ${output}")
  endif()
endif()

# Every installed engine holds the tower up, a process each.
file(GLOB backends ${prefix}/lib/plumb/plumb-*.so)
foreach(backend ${backends})
  run("" ${WORK}/build/tower ${backend})
  if(output MATCHES "${STEPS_ASIDE}")
    message(STATUS "${output}")
    continue()
  endif()
  if(NOT result EQUAL 0 OR NOT output MATCHES "top at 9\\.[45]")
    message(SEND_ERROR "the tower of ten does not stand on ${backend}: ${output}")
  endif()
  message(STATUS "${output}")
endforeach()
