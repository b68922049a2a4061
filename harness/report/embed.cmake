# Makes a C++ source that defines `NAMESPACE::VARIABLE`, a string_view, as the bytes of a file; of none, where INPUT is
# "". An array of numbers, since compilers limit the length of string literals.
#   cmake -DINPUT=FILE -DOUTPUT=FILE -DHEADER=report/x.hpp -DVARIABLE=name -P embed.cmake
set(bytes "")
if(INPUT)
  file(READ ${INPUT} bytes HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
endif()
file(WRITE ${OUTPUT} "// Made from ${INPUT}.
#include \"${HEADER}\"

namespace plumb::harness {

namespace {
const unsigned char bytes[] = {
${bytes}0x00};
}

const std::string_view ${VARIABLE}(reinterpret_cast<const char*>(bytes), sizeof bytes - 1);

}  // namespace plumb::harness
")
