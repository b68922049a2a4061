#include "library.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <memory>

#include "child.hpp"

namespace plumb::wire {
namespace {

constexpr double kDescribeSeconds = 30;

std::string folder_of_library() {
  static const char here = 0;
  Dl_info found{};
  if (dladdr(&here, &found) == 0 || found.dli_fname == nullptr) return ".";
  std::error_code error;
  return std::filesystem::absolute(found.dli_fname, error).parent_path().string();
}

struct Asked {
  std::unique_ptr<Manifest> manifest;
  std::string why_not;
};

const Asked& asked() {
  static const Asked once = [] {
    Asked answer;
    try {
      Child child(child_command());
      const Frame reply = child.call(Call::kDescribe, "", {}, std::chrono::duration<double>(kDescribeSeconds));
      answer.manifest = std::make_unique<Manifest>(reply.text, PLUMB_WIRE_NAME);
      answer.why_not = answer.manifest->unmet();
    } catch (const std::exception& error) {
      answer.why_not = error.what();
    }
    return answer;
  }();
  return once;
}

}  // namespace

const std::vector<std::string>& child_command() {
  static const std::vector<std::string> command = [] {
    std::vector<std::string> words = {PLUMB_WIRE_COMMAND};
    for (std::string& word : words)
      if (word.starts_with("@/")) word.replace(0, 1, folder_of_library());
    return words;
  }();
  return command;
}

const Manifest& manifest() {
  if (asked().manifest == nullptr) throw Error(PLUMB_E_UNSUPPORTED, asked().why_not);
  return *asked().manifest;
}

std::string why_not() { return asked().why_not; }

const PlumbBackendInfo& info_or_name() {
  if (asked().manifest != nullptr) return asked().manifest->info();
  static const PlumbBackendInfo unknown = [] {
    PlumbBackendInfo info{};
    info.struct_size = sizeof info;
    info.name = PLUMB_WIRE_NAME;
    info.version = info.build = info.exclusion_group = "";
    info.description = "an engine in a child process, which could not be asked";
    info.device = "cpu";
    info.precision = PLUMB_F64;
    info.max_threads = 1;
    return info;
  }();
  return unknown;
}

}  // namespace plumb::wire
