// A check as a worker is asked for it and as it answers.
#pragma once

#include <nlohmann/json.hpp>

#include "plumb/loader.hpp"

namespace plumb::harness::conform {

/// {"check": NAME} -> {"status": "ok", "outcome": "passed|failed|skipped", "expectations": N, "failures": [...]}.
[[nodiscard]] nlohmann::ordered_json answer_request(const Backend& backend, const nlohmann::ordered_json& request);

}  // namespace plumb::harness::conform
