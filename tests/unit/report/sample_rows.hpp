// Made-up but realistic results for the tests of the reports: two engines and a misbehaving third over scenes of every
// kind, with sweeps of dt and settings. Deterministic.
#pragma once

#include <vector>

#include "base/json.hpp"

namespace plumb::harness::testing {

/// The smallest valid row: status ok, one metric "error_of_it" with this error and threshold 0.01, gold 1e-4.
[[nodiscard]] Json sample_row(const char* scene, const char* backend, double error, double ms_per_step);

/// `sweeps` cells a problem and backend beside the default one; 0 gives what `compare` would.
[[nodiscard]] std::vector<Json> sample_rows(int sweeps);

}  // namespace plumb::harness::testing
