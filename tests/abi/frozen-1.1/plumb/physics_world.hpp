// IPhysicsWorld: the C++ face of the wall. Each side compiles it for itself; no C++ type crosses.
//
// A host gets one from plumb::Backend::create_world (loader.hpp) and calls a loaded engine through it. A backend author
// derives from it (backend.hpp) and a macro turns the class into the table of plumb.h. The meaning of every call is
// that of the function of the same name in plumb.h; what differs between the two sides is said here.
//
// Failures: the host gets results below 0 and asks error_text(). A backend throws plumb::Error instead of returning
// one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>

#include "plumb/plumb.h"

namespace plumb {

/// A failed call, as an exception for those who like one. code is below 0.
class Error : public std::runtime_error {
 public:
  Error(PlumbResult failure, const std::string& text) : std::runtime_error(text), code_(failure) {}
  [[nodiscard]] PlumbResult code() const { return code_; }

 private:
  PlumbResult code_;
};

/// Slot of a handle: a small index that is unique among the live objects of its kind in a world.
[[nodiscard]] constexpr std::uint32_t slot_of(std::uint64_t handle) { return static_cast<std::uint32_t>(handle); }
[[nodiscard]] constexpr std::uint32_t generation_of(std::uint64_t handle) {
  return static_cast<std::uint32_t>(handle >> 32);
}

/// Whether a table of the other side is long enough to have a function, which a later minor version may have appended,
/// and has it.
template <class Table, class Member>
[[nodiscard]] bool has(const Table& table, Member Table::*member) {
  const auto offset = reinterpret_cast<const char*>(&(table.*member)) - reinterpret_cast<const char*>(&table);
  return static_cast<std::size_t>(offset) + sizeof(Member) <= table.struct_size && table.*member != nullptr;
}

/// Columns of a field's rows; 0 for what is not a field.
[[nodiscard]] constexpr std::uint32_t columns_of(PlumbField field) {
  constexpr std::uint32_t columns[PLUMB_FIELD_COUNT] = {7, 6, 3, 3, 3, 3, 6, 6, 1, 7, 11, 2, 1, 2, 3, 3};
  return field < PLUMB_FIELD_COUNT ? columns[field] : 0;
}
[[nodiscard]] constexpr std::uint32_t joint_columns_of(PlumbJointField field) {
  constexpr std::uint32_t columns[PLUMB_JOINT_FIELD_COUNT] = {6, 6, 12};
  return field < PLUMB_JOINT_FIELD_COUNT ? columns[field] : 0;
}

/// Rows of f32 or f64 numbers in somebody's memory, a fixed number of bytes apart. Does not own.
template <class Byte>
class BasicRows {
 public:
  BasicRows(Byte* data, std::size_t count, std::size_t stride, PlumbDataType type)
      : data_(data), count_(count), stride_(stride), type_(type) {}

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t stride() const { return stride_; }
  [[nodiscard]] PlumbDataType type() const { return type_; }
  [[nodiscard]] Byte* data() const { return data_; }

  /// Writes the first `columns` numbers of a row.
  void put(std::size_t row, const double* values, std::size_t columns) const requires(!std::is_const_v<Byte>) {
    Byte* at = data_ + row * stride_;
    if (type_ == PLUMB_F64) {
      std::memcpy(at, values, columns * sizeof(double));
      return;
    }
    for (std::size_t i = 0; i < columns; ++i) {
      const auto narrow = static_cast<float>(values[i]);
      std::memcpy(at + i * sizeof(float), &narrow, sizeof(float));
    }
  }

  /// Reads the first `columns` numbers of a row.
  void get(std::size_t row, double* values, std::size_t columns) const {
    const Byte* at = data_ + row * stride_;
    if (type_ == PLUMB_F64) {
      std::memcpy(values, at, columns * sizeof(double));
      return;
    }
    for (std::size_t i = 0; i < columns; ++i) {
      float narrow = 0;
      std::memcpy(&narrow, at + i * sizeof(float), sizeof(float));
      values[i] = static_cast<double>(narrow);
    }
  }

 private:
  Byte* data_;
  std::size_t count_;
  std::size_t stride_;
  PlumbDataType type_;
};
using Rows = BasicRows<std::byte>;
using ConstRows = BasicRows<const std::byte>;

/// f64 rows over an array of count * columns doubles, or of count structs that begin with the columns.
template <class T>
[[nodiscard]] Rows rows_over(std::span<T> rows) {
  return {reinterpret_cast<std::byte*>(rows.data()), rows.size(), sizeof(T), PLUMB_F64};
}
template <class T>
[[nodiscard]] ConstRows const_rows_over(std::span<const T> rows) {
  return {reinterpret_cast<const std::byte*>(rows.data()), rows.size(), sizeof(T), PLUMB_F64};
}

// --- extensions: what a world may have beyond the core ---------------------------------------------------------------

/// plumb.joints/1. A backend gets descs whose bodies are alive and whose numbers are finite and in range.
class IJoints {
 public:
  virtual ~IJoints() = default;
  /// ids: an output for the host; a backend finds them filled with the handles that it must use.
  virtual PlumbResult create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) = 0;
  virtual PlumbResult destroy_joints(std::span<const PlumbJoint> ids) = 0;
  /// ids empty: the first rows.count() live joints; a backend always gets them spelled out.
  virtual PlumbResult read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) = 0;
  virtual PlumbResult write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) = 0;
};

/// What a batch of queries found, in the order that plumb.h states. Lives until the next query of the same thread.
struct Hits {
  PlumbResult result = PLUMB_OK;
  std::span<const PlumbHit> hits;
};

/// plumb.queries/1. May be called from several threads at once.
class IQueries {
 public:
  virtual ~IQueries() = default;
  virtual Hits cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) = 0;
  virtual Hits cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) = 0;
  virtual Hits overlap_shapes(std::span<const PlumbOverlap> overlaps) = 0;
};

/// plumb.collide/1
class ICollide {
 public:
  virtual ~ICollide() = default;
  /// results has pairs.size() rows. The points live until the next call of the same thread.
  virtual PlumbResult collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                                    std::span<const PlumbPairPoint>& points) = 0;
};

/// plumb.debug/1. Spans live until the next call on the world. Every one may answer PLUMB_E_UNSUPPORTED; a backend that
/// cannot show a thing throws that, with a sentence.
class IDebug {
 public:
  virtual ~IDebug() = default;
  virtual PlumbResult candidate_pairs(std::span<const PlumbDebugPair>& pairs) = 0;
  virtual PlumbResult tree_boxes(std::span<const PlumbDebugBox>& boxes) = 0;
  virtual PlumbResult separating_axes(std::span<const PlumbDebugAxis>& axes) = 0;
  virtual PlumbResult body_states(std::span<const PlumbDebugBody>& /*bodies*/) {
    throw Error(PLUMB_E_UNSUPPORTED, "this engine does not tell its islands");
  }
  virtual PlumbResult solved_constraints(std::span<const PlumbDebugConstraint>& /*constraints*/) {
    throw Error(PLUMB_E_UNSUPPORTED, "this engine does not tell in what order it solves its constraints");
  }
};

/// plumb.settings/1
class ISettings {
 public:
  virtual ~ISettings() = default;
  /// The value in force.
  virtual PlumbResult get_setting(const char* name, PlumbSettingValue& value) = 0;
  /// A backend gets known names and values of the right type and range only.
  virtual PlumbResult set_setting(const char* name, const PlumbSettingValue& value) = 0;
};

/// plumb.snapshot/1
class ISnapshot {
 public:
  virtual ~ISnapshot() = default;
  /// The bytes live until the next call on the world.
  virtual PlumbResult save(std::span<const std::byte>& data) = 0;
  virtual PlumbResult restore(std::span<const std::byte> data) = 0;
  /// Backends with the same name of a format read each other's snapshots; "" is the format of this build alone.
  [[nodiscard]] virtual std::string_view format() const { return {}; }
};

/// plumb.state/1
class IState {
 public:
  virtual ~IState() = default;
  virtual PlumbResult borrow(const PlumbStateRequest& request, PlumbDLManagedTensor*& tensor, PlumbFence* fence) = 0;
  /// The map lives until the next call on the world.
  virtual PlumbResult row_map(std::span<const PlumbBody>& ids, std::uint64_t& generation) = 0;
};

/// plumb.exceptions/1. A backend gets pairs of living bodies, the lower slot first, each once, and only such as change;
/// those of bodies that are destroyed are taken back before. backend.hpp knows the list, wakes who sleeps, and saves
/// it.
class IExceptions {
 public:
  virtual ~IExceptions() = default;
  virtual PlumbResult set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) = 0;
  /// Only the host calls this. The pairs live until the next call on the world.
  virtual PlumbResult list_exceptions(std::span<const PlumbBodyPair>& /*pairs*/) { return PLUMB_E_UNSUPPORTED; }
};

// --- the world -------------------------------------------------------------------------------------------------------

class IPhysicsWorld {
 public:
  IPhysicsWorld() = default;
  IPhysicsWorld(const IPhysicsWorld&) = delete;
  IPhysicsWorld& operator=(const IPhysicsWorld&) = delete;
  virtual ~IPhysicsWorld() = default;

  /// ids: an output for the host; a backend finds them filled with the handles that it must use.
  virtual PlumbResult create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) = 0;
  virtual PlumbResult destroy_shapes(std::span<const PlumbShape> ids) = 0;
  /// Likewise. A backend gets dynamic bodies with mass_mode PLUMB_MASS_EXPLICIT: the mass properties of shapes are
  /// worked out in backend.hpp, once for all engines. A dynamic body that cannot turn has inertia 0 0 0.
  virtual PlumbResult create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) = 0;
  virtual PlumbResult destroy_bodies(std::span<const PlumbBody> ids) = 0;

  /// ids empty: the first rows.count() live bodies in order of creation; a backend always gets them spelled out, alive
  /// and checked, and finite rows. A backend is not asked for PLUMB_FIELD_MASS: backend.hpp knows.
  virtual PlumbResult read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) = 0;
  virtual PlumbResult write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) = 0;
  virtual PlumbResult set_gravity(const PlumbVec3& gravity) = 0;

  virtual PlumbResult step(double dt) = 0;
  /// A backend finds the report's counts of bodies, joints, steps and threads filled in and the rest "not known".
  virtual PlumbResult wait(PlumbStepReport& report) = 0;

  /// Of the last step; they live until the next call on the world. The host asks result of a failure by error_text.
  virtual std::span<const PlumbContact> contacts() = 0;
  virtual std::span<const PlumbEvent> events() = 0;

  /// Extensions; null where the world has none.
  virtual IJoints* joints() { return nullptr; }
  virtual IQueries* queries() { return nullptr; }
  virtual ICollide* collide() { return nullptr; }
  virtual IDebug* debug() { return nullptr; }
  virtual ISettings* settings() { return nullptr; }
  virtual ISnapshot* snapshot() { return nullptr; }
  virtual IState* state() { return nullptr; }
  virtual IExceptions* exceptions() { return nullptr; }

  // Only the host calls what follows; backend.hpp answers it for every backend.

  /// Live bodies in order of creation.
  virtual std::span<const PlumbBody> bodies() { return {}; }
  /// plumb.snapshot/1 hash.
  virtual PlumbResult hash(std::uint64_t& /*value*/) { return PLUMB_E_UNSUPPORTED; }
  [[nodiscard]] virtual std::string error_text() const { return {}; }
};

/// Throws Error with the world's error text when a call failed; passes remarks on.
inline PlumbResult check(const IPhysicsWorld& world, PlumbResult result) {
  if (result < 0) throw Error(result, world.error_text());
  return result;
}

// --- small conveniences for both sides -------------------------------------------------------------------------------

[[nodiscard]] constexpr PlumbPose identity_pose() { return {{0, 0, 0}, {0, 0, 0, 1}}; }

[[nodiscard]] inline PlumbShapeDesc shape_desc(PlumbShapeType type) {
  PlumbShapeDesc desc{};
  desc.struct_size = sizeof(desc);
  desc.type = type;
  return desc;
}

/// A dynamic body at rest at the origin, density 1000, friction .5, that touches everything.
[[nodiscard]] inline PlumbBodyDesc body_desc(PlumbMotion motion = PLUMB_DYNAMIC) {
  PlumbBodyDesc desc{};
  desc.struct_size = sizeof(desc);
  desc.motion = motion;
  desc.pose = identity_pose();
  desc.mass_mode = PLUMB_MASS_FROM_DENSITY;
  desc.density = 1000;
  desc.inertia_orientation = {0, 0, 0, 1};
  desc.material.friction = 0.5;
  desc.gravity_scale = 1;
  desc.filter = {1, 0xffffffffu, 0, 0};
  return desc;
}

[[nodiscard]] inline PlumbJointDesc joint_desc(PlumbJointType type) {
  PlumbJointDesc desc{};
  desc.struct_size = sizeof(desc);
  desc.type = type;
  desc.frame_a = desc.frame_b = identity_pose();
  return desc;
}

[[nodiscard]] inline PlumbWorldDesc world_desc(PlumbNeeds needs) {
  PlumbWorldDesc desc{};
  desc.struct_size = sizeof(desc);
  desc.threads = 1;
  desc.needs = needs;
  desc.gravity = {0, -9.81, 0};
  return desc;
}

/// Whether two filters let their bodies touch: the rule of PlumbFilter.
[[nodiscard]] constexpr bool may_touch(const PlumbFilter& a, const PlumbFilter& b) {
  if (a.group == b.group && a.group != 0) return a.group > 0;
  return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

}  // namespace plumb
