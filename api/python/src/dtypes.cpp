#include "dtypes.hpp"

#include <cstddef>
#include <initializer_list>

namespace plumb::python {
namespace {

struct Column {
  const char* name;
  py::object format;
  std::size_t offset;
};

py::str text(const char* format) { return py::str(format); }

py::dtype make(std::size_t size, std::initializer_list<Column> columns) {
  py::list names, formats, offsets;
  for (const Column& column : columns) {
    names.append(column.name);
    formats.append(column.format);
    offsets.append(column.offset);
  }
  return {names, formats, offsets, static_cast<py::ssize_t>(size)};
}

/// Six of a joint's axes.
py::object six_of(const py::dtype& type) { return py::make_tuple(type, py::make_tuple(6)); }

// A column of a struct; a pose is two.
#define PLUMB_COLUMN(Row, member, format) \
  { #member, format, offsetof(Row, member) }
#define PLUMB_POSE(Row, member, suffix)                                                            \
  {"position" suffix, text("(3,)f8"), offsetof(Row, member)}, {                                    \
    "orientation" suffix, text("(4,)f8"), offsetof(Row, member) + offsetof(PlumbPose, orientation) \
  }

py::dtype material() {
  return make(sizeof(PlumbMaterial),
              {PLUMB_COLUMN(PlumbMaterial, friction, text("f8")), PLUMB_COLUMN(PlumbMaterial, restitution, text("f8")),
               PLUMB_COLUMN(PlumbMaterial, surface_velocity, text("(3,)f8"))});
}
py::dtype filter() {
  return make(sizeof(PlumbFilter),
              {PLUMB_COLUMN(PlumbFilter, category, text("u4")), PLUMB_COLUMN(PlumbFilter, mask, text("u4")),
               PLUMB_COLUMN(PlumbFilter, group, text("i4"))});
}
py::dtype limit() {
  return make(sizeof(PlumbLimit),
              {PLUMB_COLUMN(PlumbLimit, lower, text("f8")), PLUMB_COLUMN(PlumbLimit, upper, text("f8")),
               PLUMB_COLUMN(PlumbLimit, enabled, text("u4"))});
}
py::dtype motor() {
  return make(sizeof(PlumbMotor),
              {PLUMB_COLUMN(PlumbMotor, target_velocity, text("f8")), PLUMB_COLUMN(PlumbMotor, max_force, text("f8")),
               PLUMB_COLUMN(PlumbMotor, enabled, text("u4"))});
}
py::dtype spring() {
  return make(sizeof(PlumbSpring),
              {PLUMB_COLUMN(PlumbSpring, rest, text("f8")), PLUMB_COLUMN(PlumbSpring, frequency, text("f8")),
               PLUMB_COLUMN(PlumbSpring, damping_ratio, text("f8")), PLUMB_COLUMN(PlumbSpring, enabled, text("u4")),
               PLUMB_COLUMN(PlumbSpring, mode, text("u4"))});
}

template <class Row>
py::dtype build();

template <>
py::dtype build<PlumbBodyDesc>() {
  using Row = PlumbBodyDesc;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, motion, text("u4")),
                            PLUMB_COLUMN(Row, flags, text("u4")),
                            PLUMB_COLUMN(Row, locks, text("u4")),
                            PLUMB_COLUMN(Row, shape, text("u8")),
                            PLUMB_POSE(Row, pose, ""),
                            PLUMB_COLUMN(Row, linear_velocity, text("(3,)f8")),
                            PLUMB_COLUMN(Row, angular_velocity, text("(3,)f8")),
                            PLUMB_COLUMN(Row, mass_mode, text("u4")),
                            PLUMB_COLUMN(Row, density, text("f8")),
                            PLUMB_COLUMN(Row, mass, text("f8")),
                            PLUMB_COLUMN(Row, centre_of_mass, text("(3,)f8")),
                            PLUMB_COLUMN(Row, inertia, text("(3,)f8")),
                            PLUMB_COLUMN(Row, inertia_orientation, text("(4,)f8")),
                            PLUMB_COLUMN(Row, material, material()),
                            PLUMB_COLUMN(Row, gravity_scale, text("f8")),
                            PLUMB_COLUMN(Row, linear_damping, text("f8")),
                            PLUMB_COLUMN(Row, angular_damping, text("f8")),
                            PLUMB_COLUMN(Row, filter, filter()),
                            PLUMB_COLUMN(Row, user_data, text("u8")),
                            PLUMB_COLUMN(Row, rolling_friction, text("f8")),
                            PLUMB_COLUMN(Row, spinning_friction, text("f8"))});
}
template <>
py::dtype build<PlumbJointDesc>() {
  using Row = PlumbJointDesc;
  return make(sizeof(Row),
              {PLUMB_COLUMN(Row, type, text("u4")), PLUMB_COLUMN(Row, body_a, text("u8")),
               PLUMB_COLUMN(Row, body_b, text("u8")), PLUMB_POSE(Row, frame_a, "_a"), PLUMB_POSE(Row, frame_b, "_b"),
               PLUMB_COLUMN(Row, collide_connected, text("u4")), PLUMB_COLUMN(Row, axis_modes, text("(6,)u4")),
               PLUMB_COLUMN(Row, limits, six_of(limit())), PLUMB_COLUMN(Row, motors, six_of(motor())),
               PLUMB_COLUMN(Row, springs, six_of(spring())), PLUMB_COLUMN(Row, rest_length, text("f8")),
               PLUMB_COLUMN(Row, break_force, text("f8")), PLUMB_COLUMN(Row, break_torque, text("f8")),
               PLUMB_COLUMN(Row, user_data, text("u8")), PLUMB_COLUMN(Row, ratio, text("f8"))});
}
template <>
py::dtype build<PlumbMaterial>() {
  return material();
}
template <>
py::dtype build<PlumbCompoundChild>() {
  using Row = PlumbCompoundChild;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, shape, text("u8")), PLUMB_POSE(Row, pose, ""),
                            PLUMB_COLUMN(Row, has_material, text("u4")), PLUMB_COLUMN(Row, material, material())});
}
template <>
py::dtype build<PlumbBodyChange>() {
  using Row = PlumbBodyChange;
  return make(
      sizeof(Row),
      {PLUMB_COLUMN(Row, body, text("u8")), PLUMB_COLUMN(Row, what, text("u4")), PLUMB_COLUMN(Row, motion, text("u4")),
       PLUMB_COLUMN(Row, flags, text("u4")), PLUMB_COLUMN(Row, locks, text("u4")), PLUMB_COLUMN(Row, shape, text("u8")),
       PLUMB_COLUMN(Row, mass_mode, text("u4")), PLUMB_COLUMN(Row, density, text("f8")),
       PLUMB_COLUMN(Row, mass, text("f8")), PLUMB_COLUMN(Row, centre_of_mass, text("(3,)f8")),
       PLUMB_COLUMN(Row, inertia, text("(3,)f8")), PLUMB_COLUMN(Row, inertia_orientation, text("(4,)f8"))});
}
template <>
py::dtype build<PlumbJointChange>() {
  using Row = PlumbJointChange;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, joint, text("u8")), PLUMB_COLUMN(Row, what, text("u4")),
                            PLUMB_COLUMN(Row, enabled, text("u4")), PLUMB_COLUMN(Row, collide_connected, text("u4")),
                            PLUMB_POSE(Row, frame_a, "_a"), PLUMB_POSE(Row, frame_b, "_b"),
                            PLUMB_COLUMN(Row, axis_modes, text("(6,)u4")), PLUMB_COLUMN(Row, limits, six_of(limit())),
                            PLUMB_COLUMN(Row, motors, six_of(motor())), PLUMB_COLUMN(Row, springs, six_of(spring())),
                            PLUMB_COLUMN(Row, rest_length, text("f8")), PLUMB_COLUMN(Row, break_force, text("f8")),
                            PLUMB_COLUMN(Row, break_torque, text("f8"))});
}
template <>
py::dtype build<PlumbContact>() {
  using Row = PlumbContact;
  return make(sizeof(Row),
              {PLUMB_COLUMN(Row, body_a, text("u8")), PLUMB_COLUMN(Row, body_b, text("u8")),
               PLUMB_COLUMN(Row, child_a, text("u4")), PLUMB_COLUMN(Row, child_b, text("u4")),
               PLUMB_COLUMN(Row, position, text("(3,)f8")), PLUMB_COLUMN(Row, normal, text("(3,)f8")),
               PLUMB_COLUMN(Row, depth, text("f8")), PLUMB_COLUMN(Row, normal_impulse, text("f8")),
               PLUMB_COLUMN(Row, tangent_impulse, text("(3,)f8")), PLUMB_COLUMN(Row, feature, text("u8"))});
}
template <>
py::dtype build<PlumbManifold>() {
  using Row = PlumbManifold;
  return make(sizeof(Row),
              {PLUMB_COLUMN(Row, body_a, text("u8")), PLUMB_COLUMN(Row, body_b, text("u8")),
               PLUMB_COLUMN(Row, child_a, text("u4")), PLUMB_COLUMN(Row, child_b, text("u4")),
               PLUMB_COLUMN(Row, point_count, text("u4")), PLUMB_COLUMN(Row, normal, text("(3,)f8")),
               PLUMB_COLUMN(Row, velocity, text("(3,)f8")), PLUMB_COLUMN(Row, position, text("(4,3)f8")),
               PLUMB_COLUMN(Row, depth, text("(4,)f8")), PLUMB_COLUMN(Row, friction, text("f8")),
               PLUMB_COLUMN(Row, restitution, text("f8")), PLUMB_COLUMN(Row, surface_velocity, text("(3,)f8"))});
}
template <>
py::dtype build<PlumbManifoldChange>() {
  using Row = PlumbManifoldChange;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, manifold, text("u4")), PLUMB_COLUMN(Row, what, text("u4")),
                            PLUMB_COLUMN(Row, friction, text("f8")), PLUMB_COLUMN(Row, restitution, text("f8")),
                            PLUMB_COLUMN(Row, surface_velocity, text("(3,)f8"))});
}
template <>
py::dtype build<PlumbEvent>() {
  using Row = PlumbEvent;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, type, text("u4")), PLUMB_COLUMN(Row, body_a, text("u8")),
                            PLUMB_COLUMN(Row, body_b, text("u8")), PLUMB_COLUMN(Row, joint, text("u8"))});
}
template <>
py::dtype build<PlumbRay>() {
  using Row = PlumbRay;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, origin, text("(3,)f8")), PLUMB_COLUMN(Row, translation, text("(3,)f8")),
                            PLUMB_COLUMN(Row, filter, filter())});
}
template <>
py::dtype build<PlumbCast>() {
  using Row = PlumbCast;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, shape, text("u8")), PLUMB_POSE(Row, pose, ""),
                            PLUMB_COLUMN(Row, translation, text("(3,)f8")), PLUMB_COLUMN(Row, filter, filter())});
}
template <>
py::dtype build<PlumbTurningCast>() {
  using Row = PlumbTurningCast;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, shape, text("u8")), PLUMB_POSE(Row, pose, ""),
                            PLUMB_COLUMN(Row, translation, text("(3,)f8")), PLUMB_COLUMN(Row, rotation, text("(3,)f8")),
                            PLUMB_COLUMN(Row, filter, filter())});
}
template <>
py::dtype build<PlumbOverlap>() {
  using Row = PlumbOverlap;
  return make(sizeof(Row),
              {PLUMB_COLUMN(Row, shape, text("u8")), PLUMB_POSE(Row, pose, ""), PLUMB_COLUMN(Row, filter, filter())});
}
template <>
py::dtype build<PlumbHit>() {
  using Row = PlumbHit;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, body, text("u8")), PLUMB_COLUMN(Row, query, text("u4")),
                            PLUMB_COLUMN(Row, child, text("u4")), PLUMB_COLUMN(Row, fraction, text("f8")),
                            PLUMB_COLUMN(Row, position, text("(3,)f8")), PLUMB_COLUMN(Row, normal, text("(3,)f8"))});
}
template <>
py::dtype build<PlumbPenetration>() {
  using Row = PlumbPenetration;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, body, text("u8")), PLUMB_COLUMN(Row, query, text("u4")),
                            PLUMB_COLUMN(Row, child, text("u4")), PLUMB_COLUMN(Row, depth, text("f8")),
                            PLUMB_COLUMN(Row, position, text("(3,)f8")), PLUMB_COLUMN(Row, normal, text("(3,)f8"))});
}
template <>
py::dtype build<PlumbProbe>() {
  using Row = PlumbProbe;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, shape, text("u8")), PLUMB_POSE(Row, pose, ""),
                            PLUMB_COLUMN(Row, most_distance, text("f8")), PLUMB_COLUMN(Row, filter, filter())});
}
template <>
py::dtype build<PlumbClosest>() {
  using Row = PlumbClosest;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, body, text("u8")), PLUMB_COLUMN(Row, probe, text("u4")),
                            PLUMB_COLUMN(Row, child, text("u4")), PLUMB_COLUMN(Row, distance, text("f8")),
                            PLUMB_COLUMN(Row, on_probe, text("(3,)f8")), PLUMB_COLUMN(Row, on_body, text("(3,)f8")),
                            PLUMB_COLUMN(Row, normal, text("(3,)f8"))});
}
template <>
py::dtype build<PlumbPosedPair>() {
  using Row = PlumbPosedPair;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, shape_a, text("u8")), PLUMB_COLUMN(Row, shape_b, text("u8")),
                            PLUMB_POSE(Row, pose_a, "_a"), PLUMB_POSE(Row, pose_b, "_b")});
}
template <>
py::dtype build<PlumbPairResult>() {
  using Row = PlumbPairResult;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, distance, text("f8")), PLUMB_COLUMN(Row, first_point, text("u4")),
                            PLUMB_COLUMN(Row, point_count, text("u4"))});
}
template <>
py::dtype build<PlumbPairPoint>() {
  using Row = PlumbPairPoint;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, position, text("(3,)f8")), PLUMB_COLUMN(Row, normal, text("(3,)f8")),
                            PLUMB_COLUMN(Row, depth, text("f8")), PLUMB_COLUMN(Row, feature, text("u8"))});
}
template <>
py::dtype build<PlumbBodyPair>() {
  using Row = PlumbBodyPair;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, body_a, text("u8")), PLUMB_COLUMN(Row, body_b, text("u8"))});
}
template <>
py::dtype build<PlumbDebugPair>() {
  return build<PlumbBodyPair>();
}
template <>
py::dtype build<PlumbDebugBox>() {
  using Row = PlumbDebugBox;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, lower, text("(3,)f8")), PLUMB_COLUMN(Row, upper, text("(3,)f8")),
                            PLUMB_COLUMN(Row, body, text("u8")), PLUMB_COLUMN(Row, depth, text("i4")),
                            PLUMB_COLUMN(Row, tree, text("u4"))});
}
template <>
py::dtype build<PlumbDebugAxis>() {
  using Row = PlumbDebugAxis;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, body_a, text("u8")), PLUMB_COLUMN(Row, body_b, text("u8")),
                            PLUMB_COLUMN(Row, axis, text("(3,)f8")), PLUMB_COLUMN(Row, separation, text("f8"))});
}
template <>
py::dtype build<PlumbDebugBody>() {
  using Row = PlumbDebugBody;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, body, text("u8")), PLUMB_COLUMN(Row, island, text("i4")),
                            PLUMB_COLUMN(Row, asleep, text("u4"))});
}
template <>
py::dtype build<PlumbDebugConstraint>() {
  using Row = PlumbDebugConstraint;
  return make(sizeof(Row), {PLUMB_COLUMN(Row, body_a, text("u8")), PLUMB_COLUMN(Row, body_b, text("u8")),
                            PLUMB_COLUMN(Row, joint, text("u8")), PLUMB_COLUMN(Row, colour, text("i4"))});
}

}  // namespace

template <class Row>
const py::dtype& dtype_of() {
  static const auto* const type = new py::dtype(build<Row>());  // never freed: Python may be gone when statics go
  return *type;
}

void require_rows(const py::array& rows, const py::dtype& dtype, const char* what) {
  if (!rows.dtype().equal(dtype) || rows.ndim() != 1 || (rows.flags() & py::array::c_style) == 0)
    throw py::type_error(std::string(what) + " must be one row after another of the dtype that plumb gives for them");
}

#define PLUMB_ROWS(ROW)                     \
  ROW(PlumbBodyDesc, body_desc)             \
  ROW(PlumbJointDesc, joint_desc)           \
  ROW(PlumbCompoundChild, compound_child)   \
  ROW(PlumbMaterial, material)              \
  ROW(PlumbBodyChange, body_change)         \
  ROW(PlumbJointChange, joint_change)       \
  ROW(PlumbContact, contact)                \
  ROW(PlumbManifold, manifold)              \
  ROW(PlumbManifoldChange, manifold_change) \
  ROW(PlumbEvent, event)                    \
  ROW(PlumbRay, ray)                        \
  ROW(PlumbCast, cast)                      \
  ROW(PlumbTurningCast, turning_cast)       \
  ROW(PlumbOverlap, overlap)                \
  ROW(PlumbHit, hit)                        \
  ROW(PlumbPenetration, penetration)        \
  ROW(PlumbProbe, probe)                    \
  ROW(PlumbClosest, closest)                \
  ROW(PlumbPosedPair, posed_pair)           \
  ROW(PlumbPairResult, pair_result)         \
  ROW(PlumbPairPoint, pair_point)           \
  ROW(PlumbBodyPair, body_pair)             \
  ROW(PlumbDebugPair, debug_pair)           \
  ROW(PlumbDebugBox, debug_box)             \
  ROW(PlumbDebugAxis, debug_axis)           \
  ROW(PlumbDebugBody, debug_body)           \
  ROW(PlumbDebugConstraint, debug_constraint)

#define PLUMB_INSTANTIATE(Row, name) template const py::dtype& dtype_of<Row>();
PLUMB_ROWS(PLUMB_INSTANTIATE)

void bind_dtypes(py::module_& module) {
  module.def("columns_of", &columns_of);
  module.def("joint_columns_of", &joint_columns_of);
#define PLUMB_BIND(Row, name) module.attr(#name) = dtype_of<Row>();
  PLUMB_ROWS(PLUMB_BIND)
}

}  // namespace plumb::python
