//! Plumb, a stable interface to rigid-body physics engines, for Rust: `plumb/plumb.h`, by the same names.
//!
//! Generated from plumb.h and what it includes by api/ffi/generate.py: edit those.
//! Take the file as it is, as a module: `mod plumb;`. Every struct's `Default` is all zero, with `struct_size` set,
//! where it has one. Functions of tables are `Option`s; look at a table's `struct_size` before you take later ones.
#![allow(dead_code, non_snake_case, non_camel_case_types)]

use std::ffi::CStr;
use std::marker::{PhantomData, PhantomPinned};
use std::os::raw::{c_char, c_void};

// Zero is a value of every member: numbers, null pointers, no function.
macro_rules! zero {
    ($($name:ident),*) => {$(
        impl Default for $name {
            fn default() -> Self {
                unsafe { std::mem::zeroed() }
            }
        }
    )*};
}
macro_rules! sized {
    ($($name:ident),*) => {$(
        impl Default for $name {
            fn default() -> Self {
                let zero: Self = unsafe { std::mem::zeroed() };
                Self { struct_size: std::mem::size_of::<Self>() as u32, ..zero }
            }
        }
    )*};
}

// --- plumb/types.h
// Plain values that cross the wall: results, handles, vectors, poses.

/// The revision of this interface. Minor versions only append; nothing that is here moves or changes its meaning.
pub const fn PLUMB_MAKE_VERSION(major: u32, minor: u32) -> u32 {
    ((major as u32) << 16) | (minor as u32)
}

pub const fn PLUMB_VERSION_MAJOR(version: u32) -> u32 {
    (version as u32) >> 16
}

pub const fn PLUMB_VERSION_MINOR(version: u32) -> u32 {
    (version as u32) & 0xffff
}

pub const PLUMB_VERSION: u32 = 65538;

/// 0: done. Above 0: done, with a remark. Below 0: failed and nothing changed, except after WORLD_LOST and DEVICE_LOST,
/// when only destroying the world and reading the error text remain legal.
pub type PlumbResult = i32;

pub const PLUMB_OK: PlumbResult = 0;
/// the caller's array was too short: it is full, and the count says how many there are
pub const PLUMB_TRUNCATED: PlumbResult = 1;
/// a capacity had to grow; this call cost more than usual
pub const PLUMB_GROWN: PlumbResult = 2;
/// state was copied because it could not be lent
pub const PLUMB_COPIED: PlumbResult = 3;
/// a value out of its range, not finite, or a null where none is allowed
pub const PLUMB_E_INVALID_ARGUMENT: PlumbResult = -1;
/// the handle never existed here, or its object is gone
pub const PLUMB_E_STALE_HANDLE: PlumbResult = -2;
/// the engine cannot do this; the text says what is missing
pub const PLUMB_E_UNSUPPORTED: PlumbResult = -3;
/// needs a bit that PlumbWorldDesc.needs did not declare
pub const PLUMB_E_NOT_DECLARED: PlumbResult = -4;
pub const PLUMB_E_OUT_OF_MEMORY: PlumbResult = -5;
/// for example a read between step and wait
pub const PLUMB_E_WRONG_PHASE: PlumbResult = -6;
/// two callers at a time where only one is allowed
pub const PLUMB_E_WRONG_THREAD: PlumbResult = -7;
/// host and backend have no interface version in common
pub const PLUMB_E_VERSION: PlumbResult = -8;
/// a backend of the same exclusion group is already open in this process
pub const PLUMB_E_EXCLUDED: PlumbResult = -9;
/// the shape still has bodies, or the body still has joints
pub const PLUMB_E_IN_USE: PlumbResult = -10;
/// a snapshot, trace or cooked shape that is foreign, torn or of another version
pub const PLUMB_E_CORRUPT: PlumbResult = -11;
/// an exception inside the backend; its text is the error text
pub const PLUMB_E_INTERNAL: PlumbResult = -12;
pub const PLUMB_E_WORLD_LOST: PlumbResult = -13;
pub const PLUMB_E_DEVICE_LOST: PlumbResult = -14;

/// Handles are values: the slot in the low 32 bits, the slot's generation (from 1) in the high 32. 0 is no object. A
/// handle of a destroyed object stays stale for ever and is answered with PLUMB_E_STALE_HANDLE.
pub type PlumbShape = u64;

pub type PlumbBody = u64;

pub type PlumbJoint = u64;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbVec3 {
    pub x: f64,
    pub y: f64,
    pub z: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbQuat {
    pub x: f64,
    pub y: f64,
    pub z: f64,
    pub w: f64,
}

/// A rigid placement: a point p of the local frame is at position + orientation \* p.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbPose {
    /// m
    pub position: PlumbVec3,
    /// unit
    pub orientation: PlumbQuat,
}

/// How truly an engine has a thing. Ordered: a larger value is better.
pub type PlumbDegree = i32;

/// absent: asking for it is PLUMB_E_UNSUPPORTED
pub const PLUMB_NONE: PlumbDegree = 0;
/// there, with a meaning that differs from the interface's; the note says how
pub const PLUMB_APPROXIMATE: PlumbDegree = 1;
/// there with the right meaning, made by the adapter out of other things
pub const PLUMB_EMULATED: PlumbDegree = 2;
pub const PLUMB_NATIVE: PlumbDegree = 3;

pub type PlumbDataType = u32;

pub const PLUMB_F32: PlumbDataType = 1;
pub const PLUMB_F64: PlumbDataType = 2;

/// Opaque: made and owned by a backend.
#[repr(C)]
pub struct PlumbWorld {
    nothing: [u8; 0],
    owned_by_the_backend: PhantomData<(*mut u8, PhantomPinned)>,
}

// --- plumb/shapes.h
// Collision shapes. A shape may be shared by any number of bodies of its world, and stays what it is; but for meshes
// and height fields, which modify.h lets become others where the backend can.

pub type PlumbShapeType = u32;

/// radius
pub const PLUMB_SPHERE: PlumbShapeType = 0;
/// half_extents
pub const PLUMB_BOX: PlumbShapeType = 1;
/// radius, half_height of the segment along local y
pub const PLUMB_CAPSULE: PlumbShapeType = 2;
/// radius, half_height along local y
pub const PLUMB_CYLINDER: PlumbShapeType = 3;
/// vertices: the hull of them
pub const PLUMB_CONVEX_HULL: PlumbShapeType = 4;
/// vertices, indices: counter-clockwise seen from outside
pub const PLUMB_TRIANGLE_MESH: PlumbShapeType = 5;
/// heights, rows, columns, spacing
pub const PLUMB_HEIGHT_FIELD: PlumbShapeType = 6;
/// the half space y <= 0 of the local frame; static bodies only
pub const PLUMB_PLANE: PlumbShapeType = 7;
/// children
pub const PLUMB_COMPOUND: PlumbShapeType = 8;
pub const PLUMB_SHAPE_TYPE_COUNT: PlumbShapeType = 9;

/// Surface of a body. The coefficients of a PAIR are the same in every backend: friction sqrt(friction_a \*
/// friction_b), restitution max(restitution_a, restitution_b).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbMaterial {
    /// Coulomb, >= 0
    pub friction: f64,
    /// Newton, 0..1
    pub restitution: f64,
    /// m/s in the body's frame, for conveyors; needs PLUMB_NEED_SURFACE_VELOCITY when not 0
    pub surface_velocity: PlumbVec3,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbCompoundChild {
    /// not a compound, plane, mesh or height field
    pub shape: PlumbShape,
    /// of the child in the compound's frame
    pub pose: PlumbPose,
    /// 0: the body's material; 1: the one below
    pub has_material: u32,
    pub reserved: u32,
    pub material: PlumbMaterial,
}

/// Only the members of the shape's type are read. All arrays are copied before the call returns.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbShapeDesc {
    pub struct_size: u32,
    pub r#type: PlumbShapeType,
    /// m, > 0
    pub radius: f64,
    /// m, > 0 (capsule: >= 0)
    pub half_height: f64,
    /// m, > 0
    pub half_extents: PlumbVec3,
    /// xyz triples, m
    pub vertices: *const f64,
    /// hull: >= 4 and not all in one plane
    pub vertex_count: u32,
    pub triangle_count: u32,
    /// 3 a triangle, each < vertex_count
    pub indices: *const u32,
    /// rows \* columns values, m, row by row: y of the point at x = column \* spacing.x, z = row \* spacing.z. Each
    /// cell is two triangles, cut along the diagonal from (column, row + 1) to (column + 1, row).
    pub heights: *const f64,
    /// >= 2, along z; the field is centred: the origin is the middle of the rectangle, at height 0
    pub rows: u32,
    /// >= 2, along x
    pub columns: u32,
    /// x and z > 0, m; y unused
    pub spacing: PlumbVec3,
    pub children: *const PlumbCompoundChild,
    pub child_count: u32,
    /// of materials below; 0: all is the body's. Was reserved before 1.2
    pub material_count: u32,
    pub user_data: u64,
    /// Materials by triangle, where PLUMB_CAP_TRIANGLE_MATERIAL says that the backend has them: read when
    /// material_count is above 0. Their surface_velocity must be 0. Since 1.2
    pub materials: *const PlumbMaterial,
    /// For each triangle the row of its material, or PLUMB_BODY_MATERIAL. Of a mesh triangle_count; of a height field 2
    /// (rows - 1) (columns - 1): cell by cell, first along x, of each cell first the triangle at its corner (column,
    /// row).
    pub triangle_materials: *const u32,
}

/// In PlumbShapeDesc.triangle_materials: the material of the body that has the shape. Since 1.2
pub const PLUMB_BODY_MATERIAL: u32 = 4294967295;

// --- plumb/bodies.h
// Bodies, and the fields in which their state is read and written in batches.

pub type PlumbMotion = u32;

/// never moves of itself; may be teleported by writing its pose
pub const PLUMB_STATIC: PlumbMotion = 0;
/// moves as the host says and is moved by nothing
pub const PLUMB_KINEMATIC: PlumbMotion = 1;
pub const PLUMB_DYNAMIC: PlumbMotion = 2;
pub const PLUMB_MOTION_COUNT: PlumbMotion = 3;

// PlumbBodyDesc.flags
/// reports overlaps as events, pushes nothing; needs PLUMB_NEED_SENSORS. Sees every body that its filter lets it see,
/// but where both are static
pub const PLUMB_BODY_SENSOR: u32 = 1 << 0;
/// must not pass through others however fast it is; needs PLUMB_NEED_CCD
pub const PLUMB_BODY_CCD: u32 = 1 << 1;
/// a particle: orientation and angular velocity stay as they are
pub const PLUMB_BODY_NO_ROTATION: u32 = 1 << 2;
/// starts asleep; needs PLUMB_NEED_SLEEPING
pub const PLUMB_BODY_ASLEEP: u32 = 1 << 3;
pub const PLUMB_BODY_NEVER_SLEEPS: u32 = 1 << 4;
/// its manifolds are shown to the host before they are solved (manifolds.h); needs PLUMB_NEED_CONTACT_MODIFICATION.
/// Since 1.2
pub const PLUMB_BODY_MODIFY_CONTACTS: u32 = 1 << 5;

// PlumbBodyDesc.locks: motion along or about the world's axes that is taken away; needs PLUMB_NEED_AXIS_LOCKS.
pub const PLUMB_LOCK_LINEAR_X: u32 = 1 << 0;
pub const PLUMB_LOCK_LINEAR_Y: u32 = 1 << 1;
pub const PLUMB_LOCK_LINEAR_Z: u32 = 1 << 2;
pub const PLUMB_LOCK_ANGULAR_X: u32 = 1 << 3;
pub const PLUMB_LOCK_ANGULAR_Y: u32 = 1 << 4;
pub const PLUMB_LOCK_ANGULAR_Z: u32 = 1 << 5;

pub type PlumbMassMode = u32;

/// mass, centre of mass and inertia of the shape filled with density
pub const PLUMB_MASS_FROM_DENSITY: PlumbMassMode = 0;
/// as above, scaled so that the mass is mass; a body without a shape has inertia 0
pub const PLUMB_MASS_FROM_TOTAL: PlumbMassMode = 1;
/// mass, centre_of_mass, inertia and inertia_orientation as given
pub const PLUMB_MASS_EXPLICIT: PlumbMassMode = 2;

/// Whether two bodies may touch: equal non-zero groups decide (positive: always, negative: never); otherwise each one's
/// category must be in the other's mask. Single pairs: plumb.exceptions/1.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbFilter {
    /// bits
    pub category: u32,
    /// bits
    pub mask: u32,
    pub group: i32,
    pub reserved: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbBodyDesc {
    pub struct_size: u32,
    pub motion: PlumbMotion,
    pub flags: u32,
    pub locks: u32,
    /// 0: no shape, touches nothing
    pub shape: PlumbShape,
    /// of the body's frame, in which its shape is placed; the centre of mass may be elsewhere
    pub pose: PlumbPose,
    /// of the centre of mass, m/s
    pub linear_velocity: PlumbVec3,
    /// rad/s, world axes
    pub angular_velocity: PlumbVec3,
    /// dynamic bodies only
    pub mass_mode: PlumbMassMode,
    pub reserved: u32,
    /// kg/m3, > 0
    pub density: f64,
    /// kg, > 0
    pub mass: f64,
    /// body frame, m
    pub centre_of_mass: PlumbVec3,
    /// principal moments about the centre of mass, kg m2; 0 0 0 with NO_ROTATION
    pub inertia: PlumbVec3,
    /// from principal axes to the body frame
    pub inertia_orientation: PlumbQuat,
    pub material: PlumbMaterial,
    pub gravity_scale: f64,
    /// c in dv/dt = -c v, 1/s, >= 0; needs PLUMB_NEED_DAMPING when not 0
    pub linear_damping: f64,
    /// likewise for the angular velocity
    pub angular_damping: f64,
    pub filter: PlumbFilter,
    pub user_data: u64,
    /// Resistance to rolling and to spinning, where the shape is round or soft: the greatest moment along and about the
    /// normal of a contact, relative to its normal force, m. Of two bodies that touch the larger of each counts, and
    /// neither needs friction, though without it a ball slides instead of rolling. >= 0; need
    /// PLUMB_NEED_ROLLING_FRICTION when not 0. Since 1.2
    pub rolling_friction: f64,
    pub spinning_friction: f64,
}

/// A field is a row of numbers for every body. Pose and velocity rows are state: a write sets them. Force to impulse
/// rows act: a write adds to what acts on the body in the next step and is spent by it.
pub type PlumbField = u32;

/// 7: position, orientation x y z w; of the body frame
pub const PLUMB_FIELD_POSE: PlumbField = 0;
/// 6: linear of the centre of mass, angular; world axes
pub const PLUMB_FIELD_VELOCITY: PlumbField = 1;
/// 3: N at the centre of mass, write only; needs PLUMB_NEED_FORCES
pub const PLUMB_FIELD_FORCE: PlumbField = 2;
/// 3: N m, world axes, write only
pub const PLUMB_FIELD_TORQUE: PlumbField = 3;
/// 3: N s at the centre of mass, write only; changes the velocity at once
pub const PLUMB_FIELD_IMPULSE: PlumbField = 4;
/// 3: N m s, write only; changes the velocity at once
pub const PLUMB_FIELD_ANGULAR_IMPULSE: PlumbField = 5;
/// 6: force, world point, write only
pub const PLUMB_FIELD_FORCE_AT_POINT: PlumbField = 6;
/// 6: impulse, world point, write only
pub const PLUMB_FIELD_IMPULSE_AT_POINT: PlumbField = 7;
/// 1: 0 asleep, 1 awake; what is not dynamic never sleeps
pub const PLUMB_FIELD_AWAKE: PlumbField = 8;
/// 7: pose that a kinematic body reaches in exactly the next step, write only. After that step it reads the velocity
/// that led there; without a new target it stands still in the one after
pub const PLUMB_FIELD_KINEMATIC_TARGET: PlumbField = 9;
/// 11: mass, centre of mass (3), principal inertia (3), inertia orientation (4); read only
pub const PLUMB_FIELD_MASS: PlumbField = 10;
/// 2: friction, restitution
pub const PLUMB_FIELD_MATERIAL: PlumbField = 11;
/// 1
pub const PLUMB_FIELD_GRAVITY_SCALE: PlumbField = 12;
/// 2: linear, angular, 1/s
pub const PLUMB_FIELD_DAMPING: PlumbField = 13;
/// 3: m/s, body frame
pub const PLUMB_FIELD_SURFACE_VELOCITY: PlumbField = 14;
/// 3: category, mask, group, as whole numbers
pub const PLUMB_FIELD_FILTER: PlumbField = 15;
/// 2: rolling, spinning, m. Since 1.2
pub const PLUMB_FIELD_ROLLING_FRICTION: PlumbField = 16;
pub const PLUMB_FIELD_COUNT: PlumbField = 17;

// --- plumb/queries.h
// plumb.queries/1: rays, shape casts and overlaps against the world as the last step left it. Always in batches.

pub const PLUMB_EXT_QUERIES: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.queries/1\0") };

/// First argument of PLUMB_CAP_QUERY; the second is the shape type that is cast or overlapped (0 for rays).
pub type PlumbQueryKind = u32;

pub const PLUMB_QUERY_RAY: PlumbQueryKind = 0;
pub const PLUMB_QUERY_CAST: PlumbQueryKind = 1;
pub const PLUMB_QUERY_OVERLAP: PlumbQueryKind = 2;
/// since 1.2
pub const PLUMB_QUERY_PENETRATION: PlumbQueryKind = 3;
/// since 1.2
pub const PLUMB_QUERY_TURNING_CAST: PlumbQueryKind = 4;
pub const PLUMB_QUERY_KIND_COUNT: PlumbQueryKind = 5;

pub type PlumbHitMode = u32;

/// hits has one row a query, in its order; body 0 where nothing was hit
pub const PLUMB_HIT_CLOSEST: PlumbHitMode = 0;
/// hits has all rows, sorted by query, then fraction, then body slot: one a body
pub const PLUMB_HIT_ALL: PlumbHitMode = 1;

/// Sees a body when the rule of PlumbFilter says that the two may touch. Sensors are not seen. Of a body in which the
/// ray starts engines tell different things: a hit at fraction 0, the far side, or nothing; see the note of
/// PLUMB_CAP_QUERY.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbRay {
    /// m
    pub origin: PlumbVec3,
    /// m: direction and length in one, not 0
    pub translation: PlumbVec3,
    pub filter: PlumbFilter,
}

/// A convex shape moved without turning. A shape that overlaps at the start hits at fraction 0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbCast {
    /// sphere, box, capsule, cylinder or hull
    pub shape: PlumbShape,
    pub pose: PlumbPose,
    /// m, not 0
    pub translation: PlumbVec3,
    pub filter: PlumbFilter,
}

/// A convex shape that turns on its way, about the place of its pose: at a fraction f of the way it is at pose.position
/// + f \* translation, turned from pose.orientation by f \* |rotation| rad about rotation. One of translation and
/// rotation may be 0. Since 1.2.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbTurningCast {
    /// sphere, box, capsule, cylinder or hull
    pub shape: PlumbShape,
    pub pose: PlumbPose,
    /// m
    pub translation: PlumbVec3,
    /// rad, world axes; its length at most 2 pi: a whole turn
    pub rotation: PlumbVec3,
    pub filter: PlumbFilter,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbOverlap {
    pub shape: PlumbShape,
    pub pose: PlumbPose,
    pub filter: PlumbFilter,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbHit {
    /// 0: nothing
    pub body: PlumbBody,
    /// index into the batch
    pub query: u32,
    /// of a compound, triangle of a mesh; else 0, also for a height field
    pub child: u32,
    /// of the way, 0..1; 0 for overlaps
    pub fraction: f64,
    /// world, m; NaN for overlaps
    pub position: PlumbVec3,
    /// of the surface that was hit, unit; NaN for overlaps
    pub normal: PlumbVec3,
}

/// How deep a shape overlaps a body, and which way out, as plumb.collide/1 tells of the two: of a body with several
/// children, or a surface with several triangles, that which is deepest. Convex shapes are solid and a plane is solid
/// below; surfaces have nothing inside. Since 1.2.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbPenetration {
    pub body: PlumbBody,
    /// index into the batch
    pub query: u32,
    /// of a compound, triangle of a mesh; else 0, also for a height field
    pub child: u32,
    /// m, >= 0: how far the shape moves along normal until it only touches what it is deepest in
    pub depth: f64,
    /// world, m: where it is deepest, on either surface or between them
    pub position: PlumbVec3,
    /// unit, from the body to the shape: the way out
    pub normal: PlumbVec3,
}

/// hits\[capacity\]; \*hit_count is how many there are, also when the answer is PLUMB_TRUNCATED. Strides are in bytes.
/// All \[query\]: any number at once while no step runs.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbQueriesTable {
    pub struct_size: u32,
    pub reserved: u32,
    pub rays: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, mode: PlumbHitMode, rays: *const PlumbRay, stride: usize, count: u32,
        hits: *mut PlumbHit, capacity: u32, hit_count: *mut u32
    ) -> PlumbResult>,
    pub casts: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, mode: PlumbHitMode, casts: *const PlumbCast, stride: usize, count: u32,
        hits: *mut PlumbHit, capacity: u32, hit_count: *mut u32
    ) -> PlumbResult>,
    /// Always all hits.
    pub overlaps: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, overlaps: *const PlumbOverlap, stride: usize, count: u32, hits: *mut PlumbHit,
        capacity: u32, hit_count: *mut u32
    ) -> PlumbResult>,
    /// Of all bodies that a shape overlaps: out\[capacity\] has a row for each, sorted by query, then depth, the
    /// deepest first, then body slot. Bodies that touch the shape without depth may be told or not. PLUMB_CAP_QUERY
    /// with PLUMB_QUERY_PENETRATION says of which shapes; a table that ends before has it not. Since 1.2.
    pub penetrations: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, overlaps: *const PlumbOverlap, stride: usize, count: u32, out: *mut PlumbPenetration,
        capacity: u32, out_count: *mut u32
    ) -> PlumbResult>,
    /// As casts are, of shapes that turn on the way: the first touch on it, though it may be a corner's that swings out
    /// and back. PLUMB_CAP_QUERY with PLUMB_QUERY_TURNING_CAST says of which shapes; a table that ends before has it
    /// not. Since 1.2.
    pub turning_casts: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, mode: PlumbHitMode, casts: *const PlumbTurningCast, stride: usize, count: u32,
        hits: *mut PlumbHit, capacity: u32, hit_count: *mut u32
    ) -> PlumbResult>,
}

// --- plumb/closest.h
// plumb.closest/1: which bodies are near a convex shape, how far away, and where, in the world as the last step left
// it. Always in batches. Since 1.2.

pub const PLUMB_EXT_CLOSEST: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.closest/1\0") };

/// Looks around a shape that need not be in the world. Sees a body when the rule of PlumbFilter says that the two may
/// touch. Sensors are not seen. To look around a point give a small sphere and add its radius to distances.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbProbe {
    /// sphere, box, capsule, cylinder or hull; PLUMB_CAP_CLOSEST says which
    pub shape: PlumbShape,
    pub pose: PlumbPose,
    /// m, > 0 and finite: what is further away is not looked for
    pub most_distance: f64,
    pub filter: PlumbFilter,
}

/// The shortest way from a probe to a body. Convex shapes are solid and a plane is solid below; meshes and height
/// fields are surfaces with two sides and nothing inside. Of several ways that are equally short it is one of them.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbClosest {
    /// 0: nothing is within most_distance; then what follows child is NaN
    pub body: PlumbBody,
    /// index into the batch
    pub probe: u32,
    /// of a compound, triangle of a mesh; else 0, also for a height field. The first of equal ones; where distance is 0
    /// one of those that touch
    pub child: u32,
    /// m, >= 0; 0 where they touch or overlap: plumb.collide/1 tells how deep
    pub distance: f64,
    /// world, m: the point of the probe's surface; NaN where distance is 0
    pub on_probe: PlumbVec3,
    /// world, m: the point of the body's surface; NaN where distance is 0
    pub on_body: PlumbVec3,
    /// unit, from the probe to the body; NaN where distance is 0
    pub normal: PlumbVec3,
}

/// Needs PLUMB_NEED_QUERIES.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbClosestTable {
    pub struct_size: u32,
    pub reserved: u32,
    /// \[query\] PLUMB_HIT_CLOSEST: one row a probe, in their order, of the body that is nearest; of bodies that are
    /// equally near of the one in the lower slot. PLUMB_HIT_ALL: a row for each body within most_distance, sorted by
    /// probe, then distance, then body slot. out\[capacity\] is the caller's; \*out_count is how many there are, also
    /// when the answer is PLUMB_TRUNCATED. stride is in bytes, sizeof the caller's probe. A shape that is not convex,
    /// and a number that may not be, are PLUMB_E_INVALID_ARGUMENT; then nothing is written.
    pub bodies: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, mode: PlumbHitMode, probes: *const PlumbProbe, stride: usize, count: u32,
        out: *mut PlumbClosest, capacity: u32, out_count: *mut u32
    ) -> PlumbResult>,
}

// --- plumb/collide.h
// plumb.collide/1: collision without a step. Posed shapes in, contacts and distances out.

pub const PLUMB_EXT_COLLIDE: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.collide/1\0") };

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbPosedPair {
    pub shape_a: PlumbShape,
    pub shape_b: PlumbShape,
    pub pose_a: PlumbPose,
    pub pose_b: PlumbPose,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbPairResult {
    /// m; negative: depth of the deepest contact; NaN when apart and the engine does not tell
    pub distance: f64,
    /// into points
    pub first_point: u32,
    pub point_count: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbPairPoint {
    /// world, m
    pub position: PlumbVec3,
    /// unit, from a to b
    pub normal: PlumbVec3,
    /// m; positive: overlap
    pub depth: f64,
    /// 0: not known
    pub feature: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbCollideTable {
    pub struct_size: u32,
    pub reserved: u32,
    /// \[query\] results\[count\], points\[capacity\]; \*point_count is how many there are, also when PLUMB_TRUNCATED.
    pub pairs: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, pairs: *const PlumbPosedPair, stride: usize, count: u32, results: *mut PlumbPairResult,
        points: *mut PlumbPairPoint, capacity: u32, point_count: *mut u32
    ) -> PlumbResult>,
}

// --- plumb/cooking.h
// plumb.cooking/1: shapes worked out ahead, in a build step or on threads that load, and made from bytes in a world.
// Since 1.2.

pub const PLUMB_EXT_COOKING: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.cooking/1\0") };

/// What cook gives. Set struct_size.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbCooked {
    pub struct_size: u32,
    pub reserved: u32,
    /// the backend's, until release is given it; null when the result is below 0
    pub data: *const c_void,
    /// bytes
    pub size: u64,
    /// why not, when the result is below 0: one sentence that says what to do
    pub message: [c_char; 256],
}

/// Bytes that cook gave, in the caller's memory, at any address.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbCookedShape {
    pub struct_size: u32,
    pub reserved: u32,
    pub data: *const c_void,
    /// bytes
    pub size: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbCookingTable {
    pub struct_size: u32,
    pub reserved: u32,
    /// \[any\] A descriptor is refused as create_shapes refuses it. Compounds are not cooked: cook their children, and
    /// create the compound from the handles of these. user_data is not in the bytes.
    pub cook: Option<unsafe extern "C" fn(desc: *const PlumbShapeDesc, cooked: *mut PlumbCooked) -> PlumbResult>,
    /// \[any\] Takes null.
    pub release: Option<unsafe extern "C" fn(data: *const c_void)>,
    /// \[world\] As create_shapes does, all or none: a shape from bytes is to the bit what its descriptor would have
    /// made of it, in steps, queries, snapshots and when it is modified. The bytes are copied before the call returns.
    /// stride is sizeof the caller's row. PLUMB_E_CORRUPT for bytes that are torn, changed, of another backend,
    /// precision or byte order, or of another version of the format: keep the descriptors, and cook anew.
    /// PLUMB_E_NOT_DECLARED where materials by triangle ask for what the world's needs lack.
    pub create: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, shapes: *const PlumbCookedShape, stride: usize, count: u32, ids: *mut PlumbShape
    ) -> PlumbResult>,
}

// --- plumb/debug.h
// plumb.debug/1: what the engine sees, for pictures and for tests that want no back door.

pub const PLUMB_EXT_DEBUG: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.debug/1\0") };

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbDebugPair {
    pub body_a: PlumbBody,
    pub body_b: PlumbBody,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbDebugBox {
    /// world, m
    pub lower: PlumbVec3,
    /// world, m
    pub upper: PlumbVec3,
    /// of a leaf; 0 for an inner node
    pub body: PlumbBody,
    /// below the root, 0 for the root; -1 where there is no tree
    pub depth: i32,
    /// engines with several trees number them
    pub tree: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbDebugAxis {
    pub body_a: PlumbBody,
    pub body_b: PlumbBody,
    /// unit, from a to b: of least overlap, or separating
    pub axis: PlumbVec3,
    /// m along the axis; negative: overlap
    pub separation: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbDebugBody {
    pub body: PlumbBody,
    /// bodies of one number are bound by contacts and joints and fall asleep together; -1: of none
    pub island: i32,
    /// 0 or 1
    pub asleep: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbDebugConstraint {
    /// body_a is 0 for a joint with the world
    pub body_a: PlumbBody,
    /// body_a is 0 for a joint with the world
    pub body_b: PlumbBody,
    /// 0 for the contacts of two bodies
    pub joint: PlumbJoint,
    /// constraints of one colour share no dynamic body and are solved at once; -1: one by one
    pub colour: i32,
    /// 0
    pub reserved: u32,
}

/// As of the last step. \[world\]. out\[capacity\]; \*count is how many there are, also when PLUMB_TRUNCATED. A backend
/// answers PLUMB_E_UNSUPPORTED to what it cannot show.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbDebugTable {
    pub struct_size: u32,
    pub reserved: u32,
    pub pairs: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, out: *mut PlumbDebugPair, capacity: u32, count: *mut u32
    ) -> PlumbResult>,
    pub boxes: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, out: *mut PlumbDebugBox, capacity: u32, count: *mut u32
    ) -> PlumbResult>,
    pub axes: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, out: *mut PlumbDebugAxis, capacity: u32, count: *mut u32
    ) -> PlumbResult>,
    /// Since 1.1: look at struct_size before. Every body that lives, once.
    pub bodies: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, out: *mut PlumbDebugBody, capacity: u32, count: *mut u32
    ) -> PlumbResult>,
    /// Since 1.1. What the last step's solver had to satisfy.
    pub constraints: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, out: *mut PlumbDebugConstraint, capacity: u32, count: *mut u32
    ) -> PlumbResult>,
}

// --- plumb/exceptions.h
// plumb.exceptions/1: excluded pairs: bodies that do not touch, whatever their filters say.

pub const PLUMB_EXT_EXCEPTIONS: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.exceptions/1\0") };

/// The order of the two does not matter.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbBodyPair {
    pub body_a: PlumbBody,
    pub body_b: PlumbBody,
}

/// An exception lasts until it is taken back or one of its bodies is destroyed: a later body in the same slot has none.
/// Neither contacts nor sensors see a pair that is excepted; queries do. It stands beside what joints say of their
/// bodies (collide_connected): each may keep a pair apart by itself. Needs no PLUMB_NEED bit, as it costs nothing where
/// it is not used. Snapshots hold the exceptions of their time.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbExceptionsTable {
    pub struct_size: u32,
    pub reserved: u32,
    /// \[world\] All or none. touch 0: from the next step on the two do not touch, and a contact that they had ends
    /// with that step's events; 1: they touch as their filters say again. Bodies that sleep wake where that changes
    /// something; setting what is so already is fine. stride is sizeof the caller's pair. A body with itself, or
    /// another touch, is PLUMB_E_INVALID_ARGUMENT.
    pub set: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, pairs: *const PlumbBodyPair, stride: usize, count: u32, touch: u32
    ) -> PlumbResult>,
    /// \[world\] The exceptions there are, the lower slot of each first, in the order of body_a's slot, then body_b's.
    /// out\[capacity\]; \*count is how many there are, also when PLUMB_TRUNCATED.
    pub list: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, out: *mut PlumbBodyPair, capacity: u32, count: *mut u32
    ) -> PlumbResult>,
}

// --- plumb/joints.h
// plumb.joints/1: joints between two bodies, or between a body and the world.

pub const PLUMB_EXT_JOINTS: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.joints/1\0") };

pub type PlumbJointType = u32;

/// origins coincide
pub const PLUMB_JOINT_BALL: PlumbJointType = 0;
/// origins and x axes coincide; free axis 3
pub const PLUMB_JOINT_HINGE: PlumbJointType = 1;
/// orientations equal, b's origin on a's x axis; free axis 0
pub const PLUMB_JOINT_SLIDER: PlumbJointType = 2;
/// distance of the origins: rest_length, or within limits\[0\]; spring on axis 0
pub const PLUMB_JOINT_DISTANCE: PlumbJointType = 3;
/// frames coincide
pub const PLUMB_JOINT_FIXED: PlumbJointType = 4;
/// origins coincide, a's x axis stays square to b's y axis; free axes 3 and 4
pub const PLUMB_JOINT_UNIVERSAL: PlumbJointType = 5;
/// axis_modes say which of the six axes are free, locked or limited
pub const PLUMB_JOINT_GENERIC: PlumbJointType = 6;
/// origins coincide; axes 3 4 5 are a twist and a swing (head of joints.h)
pub const PLUMB_JOINT_SWING_TWIST: PlumbJointType = 7;
/// turns about both x axes (head of joints.h). Since 1.2
pub const PLUMB_JOINT_GEAR: PlumbJointType = 8;
/// a's turn about its x axis and b's way along its own. Since 1.2
pub const PLUMB_JOINT_RACK_AND_PINION: PlumbJointType = 9;
pub const PLUMB_JOINT_TYPE_COUNT: PlumbJointType = 10;

pub type PlumbAxisMode = u32;

pub const PLUMB_AXIS_FREE: PlumbAxisMode = 0;
pub const PLUMB_AXIS_LOCKED: PlumbAxisMode = 1;
pub const PLUMB_AXIS_LIMITED: PlumbAxisMode = 2;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbLimit {
    /// m or rad; lower <= upper
    pub lower: f64,
    /// m or rad; lower <= upper
    pub upper: f64,
    pub enabled: u32,
    pub reserved: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbMotor {
    /// m/s or rad/s, of b seen from a
    pub target_velocity: f64,
    /// N or N m, >= 0
    pub max_force: f64,
    pub enabled: u32,
    pub reserved: u32,
}

/// What a spring's two numbers are. By stiffness needs PLUMB_JOINT_HAS_STIFFNESS.
pub type PlumbSpringMode = u32;

/// frequency and damping ratio with the pair's effective mass on the axis
pub const PLUMB_SPRING_FREQUENCY: PlumbSpringMode = 0;
/// stiffness and damping: force = -stiffness (x - rest) - damping dx/dt. A stiffness of 0 is a damper; with rest as the
/// target it is a PD controller.
pub const PLUMB_SPRING_STIFFNESS: PlumbSpringMode = 1;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbSpring {
    /// m or rad; for a distance joint its rest_length is used instead
    pub rest: f64,
    /// Hz, of the undamped spring, > 0; by stiffness: N/m or N m/rad, >= 0
    pub frequency: f64,
    /// 1 is critical, >= 0; by stiffness: N s/m or N m s/rad
    pub damping_ratio: f64,
    pub enabled: u32,
    pub mode: PlumbSpringMode,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbJointDesc {
    pub struct_size: u32,
    pub r#type: PlumbJointType,
    /// 0: the world; its frame is then in world axes
    pub body_a: PlumbBody,
    /// not 0
    pub body_b: PlumbBody,
    /// in body a's frame
    pub frame_a: PlumbPose,
    /// in body b's frame
    pub frame_b: PlumbPose,
    /// 0: the two bodies do not touch each other
    pub collide_connected: u32,
    pub reserved: u32,
    /// generic only
    pub axis_modes: [PlumbAxisMode; 6],
    pub limits: [PlumbLimit; 6],
    pub motors: [PlumbMotor; 6],
    pub springs: [PlumbSpring; 6],
    /// distance, m, >= 0
    pub rest_length: f64,
    /// N, 0: never breaks
    pub break_force: f64,
    /// N m, 0: never breaks
    pub break_torque: f64,
    pub user_data: u64,
    /// gear, rack and pinion: not 0; b's teeth by a's, or rad/m. Since 1.2
    pub ratio: f64,
}

/// Rows of a joint, read in batches.
pub type PlumbJointField = u32;

/// 6: coordinates of the six axes (angles in -pi..pi)
pub const PLUMB_JOINT_COORDINATES: PlumbJointField = 0;
/// 6: force, torque on body b at frame b's origin in the last step, world axes; N, N m
pub const PLUMB_JOINT_REACTION: PlumbJointField = 1;
/// 12: target velocity and max force of axis 0, of axis 1, ...; also written
pub const PLUMB_JOINT_MOTOR: PlumbJointField = 2;
/// 6: rest of the spring of axis 0, of axis 1, ...: the targets of PD controllers; of a distance joint the first is its
/// rest_length, >= 0. Also written, which needs PLUMB_JOINT_HAS_TARGETS. Since 1.2.
pub const PLUMB_JOINT_SPRING_REST: PlumbJointField = 3;
pub const PLUMB_JOINT_FIELD_COUNT: PlumbJointField = 4;

/// What a joint type may have beyond itself; second argument of PLUMB_CAP_JOINT_FEATURE.
pub type PlumbJointFeature = u32;

pub const PLUMB_JOINT_HAS_LIMITS: PlumbJointFeature = 0;
pub const PLUMB_JOINT_HAS_MOTORS: PlumbJointFeature = 1;
pub const PLUMB_JOINT_HAS_SPRINGS: PlumbJointFeature = 2;
pub const PLUMB_JOINT_BREAKS: PlumbJointFeature = 3;
pub const PLUMB_JOINT_HAS_REACTION: PlumbJointFeature = 4;
/// springs by PLUMB_SPRING_STIFFNESS
pub const PLUMB_JOINT_HAS_STIFFNESS: PlumbJointFeature = 5;
/// its PLUMB_JOINT_SPRING_REST rows can be written
pub const PLUMB_JOINT_HAS_TARGETS: PlumbJointFeature = 6;
pub const PLUMB_JOINT_FEATURE_COUNT: PlumbJointFeature = 7;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbJointsTable {
    pub struct_size: u32,
    pub reserved: u32,
    /// \[world\] All or none; ids\[count\].
    pub create: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, descs: *const PlumbJointDesc, stride: usize, count: u32, ids: *mut PlumbJoint
    ) -> PlumbResult>,
    /// \[world\] All or none.
    pub destroy: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, ids: *const PlumbJoint, count: u32
    ) -> PlumbResult>,
    /// \[world\] ids null: the first count live joints in order of creation. stride in bytes between rows.
    pub read: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, field: PlumbJointField, r#type: PlumbDataType, ids: *const PlumbJoint, count: u32,
        rows: *mut c_void, stride: usize
    ) -> PlumbResult>,
    /// \[world\] Likewise; PLUMB_JOINT_MOTOR and PLUMB_JOINT_SPRING_REST. What sleeps and is written to wakes.
    pub write: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, field: PlumbJointField, r#type: PlumbDataType, ids: *const PlumbJoint, count: u32,
        rows: *const c_void, stride: usize
    ) -> PlumbResult>,
}

// --- plumb/manifolds.h
// plumb.manifolds/1: contact modification: what touches is shown to the host before the solver sees it. Since 1.2.

pub const PLUMB_EXT_MANIFOLDS: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.manifolds/1\0") };

// PlumbManifoldChange.what: the members that count; the others are not read.
/// in this step the two do not touch there: no contact, no event, no impact
pub const PLUMB_MANIFOLD_DISABLED: u32 = 1 << 0;
/// needs PLUMB_NEED_FRICTION
pub const PLUMB_MANIFOLD_FRICTION: u32 = 1 << 1;
/// needs PLUMB_NEED_RESTITUTION
pub const PLUMB_MANIFOLD_RESTITUTION: u32 = 1 << 2;
/// needs PLUMB_NEED_SURFACE_VELOCITY
pub const PLUMB_MANIFOLD_SURFACE_VELOCITY: u32 = 1 << 3;

pub const PLUMB_MANIFOLD_CHANGE_COUNT: u32 = 4;
pub const PLUMB_MANIFOLD_POINTS: u32 = 4;

/// Where two shapes, or a shape and a triangle, touch or are about to: up to four points of one plane. Engines that
/// make one contact of those with several triangles leave them apart for bodies with PLUMB_BODY_MODIFY_CONTACTS.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbManifold {
    pub body_a: PlumbBody,
    pub body_b: PlumbBody,
    /// child of a compound, triangle of a mesh; else 0
    pub child_a: u32,
    /// child of a compound, triangle of a mesh; else 0
    pub child_b: u32,
    /// 1 to PLUMB_MANIFOLD_POINTS
    pub point_count: u32,
    pub reserved: u32,
    /// unit, from a to b, world axes
    pub normal: PlumbVec3,
    /// of b against a where they touch (the mean of the points), as the step began, m/s
    pub velocity: PlumbVec3,
    /// world, m; as PlumbContact's
    pub position: [PlumbVec3; 4],
    /// m; positive: overlap, negative: gap
    pub depth: [f64; 4],
    /// of the two together, and likewise what follows
    pub friction: f64,
    pub restitution: f64,
    /// with which b's surface runs over a's while both bodies stand, m/s, world axes
    pub surface_velocity: PlumbVec3,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbManifoldChange {
    /// row of the last read
    pub manifold: u32,
    /// PLUMB_MANIFOLD_ bits
    pub what: u32,
    /// >= 0
    pub friction: f64,
    /// 0 to 1
    pub restitution: f64,
    pub surface_velocity: PlumbVec3,
}

/// Needs PLUMB_NEED_CONTACT_MODIFICATION; PLUMB_CAP_MANIFOLD tells what an engine can change. Changes are of this step
/// alone.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbManifoldsTable {
    pub struct_size: u32,
    pub reserved: u32,
    /// \[world\] Between step and wait: the manifolds of bodies that have PLUMB_BODY_MODIFY_CONTACTS, of those who do
    /// not sleep, before the solver sees them. out\[capacity\]; \*count is how many there are, also when
    /// PLUMB_TRUNCATED; asked again they are the same until modify is called. An engine that takes a step in parts, or
    /// over again, has more after that, so read and modify until \*count is 0. What was not read is solved as it is.
    /// stride is sizeof the caller's row.
    pub read: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, out: *mut PlumbManifold, stride: usize, capacity: u32, count: *mut u32
    ) -> PlumbResult>,
    /// \[world\] All or none; changes what was read last, each manifold at most once (count 0: nothing), and the step
    /// goes on. Without manifolds that were read since the step began, or the last call, PLUMB_E_WRONG_PHASE.
    pub modify: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, changes: *const PlumbManifoldChange, stride: usize, count: u32
    ) -> PlumbResult>,
}

// --- plumb/modify.h
// plumb.modify/1: bodies, joints and shapes that become others while they live. Since 1.2.

pub const PLUMB_EXT_MODIFY: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.modify/1\0") };

// PlumbBodyChange.what: the members that count; the others are not read.
/// motion. What becomes dynamic keeps the velocity that it had, and the mass of when it was dynamic last; a body that
/// never was needs PLUMB_MODIFY_MASS, too. What becomes kinematic or static stands still. Joints may be left between
/// bodies that are not dynamic: they do nothing until one of the two is.
pub const PLUMB_MODIFY_MOTION: u32 = 1 << 0;
/// shape; 0: none. The mass stays as it is without PLUMB_MODIFY_MASS
pub const PLUMB_MODIFY_SHAPE: u32 = 1 << 1;
/// mass_mode and what it reads, with the shape that the body has after this call; dynamic bodies only. The body goes on
/// as it moved: when its centre of mass is elsewhere, its linear velocity is that of the new one.
pub const PLUMB_MODIFY_MASS: u32 = 1 << 2;
/// flags, but PLUMB_BODY_ASLEEP (write PLUMB_FIELD_AWAKE). A body that is to turn and had PLUMB_BODY_NO_ROTATION needs
/// PLUMB_MODIFY_MASS, too.
pub const PLUMB_MODIFY_FLAGS: u32 = 1 << 3;
/// locks; velocity along what is locked is gone
pub const PLUMB_MODIFY_LOCKS: u32 = 1 << 4;

pub const PLUMB_MODIFY_BODY_COUNT: u32 = 5;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbBodyChange {
    pub body: PlumbBody,
    /// PLUMB_MODIFY_ bits of bodies
    pub what: u32,
    pub motion: PlumbMotion,
    pub flags: u32,
    pub locks: u32,
    pub shape: PlumbShape,
    pub mass_mode: PlumbMassMode,
    pub reserved: u32,
    pub density: f64,
    pub mass: f64,
    pub centre_of_mass: PlumbVec3,
    pub inertia: PlumbVec3,
    pub inertia_orientation: PlumbQuat,
}

// PlumbJointChange.what
/// frame_a, frame_b: the joint pulls its bodies there
pub const PLUMB_MODIFY_FRAMES: u32 = 1 << 0;
/// limits; rest_length of a distance joint; axis_modes of a generic one
pub const PLUMB_MODIFY_LIMITS: u32 = 1 << 1;
/// motors; PLUMB_JOINT_MOTOR rows change less and cost less
pub const PLUMB_MODIFY_MOTORS: u32 = 1 << 2;
/// springs; likewise PLUMB_JOINT_SPRING_REST rows
pub const PLUMB_MODIFY_SPRINGS: u32 = 1 << 3;
/// break_force, break_torque
pub const PLUMB_MODIFY_STRENGTH: u32 = 1 << 4;
/// collide_connected
pub const PLUMB_MODIFY_COLLIDE_CONNECTED: u32 = 1 << 5;
/// enabled; a joint that is not lets its bodies go and touch, and waits for 1
pub const PLUMB_MODIFY_ENABLED: u32 = 1 << 6;

pub const PLUMB_MODIFY_JOINT_COUNT: u32 = 7;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbJointChange {
    pub joint: PlumbJoint,
    /// PLUMB_MODIFY_ bits of joints
    pub what: u32,
    /// 0 or 1; a joint is made enabled
    pub enabled: u32,
    pub collide_connected: u32,
    pub reserved: u32,
    pub frame_a: PlumbPose,
    pub frame_b: PlumbPose,
    pub axis_modes: [PlumbAxisMode; 6],
    pub limits: [PlumbLimit; 6],
    pub motors: [PlumbMotor; 6],
    pub springs: [PlumbSpring; 6],
    pub rest_length: f64,
    pub break_force: f64,
    pub break_torque: f64,
}

/// All or none; a body or joint stands in a call once. What sleeps and is changed, or rested on what is changed, wakes.
/// Contacts that a change ends, or begins, are told by the events of the next step. A snapshot of bodies with other
/// motions, shapes, masses, flags or locks is PLUMB_E_CORRUPT until they are as they were, and so is one of shapes that
/// are others. stride is sizeof the caller's row.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbModifyTable {
    pub struct_size: u32,
    pub reserved: u32,
    /// \[world\]
    pub bodies: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, changes: *const PlumbBodyChange, stride: usize, count: u32
    ) -> PlumbResult>,
    /// \[world\]
    pub joints: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, changes: *const PlumbJointChange, stride: usize, count: u32
    ) -> PlumbResult>,
    /// \[world\] Terrain that is dug, surfaces that bend: shapes\[i\] becomes what descs\[i\] says, whole and of the
    /// type that it has, for all bodies that have it; their masses stay. What sleeps where the surface is another
    /// wakes; elsewhere contacts and sleep go on. An engine finds by itself what differs: a mesh with the same indices,
    /// or a height field of the same rows, columns and spacing, costs far less than one made anew. user_data is not
    /// read. From then on a snapshot of a whole world knows the shape by what it is now.
    pub shapes: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, shapes: *const PlumbShape, descs: *const PlumbShapeDesc, stride: usize, count: u32
    ) -> PlumbResult>,
}

// --- plumb/settings.h
// plumb.settings/1: an engine's knobs by name, so that a host can list and sweep them without knowing the engine.

pub const PLUMB_EXT_SETTINGS: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.settings/1\0") };

pub type PlumbSettingType = u32;

pub const PLUMB_SETTING_BOOL: PlumbSettingType = 0;
pub const PLUMB_SETTING_INT: PlumbSettingType = 1;
pub const PLUMB_SETTING_FLOAT: PlumbSettingType = 2;
pub const PLUMB_SETTING_CHOICE: PlumbSettingType = 3;

pub type PlumbSettingRole = u32;

/// more of it costs time and buys accuracy
pub const PLUMB_ROLE_QUALITY: PlumbSettingRole = 0;
/// changes time, not results (within the engine's determinism)
pub const PLUMB_ROLE_SPEED: PlumbSettingRole = 1;
/// another model, not more or less of the same
pub const PLUMB_ROLE_BEHAVIOUR: PlumbSettingRole = 2;

// PlumbSettingInfo.flags
/// only through PlumbWorldDesc.settings
pub const PLUMB_SETTING_CREATION_ONLY: u32 = 1 << 0;

/// number holds bool (0 or 1), int and float; choice is the word of a choice, null otherwise.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbSettingValue {
    pub r#type: PlumbSettingType,
    pub reserved: u32,
    pub number: f64,
    /// \[any\] a value read from a backend lives as long as the process
    pub choice: *const c_char,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbSetting {
    pub name: *const c_char,
    pub value: PlumbSettingValue,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbSettingInfo {
    /// snake_case
    pub name: *const c_char,
    /// "m", "1", "m/s" ...; "" for bool and choice
    pub unit: *const c_char,
    /// one line
    pub doc: *const c_char,
    pub r#type: PlumbSettingType,
    pub role: PlumbSettingRole,
    pub flags: u32,
    pub choice_count: u32,
    pub choices: *const *const c_char,
    /// of int and float, both allowed
    pub minimum: f64,
    /// of int and float, both allowed
    pub maximum: f64,
    pub default_value: PlumbSettingValue,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbSettingsTable {
    pub struct_size: u32,
    /// how many settings there are
    pub count: u32,
    /// \[any\] Lives as long as the process; null when index >= count.
    pub describe: Option<unsafe extern "C" fn(index: u32) -> *const PlumbSettingInfo>,
    /// \[world\]
    pub get: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, name: *const c_char, value: *mut PlumbSettingValue
    ) -> PlumbResult>,
    /// \[world\] Takes effect in the next step.
    pub set: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, name: *const c_char, value: *const PlumbSettingValue
    ) -> PlumbResult>,
}

// --- plumb/snapshot.h
// plumb.snapshot/1: save and restore a world in memory (rollback, save games), and a 64-bit hash of its state.

pub const PLUMB_EXT_SNAPSHOT: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.snapshot/1\0") };

/// Two kinds of snapshot, both restored by restore:
/// Of what moves (save): poses, velocities, sleep, warm-start data, random state, gravity, and the pair exceptions
/// (plumb.exceptions/1). Restored into the world that saved it, while the same bodies and joints live there.
/// Of the whole world (save_world): beside these who lives and of what, every body and joint with its handle, its
/// descriptor as it is by now, user_data, and the handles that will be given out next. Restored while other bodies and
/// joints live, or into another world, of the same needs and settings, in another process or on another platform: who
/// came since is destroyed, who is gone lives again under the handle that it had, and what was created and destroyed
/// from then on gets the same handles again. Only shapes are not in it: those that its bodies have must live in the
/// world, under the same handles and with the same geometry. A handle of a body that came after the save may so be
/// given out a second time, to whoever comes in its place.
/// Native (PLUMB_CAP_SNAPSHOT; 0: of what moves, 1: of the whole) means that save, n steps, restore, n steps gives the
/// same bits; approximate that warm-start data or an engine's order of bodies is lost.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbSnapshotTable {
    pub struct_size: u32,
    pub reserved: u32,
    /// \[world\] Needs PLUMB_NEED_SNAPSHOT. \*size is what it takes; with capacity < \*size nothing is written and the
    /// answer is PLUMB_TRUNCATED. data may be null when capacity is 0.
    pub save: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, data: *mut c_void, capacity: usize, size: *mut usize
    ) -> PlumbResult>,
    /// \[world\] Of either kind. PLUMB_E_CORRUPT for data that is foreign, torn, of another version, of other bodies,
    /// or of shapes that this world has not: then nothing has changed.
    pub restore: Option<unsafe extern "C" fn(world: *mut PlumbWorld, data: *const c_void, size: usize) -> PlumbResult>,
    /// \[world\] Over pose and velocity rows in float64 in order of creation, every NaN as the same NaN. Always there.
    pub hash: Option<unsafe extern "C" fn(world: *mut PlumbWorld, hash: *mut u64) -> PlumbResult>,
    /// \[world\] As save, of the whole world. Since 1.2.
    pub save_world: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, data: *mut c_void, capacity: usize, size: *mut usize
    ) -> PlumbResult>,
}

// --- plumb/state.h
// plumb.state/1: state rows lent without a copy, as DLPack tensors (the 1.x versioned layout of dmlc/dlpack).

pub const PLUMB_EXT_STATE: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.state/1\0") };

/// Binary layout of DLPack 1.x, declared here so that nobody needs its header; a host casts to its own DLPack type.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbDLDevice {
    /// kDLCPU 1, kDLCUDA 2
    pub device_type: i32,
    pub device_id: i32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbDLDataType {
    /// kDLFloat 2
    pub code: u8,
    pub bits: u8,
    pub lanes: u16,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbDLTensor {
    pub data: *mut c_void,
    pub device: PlumbDLDevice,
    pub ndim: i32,
    pub dtype: PlumbDLDataType,
    pub shape: *mut i64,
    /// in elements
    pub strides: *mut i64,
    pub byte_offset: u64,
}

/// PlumbDLManagedTensor.version
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbDLManagedTensor_version {
    pub major: u32,
    pub minor: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbDLManagedTensor {
    pub version: PlumbDLManagedTensor_version,
    pub manager_ctx: *mut c_void,
    /// \[any\] also after the world is gone
    pub deleter: Option<unsafe extern "C" fn(self_: *mut PlumbDLManagedTensor)>,
    /// bit 0: read only, bit 1: is a copy
    pub flags: u64,
    pub dl_tensor: PlumbDLTensor,
}

/// When the rows may be read. On the host both are null and the rows are ready.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbFence {
    /// cudaStream_t that wrote the rows
    pub stream: *mut c_void,
    /// cudaEvent_t recorded after it
    pub event: *mut c_void,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbStateRequest {
    pub struct_size: u32,
    /// pose or velocity
    pub field: PlumbField,
    /// 1 host, 2 CUDA
    pub device_type: i32,
    /// 0: fail with PLUMB_E_UNSUPPORTED rather than copy; 1: copy and answer PLUMB_COPIED
    pub allow_copy: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbStateTable {
    pub struct_size: u32,
    pub reserved: u32,
    /// \[world\] Rows x columns in the engine's type. The rows stay as they are until the next step; the caller calls
    /// the tensor's deleter when done. fence may be null.
    pub borrow: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, request: *const PlumbStateRequest, tensor: *mut *mut PlumbDLManagedTensor,
        fence: *mut PlumbFence
    ) -> PlumbResult>,
    /// \[world\] Which body each row is (0: none). \*generation changes whenever the map does.
    pub rows: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, ids: *mut PlumbBody, capacity: u32, count: *mut u32, generation: *mut u64
    ) -> PlumbResult>,
}

// --- plumb/world.h
// A world, its step, and what comes out of a step: the report, contacts and events.

/// What a scene needs. A backend may leave out all the rest; using what was not declared is PLUMB_E_NOT_DECLARED,
/// declaring what the engine lacks (PLUMB_CAP_NEED is none) makes create_world fail with PLUMB_E_UNSUPPORTED.
pub type PlumbNeeds = u64;

pub const PLUMB_NEED_ROTATION: PlumbNeeds = 1 << 0;
pub const PLUMB_NEED_COLLISION: PlumbNeeds = 1 << 1;
pub const PLUMB_NEED_FRICTION: PlumbNeeds = 1 << 2;
pub const PLUMB_NEED_RESTITUTION: PlumbNeeds = 1 << 3;
pub const PLUMB_NEED_JOINTS: PlumbNeeds = 1 << 4;
pub const PLUMB_NEED_CCD: PlumbNeeds = 1 << 5;
pub const PLUMB_NEED_SLEEPING: PlumbNeeds = 1 << 6;
/// contact, sleep and joint events
pub const PLUMB_NEED_EVENTS: PlumbNeeds = 1 << 7;
/// contact points can be read after a step
pub const PLUMB_NEED_CONTACTS: PlumbNeeds = 1 << 8;
/// and carry their impulses
pub const PLUMB_NEED_CONTACT_IMPULSES: PlumbNeeds = 1 << 9;
pub const PLUMB_NEED_SENSORS: PlumbNeeds = 1 << 10;
pub const PLUMB_NEED_KINEMATIC: PlumbNeeds = 1 << 11;
/// the term -w x I w of bodies that are not isotropic
pub const PLUMB_NEED_GYROSCOPIC: PlumbNeeds = 1 << 12;
pub const PLUMB_NEED_DAMPING: PlumbNeeds = 1 << 13;
/// forces, torques and impulses from the host
pub const PLUMB_NEED_FORCES: PlumbNeeds = 1 << 14;
pub const PLUMB_NEED_AXIS_LOCKS: PlumbNeeds = 1 << 15;
/// filters other than "everything touches everything"
pub const PLUMB_NEED_FILTERS: PlumbNeeds = 1 << 16;
pub const PLUMB_NEED_QUERIES: PlumbNeeds = 1 << 17;
pub const PLUMB_NEED_SURFACE_VELOCITY: PlumbNeeds = 1 << 18;
pub const PLUMB_NEED_JOINT_REACTIONS: PlumbNeeds = 1 << 19;
pub const PLUMB_NEED_SNAPSHOT: PlumbNeeds = 1 << 20;
/// manifolds.h. Since 1.2
pub const PLUMB_NEED_CONTACT_MODIFICATION: PlumbNeeds = 1 << 21;
/// rolling and spinning friction of bodies. Since 1.2
pub const PLUMB_NEED_ROLLING_FRICTION: PlumbNeeds = 1 << 22;
pub const PLUMB_NEED_COUNT: u32 = 23;
pub const PLUMB_NEED_ALL: PlumbNeeds = 8388607;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbWorldDesc {
    pub struct_size: u32,
    /// how many the world may use; 0 is 1. More than the engine can use is not an error
    pub threads: u32,
    pub needs: PlumbNeeds,
    /// m/s2
    pub gravity: PlumbVec3,
    /// hints; 0 is unknown
    pub body_capacity: u32,
    pub contact_capacity: u32,
    pub joint_capacity: u32,
    pub setting_count: u32,
    /// set before anything else happens; the only way for creation-only settings
    pub settings: *const PlumbSetting,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbStepDesc {
    pub struct_size: u32,
    pub reserved: u32,
    /// s, > 0
    pub dt: f64,
}

/// Phases of a step for which a backend may report its time.
pub type PlumbPhase = u32;

/// bounds and candidate pairs
pub const PLUMB_PHASE_BROAD: PlumbPhase = 0;
/// contacts of candidate pairs
pub const PLUMB_PHASE_NARROW: PlumbPhase = 1;
/// graph, colouring, sleeping
pub const PLUMB_PHASE_ISLANDS: PlumbPhase = 2;
/// joints and contacts
pub const PLUMB_PHASE_SOLVE: PlumbPhase = 3;
/// forces to velocities to poses
pub const PLUMB_PHASE_INTEGRATE: PlumbPhase = 4;
pub const PLUMB_PHASE_CONTINUOUS: PlumbPhase = 5;
/// events, contacts and state rows
pub const PLUMB_PHASE_OUTPUT: PlumbPhase = 6;
/// room for one more
pub const PLUMB_PHASE_COUNT: PlumbPhase = 8;

/// The host sets struct_size; the backend fills the rest. NaN stands for "not known".
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbStepReport {
    pub struct_size: u32,
    /// used by this step
    pub threads: u32,
    /// steps done since the world was made
    pub step: u64,
    /// alive, all motions
    pub bodies: u32,
    /// dynamic bodies not asleep
    pub awake: u32,
    /// candidate pairs of the broad phase; UINT32_MAX when not known
    pub pairs: u32,
    /// points
    pub contacts: u32,
    pub joints: u32,
    /// contacts, pairs or events that the engine found and lost
    pub dropped: u32,
    /// dynamic bodies whose pose or velocity is NaN or infinite
    pub nonfinite: u32,
    /// PlumbStepRemark bits
    pub remarks: u32,
    /// of the engine's own solver, in its own measure
    pub residual: f64,
    pub phase_seconds: [f64; 8],
}

// PlumbStepReport.remarks
/// the chosen solver gave up and another finished the step
pub const PLUMB_REMARK_SOLVER_FELL_BACK: u32 = 1 << 0;
pub const PLUMB_REMARK_CAPACITY_GREW: u32 = 1 << 1;
pub const PLUMB_REMARK_STEP_REPEATED: u32 = 1 << 2;
/// it would have made energy: solved again finer, or the gain taken out
pub const PLUMB_REMARK_ENERGY_BOUNDED: u32 = 1 << 3;

/// One contact point as the last step solved it: geometry at detection, impulse summed over the step.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbContact {
    pub body_a: PlumbBody,
    pub body_b: PlumbBody,
    /// child of a compound, triangle of a mesh; else 0
    pub child_a: u32,
    /// child of a compound, triangle of a mesh; else 0
    pub child_b: u32,
    /// world, m; between the two surfaces, where is the engine's choice
    pub position: PlumbVec3,
    /// unit, from a to b
    pub normal: PlumbVec3,
    /// m; positive: overlap, negative: gap
    pub depth: f64,
    /// N s on b along the normal; NaN where the engine does not tell
    pub normal_impulse: f64,
    /// N s on b, world axes; NaN where the engine does not tell
    pub tangent_impulse: PlumbVec3,
    /// equal from step to step for the same pair of features; 0: not known
    pub feature: u64,
}

pub type PlumbEventType = u32;

/// body_a, body_b began to touch
pub const PLUMB_EVENT_CONTACT_BEGIN: PlumbEventType = 0;
/// also when one of them was destroyed: its handle is stale by then
pub const PLUMB_EVENT_CONTACT_END: PlumbEventType = 1;
/// body_a is the sensor
pub const PLUMB_EVENT_SENSOR_ENTER: PlumbEventType = 2;
pub const PLUMB_EVENT_SENSOR_LEAVE: PlumbEventType = 3;
/// body_a
pub const PLUMB_EVENT_WAKE: PlumbEventType = 4;
/// body_a
pub const PLUMB_EVENT_SLEEP: PlumbEventType = 5;
/// joint; it is gone from the step on
pub const PLUMB_EVENT_JOINT_BROKEN: PlumbEventType = 6;
pub const PLUMB_EVENT_COUNT: PlumbEventType = 7;

/// In the order: type, then body_a's slot, then body_b's slot, then the joint's slot.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbEvent {
    pub r#type: PlumbEventType,
    pub reserved: u32,
    pub body_a: PlumbBody,
    pub body_b: PlumbBody,
    pub joint: PlumbJoint,
}

// --- plumb/worlds.h
// plumb.worlds/1: many worlds of one backend whose steps are taken together. Since 1.2.

pub const PLUMB_EXT_WORLDS: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb.worlds/1\0") };

/// A device takes thousands of small worlds in the time of one, if it is given their steps at once.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbWorldsTable {
    pub struct_size: u32,
    pub reserved: u32,
    /// \[world, each of them\] From now on the steps of this world and of the others are taken together: what step
    /// begins may not run before one of them is waited for, and runs then with what the others have begun. So begin the
    /// step of each, on any threads, and then wait for each; a world that takes no part is left out by not stepping it.
    /// No result changes, and each world is called, reports and is destroyed as before. others: worlds of the same
    /// backend, all different, none within a step (PLUMB_E_WRONG_PHASE); count 0: this one is by itself again. Who was
    /// in another group leaves it. A backend on which that is no gain does nothing.
    pub group: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, others: *const *mut PlumbWorld, count: u32
    ) -> PlumbResult>,
    /// \[world, each of its group\] As borrow of plumb.state/1, of all worlds of the group: worlds x rows x columns,
    /// this world first and the others as they were named. Whose rows they are tells each world's plumb.state/1. All
    /// must have as many rows, and none may be gone since. Of a world in no group its own.
    pub borrow_all: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, request: *const PlumbStateRequest, tensor: *mut *mut PlumbDLManagedTensor,
        fence: *mut PlumbFence
    ) -> PlumbResult>,
}

// --- plumb/plumb.h
// Plumb: a stable interface to rigid-body physics engines.

pub type PlumbLogLevel = u32;

pub const PLUMB_LOG_DEBUG: PlumbLogLevel = 0;
pub const PLUMB_LOG_INFO: PlumbLogLevel = 1;
pub const PLUMB_LOG_WARNING: PlumbLogLevel = 2;
pub const PLUMB_LOG_ERROR: PlumbLogLevel = 3;

pub type PlumbTask = Option<unsafe extern "C" fn(context: *mut c_void, index: u32)>;

/// Lives as long as the process. Every pointer may be null: a backend works without any of it. A backend keeps what the
/// first opening of it in the process lent.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbHost {
    pub struct_size: u32,
    /// threads behind run, the caller's included; 0: run is null
    pub worker_count: u32,
    pub user: *mut c_void,
    /// \[any\] One line, no newline at its end.
    pub log: Option<unsafe extern "C" fn(user: *mut c_void, level: PlumbLogLevel, line: *const c_char)>,
    /// \[any\] Calls task(context, i) for every i < count, in any order and on any thread, and returns when all are
    /// done.
    pub run: Option<unsafe extern "C" fn(user: *mut c_void, task: PlumbTask, context: *mut c_void, count: u32)>,
    /// \[any\] Memory for what grows with a scene; PLUMB_CAP_HOST_MEMORY says what a backend takes from it. bytes > 0;
    /// alignment is a power of two, at most 256. Null where there is no more: the call that asked for it fails with
    /// PLUMB_E_OUT_OF_MEMORY. release is given what allocate gave, never null. Both functions or neither. Since 1.2.
    pub allocate: Option<unsafe extern "C" fn(user: *mut c_void, bytes: usize, alignment: usize) -> *mut c_void>,
    pub release: Option<unsafe extern "C" fn(user: *mut c_void, memory: *mut c_void)>,
}

/// From run to run of the same program on the same machine, each level including those before.
pub type PlumbDeterminism = u32;

pub const PLUMB_DETERMINISM_NONE: PlumbDeterminism = 0;
/// the same calls give the same bits
pub const PLUMB_DETERMINISM_RUN: PlumbDeterminism = 1;
/// for any number of threads
pub const PLUMB_DETERMINISM_THREADS: PlumbDeterminism = 2;
/// on the CPU and on the GPU
pub const PLUMB_DETERMINISM_DEVICE: PlumbDeterminism = 3;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbBackendInfo {
    pub struct_size: u32,
    pub determinism: PlumbDeterminism,
    /// "bullet": what a user types
    pub name: *const c_char,
    /// of the engine: "3.24"
    pub version: *const c_char,
    /// changes whenever the results or times of this library may: version, compiler, flags
    pub build: *const c_char,
    /// one line
    pub description: *const c_char,
    /// "cpu" or the device's name
    pub device: *const c_char,
    /// two backends of one group cannot be open in one process; "" for none
    pub exclusion_group: *const c_char,
    /// of the engine's arithmetic
    pub precision: PlumbDataType,
    /// that a world can use
    pub max_threads: u32,
}

/// Questions to PlumbBackendTable.capability: kind, and up to two arguments.
pub type PlumbCapability = u32;

/// shape type, motion
pub const PLUMB_CAP_SHAPE: PlumbCapability = 0;
/// shape type, shape type (symmetric); the first may be dynamic: contacts and their solution
pub const PLUMB_CAP_PAIR: PlumbCapability = 1;
/// joint type
pub const PLUMB_CAP_JOINT: PlumbCapability = 2;
/// joint type, PlumbJointFeature
pub const PLUMB_CAP_JOINT_FEATURE: PlumbCapability = 3;
/// PlumbQueryKind, shape type that is cast or overlapped (0 for rays)
pub const PLUMB_CAP_QUERY: PlumbCapability = 4;
/// field
pub const PLUMB_CAP_FIELD_READ: PlumbCapability = 5;
/// field
pub const PLUMB_CAP_FIELD_WRITE: PlumbCapability = 6;
/// index of a PLUMB_NEED_ bit
pub const PLUMB_CAP_NEED: PlumbCapability = 7;
/// event type
pub const PLUMB_CAP_EVENT: PlumbCapability = 8;
/// PlumbPhase
pub const PLUMB_CAP_PHASE_TIME: PlumbCapability = 9;
pub const PLUMB_CAP_RESIDUAL: PlumbCapability = 10;
/// 0: of what moves, 1: of the whole world
pub const PLUMB_CAP_SNAPSHOT: PlumbCapability = 11;
/// runs its tasks on PlumbHost.run
pub const PLUMB_CAP_HOST_JOBS: PlumbCapability = 12;
/// materials of compound children
pub const PLUMB_CAP_CHILD_MATERIAL: PlumbCapability = 13;
/// 0: bodies, 1: joints; index of a PLUMB_MODIFY_ bit. 2: shapes; type. Since 1.2
pub const PLUMB_CAP_MODIFY: PlumbCapability = 14;
/// index of a PLUMB_MANIFOLD_ bit. Since 1.2
pub const PLUMB_CAP_MANIFOLD: PlumbCapability = 15;
/// shape type of the probe: bodies of every shape are seen. Since 1.2
pub const PLUMB_CAP_CLOSEST: PlumbCapability = 16;
/// shape type: PlumbShapeDesc.materials. Since 1.2
pub const PLUMB_CAP_TRIANGLE_MATERIAL: PlumbCapability = 17;
/// shape type: native where the engine's work is in the bytes. Since 1.2
pub const PLUMB_CAP_COOKING: PlumbCapability = 18;
/// takes what grows with a scene from PlumbHost.allocate. Since 1.2
pub const PLUMB_CAP_HOST_MEMORY: PlumbCapability = 19;
pub const PLUMB_CAP_COUNT: PlumbCapability = 20;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbBackendTable {
    pub struct_size: u32,
    /// that was negotiated
    pub version: u32,
    /// \[any\] Lives as long as the process.
    pub info: Option<unsafe extern "C" fn() -> *const PlumbBackendInfo>,
    /// \[any\] What is unknown to the backend is PLUMB_NONE. note (may be null) receives a sentence or "", never null;
    /// it lives as long as the process.
    pub capability: Option<unsafe extern "C" fn(
        kind: PlumbCapability, a: u32, b: u32, note: *mut *const c_char
    ) -> PlumbDegree>,
    /// \[any\] The table of an extension ("plumb.joints/1"), or null. Lives as long as the process.
    pub extension: Option<unsafe extern "C" fn(name: *const c_char) -> *const c_void>,
    /// \[any\]
    pub create_world: Option<unsafe extern "C" fn(
        desc: *const PlumbWorldDesc, world: *mut *mut PlumbWorld
    ) -> PlumbResult>,
    /// \[world\] Takes null. All handles of the world are gone; lent state lives on.
    pub destroy_world: Option<unsafe extern "C" fn(world: *mut PlumbWorld)>,
    /// \[any\] Text of the last failure: of this world, or with null of this thread's last create_world. Never null;
    /// lives until the next call on the world.
    pub error_text: Option<unsafe extern "C" fn(world: *mut PlumbWorld) -> *const c_char>,
    /// Shapes and bodies. \[world\] All or none. stride is sizeof the caller's descriptor. Destroying a shape that a
    /// body or compound still uses is PLUMB_E_IN_USE, and so is destroying a body that still has joints.
    pub create_shapes: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, descs: *const PlumbShapeDesc, stride: usize, count: u32, ids: *mut PlumbShape
    ) -> PlumbResult>,
    pub destroy_shapes: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, ids: *const PlumbShape, count: u32
    ) -> PlumbResult>,
    pub create_bodies: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, descs: *const PlumbBodyDesc, stride: usize, count: u32, ids: *mut PlumbBody
    ) -> PlumbResult>,
    pub destroy_bodies: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, ids: *const PlumbBody, count: u32
    ) -> PlumbResult>,
    /// \[world\] Live bodies in order of creation.
    pub list_bodies: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, ids: *mut PlumbBody, capacity: u32, count: *mut u32
    ) -> PlumbResult>,
    /// \[world\] user_data of the descriptor.
    pub user_data: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, id: PlumbBody, user_data: *mut u64
    ) -> PlumbResult>,
    /// \[world\] One row a body. ids null: the first count live bodies in order of creation. stride: bytes between
    /// rows.
    pub read: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, field: PlumbField, r#type: PlumbDataType, ids: *const PlumbBody, count: u32,
        rows: *mut c_void, stride: usize
    ) -> PlumbResult>,
    pub write: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, field: PlumbField, r#type: PlumbDataType, ids: *const PlumbBody, count: u32,
        rows: *const c_void, stride: usize
    ) -> PlumbResult>,
    /// \[world\] m/s2
    pub set_gravity: Option<unsafe extern "C" fn(world: *mut PlumbWorld, gravity: *const PlumbVec3) -> PlumbResult>,
    /// \[world\] step begins a step and may return before it is done; until wait returns, nothing else may be called
    /// (but what manifolds.h has). wait fills the report (may be null).
    pub step: Option<unsafe extern "C" fn(world: *mut PlumbWorld, desc: *const PlumbStepDesc) -> PlumbResult>,
    pub wait: Option<unsafe extern "C" fn(world: *mut PlumbWorld, report: *mut PlumbStepReport) -> PlumbResult>,
    /// \[world\] Of the last step. out\[capacity\]; \*count is how many there are, also when PLUMB_TRUNCATED. stride is
    /// sizeof the caller's row. Events also hold what destroying bodies since the step before has ended.
    pub contacts: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, out: *mut PlumbContact, stride: usize, capacity: u32, count: *mut u32
    ) -> PlumbResult>,
    pub events: Option<unsafe extern "C" fn(
        world: *mut PlumbWorld, out: *mut PlumbEvent, stride: usize, capacity: u32, count: *mut u32
    ) -> PlumbResult>,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbOpenRequest {
    pub struct_size: u32,
    /// what the host can speak
    pub min_version: u32,
    /// what the host can speak
    pub max_version: u32,
    pub reserved: u32,
    /// may be null
    pub host: *const PlumbHost,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlumbOpenReply {
    pub struct_size: u32,
    /// chosen, within the range of the request
    pub version: u32,
    pub table: *const PlumbBackendTable,
    /// why not, when the result is below 0: one sentence that says what to do
    pub message: [c_char; 256],
}

/// The one symbol of a backend. \[any\] May be called again: the same table comes back for the same version.
pub const PLUMB_OPEN_SYMBOL: &CStr = unsafe { CStr::from_bytes_with_nul_unchecked(b"plumb_backend_open\0") };

pub type plumb_backend_open = unsafe extern "C" fn(
    request: *const PlumbOpenRequest, reply: *mut PlumbOpenReply
) -> PlumbResult;

pub type PlumbOpenFunction = Option<unsafe extern "C" fn(
    request: *const PlumbOpenRequest, reply: *mut PlumbOpenReply
) -> PlumbResult>;

zero!(
    PlumbVec3, PlumbQuat, PlumbPose, PlumbMaterial, PlumbCompoundChild, PlumbFilter, PlumbRay, PlumbCast,
    PlumbTurningCast, PlumbOverlap, PlumbHit, PlumbPenetration, PlumbProbe, PlumbClosest, PlumbPosedPair,
    PlumbPairResult, PlumbPairPoint, PlumbDebugPair, PlumbDebugBox, PlumbDebugAxis, PlumbDebugBody,
    PlumbDebugConstraint, PlumbBodyPair, PlumbLimit, PlumbMotor, PlumbSpring, PlumbManifold, PlumbManifoldChange,
    PlumbBodyChange, PlumbJointChange, PlumbSettingValue, PlumbSetting, PlumbSettingInfo, PlumbDLDevice,
    PlumbDLDataType, PlumbDLTensor, PlumbDLManagedTensor_version, PlumbDLManagedTensor, PlumbFence, PlumbContact,
    PlumbEvent
);
sized!(
    PlumbShapeDesc, PlumbBodyDesc, PlumbQueriesTable, PlumbClosestTable, PlumbCollideTable, PlumbCooked,
    PlumbCookedShape, PlumbCookingTable, PlumbDebugTable, PlumbExceptionsTable, PlumbJointDesc, PlumbJointsTable,
    PlumbManifoldsTable, PlumbModifyTable, PlumbSettingsTable, PlumbSnapshotTable, PlumbStateRequest, PlumbStateTable,
    PlumbWorldDesc, PlumbStepDesc, PlumbStepReport, PlumbWorldsTable, PlumbHost, PlumbBackendInfo, PlumbBackendTable,
    PlumbOpenRequest, PlumbOpenReply
);
