// The smallest backend that is of use: particles under gravity, with no collision. What an author starts from.
#include "plumb/backend.hpp"

namespace {

class SampleWorld final : public plumb::IPhysicsWorld {
 public:
  explicit SampleWorld(const plumb::WorldInit& init) : gravity_(init.desc.gravity) {}

  static const PlumbBackendInfo& info() {
    static const PlumbBackendInfo info = {sizeof info, PLUMB_DETERMINISM_THREADS,
                                          "sample",    "1",
                                          "sample-1",  "particles under gravity",
                                          "cpu",       "",
                                          PLUMB_F64,   1};
    return info;
  }

  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) {
    note = "particles only";
    if (kind == PLUMB_CAP_SHAPE) return a == PLUMB_SPHERE && b != PLUMB_KINEMATIC ? PLUMB_NATIVE : PLUMB_NONE;
    if (kind == PLUMB_CAP_FIELD_READ || kind == PLUMB_CAP_FIELD_WRITE)
      return a <= PLUMB_FIELD_VELOCITY ? PLUMB_NATIVE : PLUMB_NONE;
    return PLUMB_NONE;
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
    for (PlumbBodyDesc& body : bodies_) {
      if (body.motion != PLUMB_DYNAMIC) continue;
      PlumbVec3 &x = body.pose.position, &v = body.linear_velocity;
      v = {v.x + dt * body.gravity_scale * gravity_.x, v.y + dt * body.gravity_scale * gravity_.y,
           v.z + dt * body.gravity_scale * gravity_.z};
      x = {x.x + dt * v.x, x.y + dt * v.y, x.z + dt * v.z};
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

  PlumbVec3 gravity_;
  std::vector<PlumbBodyDesc> bodies_;
};

}  // namespace

PLUMB_BACKEND(SampleWorld)
