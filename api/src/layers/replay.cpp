// Replays a trace on a backend and says where the two first part.
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "plumb/layers.hpp"
#include "replay_calls.hpp"
#include "trace_state.hpp"

namespace plumb::layers {
namespace {

[[noreturn]] void corrupt(const std::string& text) { throw Error(PLUMB_E_CORRUPT, text); }

/// Reads the header off the front.
TraceHeader read_header(ByteReader& in, std::span<const std::byte> all) {
  char magic[sizeof trace_magic] = {};
  if (in.left() >= sizeof magic) std::memcpy(magic, in.get_bytes(sizeof magic).data(), sizeof magic);
  if (std::memcmp(magic, trace_magic, sizeof magic) != 0) corrupt("it does not begin as a trace does");
  if (const auto format = in.get<std::uint32_t>(); format != trace_format)
    corrupt("its format is " + std::to_string(format) + ", and this program reads " + std::to_string(trace_format));
  // Minor versions only append, so what an older one recorded is understood.
  if (const auto version = in.get<std::uint32_t>();
      PLUMB_VERSION_MAJOR(version) != PLUMB_VERSION_MAJOR(PLUMB_VERSION) || version > PLUMB_VERSION)
    corrupt("it was recorded with version " + std::to_string(PLUMB_VERSION_MAJOR(version)) + "." +
            std::to_string(PLUMB_VERSION_MINOR(version)) + " of the interface, and this program speaks " +
            std::to_string(PLUMB_VERSION_MAJOR(PLUMB_VERSION)) + "." +
            std::to_string(PLUMB_VERSION_MINOR(PLUMB_VERSION)));
  TraceHeader header;
  header.backend = in.get_string();
  header.version = in.get_string();
  header.build = in.get_string();
  header.device = in.get_string();
  header.rows_every = in.get<std::uint32_t>();
  const auto before = all.first(all.size() - in.left());
  if (in.get<std::uint32_t>() != checksum(before)) corrupt("its header is damaged");
  return header;
}

class Replay {
 public:
  Replay(std::span<const std::byte> file, const PlumbBackendTable* table) : in_(file), all_(file), tables_(table) {}
  ~Replay() {
    for (auto& [number, world] : worlds_)
      if (world.world != nullptr) table().destroy_world(world.world);
  }
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  ReplayReport run() {
    report_.recorded = read_header(in_, all_);
    for (std::uint64_t record = 0;; ++record) {
      ByteReader body = read_record();
      const auto kind = body.get<std::uint8_t>();
      if (kind == end_record) {
        if (body.get<std::uint64_t>() != record || in_.left() != 0)
          corrupt("records are missing, or follow after its end");
        return report_;
      }
      if (kind == settings_record) {
        read_settings(body);
      } else if (kind == state_record) {
        compare_state(body);
      } else {
        replay_call(static_cast<Call>(kind), body);
      }
      if (body.left() != 0) corrupt("a record is longer than its call");
    }
  }

 private:
  [[nodiscard]] const PlumbBackendTable& table() const { return *tables_.next_core(); }

  ByteReader read_record() {
    const std::size_t at = all_.size() - in_.left();
    if (in_.left() == 0) corrupt("it has no end: the run that wrote it was stopped");
    const auto size = in_.get<std::uint32_t>();
    const auto sum = in_.get<std::uint32_t>();
    const auto body = in_.get_bytes(size);
    if (sum != checksum(body)) corrupt("the record at byte " + std::to_string(at) + " is damaged");
    return ByteReader(body);
  }

  void replay_call(Call call, ByteReader& body) {
    ++report_.calls;
    bool known = false;
    for_each_call([&]<Call each>() {
      if (each == call) known = true, replay<each>(body);
    });
    if (!known) corrupt("it holds a call of number " + std::to_string(static_cast<int>(call)) + ", which is none");
  }

  template <Call call>
  void replay(ByteReader& body) {
    const auto number = body.get<std::uint64_t>();
    const auto recorded = body.get<PlumbResult>();
    const std::string text = recorded < 0 ? body.get_string() : std::string();
    if constexpr (call == Call::core_create_world) {
      Decoding decoding{body, worlds_[number], recorded};
      compare(call, recorded, text, create_world(decoding), nullptr);
      return;
    } else {
      const auto found = worlds_.find(number);
      if (found == worlds_.end()) corrupt("a call is on world " + std::to_string(number) + ", which was not made");
      ReplayedWorld& world = found->second;
      if (world.world == nullptr) {  // its loss was reported; what follows cannot be asked
        body.get_bytes(body.left());
        return;
      }
      if constexpr (call == Call::core_destroy_world) {
        table().destroy_world(world.world);
        world.world = nullptr;
      } else {
        Decoding decoding{body, world, recorded};
        using Traits = CallTraits<call>;
        const auto* next = tables_.next_table<typename Traits::Table>();
        if (next == nullptr || !has(*next, Traits::pointer)) {
          body.get_bytes(body.left());
          compare(call, recorded, text, PLUMB_E_UNSUPPORTED, nullptr);
          return;
        }
        if (call == Call::core_wait && recorded >= 0) ++report_.steps;
        const PlumbResult replayed = again(CallTag<call>(), decoding, next->*Traits::pointer);
        compare(call, recorded, text, replayed, world.world);
        std::optional<Outputs> outputs;
        if (body.left() == sizeof(Outputs)) outputs = body.get<Outputs>();
        if (recorded == replayed && outputs && decoding.outputs &&
            (outputs->count != decoding.outputs->count || outputs->hash != decoding.outputs->hash)) {
          if (report_.outputs_differ++ == 0)
            report_.first_output = "call " + std::to_string(report_.calls) + " (" + std::string(Traits::name) + ")";
        }
      }
    }
  }

  PlumbResult create_world(Decoding& decoding) {
    ++report_.worlds;
    auto desc = decoding.rows<PlumbWorldDesc>();
    std::vector<std::string> names;
    std::vector<PlumbSetting> settings;
    if (desc.present) {
      if (desc.rows.size() != 1) corrupt("a world has " + std::to_string(desc.rows.size()) + " descriptors");
      auto& first = desc.rows[0];
      const auto recorded = decoding.array<PlumbSetting>(1, [&decoding] {
        PlumbSetting setting{};
        setting.name = decoding.name();
        setting.value = decoding.value();
        return setting;
      });
      for (const PlumbSetting& setting : recorded.rows)
        if (knows_setting(setting.name)) settings.push_back(setting);
      first.settings = recorded.present ? settings.data() : nullptr;
      first.setting_count = recorded.present ? static_cast<std::uint32_t>(settings.size()) : recorded.count;
    }
    return table().create_world(desc.data(), &decoding.to.world);
  }
  // Settings belong to an engine: those that the replaying one does not have are left at what it does by itself.
  [[nodiscard]] bool knows_setting(const char* name) const {
    const auto* settings = tables_.next_table<PlumbSettingsTable>();
    for (std::uint32_t i = 0; name != nullptr && settings != nullptr && i < settings->count; ++i)
      if (std::strcmp(settings->describe(i)->name, name) == 0) return true;
    return std::strcmp(report_.recorded.backend.c_str(), table().info()->name) == 0;
  }

  void compare(Call call, PlumbResult recorded, const std::string& text, PlumbResult replayed, PlumbWorld* world) {
    if (recorded == replayed) return;
    if (report_.results_differ++ != 0) return;
    const char* now = replayed < 0 ? table().error_text(world) : "";
    report_.result = ResultDifference{report_.calls, std::string(name_of(call)), recorded, replayed,
                                      recorded < 0 ? text : std::string(now == nullptr ? "" : now)};
  }

  void read_settings(ByteReader& body) {
    const auto number = body.get<std::uint64_t>();
    const auto count = body.get<std::uint32_t>();
    ReplayedWorld unused;
    Decoding decoding{body, unused, PLUMB_OK};
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::string name = body.get_string();
      const PlumbSettingValue value = decoding.value();
      char digits[32];
      std::snprintf(digits, sizeof digits, "%.9g", value.number);
      if (number == 1) report_.settings.emplace_back(name, value.choice != nullptr ? value.choice : digits);
    }
  }

  void compare_state(ByteReader& body) {
    const auto number = body.get<std::uint64_t>();
    const auto step = body.get<std::uint64_t>();
    const auto hash = body.get<std::uint64_t>();
    const auto count = body.get<std::uint32_t>();
    std::vector<StateRow> recorded;
    if (body.get<std::uint8_t>() != 0) {
      const auto bytes = body.get_bytes(std::size_t{count} * sizeof(StateRow));
      recorded.resize(count);
      if (!bytes.empty()) std::memcpy(recorded.data(), bytes.data(), bytes.size());
    }
    const auto world = worlds_.find(number);
    const bool open = !report_.state || (report_.state->world == number && report_.state->row_step == 0);
    if (world == worlds_.end() || world->second.world == nullptr || !open) return;
    const auto replayed = read_state(table(), world->second.world);
    if (!replayed || (!report_.state && hash_of(*replayed) == hash)) return;
    if (!report_.state) {
      report_.state.emplace();
      report_.state->world = number;
      report_.state->step = step;
    }
    if (recorded.empty()) return;
    compare_rows(*report_.state, step, recorded, *replayed);
    if (report_.state->body != 0) report_.state->body = number_of_living(world->second, report_.state->body - 1);
  }

  // The number in order of creation of the body that is at `index` among those that live.
  [[nodiscard]] std::uint64_t number_of_living(const ReplayedWorld& world, std::uint64_t index) const {
    std::vector<PlumbBody> ids(index + 1);
    std::uint32_t count = 0;
    table().list_bodies(world.world, ids.data(), static_cast<std::uint32_t>(ids.size()), &count);
    return world.names.number(Objects::bodies, ids[index]);
  }

  static void compare_rows(StateDifference& difference, std::uint64_t step, const std::vector<StateRow>& recorded,
                           const std::vector<StateRow>& replayed) {
    difference.row_step = step;
    for (std::size_t i = 0; i < std::min(recorded.size(), replayed.size()); ++i) {
      bool differs = false;
      for (std::size_t column = 0; column < 13; ++column) {
        const double then = recorded[i][column], now = replayed[i][column];
        if (then == now || (std::isnan(then) && std::isnan(now))) continue;
        differs = true;
        const double size = std::isnan(then) || std::isnan(now) ? INFINITY : std::abs(then - now);
        if (difference.body != 0 && size <= difference.largest) continue;
        difference.body = i + 1;
        difference.field = state_columns[column];
        difference.recorded = then;
        difference.replayed = now;
        difference.largest = size;
      }
      difference.bodies += differs ? 1 : 0;
    }
  }

  ByteReader in_;
  std::span<const std::byte> all_;
  LayerBase tables_;
  std::map<std::uint64_t, ReplayedWorld> worlds_;
  ReplayReport report_;
};

/// Runs read(bytes) on a file's bytes; what is corrupt is said with the file's name.
template <class Read>
auto read_trace(const std::string& file, Read&& read) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.is_open() || in.bad())
    throw Error(PLUMB_E_INVALID_ARGUMENT, "cannot read the trace " + file + ": " + std::strerror(errno));
  try {
    return read(std::as_bytes(std::span(bytes)));
  } catch (const Error& error) {
    if (error.code() != PLUMB_E_CORRUPT) throw;
    throw Error(PLUMB_E_CORRUPT, file + " is not a whole trace: " + error.what() + "; record it again");
  }
}

}  // namespace

TraceHeader trace_header(const std::string& file) {
  return read_trace(file, [](std::span<const std::byte> bytes) {
    ByteReader reader(bytes);
    return read_header(reader, bytes);
  });
}

ReplayReport replay(const std::string& file, const PlumbBackendTable* table) {
  return read_trace(file, [table](std::span<const std::byte> bytes) { return Replay(bytes, table).run(); });
}

}  // namespace plumb::layers
