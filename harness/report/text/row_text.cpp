#include "report/text/row_text.hpp"

#include <algorithm>

#include "base/format.hpp"

namespace plumb::harness {

const char* colour_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::gold: return "33";
    case Verdict::pass: return "32";
    case Verdict::ran: return "";
    case Verdict::failed: return "31";
    case Verdict::unsupported:
    case Verdict::unjudged: return dim;
    default: return "35";
  }
}

std::string verdict_prose(Verdict verdict) {
  std::string word(verdict_word(verdict));
  std::replace(word.begin(), word.end(), '_', ' ');
  return word;
}

std::string ms_text(const Row& row) {
  if (!row.time.median_ms) return "";
  const std::string ms = short_number(*row.time.median_ms);
  return row.time.contended ? "(" + ms + ")" : ms;
}

}  // namespace plumb::harness
