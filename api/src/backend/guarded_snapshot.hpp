// The guard of plumb.snapshot/1: what moves is the backend's to save; who lives, and of what, is known here, so that a
// snapshot of the whole world is the same work for every backend: destroy who came since, make anew who is gone or has
// become another, under the old handles, and let the backend restore what moves.
#pragma once

#include <unordered_set>

#include "guarded_cooking.hpp"
#include "saved_world.hpp"
#include "snapshot_frame.hpp"

namespace plumb::backend {

class GuardedSnapshot : public GuardedCooking {
 public:
  using GuardedCooking::GuardedCooking;

  PlumbResult save(void* data, std::size_t capacity, std::size_t* size) {
    return save_kind(false, data, capacity, size);
  }
  PlumbResult save_world(void* data, std::size_t capacity, std::size_t* size) {
    static_cast<void>(require_snapshot());
    require_capability(PLUMB_CAP_SNAPSHOT, 1, 0, "snapshot of the whole world");
    return save_kind(true, data, capacity, size);
  }

  PlumbResult restore(const void* data, std::size_t size) {
    ISnapshot& extension = require_snapshot();
    require_pointer(data, size, "data");
    const std::span<const std::byte> framed(static_cast<const std::byte*>(data), size);
    UnframedSnapshot saved = unframe_snapshot(framed, format_of(extension));
    if (!saved.world.empty()) return restore_world(saved);
    if (saved.objects != hash_of_objects())
      refuse(PLUMB_E_CORRUPT,
             "other bodies or joints live in the world than when the snapshot was saved, or bodies or shapes were made "
             "others; save_world saves bodies and joints, too");
    check_saved_exceptions(saved.exceptions, bodies_);
    const PairExceptions::Pairs rejoined = PairExceptions::difference(exceptions_.list(), saved.exceptions);
    const PairExceptions::Pairs parted = PairExceptions::difference(saved.exceptions, exceptions_.list());
    // Before the rest: who sleeps and who touches stands there.
    const PlumbResult result = with_exceptions_set(rejoined, true, [&] {
      return with_exceptions_set(parted, false, [&] { return extension.restore(saved.payload); });
    });
    exceptions_.become(std::move(saved.exceptions));
    return result;
  }

 private:
  ISnapshot& require_snapshot() const {
    ISnapshot& extension = require_extension(world_->snapshot(), PLUMB_EXT_SNAPSHOT);
    require_need(init_.desc.needs, PLUMB_NEED_SNAPSHOT, true, "a snapshot");
    return extension;
  }
  [[nodiscard]] std::string_view format_of(const ISnapshot& extension) const {
    const std::string_view format = extension.format();
    return format.empty() ? facts_.info->build : format;
  }

  PlumbResult save_kind(bool whole, void* data, std::size_t capacity, std::size_t* size) {
    ISnapshot& extension = require_snapshot();
    require_pointer(size, 1, "size");
    const std::vector<std::byte> world = whole ? living().pack() : std::vector<std::byte>();
    std::span<const std::byte> payload;
    const PlumbResult result = done(extension.save(payload));
    const std::vector<std::byte> framed =
        frame_snapshot({exceptions_.list(), world, payload}, format_of(extension), hash_of_objects());
    *size = framed.size();
    if (capacity < framed.size()) return PLUMB_TRUNCATED;
    require_pointer(data, capacity, "data");
    std::memcpy(data, framed.data(), framed.size());
    return result;
  }

  /// Who lives, and what a body is made of: what a snapshot of moving things must find as it was.
  [[nodiscard]] std::uint64_t hash_of_objects() {
    StateHash hash;
    for (const PlumbBody handle : bodies_.in_order()) {
      const BodyRecord& body = bodies_[handle];
      hash.add_word(handle);
      hash.add_word(body.shape);
      if (body.shape != 0 && may_change(shapes_[body.shape].type)) hash.add_word(shapes_[body.shape].content);
      hash.add_word(std::uint64_t{body.flags} << 32 | body.locks << 8 | body.motion);
      if (body.motion == PLUMB_DYNAMIC)
        for (const double number : body.mass_row) hash.add(number);
    }
    hash.add_word(bodies_.size());
    for (const PlumbJoint handle : joints_.in_order()) hash.add_word(handle);
    return hash.value();
  }

  template <class Bodies>
  void check_saved_exceptions(const PairExceptions::Pairs& saved, const Bodies& bodies) const {
    const bool known = std::all_of(saved.begin(), saved.end(), [&](const PlumbBodyPair& pair) {
      return bodies.alive(pair.body_a) && bodies.alive(pair.body_b) && slot_of(pair.body_a) < slot_of(pair.body_b);
    });
    if (!known || !std::is_sorted(saved.begin(), saved.end(), PairExceptions::before) ||
        (!saved.empty() && world_->exceptions() == nullptr))
      refuse(PLUMB_E_CORRUPT, "the snapshot has pair exceptions that cannot be of this world");
  }

  // --- who lives -----------------------------------------------------------------------------------------------------

  [[nodiscard]] SavedWorld living() {
    SavedWorld world;
    world.needs = init_.desc.needs;
    world.steps = steps_;
    world.body_slots = bodies_.slots();
    world.joint_slots = joints_.slots();
    Kinds<BodyKind> body_kinds;
    std::vector<BodyKind> kinds = kinds_of_bodies();
    for (std::size_t i = 0; i < kinds.size(); ++i)
      world.bodies.push_back({bodies_[world.body_slots.order[i]].user_data, body_kinds.number(kinds[i]), 0});
    world.body_kinds = body_kinds.take();
    Kinds<JointKind> joint_kinds;
    for (const PlumbJoint handle : world.joint_slots.order) {
      const JointRecord& joint = joints_[handle];
      world.joints.push_back({joint.body_a, joint.body_b, joint.user_data, joint_kinds.number(*joint.kind), 0});
    }
    world.joint_kinds = joint_kinds.take();
    std::vector<PlumbShape> shapes;
    for (const BodyKind& kind : world.body_kinds)
      if (kind.shape != 0) shapes.push_back(kind.shape);
    std::sort(shapes.begin(), shapes.end());
    shapes.erase(std::unique(shapes.begin(), shapes.end()), shapes.end());
    for (const PlumbShape shape : shapes) world.shapes.push_back({shape, shapes_[shape].content});
    return world;
  }

  [[nodiscard]] std::vector<BodyKind> kinds_of_bodies() {
    const auto handles = bodies_.in_order();
    std::vector<BodyKind> kinds(handles.size());
    std::vector<PlumbBody> statics;
    std::vector<std::size_t> of_statics;
    for (std::size_t i = 0; i < handles.size(); ++i) {
      const BodyRecord& body = bodies_[handles[i]];
      kinds[i] = blank_kind();
      kinds[i].shape = body.shape;
      kinds[i].motion = body.motion;
      kinds[i].flags = body.flags;
      kinds[i].locks = body.locks;
      std::copy(std::begin(body.mass_row), std::end(body.mass_row), kinds[i].mass_row);
      if (body.motion != PLUMB_STATIC) continue;
      statics.push_back(handles[i]);
      of_statics.push_back(i);
    }
    read_into(PLUMB_FIELD_POSE, statics, [&](std::size_t i) { return kinds[of_statics[i]].pose; });
    read_into(PLUMB_FIELD_MATERIAL, handles, [&](std::size_t i) { return kinds[i].material; });
    read_into(PLUMB_FIELD_SURFACE_VELOCITY, handles, [&](std::size_t i) { return kinds[i].surface_velocity; });
    read_into(PLUMB_FIELD_GRAVITY_SCALE, handles, [&](std::size_t i) { return kinds[i].gravity_scale; });
    read_into(PLUMB_FIELD_DAMPING, handles, [&](std::size_t i) { return kinds[i].damping; });
    read_into(PLUMB_FIELD_FILTER, handles, [&](std::size_t i) { return kinds[i].filter; });
    read_into(PLUMB_FIELD_ROLLING_FRICTION, handles, [&](std::size_t i) { return kinds[i].rolling_friction; });
    return kinds;
  }

  /// Of a body of which nothing can be read.
  [[nodiscard]] static BodyKind blank_kind() {
    BodyKind kind{};
    kind.gravity_scale[0] = 1;
    kind.filter[0] = 1;
    kind.filter[1] = 0xffffffffu;
    return kind;
  }

  /// What a backend cannot read stays as it is.
  template <class At>
  void read_into(PlumbField field, std::span<const PlumbBody> handles, const At& at) {
    const char* note = "";
    if (handles.empty() || degree(PLUMB_CAP_FIELD_READ, field, 0, note) == PLUMB_NONE) return;
    const std::uint32_t columns = columns_of(field);
    std::vector<double> rows(handles.size() * columns);
    done(world_->read(
        field, handles,
        Rows(reinterpret_cast<std::byte*>(rows.data()), handles.size(), columns * sizeof(double), PLUMB_F64)));
    for (std::size_t i = 0; i < handles.size(); ++i) std::copy_n(&rows[i * columns], columns, at(i));
  }

  // --- their return --------------------------------------------------------------------------------------------------

  /// What has to be done to have the saved bodies and joints.
  struct Changes {
    std::vector<PlumbJoint> joints_to_destroy, joints_to_create, joints_to_disable;
    std::vector<PlumbBody> bodies_to_destroy, bodies_to_create;
    std::vector<PlumbBodyDesc> bodies;
    std::vector<PlumbJointDesc> joints;
    PairExceptions::Pairs rejoined, parted;
  };

  PlumbResult restore_world(UnframedSnapshot& saved) {
    const SavedWorld then = SavedWorld::unpack(saved.world);
    check_shapes(then);
    SlotTable<BodyRecord> bodies(then.body_slots, records_of_bodies(then));
    SlotTable<JointRecord> joints(then.joint_slots, records_of_joints(then));
    for (const PlumbJoint handle : joints.in_order()) {
      if (joints[handle].body_a != 0) ++bodies[joints[handle].body_a].joints;
      ++bodies[joints[handle].body_b].joints;
    }
    check_saved_exceptions(saved.exceptions, bodies);
    const Changes changes = changes_to(then, saved.exceptions);
    PlumbResult result = PLUMB_OK;
    try {
      result = change(changes, saved.payload);
    } catch (const std::exception& error) {
      refuse(PLUMB_E_WORLD_LOST, std::string("the world was half restored when this happened: ") + error.what());
    }
    for (const auto& [table, sign] : {std::pair{&bodies_, -1}, std::pair{&bodies, 1}})
      for (const PlumbBody handle : table->in_order())
        if (const PlumbShape shape = (*table)[handle].shape; shape != 0)
          shapes_[shape].uses += static_cast<std::uint32_t>(sign);
    bodies_ = std::move(bodies);
    joints_ = std::move(joints);
    breakable_joints_ = 0;
    for (const PlumbJoint handle : joints_.in_order()) breakable_joints_ += joints_[handle].breakable ? 1 : 0;
    exceptions_.become(std::move(saved.exceptions));
    steps_ = then.steps;
    ++row_generation_;
    return result;
  }

  void check_shapes(const SavedWorld& then) const {
    if (then.needs != init_.desc.needs) refuse(PLUMB_E_CORRUPT, "the snapshot is of a world that declared other needs");
    for (const SavedShape& saved : then.shapes)
      if (!shapes_.alive(saved.shape) || shapes_[saved.shape].content != saved.content)
        refuse(PLUMB_E_CORRUPT, "the snapshot has bodies of shape " + std::to_string(saved.shape) +
                                    ", which this world has not, or not with that geometry; create the shapes of both "
                                    "worlds in the same order, and keep them");
    for (const BodyKind& kind : then.body_kinds)
      if (kind.motion >= PLUMB_MOTION_COUNT || (kind.shape != 0 && !shapes_.alive(kind.shape)))
        refuse(PLUMB_E_CORRUPT, "the snapshot has bodies that cannot be of this world");
    if (!then.joints.empty() && world_->joints() == nullptr)
      refuse(PLUMB_E_CORRUPT, "the snapshot has joints, which this world cannot have");
  }

  [[nodiscard]] static std::vector<BodyRecord> records_of_bodies(const SavedWorld& then) {
    std::vector<BodyRecord> records(then.bodies.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
      const BodyKind& kind = then.kind_of_body(i);
      records[i].shape = kind.shape;
      records[i].user_data = then.bodies[i].user_data;
      records[i].motion = kind.motion;
      records[i].flags = kind.flags;
      records[i].locks = kind.locks;
      std::copy(std::begin(kind.mass_row), std::end(kind.mass_row), records[i].mass_row);
    }
    return records;
  }
  [[nodiscard]] static std::vector<JointRecord> records_of_joints(const SavedWorld& then) {
    std::vector<JointRecord> records(then.joints.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
      const JointKind& kind = then.kind_of_joint(i);
      const SavedJoint& joint = then.joints[i];
      records[i] = {joint.body_a,   joint.body_b, kind.desc.type, breaks(kind.desc), std::make_unique<JointKind>(kind),
                    joint.user_data};
    }
    return records;
  }

  /// What lives now beside what lived then. come: places in the order of then.
  struct Difference {
    std::unordered_set<std::uint64_t> stay;
    std::vector<std::uint64_t> gone;
    std::vector<std::size_t> come;
  };
  /// is_same(its place now, its place then) of a handle that is in both.
  template <class IsSame>
  [[nodiscard]] static Difference difference(const Slots& now, const Slots& then, const IsSame& is_same) {
    std::unordered_map<std::uint64_t, std::size_t> was;
    for (std::size_t i = 0; i < then.order.size(); ++i) was.emplace(then.order[i], i);
    Difference found;
    for (std::size_t i = 0; i < now.order.size(); ++i) {
      const auto known = was.find(now.order[i]);
      if (known != was.end() && is_same(i, known->second))
        found.stay.insert(now.order[i]);
      else
        found.gone.push_back(now.order[i]);
    }
    for (std::size_t i = 0; i < then.order.size(); ++i)
      if (!found.stay.contains(then.order[i])) found.come.push_back(i);
    return found;
  }

  [[nodiscard]] Changes changes_to(const SavedWorld& then, const PairExceptions::Pairs& exceptions) {
    const SavedWorld now = living();
    const Difference bodies = difference(now.body_slots, then.body_slots, [&](std::size_t here, std::size_t there) {
      return Kinds<BodyKind>::same(now.kind_of_body(here), then.kind_of_body(there));
    });
    const Difference joints = difference(now.joint_slots, then.joint_slots, [&](std::size_t here, std::size_t there) {
      const SavedJoint &one = now.joints[here], &other = then.joints[there];
      const auto stays = [&](PlumbBody body) { return body == 0 || bodies.stay.contains(body); };
      return one.body_a == other.body_a && one.body_b == other.body_b && stays(one.body_a) && stays(one.body_b) &&
             Kinds<JointKind>::same(now.kind_of_joint(here), then.kind_of_joint(there));
    });
    Changes changes;
    changes.bodies_to_destroy = bodies.gone;
    changes.joints_to_destroy = joints.gone;
    for (const std::size_t i : bodies.come) {
      changes.bodies_to_create.push_back(then.body_slots.order[i]);
      changes.bodies.push_back(described(then.kind_of_body(i), then.bodies[i].user_data));
    }
    for (const std::size_t i : joints.come) {
      const JointKind& kind = then.kind_of_joint(i);
      PlumbJointDesc desc = kind.desc;
      desc.body_a = then.joints[i].body_a;
      desc.body_b = then.joints[i].body_b;
      desc.user_data = then.joints[i].user_data;
      changes.joints_to_create.push_back(then.joint_slots.order[i]);
      changes.joints.push_back(desc);
      if (kind.enabled == 0) changes.joints_to_disable.push_back(then.joint_slots.order[i]);
    }
    // Slots name the bodies of a pair: those of a body that goes are taken back before.
    const PairExceptions::Pairs going = exceptions_.of(changes.bodies_to_destroy);
    const PairExceptions::Pairs staying = PairExceptions::difference(exceptions_.list(), going);
    const PairExceptions::Pairs ended = PairExceptions::difference(staying, exceptions);
    std::merge(going.begin(), going.end(), ended.begin(), ended.end(), std::back_inserter(changes.rejoined),
               PairExceptions::before);
    changes.parted = PairExceptions::difference(exceptions, staying);
    return changes;
  }

  /// A body whose place and velocities are about to be restored.
  [[nodiscard]] static PlumbBodyDesc described(const BodyKind& kind, std::uint64_t user_data) {
    PlumbBodyDesc desc = body_desc(kind.motion);
    desc.shape = kind.shape;
    desc.flags = kind.flags;
    desc.locks = kind.locks;
    set_mass(kind.mass_row, desc);
    if (kind.motion == PLUMB_STATIC)
      desc.pose = {{kind.pose[0], kind.pose[1], kind.pose[2]},
                   {kind.pose[3], kind.pose[4], kind.pose[5], kind.pose[6]}};
    desc.material = {kind.material[0],
                     kind.material[1],
                     {kind.surface_velocity[0], kind.surface_velocity[1], kind.surface_velocity[2]}};
    desc.gravity_scale = kind.gravity_scale[0];
    desc.linear_damping = kind.damping[0];
    desc.angular_damping = kind.damping[1];
    desc.filter = {static_cast<std::uint32_t>(kind.filter[0]), static_cast<std::uint32_t>(kind.filter[1]),
                   static_cast<std::int32_t>(kind.filter[2]), 0};
    desc.rolling_friction = kind.rolling_friction[0];
    desc.spinning_friction = kind.rolling_friction[1];
    desc.user_data = user_data;
    return desc;
  }

  PlumbResult change(const Changes& changes, std::span<const std::byte> payload) {
    IJoints* joints = world_->joints();
    if (!changes.joints_to_destroy.empty()) done(joints->destroy_joints(changes.joints_to_destroy));
    if (!changes.rejoined.empty()) done(world_->exceptions()->set_exceptions(changes.rejoined, true));
    if (!changes.bodies_to_destroy.empty()) done(world_->destroy_bodies(changes.bodies_to_destroy));
    if (!changes.bodies_to_create.empty()) {
      std::vector<PlumbBody> handles = changes.bodies_to_create;
      done(world_->create_bodies(changes.bodies, handles));
    }
    if (!changes.joints_to_create.empty()) {
      std::vector<PlumbJoint> handles = changes.joints_to_create;
      done(joints->create_joints(changes.joints, handles));
    }
    if (!changes.joints_to_disable.empty()) {
      std::vector<PlumbJointChange> disabled(changes.joints_to_disable.size());
      for (std::size_t i = 0; i < disabled.size(); ++i) {
        disabled[i].joint = changes.joints_to_disable[i];
        disabled[i].what = PLUMB_MODIFY_ENABLED;
      }
      done(world_->modify()->modify_joints(disabled));
    }
    if (!changes.parted.empty()) done(world_->exceptions()->set_exceptions(changes.parted, false));
    return done(world_->snapshot()->restore(payload));
  }
};

}  // namespace plumb::backend
