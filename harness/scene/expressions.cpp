#include "scene/expressions.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "base/shown.hpp"
#include "plumb/nearest.hpp"
#include "scene/generators.hpp"

namespace plumb::harness {
namespace {

double degrees(double x) { return x * std::numbers::pi / 180; }
double floor_of(double x) { return std::floor(x); }
double ceil_of(double x) { return std::ceil(x); }
double round_of(double x) { return std::round(x); }
double modulo(double a, double b) { return a - b * std::floor(a / b); }

std::uint32_t whole(const char* what, double x) {
  if (!(x >= 0 && x <= static_cast<double>(largest_seed)) || x != std::floor(x))
    throw std::invalid_argument(
        fmt::format("random(seed, i): {} {} is not a whole number from 0 to {}", what, x, largest_seed));
  return static_cast<std::uint32_t>(x);
}
double random_of(double seed, double i) { return SplitMix64(whole("seed", seed), whole("i", i)).uniform(); }

const std::vector<std::string> documented_words{"pi",    "sin",   "cos",  "tan",   "asin", "acos", "atan",
                                                "atan2", "sqrt",  "exp",  "ln",    "abs",  "min",  "max",
                                                "sign",  "floor", "ceil", "round", "mod",  "deg",  "random"};
constexpr std::size_t longest_expression = 2000;

mu::Parser make_parser() {
  mu::Parser parser;
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineFun("deg", degrees);
  parser.DefineFun("floor", floor_of);
  parser.DefineFun("ceil", ceil_of);
  parser.DefineFun("round", round_of);
  parser.DefineFun("mod", modulo);
  parser.DefineFun("random", random_of);
  return parser;
}

}  // namespace

const std::vector<std::string>& expression_words() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> all = documented_words;
    // The times, which thresholds may use, and what the parser has of its own.
    for (const char* word : {"dt", "seconds", "_pi", "_e", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "log",
                             "log2", "log10", "rint", "sum", "avg"})
      all.emplace_back(word);
    return all;
  }();
  return words;
}

Expressions::Expressions() = default;
Expressions::~Expressions() = default;

void Expressions::set(const std::string& name, double value) {
  const auto [entry, fresh] = values_.insert_or_assign(name, value);
  if (fresh) compiled_.clear();
}

void Expressions::add_word(const std::string& word) {
  if (!values_.contains(word)) set(word, 1e6 + static_cast<double>(values_.size()));
}

void Expressions::set_word(const std::string& name, const std::string& word) {
  add_word(word);
  set(name, values_.at(word));
  words_[name] = word;
}

void Expressions::erase(const std::string& name) {
  values_.erase(name);
  compiled_.clear();
}

bool Expressions::uses(const std::string& text, const std::string& name) {
  try {
    mu::Parser parser = make_parser();
    parser.SetExpr(text);
    return parser.GetUsedVar().contains(name);
  } catch (const mu::ParserError&) {
    return false;
  }
}

double Expressions::evaluate(const std::string& text) {
  if (text.size() > longest_expression)
    throw std::invalid_argument(
        fmt::format("\"{}\" is too long for an expression; the most are {}", shortened(text), longest_expression));
  try {
    auto found = compiled_.find(text);
    if (found == compiled_.end()) {
      static const mu::Parser blank = make_parser();
      found = compiled_.emplace(text, blank).first;
      for (auto& [name, value] : values_) found->second.DefineVar(name, &value);
      found->second.SetExpr(text);
    }
    const double result = found->second.Eval();
    if (!std::isfinite(result)) throw std::invalid_argument(fmt::format("\"{}\" gives {}", shortened(text), result));
    return result;
  } catch (const mu::ParserError& error) {
    compiled_.erase(text);
    if (error.GetCode() != mu::ecUNASSIGNABLE_TOKEN)
      throw std::invalid_argument(
          fmt::format("\"{}\" is not an expression: {}", shortened(text), shortened(error.GetMsg(), 160)));
    std::string name = error.GetToken();
    if (const auto end = name.find_first_of(" +-*/^()<>=!&|?:,"); end != std::string::npos) name.resize(end);
    std::vector<std::string> known = documented_words;
    for (const auto& [defined, value] : values_) known.insert(known.begin(), defined);
    const std::string remedy = name == "degrees" || name == "radians"
                                   ? "; deg(x) makes radians of degrees, and angles are radians otherwise"
                                   : suggestion(shortened(name), known);
    throw std::invalid_argument(fmt::format("\"{}\": unknown name \"{}\"{}", shortened(text), shortened(name), remedy));
  }
}

std::string Expressions::interpolate(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('{', at);
    out += text.substr(at, open - at);
    if (open == std::string::npos) break;
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos)
      throw std::invalid_argument(fmt::format("\"{}\" has a {{ without a }}", shortened(text)));
    const std::string inner = text.substr(open + 1, close - open - 1);
    if (const auto word = words_.find(inner); word != words_.end()) {
      out += word->second;
    } else {
      const double value = evaluate(inner);
      if (value != std::rint(value) || std::abs(value) > 1e15)
        throw std::invalid_argument(
            fmt::format("\"{{{}}}\" gives {}, which is not a whole number", shortened(inner), value));
      out += fmt::format("{}", static_cast<long long>(value));
    }
    at = close + 1;
  }
  return out;
}

}  // namespace plumb::harness
