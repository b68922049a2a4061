// The guard of the extension tables, on top of the core's.
#pragma once

#include "guarded_world.hpp"
#include "plumb/nearest.hpp"
#include "snapshot_frame.hpp"
#include "state_copy.hpp"

namespace plumb::backend {

class GuardedExtensions : public GuardedWorld {
 public:
  using GuardedWorld::GuardedWorld;

  // --- joints --------------------------------------------------------------------------------------------------------

  PlumbResult create_joints(const PlumbJointDesc* descs, std::size_t stride, std::uint32_t count, PlumbJoint* ids) {
    IJoints& extension = require_extension(world_->joints(), PLUMB_EXT_JOINTS);
    require_need(init_.desc.needs, PLUMB_NEED_JOINTS, count != 0, "creating joints");
    std::vector<PlumbJointDesc> adopted = adopt_descs(descs, stride, count, "joints");
    require_pointer(ids, count, "ids");
    std::vector<JointRecord> records(count);
    for (std::uint32_t i = 0; i < count; ++i) records[i] = examine_joint({"joints", i}, adopted[i]);
    return create(joints_, std::move(records), {ids, count}, [&](std::span<const std::uint64_t> handles) {
      std::vector<PlumbJoint> given(handles.begin(), handles.end());
      const PlumbResult result = done(extension.create_joints(adopted, given));
      for (const PlumbJoint handle : handles) {
        const JointRecord& record = joints_[handle];
        if (record.body_a != 0) ++bodies_[record.body_a].joints;
        ++bodies_[record.body_b].joints;
        if (record.breakable) ++breakable_joints_;
      }
      return result;
    });
  }

  PlumbResult destroy_joints(const PlumbJoint* ids, std::uint32_t count) {
    IJoints& extension = require_extension(world_->joints(), PLUMB_EXT_JOINTS);
    const auto handles = distinct_live(joints_, ids, count, "joints");
    const PlumbResult result = done(extension.destroy_joints(handles));
    release_joints(handles);
    return result;
  }

  PlumbResult read_joints(PlumbJointField field, PlumbDataType type, const PlumbJoint* ids, std::uint32_t count,
                          void* rows, std::size_t stride) {
    IJoints& extension = require_extension(world_->joints(), PLUMB_EXT_JOINTS);
    const auto spelled_out = spell_out(joints_, ids, count, "ids");
    check_joint_field(field, type, count, rows, stride);
    require_need(init_.desc.needs, PLUMB_NEED_JOINT_REACTIONS, field == PLUMB_JOINT_REACTION,
                 "reading joint reactions");
    return extension.read_joints(field, spelled_out, Rows(static_cast<std::byte*>(rows), count, stride, type));
  }

  PlumbResult write_joints(PlumbJointField field, PlumbDataType type, const PlumbJoint* ids, std::uint32_t count,
                           const void* rows, std::size_t stride) {
    IJoints& extension = require_extension(world_->joints(), PLUMB_EXT_JOINTS);
    const auto spelled_out = spell_out(joints_, ids, count, "ids");
    check_joint_field(field, type, count, rows, stride);
    if (field != PLUMB_JOINT_MOTOR)
      refuse(PLUMB_E_INVALID_ARGUMENT, "only PLUMB_JOINT_MOTOR rows of joints can be written");
    const ConstRows in(static_cast<const std::byte*>(rows), count, stride, type);
    for (std::uint32_t i = 0; i < count; ++i) {
      double row[12];
      in.get(i, row, 12);
      for (std::size_t axis = 0; axis < 6; ++axis) {
        require_finite({"rows", i}, "target velocity", row[2 * axis]);
        require_not_negative({"rows", i}, "max force", row[2 * axis + 1]);
      }
    }
    return extension.write_joints(field, spelled_out, in);
  }

  // --- exceptions ----------------------------------------------------------------------------------------------------

  PlumbResult set_exceptions(const PlumbBodyPair* pairs, std::size_t stride, std::uint32_t count, std::uint32_t touch) {
    static_cast<void>(require_extension(world_->exceptions(), PLUMB_EXT_EXCEPTIONS));
    if (touch > 1)
      refuse(PLUMB_E_INVALID_ARGUMENT, "touch is " + std::to_string(touch) +
                                           "; it must be 0, for pairs that do not touch, or 1, to take that back");
    std::vector<PlumbBodyPair> adopted = adopt_rows(pairs, stride, count, "pairs");
    for (std::uint32_t i = 0; i < count; ++i) {
      const PlumbBody both[2] = {adopted[i].body_a, adopted[i].body_b};
      for (const PlumbBody body : both)
        if (!bodies_.alive(body))
          refuse(PLUMB_E_STALE_HANDLE, Where{"pairs", i}.member(body == both[0] ? "body_a" : "body_b") + " is handle " +
                                           std::to_string(body) + ", which names nothing that lives in this world");
      if (both[0] == both[1])
        refuse(PLUMB_E_INVALID_ARGUMENT, Where{"pairs", i}.member("body_b") + " is body_a; a pair is of two bodies");
    }
    const PairExceptions::Pairs changed = exceptions_.changes(std::move(adopted), touch != 0);
    PairExceptions::Pairs after = exceptions_.after(changed, touch != 0);
    const PlumbResult result = with_exceptions_set(changed, touch != 0, [&] { return wake_sleepers_of(changed); });
    exceptions_.become(std::move(after));
    return result;
  }

  PlumbResult list_exceptions(PlumbBodyPair* out, std::uint32_t capacity, std::uint32_t* count) {
    static_cast<void>(require_extension(world_->exceptions(), PLUMB_EXT_EXCEPTIONS));
    return hand_out(std::span<const PlumbBodyPair>(exceptions_.list()), out, sizeof(PlumbBodyPair), capacity, count);
  }

  // --- queries -------------------------------------------------------------------------------------------------------

  PlumbResult rays(PlumbHitMode mode, const PlumbRay* rays, std::size_t stride, std::uint32_t count, PlumbHit* hits,
                   std::uint32_t capacity, std::uint32_t* hit_count) {
    IQueries& extension = require_queries();
    check_hit_mode(mode);
    const std::vector<PlumbRay> adopted = adopt_rows(rays, stride, count, "rays");
    require_capability(PLUMB_CAP_QUERY, PLUMB_QUERY_RAY, 0, "ray casts");
    for (std::uint32_t i = 0; i < count; ++i) {
      require_finite({"rays", i}, "origin", adopted[i].origin);
      check_translation({"rays", i}, adopted[i].translation);
    }
    return hand_out_hits(extension.cast_rays(mode, adopted), hits, capacity, hit_count);
  }

  PlumbResult casts(PlumbHitMode mode, const PlumbCast* casts, std::size_t stride, std::uint32_t count, PlumbHit* hits,
                    std::uint32_t capacity, std::uint32_t* hit_count) {
    IQueries& extension = require_queries();
    check_hit_mode(mode);
    const std::vector<PlumbCast> adopted = adopt_rows(casts, stride, count, "casts");
    for (std::uint32_t i = 0; i < count; ++i) {
      check_posed_shape({"casts", i}, adopted[i].shape, adopted[i].pose, PLUMB_QUERY_CAST, "casts of a ");
      check_translation({"casts", i}, adopted[i].translation);
    }
    return hand_out_hits(extension.cast_shapes(mode, adopted), hits, capacity, hit_count);
  }

  PlumbResult overlaps(const PlumbOverlap* overlaps, std::size_t stride, std::uint32_t count, PlumbHit* hits,
                       std::uint32_t capacity, std::uint32_t* hit_count) {
    IQueries& extension = require_queries();
    const std::vector<PlumbOverlap> adopted = adopt_rows(overlaps, stride, count, "overlaps");
    for (std::uint32_t i = 0; i < count; ++i)
      check_posed_shape({"overlaps", i}, adopted[i].shape, adopted[i].pose, PLUMB_QUERY_OVERLAP, "overlaps of a ");
    return hand_out_hits(extension.overlap_shapes(adopted), hits, capacity, hit_count);
  }

  PlumbResult collide_pairs(const PlumbPosedPair* pairs, std::size_t stride, std::uint32_t count,
                            PlumbPairResult* results, PlumbPairPoint* points, std::uint32_t capacity,
                            std::uint32_t* point_count) {
    ICollide& extension = require_extension(world_->collide(), PLUMB_EXT_COLLIDE);
    const std::vector<PlumbPosedPair> adopted = adopt_rows(pairs, stride, count, "pairs");
    require_pointer(results, count, "results");
    for (std::uint32_t i = 0; i < count; ++i) {
      const PlumbPosedPair& pair = adopted[i];
      const PlumbShape both[2] = {pair.shape_a, pair.shape_b};
      require_live(shapes_, both, "pairs");
      require_pose({"pairs", i}, "pose_a", pair.pose_a);
      require_pose({"pairs", i}, "pose_b", pair.pose_b);
      const PlumbShapeType a = shapes_[pair.shape_a].type, b = shapes_[pair.shape_b].type;
      require_capability(PLUMB_CAP_PAIR, a, b, std::string("pair of ") + shape_name(a) + " and " + shape_name(b));
    }
    std::span<const PlumbPairPoint> found;
    const PlumbResult result = extension.collide_pairs(adopted, {results, count}, found);
    return std::max(result, hand_out(found, points, sizeof(PlumbPairPoint), capacity, point_count));
  }

  // --- debug ---------------------------------------------------------------------------------------------------------

  PlumbResult debug_pairs(PlumbDebugPair* out, std::uint32_t capacity, std::uint32_t* count) {
    return hand_out_debug(&IDebug::candidate_pairs, out, capacity, count);
  }
  PlumbResult debug_boxes(PlumbDebugBox* out, std::uint32_t capacity, std::uint32_t* count) {
    return hand_out_debug(&IDebug::tree_boxes, out, capacity, count);
  }
  PlumbResult debug_axes(PlumbDebugAxis* out, std::uint32_t capacity, std::uint32_t* count) {
    return hand_out_debug(&IDebug::separating_axes, out, capacity, count);
  }
  PlumbResult debug_bodies(PlumbDebugBody* out, std::uint32_t capacity, std::uint32_t* count) {
    return hand_out_debug(&IDebug::body_states, out, capacity, count);
  }
  PlumbResult debug_constraints(PlumbDebugConstraint* out, std::uint32_t capacity, std::uint32_t* count) {
    return hand_out_debug(&IDebug::solved_constraints, out, capacity, count);
  }

  // --- settings ------------------------------------------------------------------------------------------------------

  PlumbResult get_setting(const char* name, PlumbSettingValue* value) {
    ISettings& extension = require_extension(world_->settings(), PLUMB_EXT_SETTINGS);
    require_pointer(value, 1, "value");
    (void)find_setting(facts_, name);
    return extension.get_setting(name, *value);
  }

  PlumbResult set_setting(const char* name, const PlumbSettingValue* value) {
    ISettings& extension = require_extension(world_->settings(), PLUMB_EXT_SETTINGS);
    require_pointer(value, 1, "value");
    const PlumbSettingInfo& info = find_setting(facts_, name);
    if ((info.flags & PLUMB_SETTING_CREATION_ONLY) != 0)
      refuse(PLUMB_E_INVALID_ARGUMENT,
             std::string("setting ") + name + " can only be given in PlumbWorldDesc.settings");
    return extension.set_setting(name, checked_setting(info, *value));
  }

  /// The setting of a name; refuses unknown ones.
  static const PlumbSettingInfo& find_setting(const BackendFacts& facts, const char* name) {
    require_pointer(name, 1, "name");
    for (const PlumbSettingInfo& info : facts.settings)
      if (std::strcmp(info.name, name) == 0) return info;
    std::vector<std::string> known;
    for (const PlumbSettingInfo& info : facts.settings) known.emplace_back(info.name);
    refuse(PLUMB_E_INVALID_ARGUMENT,
           std::string(facts.info->name) + " has no setting \"" + name + "\"" + suggestion(name, known));
  }

  /// The value, of the setting's type and range; a choice points to the backend's own word.
  static PlumbSettingValue checked_setting(const PlumbSettingInfo& info, const PlumbSettingValue& value) {
    const std::string what = std::string("setting ") + info.name;
    if (value.type != info.type) refuse(PLUMB_E_INVALID_ARGUMENT, what + " is given as a value of another type");
    if (info.type == PLUMB_SETTING_CHOICE) {
      require_pointer(value.choice, 1, "choice");
      std::string known;
      for (std::uint32_t i = 0; i < info.choice_count; ++i) {
        if (std::strcmp(info.choices[i], value.choice) == 0) return {info.type, 0, 0, info.choices[i]};
        known += std::string(i == 0 ? "" : ", ") + info.choices[i];
      }
      refuse(PLUMB_E_INVALID_ARGUMENT, what + " is \"" + value.choice + "\"; it must be one of " + known);
    }
    const double low = info.type == PLUMB_SETTING_BOOL ? 0 : info.minimum;
    const double high = info.type == PLUMB_SETTING_BOOL ? 1 : info.maximum;
    if (!(value.number >= low && value.number <= high))
      refuse(PLUMB_E_INVALID_ARGUMENT, what + " is " + number_text(value.number) + "; it must be from " +
                                           number_text(low) + " to " + number_text(high));
    if (info.type != PLUMB_SETTING_FLOAT && value.number != std::floor(value.number))
      refuse(PLUMB_E_INVALID_ARGUMENT, what + " is " + number_text(value.number) + "; it must be a whole number");
    return {info.type, 0, value.number, nullptr};
  }

  // --- snapshot and state --------------------------------------------------------------------------------------------

  PlumbResult save(void* data, std::size_t capacity, std::size_t* size) {
    ISnapshot& extension = require_snapshot();
    require_pointer(size, 1, "size");
    std::span<const std::byte> payload;
    const PlumbResult result = extension.save(payload);
    const std::vector<std::byte> framed =
        frame_snapshot(payload, format_of(extension), bodies_.in_order(), joints_.in_order(), exceptions_.list());
    *size = framed.size();
    if (capacity < framed.size()) return PLUMB_TRUNCATED;
    require_pointer(data, capacity, "data");
    std::memcpy(data, framed.data(), framed.size());
    return result;
  }

  [[nodiscard]] std::string_view format_of(const ISnapshot& extension) const {
    const std::string_view format = extension.format();
    return format.empty() ? facts_.info->build : format;
  }

  PlumbResult restore(const void* data, std::size_t size) {
    ISnapshot& extension = require_snapshot();
    require_pointer(data, size, "data");
    const std::span<const std::byte> framed(static_cast<const std::byte*>(data), size);
    SnapshotContents saved = unframe_snapshot(framed, format_of(extension), bodies_.in_order(), joints_.in_order());
    check_saved_exceptions(saved.exceptions);
    const PairExceptions::Pairs rejoined = PairExceptions::difference(exceptions_.list(), saved.exceptions);
    const PairExceptions::Pairs parted = PairExceptions::difference(saved.exceptions, exceptions_.list());
    // Before the rest: who sleeps and who touches stands there.
    const PlumbResult result = with_exceptions_set(rejoined, true, [&] {
      return with_exceptions_set(parted, false, [&] { return extension.restore(saved.payload); });
    });
    exceptions_.become(std::move(saved.exceptions));
    return result;
  }

  PlumbResult hash(std::uint64_t* value) {
    require_pointer(value, 1, "hash");
    const auto ids = bodies_.in_order();
    std::vector<double> pose(ids.size() * 7), velocity(ids.size() * 6);
    read(PLUMB_FIELD_POSE, PLUMB_F64, ids.data(), bodies_.size(), pose.data(), 7 * sizeof(double));
    read(PLUMB_FIELD_VELOCITY, PLUMB_F64, ids.data(), bodies_.size(), velocity.data(), 6 * sizeof(double));
    StateHash state;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      for (std::size_t k = 0; k < 7; ++k) state.add(pose[7 * i + k]);
      for (std::size_t k = 0; k < 6; ++k) state.add(velocity[6 * i + k]);
    }
    *value = state.value();
    return PLUMB_OK;
  }

  PlumbResult borrow(const PlumbStateRequest* request, PlumbDLManagedTensor** tensor, PlumbFence* fence) {
    require_pointer(request, 1, "request");
    require_pointer(tensor, 1, "tensor");
    if (request->field != PLUMB_FIELD_POSE && request->field != PLUMB_FIELD_VELOCITY)
      refuse(PLUMB_E_INVALID_ARGUMENT, "only pose and velocity rows are lent");
    if (IState* extension = world_->state(); extension != nullptr) return extension->borrow(*request, *tensor, fence);
    if (request->device_type != kHostDevice)
      refuse(PLUMB_E_UNSUPPORTED,
             std::string(facts_.info->name) + " keeps its state on the host; ask for device_type 1");
    if (request->allow_copy == 0)
      refuse(PLUMB_E_UNSUPPORTED,
             std::string(facts_.info->name) + " cannot lend its rows as they lie in memory; set allow_copy");
    auto copy = std::make_unique<CopiedRows>(bodies_.size(), columns_of(request->field), facts_.info->precision);
    read(request->field, copy->type(), bodies_.in_order().data(), bodies_.size(), copy->data(), copy->row_size());
    *tensor = CopiedRows::lend(std::move(copy));
    if (fence != nullptr) *fence = {nullptr, nullptr};
    return PLUMB_COPIED;
  }

  PlumbResult state_rows(PlumbBody* ids, std::uint32_t capacity, std::uint32_t* count, std::uint64_t* generation) {
    require_pointer(generation, 1, "generation");
    std::span<const PlumbBody> map = bodies_.in_order();
    *generation = row_generation_;
    if (IState* extension = world_->state(); extension != nullptr) extension->row_map(map, *generation);
    return hand_out(map, ids, sizeof(PlumbBody), capacity, count);
  }

 private:
  template <class Extension>
  Extension& require_extension(Extension* extension, const char* name) const {
    if (extension == nullptr) refuse(PLUMB_E_UNSUPPORTED, std::string(facts_.info->name) + " has no " + name);
    return *extension;
  }

  IQueries& require_queries() const {
    IQueries& extension = require_extension(world_->queries(), PLUMB_EXT_QUERIES);
    require_need(init_.desc.needs, PLUMB_NEED_QUERIES, true, "a query");
    return extension;
  }

  ISnapshot& require_snapshot() const {
    ISnapshot& extension = require_extension(world_->snapshot(), PLUMB_EXT_SNAPSHOT);
    require_need(init_.desc.needs, PLUMB_NEED_SNAPSHOT, true, "a snapshot");
    return extension;
  }

  JointRecord examine_joint(const Where& where, const PlumbJointDesc& desc) const {
    check_joint(where, desc);
    const auto require_body = [&](PlumbBody body, const char* member) {
      if (!bodies_.alive(body)) refuse(PLUMB_E_STALE_HANDLE, where.member(member) + " names no living body");
    };
    if (desc.body_a != 0) require_body(desc.body_a, "body_a");
    require_body(desc.body_b, "body_b");
    if (desc.body_a == desc.body_b)
      refuse(PLUMB_E_INVALID_ARGUMENT, where.member("body_b") + " is body_a; a joint joins two");
    const bool moves_a = desc.body_a != 0 && bodies_[desc.body_a].motion == PLUMB_DYNAMIC;
    if (!moves_a && bodies_[desc.body_b].motion != PLUMB_DYNAMIC)
      refuse(PLUMB_E_INVALID_ARGUMENT,
             where.member("") + " joins two bodies that nothing can move; one must be dynamic");
    require_capability(PLUMB_CAP_JOINT, desc.type, 0, std::string(joint_name(desc.type)) + " joint");
    const auto feature = [&](bool used, PlumbJointFeature which, const char* what) {
      if (used)
        require_capability(PLUMB_CAP_JOINT_FEATURE, desc.type, which,
                           std::string(joint_name(desc.type)) + " joint with " + what);
    };
    bool limits = false, motors = false, springs = false;
    for (std::size_t axis = 0; axis < 6; ++axis) {
      limits = limits || desc.limits[axis].enabled != 0;
      motors = motors || desc.motors[axis].enabled != 0;
      springs = springs || desc.springs[axis].enabled != 0;
    }
    feature(limits, PLUMB_JOINT_HAS_LIMITS, "limits");
    feature(motors, PLUMB_JOINT_HAS_MOTORS, "motors");
    feature(springs, PLUMB_JOINT_HAS_SPRINGS, "springs");
    JointRecord record{desc.body_a, desc.body_b, desc.break_force > 0 || desc.break_torque > 0};
    feature(record.breakable, PLUMB_JOINT_BREAKS, "a break force");
    require_need(init_.desc.needs, PLUMB_NEED_EVENTS, record.breakable, where.member("break_force"));
    return record;
  }

  void check_joint_field(PlumbJointField field, PlumbDataType type, std::uint32_t count, const void* rows,
                         std::size_t stride) const {
    if (field >= PLUMB_JOINT_FIELD_COUNT)
      refuse(PLUMB_E_INVALID_ARGUMENT, "field is " + std::to_string(field) + "; it must be a PlumbJointField");
    check_row_memory("joint rows", joint_columns_of(field), type, count, rows, stride);
  }

  /// What stood on the other must fall.
  PlumbResult wake_sleepers_of(const PairExceptions::Pairs& pairs) {
    const char* note = "";
    if ((init_.desc.needs & PLUMB_NEED_SLEEPING) == 0 ||
        degree(PLUMB_CAP_FIELD_READ, PLUMB_FIELD_AWAKE, 0, note) == PLUMB_NONE ||
        degree(PLUMB_CAP_FIELD_WRITE, PLUMB_FIELD_AWAKE, 0, note) == PLUMB_NONE)
      return PLUMB_OK;
    std::vector<PlumbBody> bodies;
    for (const PlumbBodyPair& pair : pairs)
      for (const PlumbBody body : {pair.body_a, pair.body_b})
        if (bodies_[body].motion == PLUMB_DYNAMIC) bodies.push_back(body);
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    std::vector<double> awake(bodies.size());
    done(world_->read(PLUMB_FIELD_AWAKE, bodies, rows_over(std::span(awake))));
    std::size_t sleepers = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (awake[i] == 0) bodies[sleepers++] = bodies[i];
    if (sleepers == 0) return PLUMB_OK;
    bodies.resize(sleepers);
    awake.assign(sleepers, 1);
    done(world_->write(PLUMB_FIELD_AWAKE, bodies, const_rows_over(std::span<const double>(awake))));
    return PLUMB_OK;
  }

  void check_saved_exceptions(const PairExceptions::Pairs& saved) const {
    const bool known = std::all_of(saved.begin(), saved.end(), [this](const PlumbBodyPair& pair) {
      return bodies_.alive(pair.body_a) && bodies_.alive(pair.body_b) && slot_of(pair.body_a) < slot_of(pair.body_b);
    });
    if (!known || !std::is_sorted(saved.begin(), saved.end(), PairExceptions::before) ||
        (!saved.empty() && world_->exceptions() == nullptr))
      refuse(PLUMB_E_CORRUPT, "the snapshot has pair exceptions that cannot be of this world");
  }

  static void check_hit_mode(PlumbHitMode mode) {
    if (mode != PLUMB_HIT_CLOSEST && mode != PLUMB_HIT_ALL)
      refuse(PLUMB_E_INVALID_ARGUMENT,
             "mode is " + std::to_string(mode) + "; it must be PLUMB_HIT_CLOSEST or PLUMB_HIT_ALL");
  }

  static void check_translation(const Where& where, const PlumbVec3& translation) {
    require_finite(where, "translation", translation);
    if (is_zero(translation))
      refuse(PLUMB_E_INVALID_ARGUMENT, where.member("translation") + " is 0; it must have a length");
  }

  void check_posed_shape(const Where& where, PlumbShape shape, const PlumbPose& pose, PlumbQueryKind kind,
                         const char* what) const {
    if (!shapes_.alive(shape)) refuse(PLUMB_E_STALE_HANDLE, where.member("shape") + " names no living shape");
    require_pose(where, "pose", pose);
    const PlumbShapeType type = shapes_[shape].type;
    if (!is_convex(type))
      refuse(PLUMB_E_INVALID_ARGUMENT, where.member("shape") + " is a " + shape_name(type) + "; it must be convex");
    require_capability(PLUMB_CAP_QUERY, kind, type, std::string(what) + shape_name(type));
  }

  static PlumbResult hand_out_hits(const Hits& found, PlumbHit* hits, std::uint32_t capacity,
                                   std::uint32_t* hit_count) {
    return std::max(found.result, hand_out(found.hits, hits, sizeof(PlumbHit), capacity, hit_count));
  }

  template <class Row>
  PlumbResult hand_out_debug(PlumbResult (IDebug::*look)(std::span<const Row>&), Row* out, std::uint32_t capacity,
                             std::uint32_t* count) {
    IDebug& extension = require_extension(world_->debug(), PLUMB_EXT_DEBUG);
    std::span<const Row> rows;
    const PlumbResult result = (extension.*look)(rows);
    return std::max(result, hand_out(rows, out, sizeof(Row), capacity, count));
  }
};

}  // namespace plumb::backend
