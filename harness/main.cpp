// plumb: holds physics backends against the truth.
#include "cli/program.hpp"

int main(int count, char** arguments) { return plumb::harness::run_program(count, arguments); }
