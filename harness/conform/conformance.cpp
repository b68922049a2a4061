#include "conform/conformance.hpp"

#include "plumb/backend/names.hpp"
#include "plumb/layers.hpp"

namespace plumb::harness::conform {

PlumbNeeds Conformance::available(PlumbNeeds wanted) const {
  PlumbNeeds has = 0;
  for (std::uint32_t index = 0; index < PLUMB_NEED_COUNT; ++index)
    if (((wanted >> index) & 1) != 0 && backend_.capability(PLUMB_CAP_NEED, index) != PLUMB_NONE)
      has |= PlumbNeeds{1} << index;
  return has;
}

void Conformance::require_needs(PlumbNeeds needs) {
  for (std::uint32_t index = 0; index < PLUMB_NEED_COUNT; ++index)
    if (((needs >> index) & 1) != 0) require(PLUMB_CAP_NEED, index, 0, backend::need_name(index));
}

std::vector<Check> all_checks() {
  std::vector<Check> checks;
  for (const std::span<const Check> group :
       {shape_checks(),        body_checks(),         exact_body_checks(), material_checks(),    exact_contact_checks(),
        handle_checks(),       event_checks(),        exception_checks(),  joint_checks(),       joint_axis_checks(),
        exact_joint_checks(),  swing_twist_checks(),  gear_checks(),       drive_checks(),       modify_checks(),
        modify_joint_checks(), modify_shape_checks(), cooking_checks(),    manifold_checks(),    query_checks(),
        exact_query_checks(),  query_target_checks(), closest_checks(),    penetration_checks(), turning_cast_checks(),
        memory_checks(),       debug_checks(),        setting_checks(),    snapshot_checks(),    thread_checks()})
    checks.insert(checks.end(), group.begin(), group.end());
  return checks;
}

CheckResult run_check(const Check& check, const Backend& backend) {
  const PlumbBackendTable* validated = layers::validate(&backend.table());
  Conformance conformance(Backend(validated, backend.file()));
  (void)layers::findings(validated);
  try {
    check.run(conformance);
  } catch (const Skipped& skipped) {
    return {Outcome::skipped, conformance.expectations(), {skipped.reason}};
  } catch (const Error& error) {
    conformance.expect(false, "a call failed that should not: {}", error.what());
  }
  CheckResult result{Outcome::passed, conformance.expectations(), conformance.failures()};
  for (const layers::Finding& finding : layers::findings(validated))  // checks make a host's mistakes on purpose
    if (finding.kind == layers::FindingKind::backend_mistake)
      result.failures.push_back("validation layer: " + finding.text);
  if (!result.failures.empty()) result.outcome = Outcome::failed;
  return result;
}

}  // namespace plumb::harness::conform
