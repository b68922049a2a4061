// A backend that claims everything and computes nothing: it shows what the guard lets through.
#pragma once

#include <functional>
#include <map>
#include <stdexcept>

#include "plumb/backend.hpp"

namespace plumb::test {

class FakeWorld : public IPhysicsWorld,
                  public IJoints,
                  public IQueries,
                  public ISettings,
                  public ISnapshot,
                  public IExceptions,
                  public IModify,
                  public IManifolds,
                  public IWorlds,
                  public IClosest,
                  public backend::ICookedShapes {
 public:
  explicit FakeWorld(const WorldInit& init) : iterations_(init.setting("iterations").number) { last = this; }

  /// The world made last, and how often its class was called: a refused call must not have got here.
  inline static FakeWorld* last = nullptr;
  int calls = 0;
  std::vector<PlumbShapeDesc> shapes;  ///< of the last call; their arrays are gone
  std::vector<PlumbBodyDesc> made;
  std::function<void()> on_step;
  std::function<void(std::span<const PlumbShapeDesc>)> on_shapes;  ///< while their arrays are there
  std::uint32_t remarks = 0;                                       ///< of steps
  bool fails_to_destroy = false;
  PlumbResult answer = PLUMB_OK;  ///< of every call that changes the world
  std::vector<PlumbEvent> event_rows;
  std::map<PlumbField, std::vector<double>> written;

  static const PlumbBackendInfo& info() {
    static const PlumbBackendInfo info = {
        sizeof info, PLUMB_DETERMINISM_NONE, "fake", "1", "fake-1", "claims everything", "cpu", "", PLUMB_F64, 1};
    return info;
  }
  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
    if (kind == PLUMB_CAP_SHAPE && a == PLUMB_CYLINDER) return note = "no cylinders here", PLUMB_NONE;
    if (kind == PLUMB_CAP_SHAPE && a == PLUMB_PLANE) return b == PLUMB_STATIC ? PLUMB_NATIVE : PLUMB_NONE;
    if (kind == PLUMB_CAP_COOKING) return a == PLUMB_TRIANGLE_MESH ? PLUMB_NATIVE : PLUMB_NONE;
    if (kind == PLUMB_CAP_NEED && a == 5) return note = "no continuous collision", PLUMB_NONE;
    if (kind == PLUMB_CAP_JOINT_FEATURE && a == PLUMB_JOINT_FIXED && b == PLUMB_JOINT_HAS_TARGETS) return PLUMB_NONE;
    return PLUMB_NATIVE;
  }
  static backend::CookedFormat cooked_format() { return {"fake", 3}; }
  /// A byte a triangle.
  static std::vector<std::byte> cook(const PlumbShapeDesc& desc) {
    if (desc.triangle_count > 100) throw Error(PLUMB_E_OUT_OF_MEMORY, "too many triangles to cook");
    return std::vector<std::byte>(desc.triangle_count, std::byte{7});
  }
  static std::span<const PlumbSettingInfo> setting_infos() {
    static const char* const kChoices[] = {"fast", "exact"};
    static const PlumbSettingInfo infos[] = {{"iterations",
                                              "1",
                                              "sweeps",
                                              PLUMB_SETTING_INT,
                                              PLUMB_ROLE_QUALITY,
                                              0,
                                              0,
                                              nullptr,
                                              1,
                                              100,
                                              {PLUMB_SETTING_INT, 0, 10, nullptr}},
                                             {"solver",
                                              "",
                                              "which",
                                              PLUMB_SETTING_CHOICE,
                                              PLUMB_ROLE_BEHAVIOUR,
                                              0,
                                              2,
                                              kChoices,
                                              0,
                                              0,
                                              {PLUMB_SETTING_CHOICE, 0, 0, "fast"}},
                                             {"margin",
                                              "m",
                                              "skin",
                                              PLUMB_SETTING_FLOAT,
                                              PLUMB_ROLE_QUALITY,
                                              PLUMB_SETTING_CREATION_ONLY,
                                              0,
                                              nullptr,
                                              0,
                                              1,
                                              {PLUMB_SETTING_FLOAT, 0, 0.5, nullptr}}};
    return infos;
  }

  PlumbResult create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape>) override {
    shapes.assign(descs.begin(), descs.end());
    if (on_shapes) on_shapes(descs);
    return called();
  }
  PlumbResult destroy_shapes(std::span<const PlumbShape>) override { return called(); }
  PlumbResult create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) override {
    for (std::size_t i = 0; i < descs.size(); ++i) {
      made.push_back(descs[i]);
      handles.push_back(ids[i]);
    }
    return called();
  }
  PlumbResult destroy_bodies(std::span<const PlumbBody>) override { return fails_to_destroy ? -1 : called(); }
  PlumbResult read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) override {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      std::vector<double> row(columns_of(field), static_cast<double>(slot_of(ids[i])));
      rows.put(i, row.data(), row.size());
    }
    return called();
  }
  PlumbResult write(PlumbField field, std::span<const PlumbBody>, ConstRows rows) override {
    written[field].resize(columns_of(field));
    rows.get(0, written[field].data(), columns_of(field));
    return called();
  }
  PlumbResult set_gravity(const PlumbVec3&) override { return called(); }
  PlumbResult step(double) override {
    if (on_step) on_step();
    return called();
  }
  PlumbResult wait(PlumbStepReport& report) override {
    report.remarks = remarks;
    return called();
  }
  std::span<const PlumbContact> contacts() override { return {}; }
  std::span<const PlumbEvent> events() override { return event_rows; }

  IJoints* joints() override { return this; }
  IQueries* queries() override { return this; }
  ISettings* settings() override { return this; }
  ISnapshot* snapshot() override { return this; }
  IExceptions* exceptions() override { return this; }
  IModify* modify() override { return this; }
  IManifolds* manifolds() override { return this; }
  IWorlds* worlds() override { return this; }
  IClosest* closest() override { return this; }

  PlumbResult create_joints(std::span<const PlumbJointDesc>, std::span<PlumbJoint>) override { return called(); }
  PlumbResult destroy_joints(std::span<const PlumbJoint>) override { return called(); }
  PlumbResult read_joints(PlumbJointField, std::span<const PlumbJoint>, Rows) override { return called(); }
  PlumbResult write_joints(PlumbJointField, std::span<const PlumbJoint>, ConstRows) override { return called(); }
  Hits cast_rays(PlumbHitMode, std::span<const PlumbRay> rays) override {
    ++calls;
    hit_rows.assign(rays.size(), PlumbHit{});
    return {PLUMB_OK, hit_rows};
  }
  Hits cast_shapes(PlumbHitMode, std::span<const PlumbCast>) override { return {called(), {}}; }
  Hits overlap_shapes(std::span<const PlumbOverlap>) override { return {called(), {}}; }
  Hits turning_casts(PlumbHitMode, std::span<const PlumbTurningCast> casts) override {
    ++calls;
    hit_rows.assign(casts.size(), PlumbHit{});
    return {PLUMB_OK, hit_rows};
  }
  Penetrations penetrations(std::span<const PlumbOverlap> overlaps) override {
    ++calls;
    penetration_rows.clear();
    for (std::uint32_t i = 0; i < overlaps.size(); ++i) penetration_rows.push_back({1, i, 0, 0.5, {}, {0, 1, 0}});
    return {PLUMB_OK, penetration_rows};
  }
  ClosestBodies closest_bodies(PlumbHitMode, std::span<const PlumbProbe> probes) override {
    ++calls;
    closest_rows.assign(probes.size(), PlumbClosest{});
    return {PLUMB_OK, closest_rows};
  }
  PlumbResult get_setting(const char*, PlumbSettingValue& value) override {
    value = {PLUMB_SETTING_INT, 0, iterations_, nullptr};
    return called();
  }
  PlumbResult set_setting(const char* name, const PlumbSettingValue& value) override {
    if (std::string_view(name) == "iterations") iterations_ = value.number;
    return called();
  }
  PlumbResult save(std::span<const std::byte>& data) override {
    static const std::byte payload[5] = {std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}, std::byte{5}};
    data = payload;
    return called();
  }
  PlumbResult restore(std::span<const std::byte> data) override {
    restored = data.size();
    return called();
  }

  PlumbResult set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) override {
    if (const PlumbResult result = called(); result < 0) return result;
    for (const PlumbBodyPair& pair : pairs) exception_calls.push_back({pair.body_a, pair.body_b, touch});
    return PLUMB_OK;
  }

  PlumbResult modify_bodies(std::span<const PlumbBodyChange> changes) override {
    body_changes.assign(changes.begin(), changes.end());
    return called();
  }
  PlumbResult modify_joints(std::span<const PlumbJointChange> changes) override {
    joint_changes.assign(changes.begin(), changes.end());
    return called();
  }
  PlumbResult modify_shapes(std::span<const PlumbShape> ids, std::span<const PlumbShapeDesc> descs) override {
    shapes_changed.assign(ids.begin(), ids.end());
    return descs.size() == ids.size() ? called() : PLUMB_E_INTERNAL;
  }

  PlumbResult read_manifolds(std::span<const PlumbManifold>& rows) override {
    rows = shown;
    return called();
  }
  PlumbResult modify_manifolds(std::span<const PlumbManifoldChange> changes) override {
    manifold_changes.assign(changes.begin(), changes.end());
    return called();
  }

  PlumbResult group(std::span<IPhysicsWorld* const> others) override {
    grouped_with.assign(others.begin(), others.end());
    return called();
  }

  PlumbResult borrow_all(const PlumbStateRequest&, PlumbDLManagedTensor*&, PlumbFence*) override { return called(); }

  PlumbResult create_cooked(std::span<const backend::CookedPayload> given, std::span<const PlumbShape> ids) override {
    cooked.clear();
    for (std::size_t i = 0; i < given.size(); ++i)
      cooked.push_back({given[i].type, {given[i].bytes.begin(), given[i].bytes.end()}, ids[i]});
    return fails_to_make_cooked ? PLUMB_E_OUT_OF_MEMORY : called();
  }

  struct Cooked {
    PlumbShapeType type;
    std::vector<std::byte> bytes;
    PlumbShape id;
  };
  std::vector<Cooked> cooked;
  bool fails_to_make_cooked = false;
  std::vector<IPhysicsWorld*> grouped_with;
  std::vector<PlumbManifold> shown;
  std::vector<PlumbManifoldChange> manifold_changes;
  std::vector<PlumbBodyChange> body_changes;
  std::vector<PlumbJointChange> joint_changes;
  std::vector<PlumbShape> shapes_changed;
  struct ExceptionCall {
    PlumbBody a, b;
    bool touch;
    friend bool operator==(const ExceptionCall&, const ExceptionCall&) = default;
  };
  std::vector<ExceptionCall> exception_calls;
  std::vector<PlumbBody> handles;
  std::vector<PlumbHit> hit_rows;
  std::vector<PlumbPenetration> penetration_rows;
  std::vector<PlumbClosest> closest_rows;
  std::size_t restored = 0;

 private:
  PlumbResult called() {
    ++calls;
    return answer;
  }
  double iterations_;
};

}  // namespace plumb::test
