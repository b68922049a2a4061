// Nothing but a file to compile others' headers for: harness/CMakeLists.txt names them.
