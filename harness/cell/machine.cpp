#include "cell/machine.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

namespace plumb::harness {

namespace {

// The value of the first "key : value" line of a /proc file.
std::string entry_of(const char* file, const std::string& key) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    const auto colon = line.find(':');
    const auto start = colon == std::string::npos ? colon : line.find_first_not_of(" \t", colon + 1);
    return start == std::string::npos ? "" : line.substr(start);
  }
  return "";
}

std::string operating_system() {
  utsname names{};
  uname(&names);
  std::ifstream lines("/etc/os-release");
  const std::string kernel = std::string(names.sysname) + " " + names.release + " " + names.machine;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("PRETTY_NAME=\"", 0) == 0) return line.substr(13, line.size() - 14) + ", " + kernel;
  }
  return kernel;
}

std::string date_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace

std::uint64_t machine_memory_bytes() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

Json describe_machine() {
  Json machine;
  machine["cpu"] = entry_of("/proc/cpuinfo", "model name");
  machine["cores"] = std::thread::hardware_concurrency();
  machine["memory_mb"] = machine_memory_bytes() / 1'000'000;
  machine["os"] = operating_system();
#if defined(__clang__)
  machine["compiler"] = "clang " __clang_version__;
#else
  machine["compiler"] = "gcc " __VERSION__;
#endif
  machine["build"] = PLUMB_BUILD_TYPE;
  machine["plumb"] = PLUMB_PROGRAM_VERSION;
  machine["date"] = date_now();
  return machine;
}

double peak_memory_mb() {
  std::istringstream text(entry_of("/proc/self/status", "VmHWM"));
  double kilobytes = 0;
  text >> kilobytes;
  return kilobytes * 1024 / 1e6;
}

void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

}  // namespace plumb::harness
