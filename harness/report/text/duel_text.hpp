// A duel for a terminal: a line a scene that tells the engines apart, and in sentences what became of the others.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "report/findings/duel.hpp"

namespace plumb::harness {

/// "impulse against bullet, 23 scene variants: 14 scenes tell them apart. impulse is ahead in 13, bullet in 1." and
/// more.
[[nodiscard]] std::vector<std::string> describe_duel(const Duel& duel);

/// "Only impulse runs G4 (bullet: unsupported: no height fields).": a line a variant that one engine cannot run, or
/// neither can.
[[nodiscard]] std::vector<std::string> describe_silence(const Duel& duel);

/// "failed 0.6": the verdict and, where the row has it, the metric's error.
[[nodiscard]] std::string side_text(const Row& row, const std::string& metric);

/// "12.4x drift", "stands", "comes through": what the engine that is ahead has over the other one.
[[nodiscard]] std::string advantage_text(const DuelFinding& finding);

/// terminal_width 0: as wide as need be.
void print_duel(std::ostream& out, const Duel& duel, int terminal_width, bool colour);

}  // namespace plumb::harness
