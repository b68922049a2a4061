// The trace layer: forwards every call, then writes it to the file.
#include <cerrno>
#include <fstream>
#include <mutex>

#include "plumb/layers.hpp"
#include "trace_encode.hpp"
#include "trace_state.hpp"

namespace plumb::layers {
namespace {

struct TracedWorld {
  std::uint64_t number;
  ObjectNames names;
  Saves saves;
  std::uint64_t steps = 0;
  std::uint64_t rows_at = 0;  ///< the last step whose rows were written
};

class TraceLayer : public LayerBase {
 public:
  TraceLayer(const PlumbBackendTable* next, const std::string& file, const TraceOptions& options)
      : LayerBase(next), path_(file), rows_every_(options.rows_every), out_(file, std::ios::binary) {
    if (rows_every_ == 0)
      throw Error(PLUMB_E_INVALID_ARGUMENT, "rows_every is 0; a trace needs rows every 1 or more steps");
    if (!out_) throw Error(PLUMB_E_INVALID_ARGUMENT, "cannot write the trace " + file + ": " + std::strerror(errno));
    const PlumbBackendInfo& info = *next->info();
    ByteWriter header;
    header.put(trace_magic);
    header.put(trace_format);
    header.put<std::uint32_t>(PLUMB_VERSION);
    for (const char* text : {info.name, info.version, info.build, info.device}) header.put_string(text);
    header.put(rows_every_);
    header.put(checksum(header.bytes()));
    put(header);
  }

  template <Call call, class... Args>
  auto on(Args... args) {
    if constexpr (call == Call::core_create_world) {
      return create_world(args...);
    } else if constexpr (call == Call::core_destroy_world) {
      return destroy_world(args...);
    } else {
      return on_world_call<call>(args...);
    }
  }

  void finish() {
    ByteWriter body;
    body.put(end_record);
    body.put(records_);
    put_record(body);
    out_.close();
    if (!out_)
      throw Error(PLUMB_E_INVALID_ARGUMENT, "the trace " + path_ + " could not be written whole; is the disk full?");
  }

 private:
  template <Call call, class... Args>
  PlumbResult on_world_call(PlumbWorld* world, Args... args) {
    const PlumbResult result = next<call>()(world, args...);
    const std::lock_guard lock(mutex_);
    const auto found = worlds_.find(world);
    if (found == worlds_.end()) return result;  // made before the trace began, or never
    TracedWorld& traced = found->second;
    ByteWriter body = begin(call, traced.number, result, world);
    encode(CallTag<call>(), Encoding{body, traced.names, traced.saves, result}, args...);
    put_record(body);
    if (call == Call::core_wait && result >= 0) put_state(world, traced, ++traced.steps % rows_every_ == 0);
    return result;
  }

  PlumbResult create_world(const PlumbWorldDesc* desc, PlumbWorld** world) {
    const PlumbResult result = next<Call::core_create_world>()(desc, world);
    const std::lock_guard lock(mutex_);
    TracedWorld traced{++world_count_, {}, {}, 0, 0};
    ByteWriter body = begin(Call::core_create_world, traced.number, result, nullptr);
    Encoding encoding{body, traced.names, traced.saves, result};
    encoding.rows(desc, sizeof(PlumbWorldDesc), 1);
    if (desc != nullptr && encoding.array(desc->settings, desc->setting_count, 0)) {
      for (std::uint32_t i = 0; i < desc->setting_count; ++i) {
        body.put_string(desc->settings[i].name);
        encoding.value(desc->settings[i].value);
      }
    }
    put_record(body);
    if (result < 0) return result;
    put_settings(*world, traced);
    worlds_[*world] = std::move(traced);
    return result;
  }

  void destroy_world(PlumbWorld* world) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = worlds_.find(world); found != worlds_.end()) {
        TracedWorld& traced = found->second;
        if (traced.rows_at != traced.steps) put_state(world, traced, true);  // so that every difference can be named
        put_record(begin(Call::core_destroy_world, traced.number, PLUMB_OK, world));
        worlds_.erase(found);
      }
    }
    next<Call::core_destroy_world>()(world);
  }

  ByteWriter begin(Call call, std::uint64_t world_number, PlumbResult result, PlumbWorld* world) const {
    ByteWriter body;
    body.put(static_cast<std::uint8_t>(call));
    body.put(world_number);
    body.put(result);
    if (result < 0) body.put_string(next_core()->error_text(world));
    return body;
  }

  void put_settings(PlumbWorld* world, const TracedWorld& traced) {
    const auto* settings = next_table<PlumbSettingsTable>();
    if (settings == nullptr) return;
    ByteWriter values;
    std::uint32_t count = 0;
    ObjectNames no_names;
    Saves no_saves;
    for (std::uint32_t i = 0; i < settings->count; ++i) {
      const PlumbSettingInfo* info = settings->describe(i);
      PlumbSettingValue value{};
      if (info == nullptr || settings->get(world, info->name, &value) < 0) continue;
      values.put_string(info->name);
      Encoding{values, no_names, no_saves, PLUMB_OK}.value(value);
      ++count;
    }
    ByteWriter body;
    body.put(settings_record);
    body.put(traced.number);
    body.put(count);
    body.put_bytes(values.bytes());
    put_record(body);
  }

  void put_state(PlumbWorld* world, TracedWorld& traced, bool with_rows) {
    const auto rows = read_state(*next_core(), world);
    if (!rows) return;
    ByteWriter body;
    body.put(state_record);
    body.put(traced.number);
    body.put(traced.steps);
    body.put(hash_of(*rows));
    body.put(static_cast<std::uint32_t>(rows->size()));
    body.put<std::uint8_t>(with_rows);
    if (with_rows) {
      body.put_bytes(std::as_bytes(std::span(*rows)));
      traced.rows_at = traced.steps;
    }
    put_record(body);
  }

  void put_record(const ByteWriter& body) {
    ByteWriter head;
    head.put(static_cast<std::uint32_t>(body.bytes().size()));
    head.put(checksum(body.bytes()));
    put(head);
    put(body);
    ++records_;
  }
  void put(const ByteWriter& bytes) {
    out_.write(reinterpret_cast<const char*>(bytes.bytes().data()), static_cast<std::streamsize>(bytes.bytes().size()));
  }

  std::string path_;
  std::uint32_t rows_every_;
  std::ofstream out_;
  std::mutex mutex_;
  std::unordered_map<PlumbWorld*, TracedWorld> worlds_;
  std::uint64_t world_count_ = 0;
  std::uint64_t records_ = 0;
};

}  // namespace

const PlumbBackendTable* trace(const PlumbBackendTable* next, const std::string& file, const TraceOptions& options) {
  return LayerSlots<TraceLayer>::open("trace", next, file, options);
}

void end_trace(const PlumbBackendTable* traced) { LayerSlots<TraceLayer>::finish("trace", traced); }

}  // namespace plumb::layers
