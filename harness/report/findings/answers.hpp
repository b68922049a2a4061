// Questions that people ask first, answered from the numbers.
#pragma once

#include <string>
#include <vector>

#include "report/findings/facts.hpp"

namespace plumb::harness {

struct AnswerLine {
  std::string backend;
  std::vector<Statement> statements;  ///< at least one
  bool good = false;                  ///< the engine is an answer to "who?": each row that it shows passes its scene
};

struct AnsweredQuestion {
  std::string question;
  std::string verdict;            ///< the answer in a sentence
  std::vector<AnswerLine> lines;  ///< by engine, the best first
  std::string section;            ///< of the page that has it all: "cost"
};

/// Those that the results can answer.
[[nodiscard]] std::vector<AnsweredQuestion> answers(const OrderedRows& ordered, const std::vector<CostLine>& costs);

}  // namespace plumb::harness
