// IPhysicsWorld over a Simulation: handles and doubles outside, rows and Reals inside.
#pragma once

#include <span>
#include <vector>

#include "plugin/body_record.hpp"
#include "plugin/joint_record.hpp"
#include "plugin/settings.hpp"
#include "plumb/backend/touch_tracker.hpp"
#include "plumb/backend/world_init.hpp"
#include "plumb/physics_world.hpp"
#include "simulation.hpp"

namespace plumb::impulse {

class World final : public IPhysicsWorld, public IJoints, public IDebug, public ISettings, public IState {
 public:
  explicit World(const WorldInit& init);

  static const PlumbBackendInfo& info();
  static std::string unmet_requirement() { return Executor::unmet_requirement(); }
  static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note);
  static std::span<const PlumbSettingInfo> setting_infos() { return impulse::setting_infos(); }

  PlumbResult create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) override;
  PlumbResult destroy_shapes(std::span<const PlumbShape> ids) override;
  PlumbResult create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) override;
  PlumbResult destroy_bodies(std::span<const PlumbBody> ids) override;
  PlumbResult read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) override;
  PlumbResult write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) override;
  PlumbResult set_gravity(const PlumbVec3& gravity) override;
  PlumbResult step(double dt) override;
  PlumbResult wait(PlumbStepReport& report) override;
  std::span<const PlumbContact> contacts() override;
  std::span<const PlumbEvent> events() override { return events_; }

  /// Of the last step.
  [[nodiscard]] const StepCounters& counters() const { return simulation_.counters(); }
  /// To where kernels run, since the world was made.
  [[nodiscard]] std::uint64_t uploaded_bytes() { return simulation_.executor().uploaded_bytes(); }

  IJoints* joints() override { return this; }
  IDebug* debug() override { return this; }
  ISettings* settings() override { return this; }
  IState* state() override { return this; }

 private:
  PlumbResult create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) override;
  PlumbResult destroy_joints(std::span<const PlumbJoint> ids) override;
  PlumbResult read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) override;
  PlumbResult write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) override;
  void put_joint(std::uint32_t slot);
  void remove_joint(std::uint32_t slot);
  void break_joints();
  PlumbResult candidate_pairs(std::span<const PlumbDebugPair>& pairs) override;
  PlumbResult tree_boxes(std::span<const PlumbDebugBox>& boxes) override;
  PlumbResult separating_axes(std::span<const PlumbDebugAxis>& axes) override;
  PlumbResult get_setting(const char* name, PlumbSettingValue& value) override;
  PlumbResult set_setting(const char* name, const PlumbSettingValue& value) override;
  PlumbResult borrow(const PlumbStateRequest& request, PlumbDLManagedTensor*& tensor, PlumbFence* fence) override;
  PlumbResult row_map(std::span<const PlumbBody>& ids, std::uint64_t& generation) override;

  void make_body(const PlumbBodyDesc& desc, PlumbBody id);
  void place(std::uint32_t slot, const PlumbPose& pose);
  [[nodiscard]] PlumbPose pose(std::uint32_t slot) const;
  void read_state(PlumbField field, std::span<const PlumbBody> ids, Rows rows);
  void fetch_for_write(PlumbField field, std::span<const PlumbBody> ids);
  void write_row(PlumbField field, std::uint32_t slot, const double* row);
  void put_proxy_rows(std::uint32_t slot);
  void stop_infinite(std::uint32_t slot);
  void push(std::uint32_t slot, const Vec& force, const Vec& torque);
  void kick(std::uint32_t slot, const Vec& impulse, const Vec& angular_impulse);
  void steer_kinematics(double dt);
  void settle_kinematics();
  void clear_forces();
  void find_events();
  void tell(PlumbEventType type, const Simulation::Slots& bodies, std::vector<PlumbEvent>& events);
  void wake_for_write(PlumbField field, std::span<const PlumbBody> ids);
  void wake_for_joint(const PlumbJointDesc& desc);
  void write_awake(std::span<const PlumbBody> ids, ConstRows rows);
  const std::vector<ContactRecord>& records();

  WorldInit init_;
  Simulation simulation_;
  Settings settings_;
  PlumbVec3 gravity_;
  double last_h_ = 0, dt_ = 0;
  std::vector<BodyRecord> bodies_;   // by slot
  std::vector<JointRecord> joints_;  // by slot
  std::uint32_t breakable_joints_ = 0;
  std::uint32_t dynamic_count_ = 0;
  std::uint32_t stopped_ = 0;  // bodies whose velocity a write made infinite, since the last step
  std::vector<std::uint32_t> pushed_, steered_;
  bool records_known_ = false;
  std::vector<ContactRecord> records_;
  std::vector<PlumbContact> contacts_;
  std::vector<PlumbEvent> events_, early_events_;
  std::vector<PlumbDebugPair> debug_pairs_;
  std::vector<PlumbBody> row_ids_;    // by slot; 0 where nobody is
  std::uint64_t row_generation_ = 0;  // changes with them
  backend::TouchTracker touches_;
};

}  // namespace plumb::impulse
