// A host that leaves no call of the wall out.
#pragma once

#include "ill_table.hpp"

namespace plumb::test {

/// Makes every call at least once, straight on the table.
class Everything {
 public:
  explicit Everything(const PlumbBackendTable* table) : table_(*table) {
    PlumbWorldDesc desc = world_desc(PLUMB_NEED_ALL & ~PLUMB_NEED_CCD);
    const PlumbSetting setting = {"solver", {PLUMB_SETTING_CHOICE, 0, 0, "exact"}};
    desc.settings = &setting;
    desc.setting_count = 1;
    ok(table_.create_world(&desc, &world_));
    objects();
    rows();
    cooking();
    queries();
    extensions();
    ok(extension<PlumbJointsTable>(PLUMB_EXT_JOINTS).destroy(world_, joints_, 2));
    ok(table_.destroy_bodies(world_, bodies_, 2));
    ok(table_.destroy_shapes(world_, &shape_, 1));
    table_.destroy_world(world_);
  }

 private:
  void ok(PlumbResult result) const { EXPECT_GE(result, 0) << table_.error_text(world_); }
  template <class Table>
  const Table& extension(const char* name) const {
    return *static_cast<const Table*>(table_.extension(name));
  }

  void objects() {
    PlumbShapeDesc box = shape_desc(PLUMB_BOX);
    box.half_extents = {1, 2, 3};
    ok(table_.create_shapes(world_, &box, sizeof box, 1, &shape_));
    struct Longer {  // a host of a later version: its descriptors are longer
      PlumbBodyDesc desc;
      double more;
    } descs[2] = {{body_desc(), 1}, {body_desc(), 2}};
    for (Longer& each : descs) each.desc.shape = shape_;
    descs[1].desc.rolling_friction = 0.25;  // a trace has it only where there is any
    ok(table_.create_bodies(world_, &descs[0].desc, sizeof(Longer), 2, bodies_));
    PlumbJointDesc joints[2] = {joint_desc(PLUMB_JOINT_HINGE), joint_desc(PLUMB_JOINT_GEAR)};
    for (PlumbJointDesc& joint : joints) {
      joint.body_a = bodies_[0];
      joint.body_b = bodies_[1];
    }
    joints[1].ratio = 3;  // likewise
    ok(extension<PlumbJointsTable>(PLUMB_EXT_JOINTS).create(world_, joints, sizeof joints[0], 2, joints_));
  }

  void rows() {
    PlumbBody ids[2];
    std::uint32_t count = 0;
    ok(table_.list_bodies(world_, ids, 2, &count));
    std::uint64_t user_data = 0;
    ok(table_.user_data(world_, bodies_[1], &user_data));
    float poses[2][8] = {{0, 0, 0, 0, 0, 0, 1, 9}, {1, 2, 3, 0, 0, 0, 1, 9}};
    ok(table_.write(world_, PLUMB_FIELD_POSE, PLUMB_F32, bodies_, 2, poses, sizeof poses[0]));
    ok(table_.read(world_, PLUMB_FIELD_POSE, PLUMB_F32, bodies_, 2, poses, sizeof poses[0]));
    const PlumbVec3 gravity = {1, 2, 3};
    ok(table_.set_gravity(world_, &gravity));
    const PlumbStepDesc step = {sizeof step, 0, 0.25};
    ok(table_.step(world_, &step));
    PlumbStepReport report{};
    report.struct_size = sizeof report;
    ok(table_.wait(world_, &report));
    PlumbContact contact;
    PlumbEvent event;
    ok(table_.contacts(world_, &contact, sizeof contact, 1, &count));
    ok(table_.events(world_, &event, sizeof event, 1, &count));
    double motors[12] = {};
    const auto& joints = extension<PlumbJointsTable>(PLUMB_EXT_JOINTS);
    ok(joints.write(world_, PLUMB_JOINT_MOTOR, PLUMB_F64, joints_, 1, motors, sizeof motors));
    ok(joints.read(world_, PLUMB_JOINT_MOTOR, PLUMB_F64, nullptr, 1, motors, sizeof motors));
    ok(joints.write(world_, PLUMB_JOINT_SPRING_REST, PLUMB_F64, joints_, 1, motors, sizeof motors));
  }

  void cooking() {
    const auto& cooking = extension<PlumbCookingTable>(PLUMB_EXT_COOKING);
    PlumbShapeDesc ball = shape_desc(PLUMB_SPHERE);
    ball.radius = 0.75;
    PlumbCooked cooked{};
    cooked.struct_size = sizeof cooked;
    ok(cooking.cook(&ball, &cooked));
    const PlumbCookedShape shape = {sizeof shape, 0, cooked.data, cooked.size};
    PlumbShape made = 0;
    ok(cooking.create(world_, &shape, sizeof shape, 1, &made));
    cooking.release(cooked.data);
    ok(table_.destroy_shapes(world_, &made, 1));
  }

  void queries() const {
    const auto& table = extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES);
    const PlumbFilter filter = {1, 1, 0, 0};
    const PlumbRay ray = {{0, 0, 0}, {1, 0, 0}, filter};
    const PlumbCast cast = {shape_, identity_pose(), {4, 5, 6}, filter};
    const PlumbOverlap overlap = {shape_, identity_pose(), filter};
    PlumbHit hit;
    std::uint32_t count = 0;
    ok(table.rays(world_, PLUMB_HIT_CLOSEST, &ray, sizeof ray, 1, &hit, 1, &count));
    ok(table.casts(world_, PLUMB_HIT_CLOSEST, &cast, sizeof cast, 1, &hit, 1, &count));
    ok(table.overlaps(world_, &overlap, sizeof overlap, 1, &hit, 1, &count));
    const PlumbTurningCast turning = {shape_, identity_pose(), {4, 5, 6}, {0, 1, 0}, filter};
    ok(table.turning_casts(world_, PLUMB_HIT_CLOSEST, &turning, sizeof turning, 1, &hit, 1, &count));
    PlumbPenetration penetration;
    ok(table.penetrations(world_, &overlap, sizeof overlap, 1, &penetration, 1, &count));
    const PlumbProbe probe = {shape_, identity_pose(), 7, filter};
    PlumbClosest closest;
    ok(extension<PlumbClosestTable>(PLUMB_EXT_CLOSEST)
           .bodies(world_, PLUMB_HIT_CLOSEST, &probe, sizeof probe, 1, &closest, 1, &count));
    PlumbPosedPair pairs[2] = {{shape_, shape_, identity_pose(), identity_pose()},
                               {shape_, shape_, identity_pose(), identity_pose()}};
    pairs[1].pose_b.position = {7, 8, 9};
    PlumbPairResult results[2];
    PlumbPairPoint points[2];
    ok(extension<PlumbCollideTable>(PLUMB_EXT_COLLIDE)
           .pairs(world_, pairs, sizeof pairs[0], 2, results, points, 2, &count));
  }

  void extensions() const {
    std::uint32_t count = 0;
    const auto& debug = extension<PlumbDebugTable>(PLUMB_EXT_DEBUG);
    PlumbDebugPair pair;
    PlumbDebugBox box;
    PlumbDebugAxis axis;
    PlumbDebugBody body;
    PlumbDebugConstraint constraint;
    ok(debug.pairs(world_, &pair, 1, &count));
    ok(debug.boxes(world_, &box, 1, &count));
    ok(debug.axes(world_, &axis, 1, &count));
    ok(debug.bodies(world_, &body, 1, &count));
    ok(debug.constraints(world_, &constraint, 1, &count));
    const auto& settings = extension<PlumbSettingsTable>(PLUMB_EXT_SETTINGS);
    PlumbSettingValue value = {PLUMB_SETTING_CHOICE, 0, 0, "fast"};
    ok(settings.set(world_, "solver", &value));
    ok(settings.get(world_, "solver", &value));
    const auto& snapshot = extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT);
    std::size_t size = 0;
    ok(snapshot.save(world_, nullptr, 0, &size));
    std::vector<std::byte> data(size);
    ok(snapshot.save(world_, data.data(), data.size(), &size));
    ok(snapshot.restore(world_, data.data(), data.size()));
    ok(snapshot.save_world(world_, nullptr, 0, &size));
    std::uint64_t hash = 0;
    ok(snapshot.hash(world_, &hash));
    const auto& exceptions = extension<PlumbExceptionsTable>(PLUMB_EXT_EXCEPTIONS);
    const PlumbBodyPair apart = {bodies_[1], bodies_[0]};
    PlumbBodyPair listed;
    ok(exceptions.set(world_, &apart, sizeof apart, 1, 0));
    ok(exceptions.list(world_, &listed, 1, &count));
    EXPECT_EQ(count, 1u);
    ok(exceptions.set(world_, &apart, sizeof apart, 1, 1));
    ok(exceptions.list(world_, nullptr, 0, &count));
    EXPECT_EQ(count, 0u);
    const auto& modify = extension<PlumbModifyTable>(PLUMB_EXT_MODIFY);
    PlumbBodyChange body_changed = body_change(bodies_[0]);
    body_changed.what = PLUMB_MODIFY_SHAPE;
    body_changed.shape = shape_;
    ok(modify.bodies(world_, &body_changed, sizeof body_changed, 1));
    PlumbJointChange joint_changed = joint_change(joints_[0]);
    joint_changed.what = PLUMB_MODIFY_ENABLED;
    joint_changed.enabled = 1;
    ok(modify.joints(world_, &joint_changed, sizeof joint_changed, 1));
    const double heights[4] = {0, 0, 0, 1};
    PlumbShapeDesc field = shape_desc(PLUMB_HEIGHT_FIELD);
    field.heights = heights;
    field.rows = field.columns = 2;
    field.spacing = {1, 0, 1};
    PlumbShape ground = 0;
    ok(table_.create_shapes(world_, &field, sizeof field, 1, &ground));
    ok(modify.shapes(world_, &ground, &field, sizeof field, 1));
    const auto& manifolds = extension<PlumbManifoldsTable>(PLUMB_EXT_MANIFOLDS);
    PlumbManifold manifold;
    const PlumbStepDesc step = {sizeof step, 0, 0.01};
    ok(table_.step(world_, &step));
    ok(manifolds.read(world_, &manifold, sizeof manifold, 1, &count));
    ok(manifolds.modify(world_, nullptr, sizeof(PlumbManifoldChange), 0));
    ok(table_.wait(world_, nullptr));
    const auto& state = extension<PlumbStateTable>(PLUMB_EXT_STATE);
    const PlumbStateRequest request = {sizeof request, PLUMB_FIELD_POSE, 1, 1};
    PlumbDLManagedTensor* tensor = nullptr;
    ok(state.borrow(world_, &request, &tensor, nullptr));
    if (tensor != nullptr) tensor->deleter(tensor);
    PlumbBody ids[2];
    std::uint64_t generation = 0;
    ok(state.rows(world_, ids, 2, &count, &generation));
  }

  const PlumbBackendTable& table_;
  PlumbWorld* world_ = nullptr;
  PlumbShape shape_ = 0;
  PlumbBody bodies_[2] = {};
  PlumbJoint joints_[2] = {0, 0};
};

}  // namespace plumb::test
