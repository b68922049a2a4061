// Layers slide between a host and a backend without recompiling either: each takes a backend's table and gives one
// back.
//
//   validate  checks that both sides keep the rules of plumb.h (phases, threads, sizes, capacities, results)
//   trace     writes every call to a file, which replay() runs again on any backend
//   inject    makes one chosen call fail, so that a host can show that it survives
//
// Layers never wrap handles and pass unknown extensions through, so they stack in any order. What they return lives as
// long as the process, unless said otherwise, and there is room for 16 of each kind at a time; more throw Error.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::layers {

/// A table that forwards to next and holds both sides to plumb.h. The same next gives the same table; a table that
/// validates already is given back as it is.
///
/// A host's mistake is refused before next hears of it: PLUMB_E_WRONG_PHASE, PLUMB_E_WRONG_THREAD or
/// PLUMB_E_INVALID_ARGUMENT. A backend's mistake is answered with PLUMB_E_INTERNAL after the fact. Either way the error
/// text says what was wrong, and findings() keeps the sentence and whose mistake it was.
[[nodiscard]] const PlumbBackendTable* validate(const PlumbBackendTable* next);

/// Which side of the wall broke a rule.
enum class FindingKind { host_mistake, backend_mistake };

struct Finding {
  FindingKind kind;
  std::string text;  ///< "create_bodies: the backend left ids[1] unwritten"
};

/// What the validation layer refused or found since it was last asked, oldest first (at most 1000). Empty for a table
/// that validate() did not give.
[[nodiscard]] std::vector<Finding> findings(const PlumbBackendTable* validated);

struct TraceOptions {
  std::uint32_t rows_every = 10;  ///< steps from one full record of the state rows to the next; >= 1
};

/// A table that forwards to next and writes every call with its inputs, its result, and its outputs to file (format:
/// src/layers/trace_format.hpp). Throws Error when the file cannot be written. The table is good until end_trace.
[[nodiscard]] const PlumbBackendTable* trace(const PlumbBackendTable* next, const std::string& file,
                                             const TraceOptions& options = {});

/// Completes and closes the file of a table that trace() gave; its worlds must be destroyed by then, and the table is
/// not called again. Throws Error when something could not be written.
void end_trace(const PlumbBackendTable* traced);

/// Where a replay first answered a call differently.
struct ResultDifference {
  std::uint64_t call = 0;  ///< the how manieth of the trace, from 1
  std::string name;        ///< "create_bodies", "joints.read"
  PlumbResult recorded = 0, replayed = 0;
  std::string text;  ///< of the failing side; "" when neither failed
};

/// Where a replay's state first left the recorded one.
struct StateDifference {
  std::uint64_t world = 0;     ///< the how manieth world of the trace, from 1
  std::uint64_t step = 0;      ///< first step after which the hashes differ, from 1
  std::uint64_t row_step = 0;  ///< first step from there on whose rows were recorded; what follows is about it
  std::string field;           ///< "position.y", "orientation.w", "linear_velocity.x"; "" when those rows are equal
  std::uint64_t body = 0;      ///< the how manieth body of the world in order of creation, from 1; 0: "" above
  double recorded = 0, replayed = 0;
  double largest = 0;        ///< |recorded - replayed| of body and field, the largest of all bodies and fields
  std::uint64_t bodies = 0;  ///< how many bodies' rows differ
};

/// What a trace says of where it comes from.
struct TraceHeader {
  std::string backend, version, build, device;
  std::uint32_t rows_every = 0;
};

struct ReplayReport {
  TraceHeader recorded;
  std::vector<std::pair<std::string, std::string>> settings;  ///< in force in the first world of the trace
  std::uint64_t calls = 0, worlds = 0, steps = 0;
  std::uint64_t results_differ = 0, outputs_differ = 0;  ///< calls
  std::optional<ResultDifference> result;
  std::optional<std::string> first_output;  ///< "call 12 (contacts)": the first whose outputs differ
  std::optional<StateDifference> state;

  [[nodiscard]] bool same() const { return results_differ == 0 && outputs_differ == 0 && !state; }
};

/// The header alone; throws as replay() does.
[[nodiscard]] TraceHeader trace_header(const std::string& file);

/// Replays a trace on a backend: the same calls in the same order, handles translated. Throws Error: PLUMB_E_CORRUPT
/// for a file that is foreign, torn or of another version, PLUMB_E_INVALID_ARGUMENT for one that cannot be read.
[[nodiscard]] ReplayReport replay(const std::string& file, const PlumbBackendTable* table);

/// Which call is to fail: the nth (from 1) of a name, of all worlds together, answers result and is not forwarded.
struct Fault {
  std::string call;  ///< "step", "joints.create"
  std::uint64_t nth = 1;
  PlumbResult result = PLUMB_E_INTERNAL;  ///< below 0
};

/// Throws Error (PLUMB_E_INVALID_ARGUMENT) for a call that is not known or a result that is not a failure.
[[nodiscard]] const PlumbBackendTable* inject(const PlumbBackendTable* next, const Fault& fault);

}  // namespace plumb::layers
