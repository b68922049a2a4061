// Events of Chrome's trace event format as text: one JSON object a line, each after a comma but the first of a file.
// "Trace Event Format", Google: X is a zone with its duration, C a counter, M a name for a row of the picture.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace plumb::layers {

/// A JSON string, quotes and all.
inline void append_quoted(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      (out += '\\') += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(c));
      out += escape;
    } else {
      out += c;
    }
  }
  out += '"';
}

template <class Number>
void append_number(std::string& out, Number number) {
  char digits[32];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

/// As us, to the ns.
inline void append_us(std::string& out, std::int64_t ns) {
  if (ns < 0) out += '-';
  const std::int64_t size = ns < 0 ? -ns : ns;
  append_number(out, size / 1000);
  const auto rest = static_cast<char>('0' + size % 1000 / 100);
  for (const char c : {'.', rest, static_cast<char>('0' + size % 100 / 10), static_cast<char>('0' + size % 10)})
    out += c;
}

/// Adds events to a text. Rows are told by the format's process and thread.
class ChromeEvents {
 public:
  struct Row {
    int process;
    std::uint64_t thread;
  };

  explicit ChromeEvents(std::string& out) : out_(out) {}

  /// Name for a row; for its process where `what` is "process_name".
  void name_row(Row row, const char* what, std::string_view name) {
    begin('M', what, row);
    out_ += ",\"args\":{\"name\":";
    append_quoted(out_, name);
    out_ += "}}";
  }
  /// Times in ns; the zone may be given arguments until close().
  void zone(Row row, std::string_view name, std::int64_t start, std::int64_t duration) {
    begin('X', name, row);
    out_ += ",\"ts\":";
    append_us(out_, start);
    out_ += ",\"dur\":";
    append_us(out_, duration);
    out_ += ",\"args\":{";
    first_argument_ = true;
  }
  /// A number of any kind; finite.
  template <class Number>
  void argument(std::string_view name, Number value) {
    if (!first_argument_) out_ += ',';
    first_argument_ = false;
    append_quoted(out_, name);
    out_ += ':';
    append_number(out_, value);
  }
  void close() { out_ += "}}"; }
  void counter(Row row, std::string_view name, std::int64_t time, std::int64_t value) {
    begin('C', name, row);
    out_ += ",\"ts\":";
    append_us(out_, time);
    out_ += ",\"args\":{\"count\":";
    append_number(out_, value);
    out_ += "}}";
  }

 private:
  void begin(char kind, std::string_view name, Row row) {
    out_ += has_events_ ? ",\n" : "\n";
    has_events_ = true;
    out_ += "{\"ph\":\"";
    out_ += kind;
    out_ += "\",\"name\":";
    append_quoted(out_, name);
    out_ += ",\"pid\":";
    append_number(out_, row.process);
    out_ += ",\"tid\":";
    append_number(out_, static_cast<std::int64_t>(row.thread));
  }

  std::string& out_;
  bool has_events_ = false;  ///< so that a comma is due before the next
  bool first_argument_ = true;
};

}  // namespace plumb::layers
