// Curves: what turning a knob buys. Rows of one backend that are equal in everything but the value of one setting of
// the role "quality" are a curve; the rows themselves say which settings are knobs, so any results may hold curves.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "report/ordered/ordered_rows.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

/// A backend with one choice of everything but knobs, time step and duration.
struct Method {
  std::string backend;
  std::string label;  ///< what tells it from the other methods: "solver si"; never empty
};

/// All that a method did on a problem along one knob.
struct Curve {
  std::string knob;              ///< "" for a cell that is on no curve
  std::vector<const Row*> rows;  ///< at least one; by the knob's value, rising
};

/// A method on a problem, at one time step and duration.
struct MethodCurves {
  std::size_t method;              ///< place in CurveSet::methods
  std::vector<Curve> curves;       ///< those whose knob does something; else the cell with the default knobs
  std::vector<std::string> idle;   ///< knobs that were turned and changed nothing: every state ended with the same bits
  std::vector<const Row*> broken;  ///< cells that did not run to their end
};

struct ProblemCurves {
  const Problem* problem;
  std::vector<MethodCurves> methods;  ///< in the order of CurveSet::methods
};

/// Holds pointers into the rows, which must outlive it.
class CurveSet {
 public:
  explicit CurveSet(const OrderedRows& ordered);

  std::vector<Method> methods;  ///< those on `problems`, in order of appearance
  std::vector<ProblemCurves>
      problems;  ///< in the order of the rows; with a knob that was turned, or methods none of which ran

  /// The row is here because of a knob that is not at the engine's own value.
  [[nodiscard]] bool is_turned(const Row& row) const { return turned_.contains(&row); }

 private:
  std::set<const Row*> turned_;
};

/// The knob's value stands at the engine's own.
[[nodiscard]] bool at_default(const Row& row, const std::string& knob);

}  // namespace plumb::harness
