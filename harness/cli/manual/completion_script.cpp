#include "cli/manual/completion_script.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plumb::harness {

namespace {

std::string replaced(std::string text, char from, const std::string& to) {
  std::string out;
  for (const char c : text) {
    if (c == from)
      out += to;
    else
      out += c;
  }
  return out;
}

/// How a value is completed: with the words of a kind, with files of a kind, or with neither.
struct Completion {
  std::string words;  ///< of plumb completion --words
  enum class Files { none, any, folders } files = Files::none;
};

Completion completion_of(const OptionEntry& option) {
  using Files = Completion::Files;
  const std::string& value = option.value;
  if (value == "SCENE") return {"scenes", Files::any};
  if (value == "BACKEND" || value == "A" || value == "B") return {"backends", Files::any};
  if (value == "STUDY") return {"studies", Files::any};
  if (value == "KIND") return {"measures", Files::none};
  if (value == "CHECK") return {"checks", Files::none};
  if (value == "VERB") return {"verbs", Files::none};
  if (value == "FILE" || value == "TRACE") return {"", Files::any};
  if (value == "DIR") return {"", Files::folders};
  return {};
}

std::string joined(const std::vector<std::string>& words, const char* between = " ") {
  return fmt::format("{}", fmt::join(words, between));
}

std::vector<std::string> names_of(const std::vector<OptionEntry>& options) {
  std::vector<std::string> names;
  for (const OptionEntry& option : options)
    if (!option.positional) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

const OptionEntry* positional_of(const VerbEntry& verb) {
  const auto found = std::find_if(verb.options.begin(), verb.options.end(), [](const auto& o) { return o.positional; });
  return found == verb.options.end() ? nullptr : &*found;
}

/// The bash statement that completes a value, empty where nothing can be said.
std::string bash_statement(const OptionEntry& option) {
  if (!option.choices.empty()) return fmt::format("_plumb_among \"{}\"", joined(option.choices));
  const Completion completion = completion_of(option);
  std::vector<std::string> statements;
  if (!completion.words.empty()) statements.push_back("_plumb_words " + completion.words);
  if (completion.files == Completion::Files::any) statements.emplace_back("_plumb_files -f");
  if (completion.files == Completion::Files::folders) statements.emplace_back("_plumb_files -d");
  return joined(statements, "; ");
}

std::string bash_verb(const VerbEntry& verb) {
  std::string values;
  for (const OptionEntry& option : verb.options)
    if (!option.positional && !option.value.empty())
      values += fmt::format("        {}) {}; return ;;\n", joined(option.names, "|"),
                            bash_statement(option).empty() ? ":" : bash_statement(option));
  std::string text = fmt::format("    {})\n", verb.name);
  if (!values.empty()) text += "      case $before in\n" + values + "      esac\n";
  text +=
      fmt::format("      [[ $word == -* ]] && {{ _plumb_among \"{}\"; return; }}\n", joined(names_of(verb.options)));
  const OptionEntry* positional = positional_of(verb);
  const std::string statement = positional == nullptr ? "" : bash_statement(*positional);
  return text + (statement.empty() ? "" : "      " + statement + "\n") + "      ;;\n";
}

constexpr const char* bash_head = R"sh(# bash completion for plumb, made from its options by: plumb completion bash
_plumb_among() { COMPREPLY+=($(compgen -W "$1" -- "$word")); }
_plumb_words() { _plumb_among "$("${COMP_WORDS[0]}" completion --words "$1" 2>/dev/null)"; }
_plumb_files() { compopt -o filenames 2>/dev/null; COMPREPLY+=($(compgen "$1" -- "$word")); }

_plumb() {
  local IFS=$' \n' word="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD-1]}" verb="" i
  COMPREPLY=()
  # --option=value is three words to bash.
  if [[ $word == "=" ]]; then word=""; elif [[ $before == "=" ]]; then before="${COMP_WORDS[COMP_CWORD-2]}"; fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    [[ ${COMP_WORDS[i]} == -* ]] || { verb="${COMP_WORDS[i]}"; break; }
  done
)sh";

/// In zsh's _arguments, text in brackets or after a colon.
std::string zsh_text(const std::string& text) {
  std::string out = replaced(text, '\\', "\\\\");
  out = replaced(out, '[', "\\[");
  out = replaced(out, ']', "\\]");
  out = replaced(out, ':', "\\:");
  return replaced(out, '\'', "'\\''");
}

std::string zsh_action(const OptionEntry& option) {
  if (!option.choices.empty()) return "(" + joined(option.choices) + ")";
  const Completion completion = completion_of(option);
  const bool any = completion.files == Completion::Files::any;
  if (!completion.words.empty()) return fmt::format("_plumb_words {}{}", completion.words, any ? " files" : "");
  if (any) return "_files";
  return completion.files == Completion::Files::folders ? "_files -/" : " ";
}

std::string zsh_option(const OptionEntry& option) {
  const char* often = option.repeatable ? "*" : "";
  const std::string value =
      option.value.empty() ? "" : fmt::format(":{}:{}", zsh_text(option.value), zsh_action(option));
  if (option.positional) return fmt::format(" '{}{}'", often, value);
  std::string text;
  for (const std::string& name : option.names) {
    const bool may_have_equals = name.starts_with("--") && !value.empty();
    text += fmt::format(" '{}{}{}[{}]{}'", often, name, may_have_equals ? "=" : "", zsh_text(option.doc), value);
  }
  return text;
}

constexpr const char* zsh_head = R"sh(#compdef plumb
# zsh completion for plumb, made from its options by: plumb completion zsh
_plumb_words() {
  local -a found
  found=(${(f)"$(plumb completion --words $1 2>/dev/null)"})
  compadd -a found
  [[ $2 == files ]] && _files
}

_plumb() {
  local -a verbs
  verbs=(
)sh";

std::string fish_text(const std::string& text) { return replaced(replaced(text, '\\', "\\\\"), '\'', "\\'"); }

/// The flags of fish's complete that say how a value is completed.
std::string fish_value(const OptionEntry& option) {
  if (option.value.empty()) return "";
  if (!option.choices.empty()) return fmt::format(" -x -a '{}'", joined(option.choices));
  const Completion completion = completion_of(option);
  const std::string words =
      completion.words.empty() ? "" : fmt::format(" -a '(plumb completion --words {})'", completion.words);
  if (completion.files == Completion::Files::any) return " -r -F" + words;
  if (completion.files == Completion::Files::folders) return " -x -a '(__fish_complete_directories)'";
  return " -x" + words;
}

}  // namespace

std::string bash_completion(const ProgramTable& program) {
  std::vector<std::string> verbs = names_of(program.options);
  for (const VerbEntry& verb : program.verbs) verbs.push_back(verb.name);
  std::string text = bash_head;
  text += "  case $verb in\n    \"\") _plumb_among \"" + joined(verbs) + "\" ;;\n";
  for (const VerbEntry& verb : program.verbs) text += bash_verb(verb);
  return text + "  esac\n}\ncomplete -F _plumb plumb\n";
}

std::string zsh_completion(const ProgramTable& program) {
  std::string text = zsh_head;
  for (const VerbEntry& verb : program.verbs)
    text += fmt::format("    '{}:{}'\n", verb.name, replaced(verb.doc, '\'', "'\\''"));
  text += "  )\n  if (( CURRENT == 2 )); then\n    _describe -t verbs verb verbs\n    _arguments";
  for (const OptionEntry& option : program.options) text += zsh_option(option);
  text += "\n    return\n  fi\n  local verb=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $verb in\n";
  for (const VerbEntry& verb : program.verbs) {
    text += fmt::format("    {})\n      _arguments", verb.name);
    for (const OptionEntry& option : verb.options) text += " \\\n       " + zsh_option(option);
    text += " ;;\n";
  }
  return text + "  esac\n}\n\n_plumb \"$@\"\n";
}

std::string fish_completion(const ProgramTable& program) {
  std::string text =
      "# fish completion for plumb, made from its options by: plumb completion fish\ncomplete -c plumb -f\n";
  const auto add = [&](const std::string& condition, const OptionEntry& option) {
    text += fmt::format("complete -c plumb -n '{}'", condition);
    for (const std::string& name : option.names)
      text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    text += fmt::format("{} -d '{}'\n", fish_value(option), fish_text(option.doc));
  };
  for (const OptionEntry& option : program.options) add("__fish_use_subcommand", option);
  for (const VerbEntry& verb : program.verbs)
    text += fmt::format("complete -c plumb -n __fish_use_subcommand -a {} -d '{}'\n", verb.name, fish_text(verb.doc));
  for (const VerbEntry& verb : program.verbs) {
    const std::string within = "__fish_seen_subcommand_from " + verb.name;
    for (const OptionEntry& option : verb.options) {
      if (!option.positional) {
        add(within, option);
        continue;
      }
      const std::string value = fish_value(option);
      const auto words = value.find(" -a ");
      const bool files = value.find(" -F") != std::string::npos;
      if (words != std::string::npos || files)
        text += fmt::format("complete -c plumb -n '{}'{}{}\n", within, files ? " -F" : "",
                            words == std::string::npos ? "" : value.substr(words));
    }
  }
  return text;
}

}  // namespace plumb::harness
