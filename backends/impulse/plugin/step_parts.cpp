// A step as the simulation takes it: whole, or in parts where it made energy (solver/energy_bound.hpp).
#include <algorithm>

#include "plugin/world.hpp"

namespace plumb::impulse {

namespace {

/// A part may be divided likewise, so many times over.
constexpr int kMostDivisions = 2;
/// Steps are divided from the start for so long after one that made energy: what moves so that whole steps do goes on
/// to for a while. s
constexpr double kStaysDivided = 0.5;

}  // namespace

/// Enqueues a step, or a part of one that was divided so many times. In parts errors of joints are taken back no faster
/// than in the time of the whole step: what is taut lifts what lies on it by many times the error.
void World::start(double dt, int divided, bool is_repeat) {
  if (pacing_.parts.any_done) keep_part();
  simulation_.choose(settings_.broad_phase);
  simulation_.joints.solve_one_by_one(settings_.joints_one_by_one);
  const double most_rate = divided == 0 ? 0 : 1 / pacing_.dt;
  const SubstepLevels levels = settings_.levels(dt, pacing_.last_h, most_rate);
  StepParameters parameters = settings_.parameters(dt, gravity_, levels);
  parameters.may_be_taken_back = divided < kMostDivisions;
  parameters.is_repeat = is_repeat;
  parameters.is_later_part = pacing_.parts.any_done;
  parameters.lets_go = pacing_.lets_go && !pacing_.parts.any_done;
  simulation_.step(parameters, levels);
}

/// Of the parts of the step the first is under way.
void World::finish_steps() {
  const int divided = pacing_.parts.count > 1 ? 1 : 0;
  const double part = pacing_.dt / pacing_.parts.count;
  finish(part, divided);
  for (int k = 1; k < pacing_.parts.count; ++k) {
    start(part, divided);
    finish(part, divided);
  }
  if (pacing_.parts.gained) pacing_.divides_for = kStaysDivided;
  pacing_.lets_go = false;
}

/// When it is done: what is told and remembered of it. Goes over it again where joints did not hold as predicted, and
/// in parts where it made energy.
void World::finish(double dt, int divided) {
  simulation_.wait();
  const StepCounters& counters = simulation_.counters();
  tell(PLUMB_EVENT_WAKE, simulation_.outcome().woken, told_.events);
  pacing_.parts.gained = pacing_.parts.gained || counters.gained != 0;
  pacing_.parts.repeated = pacing_.parts.repeated || simulation_.outcome().repeated;
  pacing_.parts.grew = pacing_.parts.grew || simulation_.outcome().grew;
  if (counters.let_go != 0) {
    pacing_.parts.repeated = true;
    start(dt, divided, true);
    return finish(dt, divided);
  }
  if (simulation_.taken_back()) {
    for (int k = 0; k < kParts; ++k) {
      start(dt / kParts, divided + 1);
      finish(dt / kParts, divided + 1);
    }
    return;
  }
  tell(PLUMB_EVENT_SLEEP, simulation_.outcome().fallen_asleep, told_.events);
  pacing_.last_h = settings_.substep(dt, counters.substeps != 0 ? counters.substeps : settings_.substeps);
  pacing_.parts.any_done = true;
}

/// The last part's contacts, and what it lost, before there is another.
void World::keep_part() {
  if (simulation_.taken_back()) return;
  pacing_.parts.nonfinite += simulation_.counters().nonfinite;
  if (!init_.needs(PLUMB_NEED_CONTACT_IMPULSES) && !init_.needs(PLUMB_NEED_EVENTS)) return;
  const std::vector<ContactRecord> contacts = simulation_.contacts();
  pacing_.parts.contacts.insert(pacing_.parts.contacts.end(), contacts.begin(), contacts.end());
}

}  // namespace plumb::impulse
