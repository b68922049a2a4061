# Nothing is loaded at run time there: what uses the engine is linked with it. lib/plumb/plumb-impulse.wasm is what pages
# load, by plumb.mjs beside it.
plumb_impulse_cpu_objects(plumb_impulse_objects)
target_compile_definitions(plumb_impulse_objects PRIVATE
  PLUMB_IMPULSE_NAME="impulse" PLUMB_IMPULSE_BUILD="${PLUMB_IMPULSE_BUILD} wasm32")
set(web ${PROJECT_SOURCE_DIR}/api/web)
add_executable(plumb-backend-impulse plugin/plugin.cpp ${web}/exports.cpp)
target_link_libraries(plumb-backend-impulse PRIVATE plumb_impulse_objects plumb::loader plumb_private)
target_link_options(plumb-backend-impulse PRIVATE --no-entry)
set_target_properties(plumb-backend-impulse PROPERTIES OUTPUT_NAME plumb-impulse SUFFIX .wasm
  RUNTIME_OUTPUT_DIRECTORY ${PLUMB_BACKEND_DIRECTORY})
add_custom_command(TARGET plumb-backend-impulse POST_BUILD COMMAND ${CMAKE_COMMAND} -E copy_if_different
  ${web}/plumb.mjs ${web}/plumb.d.mts ${PLUMB_BACKEND_DIRECTORY})
install(FILES ${PLUMB_BACKEND_DIRECTORY}/plumb-impulse.wasm ${web}/plumb.mjs ${web}/plumb.d.mts
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/plumb)
