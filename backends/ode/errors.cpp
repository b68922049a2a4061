// The handlers are one set for the process; which world an error belongs to is known by the thread it happens on.
#include "errors.hpp"

#include <ode/ode.h>

#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <string>

namespace plumb::ode {
namespace {

thread_local const WorldInit* current = nullptr;

std::string format(const char* text, std::va_list arguments) {
  char line[512];
  std::vsnprintf(line, sizeof line, text, arguments);
  return line;
}

void on_fatal(const char* what, int number, const char* text, std::va_list arguments) {
  const std::string line = std::string("ODE ") + what + " " + std::to_string(number) + ": " + format(text, arguments);
  if (current != nullptr) throw Error(PLUMB_E_WORLD_LOST, line + "; destroy the world and start anew");
  std::fprintf(stderr, "%s\n", line.c_str());
}

void on_error(int number, const char* text, std::va_list arguments) { on_fatal("error", number, text, arguments); }
void on_debug(int number, const char* text, std::va_list arguments) {
  on_fatal("failed assertion", number, text, arguments);
}
void on_message(int number, const char* text, std::va_list arguments) {
  if (current == nullptr) return;
  current->log(PLUMB_LOG_WARNING, "ODE message " + std::to_string(number) + ": " + format(text, arguments));
}

/// Somebody else in this process who uses ODE may have set other handlers since.
void install_handlers() {
  if (dGetErrorHandler() != on_error) dSetErrorHandler(on_error);
  if (dGetDebugHandler() != on_debug) dSetDebugHandler(on_debug);
  if (dGetMessageHandler() != on_message) dSetMessageHandler(on_message);
}

}  // namespace

void ensure_ode() {
  install_handlers();
  static const bool started = dInitODE2(0) != 0;
  thread_local const bool allocated =
      started && dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll)) != 0;
  if (!allocated) throw Error(PLUMB_E_OUT_OF_MEMORY, "ODE cannot allocate its data for this thread");
}

ErrorScope::ErrorScope(const WorldInit& init) : outer_(current) {
  ensure_ode();
  current = &init;
}

ErrorScope::~ErrorScope() { current = outer_; }

}  // namespace plumb::ode
