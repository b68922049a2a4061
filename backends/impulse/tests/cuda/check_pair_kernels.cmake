# cmake -D PTX=FILE -P: a kernel for a pair of types holds the code of that pair and of no other. Such code has come in
# unseen before: a function that branches on types known at the call was called instead of being built for them.
file(READ "${PTX}" ptx)
foreach(part entry func)
  string(REGEX MATCHALL "\\.${part} " found "${ptx}")
  list(LENGTH found ${part})
endforeach()
string(REGEX MATCHALL "\n" lines "${ptx}")
list(LENGTH lines count)
message(STATUS "${PTX}: ${entry} kernels, ${func} functions, ${count} lines")
if(NOT entry EQUAL 2 OR NOT func EQUAL 0 OR count GREATER 1100)
  message(FATAL_ERROR "two balls, and a ball on a plane, should be 2 kernels of fewer than 1100 lines of PTX that call no "
    "function: here they have the code of other pairs, too")
endif()
