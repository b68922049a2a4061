// The first screen: what people ask first, each answered in a sentence; speed against error in one picture; one replay.
#include <fmt/format.h>

#include "report/findings/answers.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/parts/packed.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

std::string line_item(const PageContext& context, const AnswerLine& line) {
  std::string text;
  for (const Statement& statement : line.statements) text += (text.empty() ? "" : "; ") + statement_text(statement);
  return fmt::format(R"(<li class="of{}{}">{} <span>{}</span></li>)", context.backend_index(line.backend),
                     line.good ? " good" : "", backend_label(context, line.backend), text);
}

/// Question and verdict, with a line an engine below.
std::string answer_item(const PageContext& context, const AnsweredQuestion& answer) {
  std::string lines;
  for (const AnswerLine& line : answer.lines) lines += line_item(context, line);
  return fmt::format(
      R"(<details class="answer"><summary><b>{}</b> <span class="verdict">{}</span></summary><ul>{}</ul>)"
      R"(<p><a href="#{}{}">All of it</a></p></details>)",
      escape_html(answer.question), escape_html(answer.verdict), lines, answer.section, context.suffix);
}

std::string answers_part(const PageContext& context) {
  const std::vector<AnsweredQuestion> all = answers(context.ordered, context.costs);
  if (all.empty()) return "";
  std::string items;
  for (const AnsweredQuestion& answer : all) items += answer_item(context, answer);
  return fmt::format(R"(<section id="answers{}" class="part answers"><h2>Answers</h2>{}</section>)", context.suffix,
                     items);
}

/// The picture, or why there is none where there are times that do not count.
std::string speed_part(const PageContext& context) {
  std::string content;
  if (Json figure = speed_figure(context); !figure.is_null()) {
    content = packed_blocks(Json::array({figures_block(Json::array({std::move(figure)}))}));
  } else if (const std::string note = untimed_note(context); !note.empty() && context.ordered.backends.size() > 1) {
    content = about("No picture: too few scene variants have a time that counts of every engine." + note);
  } else {
    return "";
  }
  return fmt::format(R"(<section id="speed{}" class="part speed"><h2>Speed and error</h2>{}</section>)", context.suffix,
                     content);
}

}  // namespace

std::string first_screen(const PageContext& context) {
  const std::string parts = answers_part(context) + speed_part(context);
  return fmt::format(R"(<div class="first">{}</div>)", parts);
}

}  // namespace plumb::harness
