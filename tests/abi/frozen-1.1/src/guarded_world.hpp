// What stands between the table and a backend's class, in every build: it allots handles, refuses what is stale, not
// finite, out of range, undeclared or unsupported before the class is called, works out mass properties, and answers
// by itself what is the same for every engine.
#pragma once

#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "check_rows.hpp"
#include "pair_exceptions.hpp"
#include "plumb/backend/check_descs.hpp"
#include "plumb/backend/mass_properties.hpp"
#include "plumb/backend/state_hash.hpp"
#include "plumb/backend/tables.hpp"
#include "slot_table.hpp"

namespace plumb::backend {

class GuardedWorld {
 public:
  GuardedWorld(const BackendFacts& facts, WorldInit init, std::unique_ptr<IPhysicsWorld> world)
      : facts_(facts), init_(std::move(init)), world_(std::move(world)) {}

  // --- failures ------------------------------------------------------------------------------------------------------

  /// Runs a call: what it throws becomes a result and the error text.
  template <class Call>
  PlumbResult guard(Call&& call) noexcept {
    if (lost_ != PLUMB_OK) return lost_;
    try {
      return done(call());
    } catch (const Error& error) {
      return fail(error.code(), error.what());
    } catch (const std::bad_alloc&) {
      return fail(PLUMB_E_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& error) {
      return fail(PLUMB_E_INTERNAL, error.what());
    } catch (...) {
      return fail(PLUMB_E_INTERNAL, "the backend threw something that is not a std::exception");
    }
  }

  [[nodiscard]] const char* error_text() const { return error_text_.c_str(); }

  // --- shapes --------------------------------------------------------------------------------------------------------

  PlumbResult create_shapes(const PlumbShapeDesc* descs, std::size_t stride, std::uint32_t count, PlumbShape* ids) {
    const std::vector<PlumbShapeDesc> adopted = adopt_descs(descs, stride, count, "shapes");
    require_pointer(ids, count, "ids");
    std::vector<ShapeRecord> records(count);
    for (std::uint32_t i = 0; i < count; ++i) records[i] = examine_shape({"shapes", i}, adopted[i]);
    return create(shapes_, std::move(records), {ids, count}, [&](std::span<const std::uint64_t> handles) {
      std::vector<PlumbShape> given(handles.begin(), handles.end());
      const PlumbResult result = done(world_->create_shapes(adopted, given));
      for (const PlumbShape handle : handles)
        for (const PlumbShape child : shapes_[handle].children) ++shapes_[child].uses;
      return result;
    });
  }

  PlumbResult destroy_shapes(const PlumbShape* ids, std::uint32_t count) {
    const auto handles = distinct_live(shapes_, ids, count, "shapes");
    for (std::uint32_t i = 0; i < count; ++i)
      if (shapes_[ids[i]].uses != 0)
        refuse(PLUMB_E_IN_USE, Where{"shapes", i}.member("") + " is used by " + std::to_string(shapes_[ids[i]].uses) +
                                   " bodies or compounds; destroy those first");
    const PlumbResult result = done(world_->destroy_shapes(handles));
    for (const PlumbShape handle : handles)
      for (const PlumbShape child : shapes_[handle].children) --shapes_[child].uses;
    shapes_.remove(handles);
    return result;
  }

  // --- bodies --------------------------------------------------------------------------------------------------------

  PlumbResult create_bodies(const PlumbBodyDesc* descs, std::size_t stride, std::uint32_t count, PlumbBody* ids) {
    std::vector<PlumbBodyDesc> adopted = adopt_descs(descs, stride, count, "bodies");
    require_pointer(ids, count, "ids");
    std::vector<BodyRecord> records(count);
    for (std::uint32_t i = 0; i < count; ++i) records[i] = examine_body({"bodies", i}, adopted[i]);
    return create(bodies_, std::move(records), {ids, count}, [&](std::span<const std::uint64_t> handles) {
      std::vector<PlumbBody> given(handles.begin(), handles.end());
      const PlumbResult result = done(world_->create_bodies(adopted, given));
      for (const PlumbBodyDesc& desc : adopted)
        if (desc.shape != 0) ++shapes_[desc.shape].uses;
      ++row_generation_;
      return result;
    });
  }

  PlumbResult destroy_bodies(const PlumbBody* ids, std::uint32_t count) {
    const auto handles = distinct_live(bodies_, ids, count, "bodies");
    for (std::uint32_t i = 0; i < count; ++i)
      if (bodies_[ids[i]].joints != 0)
        refuse(PLUMB_E_IN_USE, Where{"bodies", i}.member("") + " still has " + std::to_string(bodies_[ids[i]].joints) +
                                   " joints; destroy those first");
    const PairExceptions::Pairs excepted = exceptions_.of(handles);
    PairExceptions::Pairs others = exceptions_.after(excepted, true);
    const PlumbResult result = with_exceptions_set(excepted, true, [&] { return world_->destroy_bodies(handles); });
    exceptions_.become(std::move(others));
    for (const PlumbBody handle : handles)
      if (const PlumbShape shape = bodies_[handle].shape; shape != 0) --shapes_[shape].uses;
    bodies_.remove(handles);
    ++row_generation_;
    return result;
  }

  PlumbResult list_bodies(PlumbBody* ids, std::uint32_t capacity, std::uint32_t* count) {
    return hand_out(bodies_.in_order(), ids, sizeof(PlumbBody), capacity, count);
  }

  PlumbResult user_data(PlumbBody id, std::uint64_t* value) {
    require_pointer(value, 1, "user_data");
    require_live(bodies_, {&id, 1}, "id");
    *value = bodies_[id].user_data;
    return PLUMB_OK;
  }

  // --- rows ----------------------------------------------------------------------------------------------------------

  PlumbResult read(PlumbField field, PlumbDataType type, const PlumbBody* ids, std::uint32_t count, void* rows,
                   std::size_t stride) {
    const auto spelled_out = spell_out(bodies_, ids, count, "ids");
    check_field(field, type, count, rows, stride, PLUMB_CAP_FIELD_READ);
    const Rows out(static_cast<std::byte*>(rows), count, stride, type);
    if (field != PLUMB_FIELD_MASS) return world_->read(field, spelled_out, out);
    for (std::uint32_t i = 0; i < count; ++i) out.put(i, bodies_[spelled_out[i]].mass_row, columns_of(field));
    return PLUMB_OK;
  }

  PlumbResult write(PlumbField field, PlumbDataType type, const PlumbBody* ids, std::uint32_t count, const void* rows,
                    std::size_t stride) {
    const auto spelled_out = spell_out(bodies_, ids, count, "ids");
    check_field(field, type, count, rows, stride, PLUMB_CAP_FIELD_WRITE);
    const PlumbNeeds need = need_of_field(field);
    if (need != 0) require_need(init_.desc.needs, need, true, std::string("writing ") + field_name(field));
    const ConstRows in(static_cast<const std::byte*>(rows), count, stride, type);
    const std::uint32_t columns = columns_of(field);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Where where{"rows", i};
      double row[16];
      in.get(i, row, columns);
      check_row(field, where, row, columns);
      check_writable(field, where, bodies_[spelled_out[i]].motion);
      check_written_needs(field, where, row);
    }
    return world_->write(field, spelled_out, in);
  }

  PlumbResult set_gravity(const PlumbVec3* gravity) {
    require_pointer(gravity, 1, "gravity");
    require_finite({"gravity", 0}, "", *gravity);
    return world_->set_gravity(*gravity);
  }

  // --- the step and what comes out of it -----------------------------------------------------------------------------

  PlumbResult step(const PlumbStepDesc* desc) {
    require_pointer(desc, 1, "desc");
    require_positive({"step", 0}, "dt", desc->dt);
    if (stepping_) refuse(PLUMB_E_WRONG_PHASE, "step was called twice; wait for the first");
    const PlumbResult result = done(world_->step(desc->dt));
    stepping_ = true;
    return result;
  }

  PlumbResult wait(PlumbStepReport* report) {
    if (!stepping_) refuse(PLUMB_E_WRONG_PHASE, "wait was called without a step");
    stepping_ = false;
    ++steps_;
    PlumbStepReport ours = blank_report();
    const PlumbResult result = world_->wait(ours);
    if (breakable_joints_ != 0) forget_broken_joints();
    ours.joints = joints_.size();
    if (report != nullptr) {
      const std::uint32_t size = report->struct_size;
      std::memcpy(report, &ours, std::min<std::size_t>(size, sizeof ours));
      report->struct_size = size;
    }
    return result;
  }

  PlumbResult contacts(PlumbContact* out, std::size_t stride, std::uint32_t capacity, std::uint32_t* count) {
    require_need(init_.desc.needs, PLUMB_NEED_CONTACTS, true, "reading contacts");
    return hand_out(world_->contacts(), out, stride, capacity, count);
  }

  PlumbResult events(PlumbEvent* out, std::size_t stride, std::uint32_t capacity, std::uint32_t* count) {
    if ((init_.desc.needs & PLUMB_NEED_SENSORS) == 0)
      require_need(init_.desc.needs, PLUMB_NEED_EVENTS, true, "reading events");
    return hand_out(world_->events(), out, stride, capacity, count);
  }

 protected:
  struct ShapeRecord {
    PlumbShapeType type = 0;
    std::uint32_t uses = 0;
    std::vector<PlumbShape> children;
    std::optional<MassProperties> unit_mass;  ///< at density 1; none for shapes without a volume
    std::string no_mass_because;
  };
  struct BodyRecord {
    PlumbShape shape = 0;
    std::uint64_t user_data = 0;
    PlumbMotion motion = PLUMB_STATIC;
    std::uint32_t joints = 0;
    double mass_row[11] = {};
  };
  struct JointRecord {
    PlumbBody body_a = 0, body_b = 0;
    bool breakable = false;
  };

  [[nodiscard]] PlumbDegree degree(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note) const {
    note = "";
    return facts_.capability(kind, a, b, note);
  }

  void require_capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const std::string& what) const {
    const char* note = "";
    if (degree(kind, a, b, note) == PLUMB_NONE)
      refuse(PLUMB_E_UNSUPPORTED,
             std::string(facts_.info->name) + " has no " + what + (*note == '\0' ? "" : ": ") + note);
  }

  /// What the class answered. A failure ends the call here, as an exception does: nothing has changed.
  static PlumbResult done(PlumbResult result) {
    if (result < 0) refuse(result, "the backend failed without a text");
    return result;
  }

  /// Tells the class of changed exceptions, then runs a call; takes them back when that failed.
  template <class Call>
  PlumbResult with_exceptions_set(const PairExceptions::Pairs& changed, bool touch, Call&& call) {
    if (changed.empty()) return done(call());
    done(world_->exceptions()->set_exceptions(changed, touch));
    try {
      return done(call());
    } catch (...) {
      static_cast<void>(world_->exceptions()->set_exceptions(changed, !touch));
      throw;
    }
  }

  template <class Record>
  static void require_live(const SlotTable<Record>& table, std::span<const std::uint64_t> handles, const char* name) {
    for (std::size_t i = 0; i < handles.size(); ++i)
      if (!table.alive(handles[i]))
        refuse(PLUMB_E_STALE_HANDLE, Where{name, i}.member("") + " is handle " + std::to_string(handles[i]) +
                                         ", which names nothing that lives in this world");
  }

  template <class Record>
  static std::span<const std::uint64_t> distinct_live(const SlotTable<Record>& table, const std::uint64_t* ids,
                                                      std::uint32_t count, const char* name) {
    require_pointer(ids, count, name);
    const std::span<const std::uint64_t> handles(ids, count);
    require_live(table, handles, name);
    std::vector<std::uint64_t> sorted(handles.begin(), handles.end());
    std::sort(sorted.begin(), sorted.end());
    if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
      refuse(PLUMB_E_INVALID_ARGUMENT,
             std::string(name) + " names handle " + std::to_string(*twice) + " twice; name it once");
    return handles;
  }

  /// Handles of a bulk call; ids null stands for the first count live ones.
  template <class Record>
  static std::span<const std::uint64_t> spell_out(const SlotTable<Record>& table, const std::uint64_t* ids,
                                                  std::uint32_t count, const char* name) {
    if (ids == nullptr) {
      if (count > table.size())
        refuse(PLUMB_E_INVALID_ARGUMENT,
               "count is " + std::to_string(count) + ", but only " + std::to_string(table.size()) + " live");
      return table.in_order().first(count);
    }
    const std::span<const std::uint64_t> handles(ids, count);
    require_live(table, handles, name);
    return handles;
  }

  /// Allots handles, lets `make` build the objects, and takes the handles back when it throws.
  template <class Record, class Make>
  static PlumbResult create(SlotTable<Record>& table, std::vector<Record> records, std::span<std::uint64_t> ids,
                            Make&& make) {
    std::vector<std::uint64_t> handles;
    handles.reserve(records.size());
    try {
      for (Record& record : records) handles.push_back(table.add(std::move(record)));
      const PlumbResult result = make(std::span<const std::uint64_t>(handles));
      std::copy(handles.begin(), handles.end(), ids.begin());
      return result;
    } catch (...) {
      table.remove(handles);
      throw;
    }
  }

  const BackendFacts& facts_;
  WorldInit init_;
  std::unique_ptr<IPhysicsWorld> world_;
  SlotTable<ShapeRecord> shapes_;
  SlotTable<BodyRecord> bodies_;
  SlotTable<JointRecord> joints_;
  PairExceptions exceptions_;
  std::uint32_t breakable_joints_ = 0;
  std::uint64_t row_generation_ = 1;

  /// Also from queries, which may run side by side.
  PlumbResult fail(PlumbResult code, const std::string& text) noexcept {
    const std::lock_guard lock(error_mutex_);
    if (code == PLUMB_E_WORLD_LOST || code == PLUMB_E_DEVICE_LOST) lost_ = code;
    try {
      error_text_ = text;
    } catch (...) {
      error_text_.clear();
    }
    return code;
  }

 private:
  ShapeRecord examine_shape(const Where& where, const PlumbShapeDesc& desc) const {
    check_shape(where, desc);
    const char* note = "";
    bool any = false;
    for (PlumbMotion motion = 0; motion < PLUMB_MOTION_COUNT; ++motion)
      any = any || degree(PLUMB_CAP_SHAPE, desc.type, motion, note) != PLUMB_NONE;
    if (!any) require_capability(PLUMB_CAP_SHAPE, desc.type, PLUMB_STATIC, shape_name(desc.type));
    ShapeRecord record;
    record.type = desc.type;
    std::vector<MassProperties> children;
    for (std::uint32_t i = 0; desc.type == PLUMB_COMPOUND && i < desc.child_count; ++i) {
      const PlumbCompoundChild& child = desc.children[i];
      const std::string name = "children[" + std::to_string(i) + "].shape";
      if (!shapes_.alive(child.shape))
        refuse(PLUMB_E_STALE_HANDLE, where.member(name.c_str()) + " names no living shape");
      const ShapeRecord& child_record = shapes_[child.shape];
      if (!is_convex(child_record.type))
        refuse(PLUMB_E_INVALID_ARGUMENT, where.member(name.c_str()) + " is a " + shape_name(child_record.type) +
                                             "; only convex shapes can be children");
      if (child.has_material != 0) {
        require_capability(PLUMB_CAP_CHILD_MATERIAL, 0, 0, "materials of compound children");
        check_material_needs(init_.desc.needs, where.member("children.material"), child.material);
      }
      record.children.push_back(child.shape);
      children.push_back(*child_record.unit_mass);
    }
    try {
      record.unit_mass = unit_mass_properties(desc, children);
    } catch (const Error& error) {
      if (desc.type == PLUMB_CONVEX_HULL) refuse(error.code(), where.member("vertices") + ": " + error.what());
      record.no_mass_because = error.what();
    }
    return record;
  }

  /// Checks a body and turns its mass into explicit numbers.
  BodyRecord examine_body(const Where& where, PlumbBodyDesc& desc) const {
    check_body(where, desc);
    check_body_needs(init_.desc.needs, where, desc);
    BodyRecord record;
    record.shape = desc.shape;
    record.user_data = desc.user_data;
    record.motion = desc.motion;
    if (desc.shape != 0) {
      if (!shapes_.alive(desc.shape)) refuse(PLUMB_E_STALE_HANDLE, where.member("shape") + " names no living shape");
      const PlumbShapeType type = shapes_[desc.shape].type;
      require_capability(PLUMB_CAP_SHAPE, type, desc.motion,
                         std::string(motion_name(desc.motion)) + " " + shape_name(type));
    }
    if (desc.motion == PLUMB_DYNAMIC) resolve_mass(where, desc);
    const double row[11] = {desc.mass,
                            desc.centre_of_mass.x,
                            desc.centre_of_mass.y,
                            desc.centre_of_mass.z,
                            desc.inertia.x,
                            desc.inertia.y,
                            desc.inertia.z,
                            desc.inertia_orientation.x,
                            desc.inertia_orientation.y,
                            desc.inertia_orientation.z,
                            desc.inertia_orientation.w};
    if (desc.motion == PLUMB_DYNAMIC) std::copy(std::begin(row), std::end(row), record.mass_row);
    return record;
  }

  void resolve_mass(const Where& where, PlumbBodyDesc& desc) const {
    if (desc.mass_mode != PLUMB_MASS_EXPLICIT) {
      if (desc.shape == 0) {
        desc.centre_of_mass = {0, 0, 0};
        desc.inertia = {0, 0, 0};
        desc.inertia_orientation = {0, 0, 0, 1};
      } else {
        const ShapeRecord& shape = shapes_[desc.shape];
        if (!shape.unit_mass)
          refuse(PLUMB_E_INVALID_ARGUMENT, where.member("mass_mode") + " asks for the mass of a " +
                                               shape_name(shape.type) + ": " + shape.no_mass_because +
                                               "; use PLUMB_MASS_EXPLICIT");
        const MassProperties& unit = *shape.unit_mass;
        const double density = desc.mass_mode == PLUMB_MASS_FROM_DENSITY ? desc.density : desc.mass / unit.mass;
        if (desc.mass_mode == PLUMB_MASS_FROM_DENSITY) desc.mass = density * unit.mass;
        desc.centre_of_mass = unit.centre_of_mass;
        desc.inertia = {density * unit.inertia.x, density * unit.inertia.y, density * unit.inertia.z};
        desc.inertia_orientation = unit.inertia_orientation;
      }
      desc.mass_mode = PLUMB_MASS_EXPLICIT;
    }
    if ((desc.flags & PLUMB_BODY_NO_ROTATION) != 0) desc.inertia = {0, 0, 0};
  }

  void check_field(PlumbField field, PlumbDataType type, std::uint32_t count, const void* rows, std::size_t stride,
                   PlumbCapability access) const {
    if (field >= PLUMB_FIELD_COUNT)
      refuse(PLUMB_E_INVALID_ARGUMENT, "field is " + std::to_string(field) + "; it must be a PlumbField");
    check_row_memory(field_name(field), columns_of(field), type, count, rows, stride);
    const bool reading = access == PLUMB_CAP_FIELD_READ;
    if (field == PLUMB_FIELD_MASS && reading) return;
    if (const char* note = ""; degree(access, field, 0, note) == PLUMB_NONE)  // one row is read faster than a text made
      require_capability(access, field, 0, std::string(reading ? "reading of " : "writing of ") + field_name(field));
  }

  void check_written_needs(PlumbField field, const Where& where, const double* row) const {
    const PlumbNeeds needs = init_.desc.needs;
    if (field == PLUMB_FIELD_MATERIAL) {
      require_need(needs, PLUMB_NEED_FRICTION, row[0] != 0, where.member("friction above 0"));
      require_need(needs, PLUMB_NEED_RESTITUTION, row[1] != 0, where.member("restitution above 0"));
    }
    require_need(needs, PLUMB_NEED_SLEEPING, field == PLUMB_FIELD_AWAKE && row[0] == 0, where.member("awake 0"));
  }

  [[nodiscard]] PlumbStepReport blank_report() const {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    PlumbStepReport report{};
    report.struct_size = sizeof report;
    report.threads = 1;
    report.step = steps_;
    report.bodies = bodies_.size();
    report.pairs = UINT32_MAX;
    report.residual = unknown;
    for (double& seconds : report.phase_seconds) seconds = unknown;
    return report;
  }

  void forget_broken_joints() {
    std::vector<PlumbJoint> broken;
    for (const PlumbEvent& event : world_->events())
      if (event.type == PLUMB_EVENT_JOINT_BROKEN && joints_.alive(event.joint)) broken.push_back(event.joint);
    release_joints(broken);
  }

 protected:
  void release_joints(std::span<const PlumbJoint> handles) {
    for (const PlumbJoint handle : handles) {
      const JointRecord& record = joints_[handle];
      if (record.body_a != 0) --bodies_[record.body_a].joints;
      --bodies_[record.body_b].joints;
      if (record.breakable) --breakable_joints_;
    }
    joints_.remove(handles);
  }

 private:
  std::mutex error_mutex_;
  std::string error_text_;
  PlumbResult lost_ = PLUMB_OK;
  bool stepping_ = false;
  std::uint64_t steps_ = 0;
};

}  // namespace plumb::backend
