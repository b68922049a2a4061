// A step as the simulation takes it: whole, or in parts where it made energy or opened a joint
// (solver/energy_bound.hpp).
#include <algorithm>

#include "plugin/world.hpp"

namespace plumb::impulse {

namespace {

/// A part may be divided likewise, so many times over.
constexpr int kMostDivisions = 2;

}  // namespace

/// Enqueues a step, or a part of one.
void World::start(const StepPart& part, bool is_repeat) {
  if (pacing_.parts.any_done) keep_part();
  simulation_.choose(settings_.broad_phase);
  simulation_.joints.solve_one_by_one(settings_.joints_one_by_one);
  const SubstepLevels levels = settings_.levels(part.dt, pacing_.last_h, pacing_.dt);
  StepParameters parameters = settings_.parameters(part.dt, gravity_, levels);
  parameters.may_be_taken_back = part.divided < kMostDivisions;
  parameters.is_repeat = is_repeat;
  parameters.is_later_part = pacing_.parts.any_done;
  parameters.lets_go = pacing_.lets_go && !pacing_.parts.any_done;
  simulation_.step(parameters, levels);
}

void World::divide(const StepPart& whole) {
  pacing_.parts.to_do.insert(pacing_.parts.to_do.end(), kParts, {whole.dt / kParts, whole.divided + 1});
}

/// Takes the parts to the end of the step, and returns true; false where what one has found is shown to the host.
bool World::advance() {
  while (!pacing_.parts.to_do.empty()) {
    if (!simulation_.wait()) return false;
    finish_part();
  }
  return true;
}

/// When it is done: what is told and remembered of it, and the next one begins. Goes over it again where joints did not
/// hold as predicted or were opened, and in parts where it made energy or they are opened all the same.
void World::finish_part() {
  Parts& parts = pacing_.parts;
  const StepPart part = parts.to_do.back();
  const StepCounters& counters = simulation_.counters();
  tell(PLUMB_EVENT_WAKE, simulation_.outcome().woken, told_.events);
  parts.gained = parts.gained || counters.bound.gained != 0;
  parts.repeated = parts.repeated || simulation_.outcome().repeated || counters.bound.still_open != 0;
  parts.grew = parts.grew || simulation_.outcome().grew;
  if (counters.bound.let_go != 0 || counters.bound.opened != 0) {
    parts.repeated = true;
    return start(part, true);
  }
  parts.to_do.pop_back();
  if (simulation_.taken_back()) {
    divide(part);
  } else {
    tell(PLUMB_EVENT_SLEEP, simulation_.outcome().fallen_asleep, told_.events);
    const std::uint32_t substeps = counters.levels.substeps;
    pacing_.last_h = settings_.substep(part.dt, substeps != 0 ? substeps : settings_.substeps_in(pacing_.dt));
    parts.any_done = true;
  }
  if (!parts.to_do.empty()) start(parts.to_do.back());
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
