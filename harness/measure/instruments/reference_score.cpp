#include "measure/instruments/reference_score.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "reference/solver.hpp"

namespace plumb::harness {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using referee::BodyState;
using referee::vec;

constexpr std::size_t most_bodies = 40, most_contacts = 100;
constexpr double least_precision = 1e-8;  // of the reference, so that it is worth comparing with

Index at(std::size_t body) { return 6 * static_cast<Index>(body); }

/// Whether bodies meet in this step: a gap closes, or what touches comes faster than from a step or two of falling.
bool meets_anew(const std::vector<FoundContact>& found, double flat, double dt, double fall) {
  return std::any_of(found.begin(), found.end(), [&](const FoundContact& contact) {
    return contact.gap > flat ? contact.gap + dt * contact.free_speed < 0 : contact.speed < -2 * fall;
  });
}

/// Root of the mean square over all mass of velocities (linear, angular) in the norm of kinetic energy.
double speed_of(std::span<const BodyState> bodies, const VectorXd& velocities) {
  double energy = 0, mass = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].mass.mass <= 0) continue;
    const referee::Vec3 linear = velocities.segment<3>(at(i)), angular = velocities.segment<3>(at(i) + 3);
    energy += bodies[i].mass.mass * linear.squaredNorm() + angular.dot(bodies[i].inertia() * angular);
    mass += bodies[i].mass.mass;
  }
  return std::sqrt(energy / mass);
}

}  // namespace

StepErrors step_errors(const StepContacts& contacts, double dt, std::span<const BodyState> before,
                       std::span<const BodyState> after, const std::optional<VectorXd>& told) {
  using Verdict = StepErrors::Verdict;
  const double flat = contacts.flat(), fall = dt * contacts.forces().gravity.norm();
  StepErrors errors;
  std::vector<FoundContact> found = contacts.find(before);
  const bool touches = std::any_of(found.begin(), found.end(), [&](const FoundContact& c) { return c.gap <= flat; });
  if (!touches || found.size() > most_contacts) return errors;
  errors.verdict = Verdict::meeting;
  if (meets_anew(found, flat, dt, fall)) return errors;
  std::vector<reference::StepContact> points;
  for (FoundContact& one : found) {
    one.contact.bias = one.gap > flat ? one.gap / dt : 0;
    points.push_back(one.contact);
  }
  const reference::StepProblem step(before, std::move(points), contacts.forces());
  reference::SolverOptions options;
  options.rounds = 5;
  const reference::Solution exact = reference::solve(step.problem(), options);
  errors.verdict = Verdict::unsolved;
  errors.residual = exact.residual.natural_map;
  if (errors.residual > least_precision) return errors;
  errors.verdict = Verdict::scored;
  VectorXd difference = step.velocity_after(exact.impulse);
  for (std::size_t i = 0; i < before.size(); ++i) {
    difference.segment<3>(at(i)) -= after[i].linear;
    difference.segment<3>(at(i) + 3) -= after[i].angular;
  }
  errors.velocity = speed_of(before, difference) / fall;
  // As the velocities that the impulses give, so that light bodies count as heavy ones do.
  if (told) errors.force = speed_of(before, step.velocity_of(*told - step.impulse_on_bodies(exact.impulse))) / fall;
  return errors;
}

struct ReferenceScore::State {
  explicit State(const Scene& scene) : contacts(scene) {}

  StepContacts contacts;
  std::unordered_map<PlumbBody, std::size_t> index;
  bool tells_impulses = false;
  std::vector<BodyState> before;
  double velocity_squares = 0, velocity_max = 0, force_squares = 0, residual = 0;
  int steps = 0, force_steps = 0, met = 0, unsolved = 0;

  [[nodiscard]] std::optional<VectorXd> told_by(Simulation& simulation, std::span<const BodyState> after) const;
};

ReferenceScore::ReferenceScore(Simulation& simulation) {
  const Scene& scene = simulation.scene();
  if (scene.bodies.size() > most_bodies || vec(scene.gravity).norm() == 0 || (scene.needs & PLUMB_NEED_COLLISION) == 0)
    return;
  auto state = std::make_unique<State>(scene);
  if (!state->contacts.obstacle().empty()) return;
  state->tells_impulses = (scene.needs & PLUMB_NEED_CONTACT_IMPULSES) != 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) state->index[simulation.handle(i)] = i;
  state_ = std::move(state);
}

ReferenceScore::~ReferenceScore() = default;

void ReferenceScore::before_step(Simulation& simulation) {
  if (!state_) return;
  state_->before = referee::body_states<PoseRow, VelocityRow>(state_->contacts.masses(), simulation.poses(),
                                                              simulation.velocities());
}

void ReferenceScore::after_step(Simulation& simulation) {
  if (!state_ || state_->before.empty() || !simulation.finite()) return;
  State& s = *state_;
  const std::vector<BodyState> before = std::move(s.before);
  s.before.clear();
  const auto after =
      referee::body_states<PoseRow, VelocityRow>(s.contacts.masses(), simulation.poses(), simulation.velocities());
  const StepErrors errors = step_errors(s.contacts, simulation.scene().dt, before, after, s.told_by(simulation, after));
  if (errors.verdict == StepErrors::Verdict::meeting) ++s.met;
  if (errors.verdict == StepErrors::Verdict::unsolved) ++s.unsolved;
  if (errors.verdict != StepErrors::Verdict::scored) return;
  s.residual = std::max(s.residual, errors.residual);
  s.velocity_squares += errors.velocity * errors.velocity;
  s.velocity_max = std::max(s.velocity_max, errors.velocity);
  ++s.steps;
  if (!errors.force) return;
  s.force_squares += *errors.force * *errors.force;
  ++s.force_steps;
}

std::optional<VectorXd> ReferenceScore::State::told_by(Simulation& simulation, std::span<const BodyState> after) const {
  if (!tells_impulses) return std::nullopt;
  VectorXd told = VectorXd::Zero(at(after.size()));
  for (const PlumbContact& contact : simulation.contacts()) {
    const auto a = index.find(contact.body_a), b = index.find(contact.body_b);
    if (a == index.end() || b == index.end()) continue;
    const referee::Vec3 impulse = contact.normal_impulse * vec(contact.normal) + vec(contact.tangent_impulse);
    if (!impulse.allFinite()) return std::nullopt;
    for (const auto& [body, sign] : {std::pair{a->second, -1.0}, {b->second, 1.0}}) {
      told.segment<3>(at(body)) += sign * impulse;
      told.segment<3>(at(body) + 3) += sign * (vec(contact.position) - after[body].centre()).cross(impulse);
    }
  }
  return told;
}

void ReferenceScore::add_to(std::vector<Metric>& metrics) const {
  if (!state_ || state_->steps == 0) return;
  const State& s = *state_;
  const auto add = [&](const char* name, double value, const std::string& note) {
    metrics.push_back({name, value, 0.0, std::abs(value), std::nullopt, note});
  };
  std::string sampled = std::to_string(s.steps) + " sampled steps";
  if (s.met > 0) sampled += ", " + std::to_string(s.met) + " left out in which bodies met";
  if (s.unsolved > 0) sampled += ", " + std::to_string(s.unsolved) + " that the reference did not solve";
  const std::string unit = "; 1: what a step of gravity gives";
  add("reference_velocity_error", std::sqrt(s.velocity_squares / s.steps), "RMS over " + sampled + unit);
  add("reference_velocity_error_max", s.velocity_max, "of " + sampled + unit);
  if (s.force_steps > 0)
    add("reference_force_error", std::sqrt(s.force_squares / s.force_steps),
        "net impulse on each body, as the speed it gives; RMS over " + sampled + unit);
  add("reference_residual", s.residual, "natural map of the exact solution itself, worst");
}

std::vector<MetricSpec> ReferenceScore::specs() {
  std::vector<MetricSpec> specs;
  for (const char* name :
       {"reference_velocity_error", "reference_velocity_error_max", "reference_force_error", "reference_residual"})
    specs.push_back({name, "1", "", std::nullopt, std::nullopt});
  return specs;
}

}  // namespace plumb::harness
