#include "cli/manual/man_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace plumb::harness {

namespace {

/// Text as roff reads it: hyphens that one can copy, and no line that is taken for a request.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if (c == '\n') {
      out += ' ';
    } else {
      if ((c == '.' || c == '\'') && out.empty()) out += "\\&";
      out += c;
    }
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string title(const std::string& name, const std::string& version) {
  return fmt::format(".TH {} 1 \"\" \"{}\" \"Plumb Manual\"\n", roff(upper(name)), roff(version));
}

std::string name_section(const std::string& name, const std::string& doc) {
  return fmt::format(".SH NAME\n{} \\- {}\n", roff(name), roff(doc));
}

std::string sentence(const std::string& text) { return text.empty() || text.ends_with('.') ? text : text + "."; }

std::string option_of(const OptionEntry& option) {
  std::string names;
  for (const std::string& name : option.names) {
    if (!names.empty()) names += ", ";
    names += option.positional ? italic(name) : bold(name);
  }
  if (!option.positional && !option.value.empty()) names += " " + italic(option.value);
  std::string text = roff(sentence(option.doc));
  if (!option.choices.empty()) text += roff(fmt::format(" One of {}.", fmt::join(option.choices, ", ")));
  if (!option.default_text.empty()) text += " Default: " + roff(option.default_text) + ".";
  if (option.repeatable) text += option.positional ? " Several may be given." : " Repeatable.";
  return ".TP\n" + names + "\n" + text + "\n";
}

std::string options_section(const char* heading, const std::vector<OptionEntry>& options, bool positional) {
  std::string text;
  for (const OptionEntry& option : options)
    if (option.positional == positional) text += option_of(option);
  return text.empty() ? "" : fmt::format(".SH {}\n{}", heading, text);
}

std::string synopsis(const std::string& line, const std::vector<OptionEntry>& options) {
  std::string text = bold(line) + " [" + italic("OPTION") + "...]";
  for (const OptionEntry& option : options) {
    if (!option.positional) continue;
    std::string argument = italic(option.names.front()) + (option.repeatable ? "..." : "");
    text += option.required ? " " + argument : " [" + argument + "]";
  }
  return ".SH SYNOPSIS\n" + text + "\n";
}

std::string examples_section(const std::vector<ExampleEntry>& examples) {
  std::string text;
  for (const ExampleEntry& example : examples)
    text += ".PP\n" + roff(sentence(example.doc)) + "\n.PP\n.RS 4\n.nf\n" + roff(example.line) + "\n.fi\n.RE\n";
  return text.empty() ? "" : ".SH EXAMPLES\n" + text;
}

constexpr const char* exit_status =
    ".SH EXIT STATUS\n"
    ".TP\n\\fB0\\fR\nAll that was asked ran.\n"
    ".TP\n\\fB1\\fR\nA threshold was missed, a check failed or a replay differed, where the verb or "
    "\\fB\\-\\-strict\\fR "
    "asks for that.\n"
    ".TP\n\\fB2\\fR\nThe question was wrong; a line on standard error says how.\n";

constexpr const char* environment =
    ".SH ENVIRONMENT\n"
    ".TP\n\\fBPLUMB_BACKEND_PATH\\fR\nFolders, separated by colons, in which backends are looked for first.\n"
    ".TP\n\\fBPLUMB_SCENES\\fR\nFolders, separated by colons, of more scenes.\n"
    ".TP\n\\fBPLUMB_VIEWER\\fR\nThe folder of the script that takes pictures, for \\fBplumb export\\fR.\n"
    ".TP\n\\fBNO_COLOR\\fR\nNo colours on a terminal.\n";

std::string see_also(const ProgramTable& program, const std::string& but) {
  std::string text;
  const auto add = [&](const std::string& name) {
    if (name != but) text += (text.empty() ? "" : ",\n") + (".BR " + roff(name)) + " (1)";
  };
  add(program.name);
  for (const VerbEntry& verb : program.verbs) add(program.name + "-" + verb.name);
  return ".SH SEE ALSO\n" + text + "\n";
}

}  // namespace

std::string man_page(const ProgramTable& program, const std::string& version) {
  std::string text =
      title(program.name, version) + name_section(program.name, "hold physics backends against the truth");
  text += ".SH SYNOPSIS\n" + bold(program.name) + " " + italic("VERB") + " [" + italic("ARGUMENT") + "...]\n";
  text += ".SH DESCRIPTION\n" + roff(program.doc) + "\n";
  text += ".SH VERBS\n";
  for (const VerbEntry& verb : program.verbs)
    text += fmt::format(".TP\n{}\n{} See \\fB{}\\fR(1).\n", bold(verb.name), roff(sentence(verb.doc)),
                        roff(program.name + "-" + verb.name));
  return text + options_section("OPTIONS", program.options, false) + exit_status + environment +
         see_also(program, program.name);
}

std::string man_page(const ProgramTable& program, const VerbEntry& verb, const std::string& version) {
  const std::string name = program.name + "-" + verb.name;
  return title(name, version) + name_section(name, verb.doc) + synopsis(program.name + " " + verb.name, verb.options) +
         ".SH DESCRIPTION\n" + roff(sentence(verb.doc)) + "\n" + options_section("ARGUMENTS", verb.options, true) +
         options_section("OPTIONS", verb.options, false) + exit_status + examples_section(verb.examples) +
         see_also(program, name);
}

}  // namespace plumb::harness
