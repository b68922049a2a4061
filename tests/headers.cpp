// Nothing but a file to compile others' headers for: tests/CMakeLists.txt names them.
