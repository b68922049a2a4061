// A backend of particles that does, when asked by its setting "misbehaviour" or by PLUMB_MISBEHAVE, what engines do on
// bad days. Everything that happens before there is a world is asked for by the variable only.
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "plumb/backend.hpp"

namespace {

const char* const choices[] = {"none", "segfault", "abort",  "hang",   "eat_memory", "nan",    "throw",
                               "exit", "print",    "refuse", "garble", "jostle",     "remark", "disturb"};

std::string from_environment() {
  const char* word = std::getenv("PLUMB_MISBEHAVE");
  return word == nullptr ? "none" : word;
}

const PlumbSettingInfo setting_list[] = {
    {"misbehaviour",
     "",
     "what goes wrong, and it does so in the tenth step",
     PLUMB_SETTING_CHOICE,
     PLUMB_ROLE_BEHAVIOUR,
     0,
     sizeof choices / sizeof *choices,
     choices,
     0,
     0,
     {PLUMB_SETTING_CHOICE, 0, 0, choices[0]}},
    {"iterations",
     "1",
     "does nothing",
     PLUMB_SETTING_INT,
     PLUMB_ROLE_QUALITY,
     0,
     0,
     nullptr,
     1,
     100,
     {PLUMB_SETTING_INT, 0, 10, nullptr}},
    {"pause",
     "s",
     "time that a step sleeps",
     PLUMB_SETTING_FLOAT,
     PLUMB_ROLE_SPEED,
     0,
     0,
     nullptr,
     0,
     10,
     {PLUMB_SETTING_FLOAT, 0, 0, nullptr}},
    {"substeps",
     "1",
     "parts of a step",
     PLUMB_SETTING_INT,
     PLUMB_ROLE_QUALITY,
     0,
     0,
     nullptr,
     1,
     64,
     {PLUMB_SETTING_INT, 0, 1, nullptr}},
};
constexpr std::size_t setting_count = std::size(setting_list);

class MisbehavingWorld final : public plumb::IPhysicsWorld, public plumb::IJoints, public plumb::ISettings {
 public:
  explicit MisbehavingWorld(const plumb::WorldInit& init) : gravity_(init.desc.gravity) {
    for (std::size_t i = 0; i < setting_count; ++i) set_setting(setting_list[i].name, init.values[i]);
  }

  static const PlumbBackendInfo& info() {
    static const PlumbBackendInfo value = {sizeof value,    PLUMB_DETERMINISM_THREADS,
                                           "misbehaving",   "1",
                                           "misbehaving-1", "goes wrong as asked",
                                           "cpu",           "",
                                           PLUMB_F64,       1};
    return value;
  }
  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
    note = "particles only";
    if (kind == PLUMB_CAP_SHAPE) return PLUMB_NATIVE;
    constexpr PlumbNeeds met = PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS;
    if (kind == PLUMB_CAP_NEED) return (met >> a & 1) != 0 ? PLUMB_NATIVE : PLUMB_NONE;
    if (kind == PLUMB_CAP_JOINT) return PLUMB_NATIVE;
    if (kind == PLUMB_CAP_JOINT_FEATURE) return b == PLUMB_JOINT_HAS_LIMITS ? PLUMB_NATIVE : PLUMB_NONE;
    if (kind == PLUMB_CAP_FIELD_READ || kind == PLUMB_CAP_FIELD_WRITE)
      return a <= PLUMB_FIELD_VELOCITY ? PLUMB_NATIVE : PLUMB_NONE;
    return PLUMB_NONE;
  }
  static std::span<const PlumbSettingInfo> setting_infos() { return setting_list; }

  plumb::ISettings* settings() override { return this; }
  PlumbResult get_setting(const char* name, PlumbSettingValue& value) override { return value = *find(name), PLUMB_OK; }
  PlumbResult set_setting(const char* name, const PlumbSettingValue& value) override {
    PlumbSettingValue& mine = *find(name);
    mine = value;
    for (const char* choice : choices) {
      if (value.choice != nullptr && std::strcmp(choice, value.choice) == 0) mine.choice = choice;
    }
    return PLUMB_OK;
  }

  PlumbResult create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape>) override {
    for (std::size_t i = 0; i < descs.size(); ++i)
      if (descs[i].radius > 1e6) refuse_element(i, ".radius is");
    return PLUMB_OK;
  }
  PlumbResult destroy_shapes(std::span<const PlumbShape>) override { return PLUMB_OK; }
  PlumbResult create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) override {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      if (descs[i].mass > 1e12) refuse_element(i, ".mass is");
      if (plumb::slot_of(ids[i]) >= bodies_.size()) bodies_.resize(plumb::slot_of(ids[i]) + 1);
      bodies_[plumb::slot_of(ids[i])] = descs[i];
    }
    return PLUMB_OK;
  }
  PlumbResult destroy_bodies(std::span<const PlumbBody> ids) override {
    for (const PlumbBody id : ids) bodies_[plumb::slot_of(id)].motion = PLUMB_STATIC;
    return PLUMB_OK;
  }
  PlumbResult read(PlumbField field, std::span<const PlumbBody> ids, plumb::Rows rows) override {
    for (std::size_t i = 0; i < ids.size(); ++i) rows.put(i, row(field, ids[i]), plumb::columns_of(field));
    return PLUMB_OK;
  }
  PlumbResult write(PlumbField field, std::span<const PlumbBody> ids, plumb::ConstRows rows) override {
    for (std::size_t i = 0; i < ids.size(); ++i) rows.get(i, row(field, ids[i]), plumb::columns_of(field));
    return PLUMB_OK;
  }

  // Joints hold nothing: they are there to be refused.
  plumb::IJoints* joints() override { return this; }
  PlumbResult create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint>) override {
    for (std::size_t i = 0; i < descs.size(); ++i)
      if (descs[i].limits[3].upper > 1e7) refuse_element(i, ".limits[3] are");
    return PLUMB_OK;
  }
  PlumbResult destroy_joints(std::span<const PlumbJoint>) override { return PLUMB_OK; }
  PlumbResult read_joints(PlumbJointField, std::span<const PlumbJoint>, plumb::Rows) override {
    return PLUMB_E_UNSUPPORTED;
  }
  PlumbResult write_joints(PlumbJointField, std::span<const PlumbJoint>, plumb::ConstRows) override {
    return PLUMB_E_UNSUPPORTED;
  }

  PlumbResult set_gravity(const PlumbVec3& gravity) override { return gravity_ = gravity, PLUMB_OK; }

  PlumbResult step(double dt) override {
    if (++steps_ == 10) misbehave();
    if (values_[2].number > 0) std::this_thread::sleep_for(std::chrono::duration<double>(values_[2].number));
    for (int part = 0; part < values_[3].number; ++part) move(dt / values_[3].number);
    return PLUMB_OK;
  }
  void move(double dt) {
    for (PlumbBodyDesc& body : bodies_) {
      if (body.motion != PLUMB_DYNAMIC) continue;
      PlumbVec3 &x = body.pose.position, &v = body.linear_velocity;
      v = {v.x + dt * body.gravity_scale * gravity_.x, v.y + dt * body.gravity_scale * gravity_.y,
           v.z + dt * body.gravity_scale * gravity_.z};
      x = {x.x + dt * v.x, x.y + dt * v.y, x.z + dt * v.z};
    }
  }
  PlumbResult wait(PlumbStepReport& report) override {
    if (steps_ == 10 && std::strcmp(values_[0].choice, "remark") == 0)
      report.remarks = PLUMB_REMARK_SOLVER_FELL_BACK | PLUMB_REMARK_STEP_REPEATED | PLUMB_REMARK_ENERGY_BOUNDED;
    report.phase_seconds[PLUMB_PHASE_INTEGRATE] = 1e-7;  // so that there is one to be shown
    return PLUMB_OK;
  }
  std::span<const PlumbContact> contacts() override { return {}; }
  std::span<const PlumbEvent> events() override { return {}; }

 private:
  [[noreturn]] static void refuse_element(std::size_t i, const std::string& member) {
    throw plumb::Error(PLUMB_E_INVALID_ARGUMENT, "descs[" + std::to_string(i) + "]" + member + " beyond this engine");
  }

  PlumbSettingValue* find(const char* name) {
    for (std::size_t i = 0; i < setting_count; ++i) {
      if (std::strcmp(name, setting_list[i].name) == 0) return &values_[i];
    }
    throw plumb::Error(PLUMB_E_INVALID_ARGUMENT, "no such setting");
  }

  double* row(PlumbField field, PlumbBody id) {
    PlumbBodyDesc& body = bodies_[plumb::slot_of(id)];
    return field == PLUMB_FIELD_POSE ? &body.pose.position.x : &body.linear_velocity.x;
  }

  void misbehave() {
    const std::string word = values_[0].choice;
    if (word == "segfault") std::raise(SIGSEGV);
    if (word == "abort") std::abort();
    if (word == "exit") std::exit(3);
    if (word == "throw") throw std::runtime_error("the engine threw");
    if (word == "refuse") throw plumb::Error(PLUMB_E_OUT_OF_MEMORY, "no room for contacts");
    if (word == "hang") {
      while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    if (word == "nan") {
      for (PlumbBodyDesc& body : bodies_) body.pose.position.y = std::numeric_limits<double>::quiet_NaN();
    }
    if (word == "jostle") {  // the more bodies there are, the farther each is moved
      for (PlumbBodyDesc& body : bodies_) body.pose.position.x += 0.01 * static_cast<double>(bodies_.size());
    }
    if (word == "disturb") {  // worlds that came to this step before move the bodies
      static std::atomic<int> before{0};
      const int worlds = before++;
      for (PlumbBodyDesc& body : bodies_) body.pose.position.x += 0.01 * worlds;
    }
    if (word == "print") {
      std::puts("{\"status\": \"ok\", \"this\": \"is no answer\"}");
      std::fputs("an engine talks\n", stderr);
    }
    if (word == "garble") {  // onto the pipe of the answers, as an engine with a stray descriptor would
      if (std::FILE* stray = fdopen(4, "w")) std::fputs("no answer at all\n", stray), std::fflush(stray);
    }
    if (word == "eat_memory") {
      constexpr std::size_t block = std::size_t{16} << 20;
      while (true) {
        eaten_.push_back(std::make_unique<char[]>(block));
        std::memset(eaten_.back().get(), 1, block);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
  }

  PlumbVec3 gravity_;
  std::vector<PlumbBodyDesc> bodies_;
  std::vector<std::unique_ptr<char[]>> eaten_;
  int steps_ = 0;
  PlumbSettingValue values_[setting_count] = {setting_list[0].default_value, setting_list[1].default_value,
                                              setting_list[2].default_value, setting_list[3].default_value};
};

}  // namespace

extern "C" PLUMB_EXPORT PlumbResult plumb_backend_open(const PlumbOpenRequest* request, PlumbOpenReply* reply) {
  const std::string word = from_environment();
  if (word == "segfault_on_open") std::raise(SIGSEGV);
  const PlumbResult result = plumb::backend::open<MisbehavingWorld>(request, reply);
  if (word == "lie_about_version") reply->version = PLUMB_MAKE_VERSION(77, 7);
  if (word == "lie_about_size") {
    static PlumbBackendTable table = *reply->table;
    table.struct_size = 24;
    reply->table = &table;
  }
  return result;
}
