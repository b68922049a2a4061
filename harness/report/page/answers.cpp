// Near the top: questions that people ask first, each answered in a sentence, with a line an engine and its run.
#include "report/answers.hpp"

#include <fmt/format.h>

#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

std::string line_item(const PageContext& context, const AnswerLine& line) {
  const std::string text =
      line.statement.row ? row_link(*line.statement.row, line.statement.text, "") : escape_html(line.statement.text);
  return fmt::format(R"(<li class="e{}{}">{} <span>{}</span></li>)", context.backend_index(line.backend),
                     line.good ? " good" : "", backend_label(context, line.backend), text);
}

}  // namespace

std::string answers_section(const PageContext& context) {
  const std::vector<AnsweredQuestion> all = answers(context.study, context.costs);
  if (all.empty()) return "";
  std::string out = section_start(context, "answers", "Answers") +
                    R"(<p class="about">Made from the numbers below; each line )"
                    R"(leads to the run that shows it.</p><div class="answers">)";
  for (const AnsweredQuestion& answer : all) {
    std::string lines;
    for (const AnswerLine& line : answer.lines) lines += line_item(context, line);
    out += fmt::format(
        R"(<article class="answer"><h3><a href="#{}{}">{}</a></h3>{}<ul>{}</ul></article>)", answer.section,
        context.suffix, escape_html(answer.question),
        answer.verdict.empty() ? "" : fmt::format(R"(<p class="verdict">{}</p>)", escape_html(answer.verdict)), lines);
  }
  return out + "</div></section>";
}

}  // namespace plumb::harness
