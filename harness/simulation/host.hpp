// The host of a scene at work: before each step it moves, pushes, sets motors and cuts as the scene says.
#pragma once

#include <memory>
#include <vector>

#include "scene/expressions.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

class Simulation;

class Host {
 public:
  /// Scene must outlive it.
  explicit Host(const Scene& scene);
  /// Does what belongs to the step that begins now. Throws Error.
  void before_step(Simulation& simulation);

 private:
  /// An action with its expressions compiled.
  struct Actor {
    const SceneAction* action;
    std::unique_ptr<Expressions> names;

    [[nodiscard]] std::vector<double> numbers(double time) const;
  };
  struct Cut {
    std::size_t joint;
    double time;
  };
  void act(Simulation& simulation, const Actor& actor) const;

  const Scene& scene_;
  std::vector<Actor> actors_;
  std::vector<Cut> cuts_;  ///< still to come, the next one last
};

}  // namespace plumb::harness
