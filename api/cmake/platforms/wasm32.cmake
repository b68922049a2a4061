# WebAssembly with SIMD and exceptions: Debian's emscripten with a compiler newer than the one that it brings along. A
# program is one .wasm that asks for nothing but WASI's system calls. Objects may be linked with threads, too, for which
# statics have to be made once.
set(config ${CMAKE_CURRENT_LIST_DIR}/emscripten_config.py)
set(EMSCRIPTEN_ROOT_PATH /usr/share/emscripten)
set(EMSCRIPTEN_SYSTEM_PROCESSOR wasm32)
foreach(language C CXX)
  set(CMAKE_${language}_FLAGS_INIT "--em-config ${config} -msimd128 -mnontrapping-fptoint -mbulk-memory -matomics -fthreadsafe-statics -fwasm-exceptions")
endforeach()
set(CMAKE_EXE_LINKER_FLAGS_INIT "-sSTANDALONE_WASM -sALLOW_MEMORY_GROWTH -sWASM_BIGINT")
include(${EMSCRIPTEN_ROOT_PATH}/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_CROSSCOMPILING_EMULATOR node;--no-warnings;${CMAKE_CURRENT_LIST_DIR}/run_wasm.mjs)
