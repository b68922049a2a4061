#include "conform/request.hpp"

#include "conform/conformance.hpp"

namespace plumb::harness::conform {

nlohmann::ordered_json answer_request(const Backend& backend, const nlohmann::ordered_json& request) {
  constexpr const char* outcomes[] = {"passed", "failed", "skipped"};
  const std::string name = request.at("check");
  for (const Check& check : all_checks()) {
    if (check.name != name) continue;
    const CheckResult result = run_check(check, backend);
    return {{"status", "ok"},
            {"outcome", outcomes[static_cast<int>(result.outcome)]},
            {"expectations", result.expectations},
            {"failures", result.failures}};
  }
  return {{"status", "error"}, {"reason", "no check is called " + name}};
}

}  // namespace plumb::harness::conform
