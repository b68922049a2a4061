// The smallest backend that is of use: particles under gravity, with no collision. What an author starts from.
#include "plumb/backend.hpp"

#include "plumb/backend/settings_table.hpp"
#include "plumb/backend/small_math.hpp"
#include "plumb/backend/usual_capability.hpp"

namespace {

using namespace plumb::backend;

enum class Integrator { kSemiImplicit, kVerlet };
constexpr const char* kIntegrators[] = {"semi_implicit", "verlet"};  // in the order of Integrator

struct Settings {
  int substeps;
  Integrator integrator;
};
const SettingsTable<Settings>& settings_table() {
  static const SettingsTable<Settings> all = {
      setting<&Settings::substeps>(
          int_setting("substeps", "1", PLUMB_ROLE_QUALITY, 1, 1000, 1, "parts in which a step is done")),
      setting<&Settings::integrator>(choice_setting(
          "integrator", PLUMB_ROLE_BEHAVIOUR, kIntegrators,
          "semi_implicit: velocities first, of first order; verlet: half of them before and half after"))};
  return all;
}

class SampleWorld final : public plumb::IPhysicsWorld, public plumb::ISettings {
 public:
  explicit SampleWorld(const plumb::WorldInit& init)
      : settings_(settings_table().values(init)), gravity_(init.desc.gravity) {}

  static const PlumbBackendInfo& info() {
    static const PlumbBackendInfo info = [] {
      PlumbBackendInfo i{};
      i.struct_size = sizeof i;
      i.determinism = PLUMB_DETERMINISM_THREADS;
      i.name = "sample";
      i.version = "1";
      i.build = "sample-1";
      i.description = "particles under gravity";
      i.device = "cpu";
      i.exclusion_group = "";
      i.precision = PLUMB_F64;
      i.max_threads = 1;
      return i;
    }();
    return info;
  }

  /// An engine that has more than it lacks begins with usual_capability, and names what it lacks.
  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
    const bool shapes = kind == PLUMB_CAP_SHAPE && a == PLUMB_SPHERE && b != PLUMB_KINEMATIC;
    const bool fields = (kind == PLUMB_CAP_FIELD_READ || kind == PLUMB_CAP_FIELD_WRITE) && a <= PLUMB_FIELD_VELOCITY;
    const Capability known = shapes || fields ? usual_capability(kind, a, b) : Capability{PLUMB_NONE, "particles only"};
    note = known.note;
    return known.degree;
  }
  static std::span<const PlumbSettingInfo> setting_infos() { return settings_table().infos(); }

  plumb::ISettings* settings() override { return this; }
  PlumbResult get_setting(const char* name, PlumbSettingValue& value) override {
    return value = settings_table().get(settings_, name), PLUMB_OK;
  }
  PlumbResult set_setting(const char* name, const PlumbSettingValue& value) override {
    return settings_table().set(settings_, name, value), PLUMB_OK;
  }

  PlumbResult create_shapes(std::span<const PlumbShapeDesc>, std::span<PlumbShape>) override { return PLUMB_OK; }
  PlumbResult destroy_shapes(std::span<const PlumbShape>) override { return PLUMB_OK; }

  PlumbResult create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) override {
    for (std::size_t i = 0; i < descs.size(); ++i) {
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
  PlumbResult set_gravity(const PlumbVec3& gravity) override { return gravity_ = gravity, PLUMB_OK; }

  PlumbResult step(double dt) override {
    const double h = dt / settings_.substeps, before = settings_.integrator == Integrator::kVerlet ? h / 2 : h;
    for (int part = 0; part < settings_.substeps; ++part)
      for (PlumbBodyDesc& body : bodies_) {
        if (body.motion != PLUMB_DYNAMIC) continue;
        PlumbVec3 &x = body.pose.position, &v = body.linear_velocity;
        v = add(v, scale(before * body.gravity_scale, gravity_));
        x = add(x, scale(h, v));
        v = add(v, scale((h - before) * body.gravity_scale, gravity_));
      }
    return PLUMB_OK;
  }
  PlumbResult wait(PlumbStepReport&) override { return PLUMB_OK; }
  std::span<const PlumbContact> contacts() override { return {}; }
  std::span<const PlumbEvent> events() override { return {}; }

 private:
  double* row(PlumbField field, PlumbBody id) {
    PlumbBodyDesc& body = bodies_[plumb::slot_of(id)];
    return field == PLUMB_FIELD_POSE ? &body.pose.position.x : &body.linear_velocity.x;
  }

  Settings settings_;
  PlumbVec3 gravity_;
  std::vector<PlumbBodyDesc> bodies_;
};

}  // namespace

PLUMB_BACKEND(SampleWorld)
