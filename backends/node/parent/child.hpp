// A child process that holds a world, and calls to it with a deadline. What it dies of ends the world, never the host.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "frame.hpp"

namespace plumb::wire {

/// Closes a descriptor at its end of life.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();
  [[nodiscard]] int get() const { return number_; }

 private:
  int number_;
};

class Child {
 public:
  /// Starts `command`, looked up on PATH, with the wire at descriptor 3, in the host's process group. Throws
  /// PLUMB_E_UNSUPPORTED when it cannot be started.
  explicit Child(const std::vector<std::string>& command);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  /// Kills it.
  ~Child();

  /// One round trip. Throws the child's own failure; and PLUMB_E_WORLD_LOST, after which nothing more may be asked,
  /// when it dies, answers later than `deadline`, or answers something that is no frame of this wire.
  Frame call(Call call, const std::string& text, std::span<const double> numbers,
             std::chrono::duration<double> deadline);

 private:
  void send(std::span<const std::byte> bytes);
  void receive(std::span<std::byte> bytes);
  void wait_for(short events);
  void keep_errors();
  [[noreturn]] void lose(const std::string& what);
  std::string how_it_ended();

  std::string program_;
  Descriptor wire_, errors_;
  pid_t pid_ = -1;
  Call asked_ = Call::kDescribe;
  std::uint32_t sequence_ = 0;
  std::chrono::steady_clock::time_point until_;
  double deadline_seconds_ = 0;
  std::string last_errors_;  ///< the end of what it wrote to stdout and stderr
  std::string lost_;         ///< why it is no more, once it is
};

}  // namespace plumb::wire
