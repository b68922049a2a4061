// The worker's side: one backend, opened once, that answers requests until its parent is gone.
#pragma once

#include <string>

namespace plumb::harness {

/// Serves on the descriptors of progress.hpp. Requests: {"request": "describe"}, answered by describe() or by
/// {"status": "error", "reason"}; {"request": "run", ...} as run_cell takes it; {"request": "conform", "check"} as
/// conform::answer_request does. Returns the exit status.
int serve_as_worker(const std::string& backend_file);

}  // namespace plumb::harness
