# Nothing is loaded at run time there: what uses the engine is linked with it. lib/plumb/plumb-impulse.wasm is what pages
# load, by plumb.mjs beside it, and is a package that npm can pack.
plumb_impulse_cpu_objects(plumb_impulse_objects)
target_compile_definitions(plumb_impulse_objects PRIVATE
  PLUMB_IMPULSE_NAME="impulse" PLUMB_IMPULSE_BUILD="${PLUMB_IMPULSE_BUILD} wasm32")
set(web ${PROJECT_SOURCE_DIR}/api/web)
add_executable(plumb-backend-impulse plugin/plugin.cpp
  ${web}/exports/engine.cpp ${web}/exports/world.cpp ${web}/exports/extensions.cpp)
target_link_libraries(plumb-backend-impulse PRIVATE plumb_impulse_objects plumb::loader plumb_private)
target_link_options(plumb-backend-impulse PRIVATE --no-entry)
file(GLOB modules CONFIGURE_DEPENDS ${web}/engine/*.mjs)
set(faces ${web}/plumb.mjs ${web}/plumb.d.mts ${web}/package.json ${web}/README.md)
set_target_properties(plumb-backend-impulse PROPERTIES OUTPUT_NAME plumb-impulse SUFFIX .wasm
  RUNTIME_OUTPUT_DIRECTORY ${PLUMB_BACKEND_DIRECTORY} LINK_DEPENDS "${modules};${faces}")
add_custom_command(TARGET plumb-backend-impulse POST_BUILD
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${faces} ${PLUMB_BACKEND_DIRECTORY}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${PLUMB_BACKEND_DIRECTORY}/engine
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${modules} ${PLUMB_BACKEND_DIRECTORY}/engine)
install(FILES ${PLUMB_BACKEND_DIRECTORY}/plumb-impulse.wasm ${faces} DESTINATION ${CMAKE_INSTALL_LIBDIR}/plumb)
install(FILES ${modules} DESTINATION ${CMAKE_INSTALL_LIBDIR}/plumb/engine)
