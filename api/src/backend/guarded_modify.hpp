// The guard of plumb.modify/1: a change is held to what a descriptor with the same members would be held to.
#pragma once

#include "guarded_extensions.hpp"

namespace plumb::backend {

class GuardedModify : public GuardedExtensions {
 public:
  using GuardedExtensions::GuardedExtensions;

  PlumbResult modify_bodies(const PlumbBodyChange* changes, std::size_t stride, std::uint32_t count) {
    IModify& extension = require_extension(world_->modify(), PLUMB_EXT_MODIFY);
    std::vector<PlumbBodyChange> adopted = adopt_rows(changes, stride, count, "changes");
    require_each_once<BodyRecord, PlumbBodyChange>(bodies_, adopted, &PlumbBodyChange::body, "body");
    std::vector<BodyRecord> records(count);
    for (std::uint32_t i = 0; i < count; ++i) records[i] = examine_body_change({"changes", i}, adopted[i]);
    const PlumbResult result = done(extension.modify_bodies(adopted));
    for (std::uint32_t i = 0; i < count; ++i) {
      BodyRecord& record = bodies_[adopted[i].body];
      if (records[i].shape != 0) ++shapes_[records[i].shape].uses;
      if (record.shape != 0) --shapes_[record.shape].uses;
      record = records[i];
    }
    return result;
  }

  PlumbResult modify_joints(const PlumbJointChange* changes, std::size_t stride, std::uint32_t count) {
    IModify& extension = require_extension(world_->modify(), PLUMB_EXT_MODIFY);
    const std::vector<PlumbJointChange> adopted = adopt_rows(changes, stride, count, "changes");
    require_each_once<JointRecord, PlumbJointChange>(joints_, adopted, &PlumbJointChange::joint, "joint");
    for (std::uint32_t i = 0; i < count; ++i) examine_joint_change({"changes", i}, adopted[i]);
    const PlumbResult result = done(extension.modify_joints(adopted));
    for (const PlumbJointChange& change : adopted) {
      JointRecord& record = joints_[change.joint];
      if ((change.what & PLUMB_MODIFY_STRENGTH) != 0)
        set_breakable(record, change.break_force > 0 || change.break_torque > 0);
      if (record.kind == nullptr) continue;
      apply(change, record.kind->desc);
      if ((change.what & PLUMB_MODIFY_ENABLED) != 0) record.kind->enabled = change.enabled;
    }
    return result;
  }

  PlumbResult modify_shapes(const PlumbShape* shapes, const PlumbShapeDesc* descs, std::size_t stride,
                            std::uint32_t count) {
    IModify& extension = require_extension(world_->modify(), PLUMB_EXT_MODIFY);
    const auto handles = distinct_live(shapes_, shapes, count, "shapes");
    const std::vector<PlumbShapeDesc> adopted = adopt_descs(descs, stride, count, "descs", kShapeDesc10);
    std::vector<ShapeRecord> records(count);
    for (std::uint32_t i = 0; i < count; ++i) records[i] = examine_shape_change({"descs", i}, handles[i], adopted[i]);
    const PlumbResult result = done(extension.modify_shapes(handles, adopted));
    for (std::uint32_t i = 0; i < count; ++i) {
      records[i].uses = shapes_[handles[i]].uses;
      shapes_[handles[i]] = std::move(records[i]);
    }
    return result;
  }

 private:
  ShapeRecord examine_shape_change(const Where& where, PlumbShape shape, const PlumbShapeDesc& desc) const {
    const PlumbShapeType type = shapes_[shape].type;
    if (!may_change(type))
      refuse(PLUMB_E_UNSUPPORTED,
             std::string("a ") + shape_name(type) +
                 " does not change; only meshes and height fields do: give its bodies another shape");
    require_capability(PLUMB_CAP_MODIFY, 2, type, std::string("way to change a ") + shape_name(type));
    if (desc.type != type)
      refuse(PLUMB_E_INVALID_ARGUMENT, where.member("type") + " is " + shape_name(desc.type) + ", but the shape is a " +
                                           shape_name(type) + "; give its bodies another shape instead");
    return examine_shape(where, desc);
  }

  template <class Record, class Change>
  static void require_each_once(const SlotTable<Record>& table, std::span<const Change> changes,
                                std::uint64_t Change::*handle, const char* name) {
    std::vector<std::uint64_t> handles(changes.size());
    std::transform(changes.begin(), changes.end(), handles.begin(),
                   [&](const Change& change) { return change.*handle; });
    for (std::uint32_t i = 0; i < handles.size(); ++i)
      if (!table.alive(handles[i]))
        refuse(PLUMB_E_STALE_HANDLE, Where{"changes", i}.member(name) + " is handle " + std::to_string(handles[i]) +
                                         ", which names nothing that lives in this world");
    (void)distinct_live(table, handles.data(), static_cast<std::uint32_t>(handles.size()), "changes");
  }

  void require_known(const Where& where, std::uint32_t what, std::uint32_t is_joint) const {
    const std::uint32_t count = is_joint != 0 ? PLUMB_MODIFY_JOINT_COUNT : PLUMB_MODIFY_BODY_COUNT;
    if (what == 0 || what >> count != 0)
      refuse_value(where, "what", what,
                   is_joint != 0 ? "PLUMB_MODIFY_ bits of joints" : "PLUMB_MODIFY_ bits of bodies");
    for (std::uint32_t bit = 0; bit < count; ++bit)
      if ((what >> bit & 1) != 0)
        require_capability(PLUMB_CAP_MODIFY, is_joint, bit,
                           std::string("way to change the ") + modified_name(is_joint, bit) + " of a " +
                               (is_joint != 0 ? "joint" : "body"));
  }

  /// Checks a body's change and fills what it leaves as it is.
  BodyRecord examine_body_change(const Where& where, PlumbBodyChange& change) const {
    require_known(where, change.what, 0);
    const BodyRecord& record = bodies_[change.body];
    if ((change.what & PLUMB_MODIFY_FLAGS) != 0 && (change.flags & PLUMB_BODY_ASLEEP) != 0)
      refuse(PLUMB_E_INVALID_ARGUMENT,
             where.member("flags") + " has PLUMB_BODY_ASLEEP; write PLUMB_FIELD_AWAKE instead");
    PlumbBodyDesc desc = described(record, change);
    if ((change.what & PLUMB_MODIFY_MASS) == 0)
      require_known_mass(where, desc);
    else if (desc.motion != PLUMB_DYNAMIC)
      refuse(PLUMB_E_INVALID_ARGUMENT, where.member("what") + " has PLUMB_MODIFY_MASS, but the body is " +
                                           motion_name(desc.motion) + "; only dynamic bodies have a mass");
    BodyRecord after = examine_body(where, desc);
    after.user_data = record.user_data;
    after.joints = record.joints;
    if (desc.motion != PLUMB_DYNAMIC) std::copy(std::begin(record.mass_row), std::end(record.mass_row), after.mass_row);
    fill(change, desc);
    return after;
  }

  /// What the body would be made of, with the change in it. What cannot be changed here has nothing to be refused for.
  static PlumbBodyDesc described(const BodyRecord& record, const PlumbBodyChange& change) {
    const auto changes = [&](std::uint32_t bit) { return (change.what & bit) != 0; };
    PlumbBodyDesc desc = body_desc(changes(PLUMB_MODIFY_MOTION) ? change.motion : record.motion);
    desc.material.friction = 0;
    desc.shape = changes(PLUMB_MODIFY_SHAPE) ? change.shape : record.shape;
    desc.flags = changes(PLUMB_MODIFY_FLAGS) ? change.flags : record.flags;
    desc.locks = changes(PLUMB_MODIFY_LOCKS) ? change.locks : record.locks;
    set_mass(record.mass_row, desc);
    if (!changes(PLUMB_MODIFY_MASS)) return desc;
    desc.mass_mode = change.mass_mode;
    desc.density = change.density;
    desc.mass = change.mass;
    desc.centre_of_mass = change.centre_of_mass;
    desc.inertia = change.inertia;
    desc.inertia_orientation = change.inertia_orientation;
    return desc;
  }

  static void require_known_mass(const Where& where, const PlumbBodyDesc& desc) {
    if (desc.motion != PLUMB_DYNAMIC) return;
    if (desc.mass == 0)
      refuse(PLUMB_E_INVALID_ARGUMENT,
             where.member("motion") + " is PLUMB_DYNAMIC, and the body never had a mass; add PLUMB_MODIFY_MASS");
    if (is_zero(desc.inertia) && (desc.flags & PLUMB_BODY_NO_ROTATION) == 0)
      refuse(PLUMB_E_INVALID_ARGUMENT,
             where.member("flags") +
                 " let the body turn, and it has no inertia; add PLUMB_MODIFY_MASS, or keep PLUMB_BODY_NO_ROTATION");
  }

  static void fill(PlumbBodyChange& change, const PlumbBodyDesc& desc) {
    change.motion = desc.motion;
    change.flags = desc.flags;
    change.locks = desc.locks;
    change.shape = desc.shape;
    change.mass_mode = PLUMB_MASS_EXPLICIT;
    change.mass = desc.mass;
    change.centre_of_mass = desc.centre_of_mass;
    change.inertia = desc.inertia;
    change.inertia_orientation = desc.inertia_orientation;
  }

  void examine_joint_change(const Where& where, const PlumbJointChange& change) const {
    require_known(where, change.what, 1);
    if ((change.what & PLUMB_MODIFY_ENABLED) != 0 && change.enabled > 1)
      refuse_value(where, "enabled", change.enabled, "0 or 1");
    const JointRecord& record = joints_[change.joint];
    PlumbJointDesc desc = joint_desc(record.type);
    apply(change, desc);
    check_joint(where, desc);
    require_joint_features(where, desc);
  }

  void set_breakable(JointRecord& record, bool breakable) {
    if (record.breakable == breakable) return;
    record.breakable = breakable;
    breakable ? ++breakable_joints_ : --breakable_joints_;
  }
};

}  // namespace plumb::backend
