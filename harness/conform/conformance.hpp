// Conformance: what a backend claims, compared with what it does. Any backend can be given to these checks; one that
// lacks a capability skips the checks of it, and nothing else decides what is skipped.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <span>
#include <string>
#include <vector>

#include "plumb/loader.hpp"

namespace plumb::harness::conform {

/// Ends a check that the backend's claims leave out; the reason names the capability.
struct Skipped {
  std::string reason;
};

/// What PLUMB_CAP_NEED calls one PLUMB_NEED_ bit.
constexpr std::uint32_t need_index(PlumbNeeds need) { return static_cast<std::uint32_t>(std::countr_zero(need)); }

/// What a check gets: the backend, and a place for what is wrong.
class Conformance {
 public:
  explicit Conformance(Backend backend) : backend_(std::move(backend)) {}

  [[nodiscard]] Backend& backend() { return backend_; }

  /// Notes a failure unless ok. The text says what was expected and what came out.
  template <class... Arguments>
  void expect(bool ok, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    ++expectations_;
    if (!ok) failures_.push_back(fmt::format(text, std::forward<Arguments>(arguments)...));
  }

  /// Ends the check when the backend says that it has not this.
  PlumbDegree require(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char* what) {
    const PlumbDegree degree = backend_.capability(kind, a, b);
    if (degree == PLUMB_NONE) throw Skipped{fmt::format("no {}: {}", what, backend_.capability_note(kind, a, b))};
    return degree;
  }
  void require_needs(PlumbNeeds needs);

  /// Whether the backend claims the thing with the interface's own meaning: as native or emulated.
  [[nodiscard]] bool is_exact(PlumbCapability kind, std::uint32_t a, std::uint32_t b = 0) const {
    return backend_.capability(kind, a, b) > PLUMB_APPROXIMATE;
  }
  /// Ends the check where the backend has not this, or says that it only approximates it.
  void require_exact(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char* what) {
    if (require(kind, a, b, what) == PLUMB_APPROXIMATE)
      throw Skipped{fmt::format("approximate {}: {}", what, backend_.capability_note(kind, a, b))};
  }

  /// The needs of `wanted` that the backend has.
  [[nodiscard]] PlumbNeeds available(PlumbNeeds wanted) const;

  [[nodiscard]] const std::vector<std::string>& failures() const { return failures_; }
  [[nodiscard]] std::size_t expectations() const { return expectations_; }

 private:
  Backend backend_;
  std::vector<std::string> failures_;
  std::size_t expectations_ = 0;
};

struct Check {
  const char* name;  ///< "pairs.static", what a user types
  const char* doc;   ///< one line
  void (*run)(Conformance&);
};

/// Each file of checks has a list; all_checks joins them.
[[nodiscard]] std::span<const Check> shape_checks();
[[nodiscard]] std::span<const Check> body_checks();
[[nodiscard]] std::span<const Check> exact_body_checks();
[[nodiscard]] std::span<const Check> exact_contact_checks();
[[nodiscard]] std::span<const Check> exact_joint_checks();
[[nodiscard]] std::span<const Check> swing_twist_checks();
[[nodiscard]] std::span<const Check> gear_checks();
[[nodiscard]] std::span<const Check> drive_checks();
[[nodiscard]] std::span<const Check> exact_query_checks();
[[nodiscard]] std::span<const Check> material_checks();
[[nodiscard]] std::span<const Check> handle_checks();
[[nodiscard]] std::span<const Check> event_checks();
[[nodiscard]] std::span<const Check> exception_checks();
[[nodiscard]] std::span<const Check> modify_checks();
[[nodiscard]] std::span<const Check> modify_joint_checks();
[[nodiscard]] std::span<const Check> modify_shape_checks();
[[nodiscard]] std::span<const Check> cooking_checks();
[[nodiscard]] std::span<const Check> manifold_checks();
[[nodiscard]] std::span<const Check> joint_checks();
[[nodiscard]] std::span<const Check> joint_axis_checks();
[[nodiscard]] std::span<const Check> query_checks();
[[nodiscard]] std::span<const Check> query_target_checks();
[[nodiscard]] std::span<const Check> closest_checks();
[[nodiscard]] std::span<const Check> penetration_checks();
[[nodiscard]] std::span<const Check> turning_cast_checks();
[[nodiscard]] std::span<const Check> memory_checks();
[[nodiscard]] std::span<const Check> debug_checks();
[[nodiscard]] std::span<const Check> setting_checks();
[[nodiscard]] std::span<const Check> snapshot_checks();
[[nodiscard]] std::span<const Check> thread_checks();
[[nodiscard]] std::vector<Check> all_checks();

enum class Outcome { passed, failed, skipped };

struct CheckResult {
  Outcome outcome;
  std::size_t expectations;
  std::vector<std::string> failures;  ///< or the one reason of a skip
};

/// Runs one check in this process, on the backend behind the validation layer; what the layer found is a failure too.
[[nodiscard]] CheckResult run_check(const Check& check, const Backend& backend);

}  // namespace plumb::harness::conform
