// One scene built in one world of one backend, stepped and observed. What measures are written against.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "plumb/loader.hpp"
#include "scene/scene.hpp"
#include "simulation/cell_clock.hpp"

namespace plumb::harness {

/// Rows of all bodies of the scene, in its order, float64, as the world's batch reads deliver them.
struct PoseRow {
  PlumbVec3 position;
  PlumbQuat orientation;
};
struct VelocityRow {
  PlumbVec3 linear;  ///< of the centre of mass
  PlumbVec3 angular;
};

class Simulation;

/// Watches a simulation from its start to its end, always outside the timing; for recording and general metrics.
class SimulationObserver {
 public:
  virtual ~SimulationObserver() = default;
  virtual void started(Simulation&) {}
  virtual void stepped(Simulation&) {}
  virtual void ended(Simulation&) noexcept {}  ///< from the destructor
};

struct SimulationOptions {
  std::vector<std::pair<std::string, PlumbSettingValue>> settings;  ///< already checked against the backend
  std::uint32_t threads = 1;
  bool needs_all = false;  ///< declare every need that the backend has, not just the scene's
  std::shared_ptr<SimulationObserver> observer = nullptr;
  CellClock* clock = nullptr;  ///< told which time is the engine's; null: nobody asks
};

/// Wall times of the steps, and the worst of what the reports said.
struct StepStatistics {
  std::vector<double> step_ms;  ///< from step until the pose rows are in the harness's memory
  double setup_ms = 0;
  std::uint32_t contacts_max = 0;
  std::uint64_t dropped = 0;
  std::uint32_t nonfinite = 0;
  std::uint64_t solver_fallbacks = 0;
  std::uint64_t energy_bounded = 0;  // steps
  std::uint64_t steps_repeated = 0;
  std::vector<double> phase_ms;  ///< medians by PlumbPhase, NaN where not known
};

class Simulation {
 public:
  /// Builds the scene; throws Error (with code PLUMB_E_UNSUPPORTED where the engine lacks something).
  Simulation(Backend& backend, const Scene& scene, const SimulationOptions& options);
  ~Simulation();
  Simulation(Simulation&&) noexcept;

  [[nodiscard]] const Scene& scene() const;
  /// What is done with it is taken for the engine's doing, until the next call here returns.
  [[nodiscard]] IPhysicsWorld& world();
  [[nodiscard]] PlumbBody handle(std::size_t body) const;
  [[nodiscard]] PlumbJoint joint_handle(std::size_t joint) const;

  /// One timed step of scene().dt, then reads poses. False when scene().seconds are over (nothing was done).
  bool advance();
  /// The same in two, for worlds that are stepped together: the first is false when the scene's seconds are over.
  bool begin_step();
  void finish_step();
  /// Steps until the end; calls `observe` after each step when given.
  void run(const std::function<void(Simulation&)>& observe = {});

  [[nodiscard]] double time() const;  ///< steps * dt
  [[nodiscard]] std::uint64_t steps() const;
  [[nodiscard]] std::span<const PoseRow> poses() const;     ///< as of the last step (or the start)
  [[nodiscard]] std::span<const VelocityRow> velocities();  ///< read on first use after a step, outside the timing
  [[nodiscard]] std::span<const PlumbContact> contacts();   ///< likewise; the scene must need contacts
  [[nodiscard]] std::span<const PlumbEvent> events();
  [[nodiscard]] const PlumbStepReport& report() const;             ///< of the last step
  [[nodiscard]] PlumbVec3 centre_of_mass(std::size_t body) const;  ///< world, of the last step
  [[nodiscard]] bool finite() const;                               ///< no pose so far was NaN or infinite

  /// Host actions between steps, by body index; all throw Error on failure.
  void write(PlumbField field, std::size_t body, std::span<const double> row);
  void set_gravity(const PlumbVec3& gravity);

  [[nodiscard]] const StepStatistics& statistics() const;
  [[nodiscard]] std::uint64_t state_hash();  ///< of all bodies' poses and velocities (referee/hash.hpp)

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace plumb::harness
