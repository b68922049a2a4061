# plumb_add_backend(NAME SOURCES...): a loadable backend plumb-NAME.so that exports plumb_backend_open and nothing else.
# The global property PLUMB_BACKENDS lists all that were added so far.
set(PLUMB_BACKEND_MAP "${CMAKE_CURRENT_LIST_DIR}/backend.map" CACHE INTERNAL "")
function(plumb_add_backend name)
  set(target plumb-backend-${name})
  add_library(${target} MODULE ${ARGN})
  set_property(GLOBAL APPEND PROPERTY PLUMB_BACKENDS ${name})
  target_link_libraries(${target} PRIVATE plumb::backend)
  target_compile_features(${target} PRIVATE cxx_std_20)
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME plumb-${name}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(PLUMB_BACKEND_DIRECTORY)
    set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${PLUMB_BACKEND_DIRECTORY}")
  endif()
  if(CMAKE_SYSTEM_NAME STREQUAL Linux)
    set_target_properties(${target} PROPERTIES LINK_DEPENDS "${PLUMB_BACKEND_MAP}")
    target_link_options(${target} PRIVATE "LINKER:--version-script=${PLUMB_BACKEND_MAP}")
    if(NOT PLUMB_SANITIZE)
      target_link_options(${target} PRIVATE LINKER:--no-undefined)
    endif()
  endif()
endfunction()

# plumb_tune_backend(NAME FILE): the settings of the profile "tuned", beside the backend's library.
function(plumb_tune_backend name file)
  set(target plumb-backend-${name})
  add_custom_command(TARGET ${target} POST_BUILD VERBATIM COMMAND ${CMAKE_COMMAND} -E copy_if_different
    "${CMAKE_CURRENT_SOURCE_DIR}/${file}" "$<TARGET_FILE_DIR:${target}>/plumb-${name}.tuned.json")
  install(FILES ${file} DESTINATION lib/plumb RENAME plumb-${name}.tuned.json)
endfunction()
