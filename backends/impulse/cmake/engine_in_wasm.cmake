# Nothing is loaded at run time there: what uses the engine is linked with it. lib/plumb has what pages load, by plumb.mjs,
# and is a package that npm can pack: plumb-impulse.wasm, of one thread, and plumb-impulse-threads.wasm for where memory
# may be shared. Both are linked of the same objects: atomic instructions do without shared memory, too.
plumb_impulse_cpu_objects(plumb_impulse_objects)
target_compile_definitions(plumb_impulse_objects PRIVATE
  PLUMB_IMPULSE_NAME="impulse" PLUMB_IMPULSE_BUILD="${PLUMB_IMPULSE_BUILD} wasm32")
set(web ${PROJECT_SOURCE_DIR}/api/web)
add_library(plumb_impulse_exports OBJECT
  plugin/plugin.cpp ${web}/exports/engine.cpp ${web}/exports/world.cpp ${web}/exports/extensions.cpp)
target_include_directories(plumb_impulse_exports PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(plumb_impulse_exports PRIVATE plumb::loader plumb_private)

# plumb_impulse_in_wasm(TARGET): a .wasm of one thread that has the engine.
function(plumb_impulse_in_wasm target)
  set(cpu ${PROJECT_SOURCE_DIR}/backends/impulse/exec/cpu)
  target_sources(${target} PRIVATE ${cpu}/arena_std.cpp ${cpu}/arena_run.cpp ${cpu}/tls_base_web.cpp)
  target_link_libraries(${target} PRIVATE plumb_impulse_objects plumb::loader plumb_private)
  set_target_properties(${target} PROPERTIES SUFFIX .wasm)
endfunction()

# plumb_impulse_in_wasm_with_threads(TARGET): likewise with threads, over memory that it is given (engine/threads.mjs, which
# knows its sizes). emscripten refuses threads in what stands alone, so that its libraries for them are named here.
function(plumb_impulse_in_wasm_with_threads target)
  set(cpu ${PROJECT_SOURCE_DIR}/backends/impulse/exec/cpu)
  target_sources(${target} PRIVATE ${cpu}/arena_web.cpp ${cpu}/arena_run.cpp)
  target_link_libraries(${target} PRIVATE plumb_impulse_objects plumb::loader plumb_private
    standalonewasm-memgrow c-mt dlmalloc-mt compiler_rt-mt c++-mt-except c++abi-mt-except unwind-mt-except)
  target_link_options(${target} PRIVATE --no-entry -nodefaultlibs -sIMPORTED_MEMORY
    -sINITIAL_MEMORY=16777216 -sMAXIMUM_MEMORY=2147483648
    LINKER:--shared-memory,--export-memory,--export=__stack_pointer)
  set_target_properties(${target} PROPERTIES SUFFIX .wasm)
endfunction()

add_executable(plumb-backend-impulse)
target_link_libraries(plumb-backend-impulse PRIVATE plumb_impulse_exports)
plumb_impulse_in_wasm(plumb-backend-impulse)
target_link_options(plumb-backend-impulse PRIVATE --no-entry)
add_executable(plumb-backend-impulse-threads)
target_link_libraries(plumb-backend-impulse-threads PRIVATE plumb_impulse_exports)
plumb_impulse_in_wasm_with_threads(plumb-backend-impulse-threads)

file(GLOB modules CONFIGURE_DEPENDS ${web}/engine/*.mjs)
set(faces ${web}/plumb.mjs ${web}/plumb.d.mts ${web}/package.json ${web}/README.md)
set_target_properties(plumb-backend-impulse PROPERTIES OUTPUT_NAME plumb-impulse
  RUNTIME_OUTPUT_DIRECTORY ${PLUMB_BACKEND_DIRECTORY} LINK_DEPENDS "${modules};${faces}")
set_target_properties(plumb-backend-impulse-threads PROPERTIES OUTPUT_NAME plumb-impulse-threads
  RUNTIME_OUTPUT_DIRECTORY ${PLUMB_BACKEND_DIRECTORY})
add_custom_command(TARGET plumb-backend-impulse POST_BUILD
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${faces} ${PLUMB_BACKEND_DIRECTORY}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${PLUMB_BACKEND_DIRECTORY}/engine
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${modules} ${PLUMB_BACKEND_DIRECTORY}/engine)
install(FILES ${PLUMB_BACKEND_DIRECTORY}/plumb-impulse.wasm ${PLUMB_BACKEND_DIRECTORY}/plumb-impulse-threads.wasm ${faces}
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/plumb)
install(FILES ${modules} DESTINATION ${CMAKE_INSTALL_LIBDIR}/plumb/engine)
