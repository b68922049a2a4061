#include "rows/row.hpp"

#include <cmath>
#include <string_view>

#include "base/format.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::harness {

namespace {

/// A number that counts something, written without a point.
struct Count {
  const std::optional<double>& of;
};
struct MutableCount {
  std::optional<double>& of;
};
Count count(const std::optional<double>& of) { return {of}; }
MutableCount count(std::optional<double>& of) { return {of}; }

Json whole_or_null(const std::optional<double>& number) {
  return number ? Json(static_cast<std::int64_t>(std::llround(*number))) : Json();
}
Json number_or_null(const std::optional<double>& number) { return number ? Json(*number) : Json(); }

/// Makes an object of fields, in their order.
class Writer {
 public:
  void operator()(const char* key, const std::string& text) { object_[key] = text; }
  void operator()(const char* key, const Json& object) { object_[key] = object; }
  void operator()(const char* key, const std::optional<double>& number) { object_[key] = number_or_null(number); }
  void operator()(const char* key, const std::optional<bool>& answer) {
    object_[key] = answer ? Json(*answer) : Json();
  }
  void operator()(const char* key, Count number) { object_[key] = whole_or_null(number.of); }
  void operator()(const char* key, const std::vector<std::string>& words) { object_[key] = words; }
  void operator()(const char* key, const std::vector<double>& numbers) { object_[key] = numbers; }
  void operator()(const char* key, const std::optional<Interval>& interval) {
    object_[key] = interval ? Json::array({interval->low, interval->high}) : Json();
  }
  void operator()(const char* key, const std::vector<std::pair<std::string, double>>& numbers) {
    Json& named = object_[key] = Json::object();
    for (const auto& [name, number] : numbers) named[name] = number;
  }
  void operator()(const char* key, const std::optional<Contention>& contention) {
    object_[key] = contention ? Json{{"load", number_or_null(contention->load)}, {"why", contention->why}} : Json();
  }
  void operator()(const char* key, const std::vector<MetricResult>& metrics) { object_[key] = to_json(metrics); }
  template <class Value>
  void if_told(const char* key, const Value& value, bool told) {
    if (told) (*this)(key, value);
  }
  template <class Fields>
  void object(const char* key, const Fields& fields) {
    Writer inside;
    fields(inside);
    object_[key] = std::move(inside.object_);
  }
  void first_and_last(const char* key, const std::optional<double>& first, const std::optional<double>& last) {
    object_[key] = first && last ? Json::array({whole_or_null(first), whole_or_null(last)}) : Json::array();
  }
  void machine(const char* key, const RowOrigin& origin) {
    Json& machine = object_[key] = origin.machine;
    if (!origin.date.empty()) machine["date"] = origin.date;
  }
  void constant(const char* key, int value) { object_[key] = value; }

  [[nodiscard]] Json finished() { return std::move(object_); }

 private:
  Json object_ = Json::object();
};

const Json& member(const Json& object, const char* key) {
  static const Json none;
  if (!object.is_object()) return none;
  const auto found = object.find(key);
  return found == object.end() ? none : *found;
}

std::optional<double> as_number(const Json& value) {
  if (!value.is_number()) return std::nullopt;
  const double number = value.get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::string as_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_null() ? std::string() : value_text(value);
}

/// Fills fields from an object that may lack any of them, or have them of other types.
class Reader {
 public:
  explicit Reader(const Json& object) : object_(object) {}

  void operator()(const char* key, std::string& text) const { text = as_text(member(object_, key)); }
  void operator()(const char* key, Json& object) const {
    const Json& value = member(object_, key);
    object = value.is_object() ? value : Json::object();
  }
  void operator()(const char* key, std::optional<double>& number) const { number = as_number(member(object_, key)); }
  void operator()(const char* key, std::optional<bool>& answer) const {
    if (const Json& value = member(object_, key); value.is_boolean()) answer = value.get<bool>();
  }
  void operator()(const char* key, MutableCount number) const { (*this)(key, number.of); }
  void operator()(const char* key, std::vector<std::string>& words) const {
    if (!member(object_, key).is_array()) return;
    for (const Json& word : member(object_, key)) {
      if (word.is_string()) words.push_back(word);
    }
  }
  void operator()(const char* key, std::vector<double>& numbers) const {
    if (!member(object_, key).is_array()) return;
    for (const Json& value : member(object_, key)) {
      if (const auto number = as_number(value)) numbers.push_back(*number);
    }
  }
  void operator()(const char* key, std::optional<Interval>& interval) const {
    const Json& ends = member(object_, key);
    if (!ends.is_array() || ends.size() != 2) return;
    const auto low = as_number(ends[0]), high = as_number(ends[1]);
    if (low && high && *low <= *high) interval = Interval{*low, *high};
  }
  void operator()(const char* key, std::vector<std::pair<std::string, double>>& numbers) const {
    if (!member(object_, key).is_object()) return;
    for (const auto& [name, value] : member(object_, key).items()) {
      if (const auto number = as_number(value)) numbers.emplace_back(name, *number);
    }
  }
  void operator()(const char* key, std::optional<Contention>& contention) const {
    const Json& value = member(object_, key);
    if (value.is_null() || value == Json(false)) return;
    contention = value.is_object() ? Contention{as_number(member(value, "load")), as_text(member(value, "why"))}
                                   : Contention{std::nullopt, value_text(value)};
  }
  void operator()(const char* key, std::vector<MetricResult>& metrics) const {
    metrics = parse_metrics(member(object_, key));
  }
  template <class Value>
  void if_told(const char* key, Value&& value, bool /*told*/) const {
    (*this)(key, value);
  }
  template <class Fields>
  void object(const char* key, const Fields& fields) const {
    const Reader inside(member(object_, key));
    fields(inside);
  }
  void first_and_last(const char* key, std::optional<double>& first, std::optional<double>& last) const {
    const Json& ends = member(object_, key);
    if (!ends.is_array() || ends.size() != 2) return;
    first = as_number(ends[0]);
    last = as_number(ends[1]);
  }
  void machine(const char* key, RowOrigin& origin) const {
    (*this)(key, origin.machine);
    origin.date = as_text(member(origin.machine, "date"));
    origin.machine.erase("date");
  }
  void constant(const char* /*key*/, int /*value*/) const {}

 private:
  const Json& object_;
};

/// All keys of a row, in their order in the file.
template <class Visitor, class AnyRow>
void visit_fields(Visitor& visit, AnyRow& row) {
  visit.constant("format", row_format);
  visit("scene", row.scene);
  visit("group", row.group);
  visit("params", row.params);
  visit("backend", row.backend);
  visit("backend_version", row.engine.version);
  visit("settings", row.settings);
  visit("profile", row.profile);
  visit("dt", row.dt);
  visit("seconds", row.seconds);
  visit("threads", count(row.threads));
  visit("status", row.status);
  visit("reason", row.reason);
  visit("metrics", row.metrics);
  visit.object("time", [&time = row.time](auto& part) {
    part.object("ms_per_step", [&time](auto& per_step) {
      per_step("median", time.median_ms);
      per_step("min", time.min_ms);
      per_step("max", time.max_ms);
      per_step("p99", time.p99_ms);
    });
    part("runs", time.runs_ms);
    part("ci95", time.ci95);
    part("wall_s", time.wall_s);
    part.first_and_last("window", time.window_first, time.window_last);
    part("steps", count(time.steps));
    part("setup_ms", time.setup_ms);
    part("phase_ms", time.phase_ms);
  });
  visit.object("counts", [&counts = row.counts](auto& part) {
    part("bodies", count(counts.bodies));
    part("contacts_max", count(counts.contacts_max));
    part("dropped", count(counts.dropped));
    part("nonfinite", count(counts.nonfinite));
  });
  visit("hash", row.hash);
  visit("peak_mb", row.counts.peak_mb);
  visit.machine("machine", row.origin);
  visit("contended", row.time.contended);
  visit.if_told("defaults", row.engine.defaults, row.engine.tells_defaults);
  visit("knobs", row.engine.knobs);
  visit("slug", row.slug);
  visit("needs", row.needs);
  visit("repeats", count(row.time.repeats));
  visit.if_told("restarted", count(row.time.restarted), row.time.restarted.has_value());
  visit("backend_build", row.engine.build);
  visit("cell", row.origin.cell);
  visit.if_told("study", row.origin.study, !row.origin.study.empty());
}

/// All keys of a metric.
template <class Visitor, class AnyMetric>
void visit_fields_of_metric(Visitor& visit, AnyMetric& metric) {
  const auto number = [&](const char* key, auto& of) {
    if (metric.whole) {
      visit(key, count(of));
    } else {
      visit(key, of);
    }
  };
  number("value", metric.value);
  visit("unit", metric.unit);
  number("truth", metric.truth);
  number("error", metric.error);
  visit("threshold", metric.threshold);
  visit("gold", metric.gold);
  visit("pass", metric.pass);
  visit.if_told("unbiased_error", metric.unbiased_error, metric.tells_unbiased_error);
  visit.if_told("note", metric.note, !metric.note.empty());
}

MetricResult parse_metric(const std::string& name, const Json& from) {
  MetricResult metric;
  metric.name = name;
  const Reader reader(from);
  visit_fields_of_metric(reader, metric);
  metric.tells_unbiased_error = from.is_object() && from.contains("unbiased_error");
  metric.whole = member(from, "value").is_number_integer();
  // A scored error that is not finite misses whatever it is held against.
  if (!metric.pass && metric.threshold) metric.pass = metric.error && *metric.error <= *metric.threshold;
  if (const Json& gold = member(from, "gold"); gold.is_boolean()) metric.is_gold = gold.get<bool>();
  if (metric.gold) metric.is_gold = metric.error && *metric.error <= *metric.gold;
  return metric;
}

std::string params_text(const Json& params, bool with_seed) {
  std::string out;
  for (const auto& [name, value] : params.items()) {
    if (name == "seed" && !with_seed) continue;
    if (!out.empty()) out += ' ';
    out += name + "=" + value_text(value);
  }
  return out;
}

/// Why the object cannot be read as a row; "" when it can.
std::string trouble_with(const Json& row) {
  const Json& format = member(row, "format");
  const bool says_one = format.is_number_integer() && format > 0;
  if (says_one && format > row_format)
    return "this row has format " + format.dump() + ", and this plumb reads " + std::to_string(row_format) +
           "; read it with the plumb that wrote it, or a newer one";
  for (const char* key : {"scene", "backend", "status", "cell"}) {
    if (!member(row, key).is_string())
      return "this is no row that plumb wrote: it has no \"" + std::string(key) + "\"; keep other things elsewhere";
  }
  if (!says_one)
    return "this row does not say its \"format\", so that nobody knows what its numbers mean; take it away and run it "
           "again";
  return "";
}

}  // namespace

const MetricResult* Row::metric(std::string_view name) const {
  for (const MetricResult& metric : metrics) {
    if (metric.name == name) return &metric;
  }
  return nullptr;
}

std::optional<double> Row::ms_per_simulated_second() const {
  const std::optional<double> ms = fair_ms();
  if (!ms || !dt || *ms <= 0 || *dt <= 0) return std::nullopt;
  return *ms / *dt;
}

std::string Row::variant() const { return params_text(params, true); }

std::string Row::problem_variant() const { return params_text(params, false); }

Json to_json(const Row& row) {
  Writer writer;
  visit_fields(writer, row);
  return writer.finished();
}

Json to_json(const std::vector<MetricResult>& metrics) {
  Json named = Json::object();
  for (const MetricResult& metric : metrics) {
    Writer writer;
    visit_fields_of_metric(writer, metric);
    named[metric.name] = writer.finished();
  }
  return named;
}

std::vector<MetricResult> parse_metrics(const Json& metrics) {
  std::vector<MetricResult> parsed;
  if (!metrics.is_object()) return parsed;
  for (const auto& [name, metric] : metrics.items()) parsed.push_back(parse_metric(name, metric));
  return parsed;
}

Row parse_row(const Json& line, std::size_t index) {
  Row row;
  const Reader reader(line);
  visit_fields(reader, row);
  row.engine.tells_defaults = member(line, "defaults").is_object();
  row.origin.index = index;
  if (row.status.empty()) {
    row.status = "error";
    if (row.reason.empty()) row.reason = "the line in the results has no status";
  }
  return row;
}

std::vector<Row> parse_rows(const std::vector<Json>& lines) {
  std::vector<Row> rows;
  rows.reserve(lines.size());
  for (const Json& line : lines) rows.push_back(parse_row(line, rows.size()));
  return rows;
}

std::optional<Row> read_row(const std::string& line, const std::filesystem::path& file, std::size_t number) {
  const Json row = Json::parse(line, nullptr, false);
  if (!row.is_object()) return std::nullopt;
  if (const std::string trouble = trouble_with(row); !trouble.empty())
    throw Error(PLUMB_E_CORRUPT, file.string() + ":" + std::to_string(number) + ": " + trouble);
  return parse_row(row, 0);
}

std::string row_key(const Row& row) { return line_of({row.origin.machine, row.origin.cell}); }

}  // namespace plumb::harness
