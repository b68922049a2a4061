// A robot's file as a scene, and what is done to it before it runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.hpp"

namespace plumb::harness::testing {

/// Made by `plumb convert` of a file that a package put on this machine.
class RobotScene {
 public:
  /// Throws std::runtime_error with what the program said.
  RobotScene(const std::filesystem::path& file, const std::vector<std::string>& options, double seconds);

  /// N, of all that moves.
  [[nodiscard]] double weight() const;
  /// m, from the lowest frame of a body to the highest.
  [[nodiscard]] double height() const;

  /// Hinges to which the file gives no friction get this much, N m.
  void rub(double effort);
  /// A mass is fixed to a body, kg.
  void load(const std::string& body, double mass);
  /// The part along y, or all of a vector without one, of what `plumb` calls a quantity; the truth is 0.
  void watch(const std::string& name, const Json& quantity, const std::string& unit);

  /// The metrics of one backend. Throws std::runtime_error with its reason where it does not run.
  [[nodiscard]] Json run(const std::string& backend) const;

 private:
  [[nodiscard]] bool moves(const Json& body) const;
  Json scene_;
};

/// Backends of this machine to which nothing is approximate: what is demanded of robots is demanded of them.
[[nodiscard]] std::vector<std::string> exact_backends();

}  // namespace plumb::harness::testing
