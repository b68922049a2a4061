// plumb problem: writes the contact problem of a scene's step for other solvers. plumb solve: solves such a file.
#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>

#include "base/json.hpp"
#include "cli/manual/examples.hpp"
#include "cli/options/numbers.hpp"
#include "cli/options/one_scene.hpp"
#include "cli/output/draft_file.hpp"
#include "cli/verbs/verbs.hpp"
#include "measure/instruments/step_contacts.hpp"
#include "plumb/loader.hpp"
#include "plumb/nearest.hpp"
#include "reference/fclib.hpp"
#include "reference/solver.hpp"
#include "scene/limits.hpp"
#include "simulation/simulation.hpp"

namespace plumb::harness {
namespace {

struct ProblemOptions {
  std::string scene, backend, out;
  std::vector<std::string> parameters;
  std::uint64_t step = 0;
  bool json = false;
};

struct SolveOptions {
  std::string file;
  double tolerance = reference::SolverOptions{}.tolerance;
  bool json = false;
};

std::vector<referee::BodyState> start_of(const Scene& scene, const std::vector<referee::Mass>& masses) {
  std::vector<referee::BodyState> states;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const PlumbBodyDesc& body = scene.bodies[i].desc;
    states.push_back(
        {masses[i], referee::pose(body.pose), referee::vec(body.linear_velocity), referee::vec(body.angular_velocity)});
  }
  return states;
}

/// States of the scene after so many steps of a backend; before any, those of the scene itself.
std::vector<referee::BodyState> states_after(const Scene& scene, const std::vector<referee::Mass>& masses,
                                             const ProblemOptions& options) {
  if (options.step == 0) return start_of(scene, masses);
  if (options.backend.empty()) throw UsageError("--step " + std::to_string(options.step) + " needs a --backend");
  Backend backend = open_backend(options.backend);
  Simulation simulation(backend, scene, {});
  while (simulation.steps() < options.step) {
    if (!simulation.advance())
      throw UsageError(
          fmt::format("--step {} is beyond the end: scene {} has {}", options.step, scene.id, simulation.steps()));
  }
  if (!simulation.finite()) throw UsageError("by that step a pose is no longer finite");
  return referee::body_states<PoseRow, VelocityRow>(masses, simulation.poses(), simulation.velocities());
}

Json json_of(const reference::Solution& solution) {
  const reference::Residual& residual = solution.residual;
  return {{"converged", solution.converged},
          {"residual",
           {{"natural_map", residual.natural_map},
            {"primal", residual.primal},
            {"dual", residual.dual},
            {"complementarity", residual.complementarity}}},
          {"sweeps", solution.sweeps},
          {"newton_iterations", solution.newton_iterations}};
}

Json rows_of(const Eigen::VectorXd& values, int dimension) {
  Json rows = Json::array();
  for (Eigen::Index c = 0; c < values.size(); c += 3) {
    Json row = Json::array();
    for (int i = 0; i < dimension; ++i) row.push_back(values[c + i]);
    rows.push_back(row);
  }
  return rows;
}

std::string verdict(const reference::Solution& solution) {
  return fmt::format(
      "{}: residual {:.3g} (cone {:.3g}, dual cone {:.3g}, complementarity {:.3g}), {} sweeps, {} Newton "
      "iterations",
      solution.converged ? "solved" : "NOT solved to the tolerance", solution.residual.natural_map,
      solution.residual.primal, solution.residual.dual, solution.residual.complementarity, solution.sweeps,
      solution.newton_iterations);
}

int write_problem(const ProblemOptions& options) {
  DraftFile out(options.out);
  const Scene scene = one_scene(options.scene, options.parameters);
  const StepContacts contacts(scene);
  if (!contacts.obstacle().empty())
    throw UsageError("the contact problem of scene " + scene.id + " is not worked out: " + contacts.obstacle());
  const std::vector<referee::BodyState> states = states_after(scene, contacts.masses(), options);
  if (const std::size_t count = contacts.find(states).size(); count > reference::most_contacts)
    throw UsageError(
        fmt::format("the contact problem of scene {} has {} contacts; at most {} are solved: make the scene "
                    "smaller by --param (plumb scenes {} names its parameters)",
                    scene.id, count, reference::most_contacts, scene.id));
  const reference::StepProblem step = contacts.problem(states);
  const reference::Solution solution = reference::solve(step.problem());
  reference::FclibProblem file;
  file.problem = step.problem();
  file.title = fmt::format("{} {}, step {}", scene.id, scene.slug, options.step);
  file.description = "One time step of rigid bodies, contacts by their geometry at its start; u in m/s, r in N s";
  if (!options.backend.empty()) file.description += "; state by " + options.backend;
  file.math_info = fmt::format("dt {} s; W = H M^-1 H', q = H v_free + gap / dt", scene.dt);
  if (solution.converged) file.impulse = solution.impulse;
  out.write(reference::fclib_bytes(file));
  if (options.json) {
    Json json = json_of(solution);
    json["scene"] = scene.id;
    json["step"] = options.step;
    json["contacts"] = step.problem().contacts();
    json["file"] = options.out;
    std::cout << line_of(json) << "\n";
  } else {
    std::cout << fmt::format("{}: {} contacts in {}\n{}\n", file.title, step.problem().contacts(), options.out,
                             verdict(solution));
  }
  return 0;
}

int solve_file(const SolveOptions& options) {
  const reference::FclibProblem file = reference::read_fclib(options.file);
  reference::SolverOptions wanted;
  wanted.tolerance = options.tolerance;
  const auto start = std::chrono::steady_clock::now();
  const reference::Solution solution = reference::solve(file.problem, wanted);
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (options.json) {
    Json json = json_of(solution);
    json["file"] = options.file;
    json["title"] = file.title;
    json["contacts"] = file.problem.contacts();
    json["spacedim"] = file.spacedim;
    json["milliseconds"] = ms;
    json["impulse"] = rows_of(solution.impulse, file.spacedim);
    json["velocity"] = rows_of(solution.velocity, file.spacedim);
    if (file.impulse) json["residual_of_file"] = reference::residual(file.problem, *file.impulse).natural_map;
    std::cout << line_of(json) << "\n";
    return solution.converged ? 0 : 1;
  }
  std::cout << fmt::format("{}{} contacts, {:.3g} ms\n{}\n", file.title.empty() ? "" : file.title + ": ",
                           file.problem.contacts(), ms, verdict(solution));
  std::cout << fmt::format("{:>7} {:>6} {:>42} {:>42}\n", "contact", "mu", "impulse (normal, tangents)",
                           "velocity (normal, tangents)");
  const auto three = [](const Eigen::VectorXd& v, Eigen::Index at) {
    return fmt::format("{:>13.6g} {:>13.6g} {:>13.6g}", v[at], v[at + 1], v[at + 2]);
  };
  for (Eigen::Index c = 0; c < file.problem.contacts(); ++c)
    std::cout << fmt::format("{:>7} {:>6.4g}  {}  {}\n", c, file.problem.mu[c], three(solution.impulse, 3 * c),
                             three(solution.velocity, 3 * c));
  return solution.converged ? 0 : 1;
}

}  // namespace

void add_problem(CLI::App& program, int& status) {
  auto options = std::make_shared<ProblemOptions>();
  CLI::App* verb = program.add_subcommand(
      "problem", "Write the contact problem of one step of a scene in FCLIB's HDF5 layout, with its exact solution");
  verb->add_option("SCENE", options->scene, "Id, slug or file of one scene")->required();
  verb->add_option("--backend", options->backend, "Name or file of the backend that does the steps before")
      ->type_name("BACKEND");
  verb->add_option("--step", options->step, "Steps done before; 0: as the scene starts")
      ->check(whole_number_within(0, static_cast<std::int64_t>(most_steps)))
      ->capture_default_str();
  verb->add_option("--param", options->parameters, "name=value of a scene's parameter, repeatable")
      ->type_name("NAME=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb->add_option("--out", options->out, "The file to write")->type_name("FILE")->required();
  verb->add_flag("--json", options->json, "Print one JSON object");
  add_examples(*verb, {{"plumb problem D7 --out d7.hdf5", "as the scene starts"},
                       {"plumb problem D7 --backend ode --step 20 --out d7.hdf5", "after 20 steps of an engine"}});
  verb->callback([options, &status] { status = write_problem(*options); });
}

void add_solve(CLI::App& program, int& status) {
  auto options = std::make_shared<SolveOptions>();
  CLI::App* verb = program.add_subcommand("solve", "Solve a contact problem in FCLIB's HDF5 layout, in float64");
  verb->add_option("FILE", options->file, "A file with a local problem (/fclib_local)")->required();
  verb->add_option("--tolerance", options->tolerance, "Of the natural map, relative to |q|; exit with 1 above it")
      ->check(number_above_0())
      ->capture_default_str();
  verb->add_flag("--json", options->json, "Print one JSON object, with impulses and velocities");
  add_examples(*verb, {{"plumb solve d7.hdf5", "impulses, velocities and the residual"},
                       {"plumb solve d7.hdf5 --tolerance 1e-12 --json", "as JSON"}});
  verb->callback([options, &status] { status = solve_file(*options); });
}

}  // namespace plumb::harness
