// Plumb, a stable interface to rigid-body physics engines, for C#: plumb/plumb.h, by the same names.
//
// Generated from plumb.h and what it includes by api/ffi/generate.py: edit those.
// Take the file as it is, and compile with /unsafe (C# 7: Mono, .NET, Unity). Functions of tables are IntPtr, of which
// Calls.Function<PlumbBackendTable.Step>(table->step) makes a delegate; keep it. Look at a table's struct_size before
// you take what came later. Delegates that you lend (PlumbHost.log) must live for as long as they may be called.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Plumb.Ffi
{
public static class Calls
{
    public static T Function<T>(IntPtr pointer) where T : class
    {
        return pointer == IntPtr.Zero ? null : (T)(object)Marshal.GetDelegateForFunctionPointer(pointer, typeof(T));
    }

    public static unsafe string Text(byte* text)
    {
        int length = 0;
        while (text != null && text[length] != 0) ++length;
        return text == null ? null : Encoding.UTF8.GetString(text, length);
    }

    // To give to C: fixed (byte* name = Calls.Bytes(PLUMB_EXT_JOINTS)) ...
    public static byte[] Bytes(string text)
    {
        return Encoding.UTF8.GetBytes(text + "\0");
    }
}

// --- plumb/types.h
// Plain values that cross the wall: results, handles, vectors, poses.

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbVec3
{
    public double x;
    public double y;
    public double z;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbQuat
{
    public double x;
    public double y;
    public double z;
    public double w;
}

/// <summary>A rigid placement: a point p of the local frame is at position + orientation * p.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbPose
{
    /// <summary>m</summary>
    public PlumbVec3 position;
    /// <summary>unit</summary>
    public PlumbQuat orientation;
}

/// <summary>Opaque: made and owned by a backend.</summary>
public struct PlumbWorld
{
}

// --- plumb/shapes.h
// Collision shapes. A shape may be shared by any number of bodies of its world, and stays what it is; but for meshes
// and height fields, which modify.h lets become others where the backend can.

/// <summary>Surface of a body. The coefficients of a PAIR are the same in every backend: friction sqrt(friction_a *
/// friction_b), restitution max(restitution_a, restitution_b).</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbMaterial
{
    /// <summary>Coulomb, &gt;= 0</summary>
    public double friction;
    /// <summary>Newton, 0..1</summary>
    public double restitution;
    /// <summary>m/s in the body's frame, for conveyors; needs PLUMB_NEED_SURFACE_VELOCITY when not 0</summary>
    public PlumbVec3 surface_velocity;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbCompoundChild
{
    /// <summary>not a compound, plane, mesh or height field</summary>
    public ulong shape;
    /// <summary>of the child in the compound's frame</summary>
    public PlumbPose pose;
    /// <summary>0: the body's material; 1: the one below</summary>
    public uint has_material;
    public uint reserved;
    public PlumbMaterial material;
}

/// <summary>Only the members of the shape's type are read. All arrays are copied before the call returns.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbShapeDesc
{
    public uint struct_size;
    public uint type;
    /// <summary>m, &gt; 0</summary>
    public double radius;
    /// <summary>m, &gt; 0 (capsule: &gt;= 0)</summary>
    public double half_height;
    /// <summary>m, &gt; 0</summary>
    public PlumbVec3 half_extents;
    /// <summary>xyz triples, m</summary>
    public double* vertices;
    /// <summary>hull: &gt;= 4 and not all in one plane</summary>
    public uint vertex_count;
    public uint triangle_count;
    /// <summary>3 a triangle, each &lt; vertex_count</summary>
    public uint* indices;
    /// <summary>rows * columns values, m, row by row: y of the point at x = column * spacing.x, z = row * spacing.z.
    /// Each cell is two triangles, cut along the diagonal from (column, row + 1) to (column + 1, row).</summary>
    public double* heights;
    /// <summary>&gt;= 2, along z; the field is centred: the origin is the middle of the rectangle, at height
    /// 0</summary>
    public uint rows;
    /// <summary>&gt;= 2, along x</summary>
    public uint columns;
    /// <summary>x and z &gt; 0, m; y unused</summary>
    public PlumbVec3 spacing;
    public PlumbCompoundChild* children;
    public uint child_count;
    /// <summary>of materials below; 0: all is the body's. Was reserved before 1.2</summary>
    public uint material_count;
    public ulong user_data;
    /// <summary>Materials by triangle, where PLUMB_CAP_TRIANGLE_MATERIAL says that the backend has them: read when
    /// material_count is above 0. Their surface_velocity must be 0. Since 1.2</summary>
    public PlumbMaterial* materials;
    /// <summary>For each triangle the row of its material, or PLUMB_BODY_MATERIAL. Of a mesh triangle_count; of a
    /// height field 2 (rows - 1) (columns - 1): cell by cell, first along x, of each cell first the triangle at its
    /// corner (column, row).</summary>
    public uint* triangle_materials;
}

// --- plumb/bodies.h
// Bodies, and the fields in which their state is read and written in batches.

/// <summary>Whether two bodies may touch: equal non-zero groups decide (positive: always, negative: never); otherwise
/// each one's category must be in the other's mask. Single pairs: plumb.exceptions/1.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbFilter
{
    /// <summary>bits</summary>
    public uint category;
    /// <summary>bits</summary>
    public uint mask;
    public int group;
    public uint reserved;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbBodyDesc
{
    public uint struct_size;
    public uint motion;
    public uint flags;
    public uint locks;
    /// <summary>0: no shape, touches nothing</summary>
    public ulong shape;
    /// <summary>of the body's frame, in which its shape is placed; the centre of mass may be elsewhere</summary>
    public PlumbPose pose;
    /// <summary>of the centre of mass, m/s</summary>
    public PlumbVec3 linear_velocity;
    /// <summary>rad/s, world axes</summary>
    public PlumbVec3 angular_velocity;
    /// <summary>dynamic bodies only</summary>
    public uint mass_mode;
    public uint reserved;
    /// <summary>kg/m3, &gt; 0</summary>
    public double density;
    /// <summary>kg, &gt; 0</summary>
    public double mass;
    /// <summary>body frame, m</summary>
    public PlumbVec3 centre_of_mass;
    /// <summary>principal moments about the centre of mass, kg m2; 0 0 0 with NO_ROTATION</summary>
    public PlumbVec3 inertia;
    /// <summary>from principal axes to the body frame</summary>
    public PlumbQuat inertia_orientation;
    public PlumbMaterial material;
    public double gravity_scale;
    /// <summary>c in dv/dt = -c v, 1/s, &gt;= 0; needs PLUMB_NEED_DAMPING when not 0</summary>
    public double linear_damping;
    /// <summary>likewise for the angular velocity</summary>
    public double angular_damping;
    public PlumbFilter filter;
    public ulong user_data;
    /// <summary>Resistance to rolling and to spinning, where the shape is round or soft: the greatest moment along and
    /// about the normal of a contact, relative to its normal force, m. Of two bodies that touch the larger of each
    /// counts, and neither needs friction, though without it a ball slides instead of rolling. &gt;= 0; need
    /// PLUMB_NEED_ROLLING_FRICTION when not 0. Since 1.2</summary>
    public double rolling_friction;
    public double spinning_friction;
}

// --- plumb/queries.h
// plumb.queries/1: rays, shape casts and overlaps against the world as the last step left it. Always in batches.

/// <summary>Sees a body when the rule of PlumbFilter says that the two may touch. Sensors are not seen. Of a body in
/// which the ray starts engines tell different things: a hit at fraction 0, the far side, or nothing; see the note of
/// PLUMB_CAP_QUERY.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbRay
{
    /// <summary>m</summary>
    public PlumbVec3 origin;
    /// <summary>m: direction and length in one, not 0</summary>
    public PlumbVec3 translation;
    public PlumbFilter filter;
}

/// <summary>A convex shape moved without turning. A shape that overlaps at the start hits at fraction 0.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbCast
{
    /// <summary>sphere, box, capsule, cylinder or hull</summary>
    public ulong shape;
    public PlumbPose pose;
    /// <summary>m, not 0</summary>
    public PlumbVec3 translation;
    public PlumbFilter filter;
}

/// <summary>A convex shape that turns on its way, about the place of its pose: at a fraction f of the way it is at
/// pose.position + f * translation, turned from pose.orientation by f * |rotation| rad about rotation. One of
/// translation and rotation may be 0. Since 1.2.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbTurningCast
{
    /// <summary>sphere, box, capsule, cylinder or hull</summary>
    public ulong shape;
    public PlumbPose pose;
    /// <summary>m</summary>
    public PlumbVec3 translation;
    /// <summary>rad, world axes; its length at most 2 pi: a whole turn</summary>
    public PlumbVec3 rotation;
    public PlumbFilter filter;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbOverlap
{
    public ulong shape;
    public PlumbPose pose;
    public PlumbFilter filter;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbHit
{
    /// <summary>0: nothing</summary>
    public ulong body;
    /// <summary>index into the batch</summary>
    public uint query;
    /// <summary>of a compound, triangle of a mesh; else 0, also for a height field</summary>
    public uint child;
    /// <summary>of the way, 0..1; 0 for overlaps</summary>
    public double fraction;
    /// <summary>world, m; NaN for overlaps</summary>
    public PlumbVec3 position;
    /// <summary>of the surface that was hit, unit; NaN for overlaps</summary>
    public PlumbVec3 normal;
}

/// <summary>How deep a shape overlaps a body, and which way out, as plumb.collide/1 tells of the two: of a body with
/// several children, or a surface with several triangles, that which is deepest. Convex shapes are solid and a plane is
/// solid below; surfaces have nothing inside. Since 1.2.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbPenetration
{
    public ulong body;
    /// <summary>index into the batch</summary>
    public uint query;
    /// <summary>of a compound, triangle of a mesh; else 0, also for a height field</summary>
    public uint child;
    /// <summary>m, &gt;= 0: how far the shape moves along normal until it only touches what it is deepest in</summary>
    public double depth;
    /// <summary>world, m: where it is deepest, on either surface or between them</summary>
    public PlumbVec3 position;
    /// <summary>unit, from the body to the shape: the way out</summary>
    public PlumbVec3 normal;
}

/// <summary>hits[capacity]; *hit_count is how many there are, also when the answer is PLUMB_TRUNCATED. Strides are in
/// bytes. All [query]: any number at once while no step runs.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbQueriesTable
{
    public uint struct_size;
    public uint reserved;
    public IntPtr rays;
    public IntPtr casts;
    /// <summary>Always all hits.</summary>
    public IntPtr overlaps;
    /// <summary>Of all bodies that a shape overlaps: out[capacity] has a row for each, sorted by query, then depth, the
    /// deepest first, then body slot. Bodies that touch the shape without depth may be told or not. PLUMB_CAP_QUERY
    /// with PLUMB_QUERY_PENETRATION says of which shapes; a table that ends before has it not. Since 1.2.</summary>
    public IntPtr penetrations;
    /// <summary>As casts are, of shapes that turn on the way: the first touch on it, though it may be a corner's that
    /// swings out and back. PLUMB_CAP_QUERY with PLUMB_QUERY_TURNING_CAST says of which shapes; a table that ends
    /// before has it not. Since 1.2.</summary>
    public IntPtr turning_casts;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Rays(
        PlumbWorld* world, uint mode, PlumbRay* rays, UIntPtr stride, uint count, PlumbHit* hits, uint capacity,
        uint* hit_count
    );

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Casts(
        PlumbWorld* world, uint mode, PlumbCast* casts, UIntPtr stride, uint count, PlumbHit* hits, uint capacity,
        uint* hit_count
    );

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Overlaps(
        PlumbWorld* world, PlumbOverlap* overlaps, UIntPtr stride, uint count, PlumbHit* hits, uint capacity,
        uint* hit_count
    );

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Penetrations(
        PlumbWorld* world, PlumbOverlap* overlaps, UIntPtr stride, uint count, PlumbPenetration* @out, uint capacity,
        uint* out_count
    );

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int TurningCasts(
        PlumbWorld* world, uint mode, PlumbTurningCast* casts, UIntPtr stride, uint count, PlumbHit* hits,
        uint capacity, uint* hit_count
    );
}

// --- plumb/closest.h
// plumb.closest/1: which bodies are near a convex shape, how far away, and where, in the world as the last step left
// it. Always in batches. Since 1.2.

/// <summary>Looks around a shape that need not be in the world. Sees a body when the rule of PlumbFilter says that the
/// two may touch. Sensors are not seen. To look around a point give a small sphere and add its radius to
/// distances.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbProbe
{
    /// <summary>sphere, box, capsule, cylinder or hull; PLUMB_CAP_CLOSEST says which</summary>
    public ulong shape;
    public PlumbPose pose;
    /// <summary>m, &gt; 0 and finite: what is further away is not looked for</summary>
    public double most_distance;
    public PlumbFilter filter;
}

/// <summary>The shortest way from a probe to a body. Convex shapes are solid and a plane is solid below; meshes and
/// height fields are surfaces with two sides and nothing inside. Of several ways that are equally short it is one of
/// them.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbClosest
{
    /// <summary>0: nothing is within most_distance; then what follows child is NaN</summary>
    public ulong body;
    /// <summary>index into the batch</summary>
    public uint probe;
    /// <summary>of a compound, triangle of a mesh; else 0, also for a height field. The first of equal ones; where
    /// distance is 0 one of those that touch</summary>
    public uint child;
    /// <summary>m, &gt;= 0; 0 where they touch or overlap: plumb.collide/1 tells how deep</summary>
    public double distance;
    /// <summary>world, m: the point of the probe's surface; NaN where distance is 0</summary>
    public PlumbVec3 on_probe;
    /// <summary>world, m: the point of the body's surface; NaN where distance is 0</summary>
    public PlumbVec3 on_body;
    /// <summary>unit, from the probe to the body; NaN where distance is 0</summary>
    public PlumbVec3 normal;
}

/// <summary>Needs PLUMB_NEED_QUERIES.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbClosestTable
{
    public uint struct_size;
    public uint reserved;
    /// <summary>[query] PLUMB_HIT_CLOSEST: one row a probe, in their order, of the body that is nearest; of bodies that
    /// are equally near of the one in the lower slot. PLUMB_HIT_ALL: a row for each body within most_distance, sorted
    /// by probe, then distance, then body slot. out[capacity] is the caller's; *out_count is how many there are, also
    /// when the answer is PLUMB_TRUNCATED. stride is in bytes, sizeof the caller's probe. A shape that is not convex,
    /// and a number that may not be, are PLUMB_E_INVALID_ARGUMENT; then nothing is written.</summary>
    public IntPtr bodies;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Bodies(
        PlumbWorld* world, uint mode, PlumbProbe* probes, UIntPtr stride, uint count, PlumbClosest* @out, uint capacity,
        uint* out_count
    );
}

// --- plumb/collide.h
// plumb.collide/1: collision without a step. Posed shapes in, contacts and distances out.

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbPosedPair
{
    public ulong shape_a;
    public ulong shape_b;
    public PlumbPose pose_a;
    public PlumbPose pose_b;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbPairResult
{
    /// <summary>m; negative: depth of the deepest contact; NaN when apart and the engine does not tell</summary>
    public double distance;
    /// <summary>into points</summary>
    public uint first_point;
    public uint point_count;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbPairPoint
{
    /// <summary>world, m</summary>
    public PlumbVec3 position;
    /// <summary>unit, from a to b</summary>
    public PlumbVec3 normal;
    /// <summary>m; positive: overlap</summary>
    public double depth;
    /// <summary>0: not known</summary>
    public ulong feature;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbCollideTable
{
    public uint struct_size;
    public uint reserved;
    /// <summary>[query] results[count], points[capacity]; *point_count is how many there are, also when
    /// PLUMB_TRUNCATED.</summary>
    public IntPtr pairs;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Pairs(
        PlumbWorld* world, PlumbPosedPair* pairs, UIntPtr stride, uint count, PlumbPairResult* results,
        PlumbPairPoint* points, uint capacity, uint* point_count
    );
}

// --- plumb/cooking.h
// plumb.cooking/1: shapes worked out ahead, in a build step or on threads that load, and made from bytes in a world.
// Since 1.2.

/// <summary>What cook gives. Set struct_size.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbCooked
{
    public uint struct_size;
    public uint reserved;
    /// <summary>the backend's, until release is given it; null when the result is below 0</summary>
    public void* data;
    /// <summary>bytes</summary>
    public ulong size;
    /// <summary>why not, when the result is below 0: one sentence that says what to do</summary>
    public fixed byte message[256];
}

/// <summary>Bytes that cook gave, in the caller's memory, at any address.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbCookedShape
{
    public uint struct_size;
    public uint reserved;
    public void* data;
    /// <summary>bytes</summary>
    public ulong size;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbCookingTable
{
    public uint struct_size;
    public uint reserved;
    /// <summary>[any] A descriptor is refused as create_shapes refuses it. Compounds are not cooked: cook their
    /// children, and create the compound from the handles of these. user_data is not in the bytes.</summary>
    public IntPtr cook;
    /// <summary>[any] Takes null.</summary>
    public IntPtr release;
    /// <summary>[world] As create_shapes does, all or none: a shape from bytes is to the bit what its descriptor would
    /// have made of it, in steps, queries, snapshots and when it is modified. The bytes are copied before the call
    /// returns. stride is sizeof the caller's row. PLUMB_E_CORRUPT for bytes that are torn, changed, of another
    /// backend, precision or byte order, or of another version of the format: keep the descriptors, and cook anew.
    /// PLUMB_E_NOT_DECLARED where materials by triangle ask for what the world's needs lack.</summary>
    public IntPtr create;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Cook(PlumbShapeDesc* desc, PlumbCooked* cooked);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void Release(void* data);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Create(
        PlumbWorld* world, PlumbCookedShape* shapes, UIntPtr stride, uint count, ulong* ids
    );
}

// --- plumb/debug.h
// plumb.debug/1: what the engine sees, for pictures and for tests that want no back door.

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbDebugPair
{
    public ulong body_a;
    public ulong body_b;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbDebugBox
{
    /// <summary>world, m</summary>
    public PlumbVec3 lower;
    /// <summary>world, m</summary>
    public PlumbVec3 upper;
    /// <summary>of a leaf; 0 for an inner node</summary>
    public ulong body;
    /// <summary>below the root, 0 for the root; -1 where there is no tree</summary>
    public int depth;
    /// <summary>engines with several trees number them</summary>
    public uint tree;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbDebugAxis
{
    public ulong body_a;
    public ulong body_b;
    /// <summary>unit, from a to b: of least overlap, or separating</summary>
    public PlumbVec3 axis;
    /// <summary>m along the axis; negative: overlap</summary>
    public double separation;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbDebugBody
{
    public ulong body;
    /// <summary>bodies of one number are bound by contacts and joints and fall asleep together; -1: of none</summary>
    public int island;
    /// <summary>0 or 1</summary>
    public uint asleep;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbDebugConstraint
{
    /// <summary>body_a is 0 for a joint with the world</summary>
    public ulong body_a;
    /// <summary>body_a is 0 for a joint with the world</summary>
    public ulong body_b;
    /// <summary>0 for the contacts of two bodies</summary>
    public ulong joint;
    /// <summary>constraints of one colour share no dynamic body and are solved at once; -1: one by one</summary>
    public int colour;
    /// <summary>0</summary>
    public uint reserved;
}

/// <summary>As of the last step. [world]. out[capacity]; *count is how many there are, also when PLUMB_TRUNCATED. A
/// backend answers PLUMB_E_UNSUPPORTED to what it cannot show.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbDebugTable
{
    public uint struct_size;
    public uint reserved;
    public IntPtr pairs;
    public IntPtr boxes;
    public IntPtr axes;
    /// <summary>Since 1.1: look at struct_size before. Every body that lives, once.</summary>
    public IntPtr bodies;
    /// <summary>Since 1.1. What the last step's solver had to satisfy.</summary>
    public IntPtr constraints;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Pairs(PlumbWorld* world, PlumbDebugPair* @out, uint capacity, uint* count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Boxes(PlumbWorld* world, PlumbDebugBox* @out, uint capacity, uint* count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Axes(PlumbWorld* world, PlumbDebugAxis* @out, uint capacity, uint* count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Bodies(PlumbWorld* world, PlumbDebugBody* @out, uint capacity, uint* count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Constraints(PlumbWorld* world, PlumbDebugConstraint* @out, uint capacity, uint* count);
}

// --- plumb/exceptions.h
// plumb.exceptions/1: excluded pairs: bodies that do not touch, whatever their filters say.

/// <summary>The order of the two does not matter.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbBodyPair
{
    public ulong body_a;
    public ulong body_b;
}

/// <summary>An exception lasts until it is taken back or one of its bodies is destroyed: a later body in the same slot
/// has none. Neither contacts nor sensors see a pair that is excepted; queries do. It stands beside what joints say of
/// their bodies (collide_connected): each may keep a pair apart by itself. Needs no PLUMB_NEED bit, as it costs nothing
/// where it is not used. Snapshots hold the exceptions of their time.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbExceptionsTable
{
    public uint struct_size;
    public uint reserved;
    /// <summary>[world] All or none. touch 0: from the next step on the two do not touch, and a contact that they had
    /// ends with that step's events; 1: they touch as their filters say again. Bodies that sleep wake where that
    /// changes something; setting what is so already is fine. stride is sizeof the caller's pair. A body with itself,
    /// or another touch, is PLUMB_E_INVALID_ARGUMENT.</summary>
    public IntPtr set;
    /// <summary>[world] The exceptions there are, the lower slot of each first, in the order of body_a's slot, then
    /// body_b's. out[capacity]; *count is how many there are, also when PLUMB_TRUNCATED.</summary>
    public IntPtr list;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Set(PlumbWorld* world, PlumbBodyPair* pairs, UIntPtr stride, uint count, uint touch);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int List(PlumbWorld* world, PlumbBodyPair* @out, uint capacity, uint* count);
}

// --- plumb/joints.h
// plumb.joints/1: joints between two bodies, or between a body and the world.

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbLimit
{
    /// <summary>m or rad; lower &lt;= upper</summary>
    public double lower;
    /// <summary>m or rad; lower &lt;= upper</summary>
    public double upper;
    public uint enabled;
    public uint reserved;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbMotor
{
    /// <summary>m/s or rad/s, of b seen from a</summary>
    public double target_velocity;
    /// <summary>N or N m, &gt;= 0</summary>
    public double max_force;
    public uint enabled;
    public uint reserved;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbSpring
{
    /// <summary>m or rad; for a distance joint its rest_length is used instead</summary>
    public double rest;
    /// <summary>Hz, of the undamped spring, &gt; 0; by stiffness: N/m or N m/rad, &gt;= 0</summary>
    public double frequency;
    /// <summary>1 is critical, &gt;= 0; by stiffness: N s/m or N m s/rad</summary>
    public double damping_ratio;
    public uint enabled;
    public uint mode;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbJointDesc
{
    public uint struct_size;
    public uint type;
    /// <summary>0: the world; its frame is then in world axes</summary>
    public ulong body_a;
    /// <summary>not 0</summary>
    public ulong body_b;
    /// <summary>in body a's frame</summary>
    public PlumbPose frame_a;
    /// <summary>in body b's frame</summary>
    public PlumbPose frame_b;
    /// <summary>0: the two bodies do not touch each other</summary>
    public uint collide_connected;
    public uint reserved;
    /// <summary>generic only</summary>
    public fixed uint axis_modes[6];
    public PlumbLimit_6 limits;
    public PlumbMotor_6 motors;
    public PlumbSpring_6 springs;
    /// <summary>distance, m, &gt;= 0</summary>
    public double rest_length;
    /// <summary>N, 0: never breaks</summary>
    public double break_force;
    /// <summary>N m, 0: never breaks</summary>
    public double break_torque;
    public ulong user_data;
    /// <summary>gear, rack and pinion: not 0; b's teeth by a's, or rad/m. Since 1.2</summary>
    public double ratio;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbJointsTable
{
    public uint struct_size;
    public uint reserved;
    /// <summary>[world] All or none; ids[count].</summary>
    public IntPtr create;
    /// <summary>[world] All or none.</summary>
    public IntPtr destroy;
    /// <summary>[world] ids null: the first count live joints in order of creation. stride in bytes between
    /// rows.</summary>
    public IntPtr read;
    /// <summary>[world] Likewise; PLUMB_JOINT_MOTOR and PLUMB_JOINT_SPRING_REST. What sleeps and is written to
    /// wakes.</summary>
    public IntPtr write;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Create(PlumbWorld* world, PlumbJointDesc* descs, UIntPtr stride, uint count, ulong* ids);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Destroy(PlumbWorld* world, ulong* ids, uint count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Read(
        PlumbWorld* world, uint field, uint type, ulong* ids, uint count, void* rows, UIntPtr stride
    );

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Write(
        PlumbWorld* world, uint field, uint type, ulong* ids, uint count, void* rows, UIntPtr stride
    );
}

// --- plumb/manifolds.h
// plumb.manifolds/1: contact modification: what touches is shown to the host before the solver sees it. Since 1.2.

/// <summary>Where two shapes, or a shape and a triangle, touch or are about to: up to four points of one plane. Engines
/// that make one contact of those with several triangles leave them apart for bodies with
/// PLUMB_BODY_MODIFY_CONTACTS.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbManifold
{
    public ulong body_a;
    public ulong body_b;
    /// <summary>child of a compound, triangle of a mesh; else 0</summary>
    public uint child_a;
    /// <summary>child of a compound, triangle of a mesh; else 0</summary>
    public uint child_b;
    /// <summary>1 to PLUMB_MANIFOLD_POINTS</summary>
    public uint point_count;
    public uint reserved;
    /// <summary>unit, from a to b, world axes</summary>
    public PlumbVec3 normal;
    /// <summary>of b against a where they touch (the mean of the points), as the step began, m/s</summary>
    public PlumbVec3 velocity;
    /// <summary>world, m; as PlumbContact's</summary>
    public PlumbVec3_4 position;
    /// <summary>m; positive: overlap, negative: gap</summary>
    public fixed double depth[4];
    /// <summary>of the two together, and likewise what follows</summary>
    public double friction;
    public double restitution;
    /// <summary>with which b's surface runs over a's while both bodies stand, m/s, world axes</summary>
    public PlumbVec3 surface_velocity;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbManifoldChange
{
    /// <summary>row of the last read</summary>
    public uint manifold;
    /// <summary>PLUMB_MANIFOLD_ bits</summary>
    public uint what;
    /// <summary>&gt;= 0</summary>
    public double friction;
    /// <summary>0 to 1</summary>
    public double restitution;
    public PlumbVec3 surface_velocity;
}

/// <summary>Needs PLUMB_NEED_CONTACT_MODIFICATION; PLUMB_CAP_MANIFOLD tells what an engine can change. Changes are of
/// this step alone.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbManifoldsTable
{
    public uint struct_size;
    public uint reserved;
    /// <summary>[world] Between step and wait: the manifolds of bodies that have PLUMB_BODY_MODIFY_CONTACTS, of those
    /// who do not sleep, before the solver sees them. out[capacity]; *count is how many there are, also when
    /// PLUMB_TRUNCATED; asked again they are the same until modify is called. An engine that takes a step in parts, or
    /// over again, has more after that, so read and modify until *count is 0. What was not read is solved as it is.
    /// stride is sizeof the caller's row.</summary>
    public IntPtr read;
    /// <summary>[world] All or none; changes what was read last, each manifold at most once (count 0: nothing), and the
    /// step goes on. Without manifolds that were read since the step began, or the last call,
    /// PLUMB_E_WRONG_PHASE.</summary>
    public IntPtr modify;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Read(PlumbWorld* world, PlumbManifold* @out, UIntPtr stride, uint capacity, uint* count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Modify(PlumbWorld* world, PlumbManifoldChange* changes, UIntPtr stride, uint count);
}

// --- plumb/modify.h
// plumb.modify/1: bodies, joints and shapes that become others while they live. Since 1.2.

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbBodyChange
{
    public ulong body;
    /// <summary>PLUMB_MODIFY_ bits of bodies</summary>
    public uint what;
    public uint motion;
    public uint flags;
    public uint locks;
    public ulong shape;
    public uint mass_mode;
    public uint reserved;
    public double density;
    public double mass;
    public PlumbVec3 centre_of_mass;
    public PlumbVec3 inertia;
    public PlumbQuat inertia_orientation;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbJointChange
{
    public ulong joint;
    /// <summary>PLUMB_MODIFY_ bits of joints</summary>
    public uint what;
    /// <summary>0 or 1; a joint is made enabled</summary>
    public uint enabled;
    public uint collide_connected;
    public uint reserved;
    public PlumbPose frame_a;
    public PlumbPose frame_b;
    public fixed uint axis_modes[6];
    public PlumbLimit_6 limits;
    public PlumbMotor_6 motors;
    public PlumbSpring_6 springs;
    public double rest_length;
    public double break_force;
    public double break_torque;
}

/// <summary>All or none; a body or joint stands in a call once. What sleeps and is changed, or rested on what is
/// changed, wakes. Contacts that a change ends, or begins, are told by the events of the next step. A snapshot of
/// bodies with other motions, shapes, masses, flags or locks is PLUMB_E_CORRUPT until they are as they were, and so is
/// one of shapes that are others. stride is sizeof the caller's row.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbModifyTable
{
    public uint struct_size;
    public uint reserved;
    /// <summary>[world]</summary>
    public IntPtr bodies;
    /// <summary>[world]</summary>
    public IntPtr joints;
    /// <summary>[world] Terrain that is dug, surfaces that bend: shapes[i] becomes what descs[i] says, whole and of the
    /// type that it has, for all bodies that have it; their masses stay. What sleeps where the surface is another
    /// wakes; elsewhere contacts and sleep go on. An engine finds by itself what differs: a mesh with the same indices,
    /// or a height field of the same rows, columns and spacing, costs far less than one made anew. user_data is not
    /// read. From then on a snapshot of a whole world knows the shape by what it is now.</summary>
    public IntPtr shapes;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Bodies(PlumbWorld* world, PlumbBodyChange* changes, UIntPtr stride, uint count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Joints(PlumbWorld* world, PlumbJointChange* changes, UIntPtr stride, uint count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Shapes(
        PlumbWorld* world, ulong* shapes, PlumbShapeDesc* descs, UIntPtr stride, uint count
    );
}

// --- plumb/settings.h
// plumb.settings/1: an engine's knobs by name, so that a host can list and sweep them without knowing the engine.

/// <summary>number holds bool (0 or 1), int and float; choice is the word of a choice, null otherwise.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbSettingValue
{
    public uint type;
    public uint reserved;
    public double number;
    /// <summary>[any] a value read from a backend lives as long as the process</summary>
    public byte* choice;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbSetting
{
    public byte* name;
    public PlumbSettingValue value;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbSettingInfo
{
    /// <summary>snake_case</summary>
    public byte* name;
    /// <summary>"m", "1", "m/s" ...; "" for bool and choice</summary>
    public byte* unit;
    /// <summary>one line</summary>
    public byte* doc;
    public uint type;
    public uint role;
    public uint flags;
    public uint choice_count;
    public byte** choices;
    /// <summary>of int and float, both allowed</summary>
    public double minimum;
    /// <summary>of int and float, both allowed</summary>
    public double maximum;
    public PlumbSettingValue default_value;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbSettingsTable
{
    public uint struct_size;
    /// <summary>how many settings there are</summary>
    public uint count;
    /// <summary>[any] Lives as long as the process; null when index &gt;= count.</summary>
    public IntPtr describe;
    /// <summary>[world]</summary>
    public IntPtr get;
    /// <summary>[world] Takes effect in the next step.</summary>
    public IntPtr set;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate PlumbSettingInfo* Describe(uint index);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Get(PlumbWorld* world, byte* name, PlumbSettingValue* value);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Set(PlumbWorld* world, byte* name, PlumbSettingValue* value);
}

// --- plumb/snapshot.h
// plumb.snapshot/1: save and restore a world in memory (rollback, save games), and a 64-bit hash of its state.

/// <summary>Two kinds of snapshot, both restored by restore:
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
/// same bits; approximate that warm-start data or an engine's order of bodies is lost.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbSnapshotTable
{
    public uint struct_size;
    public uint reserved;
    /// <summary>[world] Needs PLUMB_NEED_SNAPSHOT. *size is what it takes; with capacity &lt; *size nothing is written
    /// and the answer is PLUMB_TRUNCATED. data may be null when capacity is 0.</summary>
    public IntPtr save;
    /// <summary>[world] Of either kind. PLUMB_E_CORRUPT for data that is foreign, torn, of another version, of other
    /// bodies, or of shapes that this world has not: then nothing has changed.</summary>
    public IntPtr restore;
    /// <summary>[world] Over pose and velocity rows in float64 in order of creation, every NaN as the same NaN. Always
    /// there.</summary>
    public IntPtr hash;
    /// <summary>[world] As save, of the whole world. Since 1.2.</summary>
    public IntPtr save_world;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Save(PlumbWorld* world, void* data, UIntPtr capacity, UIntPtr* size);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Restore(PlumbWorld* world, void* data, UIntPtr size);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Hash(PlumbWorld* world, ulong* hash);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int SaveWorld(PlumbWorld* world, void* data, UIntPtr capacity, UIntPtr* size);
}

// --- plumb/state.h
// plumb.state/1: state rows lent without a copy, as DLPack tensors (the 1.x versioned layout of dmlc/dlpack).

/// <summary>Binary layout of DLPack 1.x, declared here so that nobody needs its header; a host casts to its own DLPack
/// type.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbDLDevice
{
    /// <summary>kDLCPU 1, kDLCUDA 2</summary>
    public int device_type;
    public int device_id;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbDLDataType
{
    /// <summary>kDLFloat 2</summary>
    public byte code;
    public byte bits;
    public ushort lanes;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbDLTensor
{
    public void* data;
    public PlumbDLDevice device;
    public int ndim;
    public PlumbDLDataType dtype;
    public long* shape;
    /// <summary>in elements</summary>
    public long* strides;
    public ulong byte_offset;
}

/// <summary>PlumbDLManagedTensor.version</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbDLManagedTensor_version
{
    public uint major;
    public uint minor;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbDLManagedTensor
{
    public PlumbDLManagedTensor_version version;
    public void* manager_ctx;
    /// <summary>[any] also after the world is gone</summary>
    public IntPtr deleter;
    /// <summary>bit 0: read only, bit 1: is a copy</summary>
    public ulong flags;
    public PlumbDLTensor dl_tensor;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void Deleter(PlumbDLManagedTensor* self);
}

/// <summary>When the rows may be read. On the host both are null and the rows are ready.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbFence
{
    /// <summary>cudaStream_t that wrote the rows</summary>
    public void* stream;
    /// <summary>cudaEvent_t recorded after it</summary>
    public void* @event;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbStateRequest
{
    public uint struct_size;
    /// <summary>pose or velocity</summary>
    public uint field;
    /// <summary>1 host, 2 CUDA</summary>
    public int device_type;
    /// <summary>0: fail with PLUMB_E_UNSUPPORTED rather than copy; 1: copy and answer PLUMB_COPIED</summary>
    public uint allow_copy;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbStateTable
{
    public uint struct_size;
    public uint reserved;
    /// <summary>[world] Rows x columns in the engine's type. The rows stay as they are until the next step; the caller
    /// calls the tensor's deleter when done. fence may be null.</summary>
    public IntPtr borrow;
    /// <summary>[world] Which body each row is (0: none). *generation changes whenever the map does.</summary>
    public IntPtr rows;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Borrow(
        PlumbWorld* world, PlumbStateRequest* request, PlumbDLManagedTensor** tensor, PlumbFence* fence
    );

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Rows(PlumbWorld* world, ulong* ids, uint capacity, uint* count, ulong* generation);
}

// --- plumb/world.h
// A world, its step, and what comes out of a step: the report, contacts and events.

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbWorldDesc
{
    public uint struct_size;
    /// <summary>how many the world may use; 0 is 1. More than the engine can use is not an error</summary>
    public uint threads;
    public ulong needs;
    /// <summary>m/s2</summary>
    public PlumbVec3 gravity;
    /// <summary>hints; 0 is unknown</summary>
    public uint body_capacity;
    public uint contact_capacity;
    public uint joint_capacity;
    public uint setting_count;
    /// <summary>set before anything else happens; the only way for creation-only settings</summary>
    public PlumbSetting* settings;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbStepDesc
{
    public uint struct_size;
    public uint reserved;
    /// <summary>s, &gt; 0</summary>
    public double dt;
}

/// <summary>The host sets struct_size; the backend fills the rest. NaN stands for "not known".</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbStepReport
{
    public uint struct_size;
    /// <summary>used by this step</summary>
    public uint threads;
    /// <summary>steps done since the world was made</summary>
    public ulong step;
    /// <summary>alive, all motions</summary>
    public uint bodies;
    /// <summary>dynamic bodies not asleep</summary>
    public uint awake;
    /// <summary>candidate pairs of the broad phase; UINT32_MAX when not known</summary>
    public uint pairs;
    /// <summary>points</summary>
    public uint contacts;
    public uint joints;
    /// <summary>contacts, pairs or events that the engine found and lost</summary>
    public uint dropped;
    /// <summary>dynamic bodies whose pose or velocity is NaN or infinite</summary>
    public uint nonfinite;
    /// <summary>PlumbStepRemark bits</summary>
    public uint remarks;
    /// <summary>of the engine's own solver, in its own measure</summary>
    public double residual;
    public fixed double phase_seconds[8];
}

/// <summary>One contact point as the last step solved it: geometry at detection, impulse summed over the
/// step.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbContact
{
    public ulong body_a;
    public ulong body_b;
    /// <summary>child of a compound, triangle of a mesh; else 0</summary>
    public uint child_a;
    /// <summary>child of a compound, triangle of a mesh; else 0</summary>
    public uint child_b;
    /// <summary>world, m; between the two surfaces, where is the engine's choice</summary>
    public PlumbVec3 position;
    /// <summary>unit, from a to b</summary>
    public PlumbVec3 normal;
    /// <summary>m; positive: overlap, negative: gap</summary>
    public double depth;
    /// <summary>N s on b along the normal; NaN where the engine does not tell</summary>
    public double normal_impulse;
    /// <summary>N s on b, world axes; NaN where the engine does not tell</summary>
    public PlumbVec3 tangent_impulse;
    /// <summary>equal from step to step for the same pair of features; 0: not known</summary>
    public ulong feature;
}

/// <summary>In the order: type, then body_a's slot, then body_b's slot, then the joint's slot.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbEvent
{
    public uint type;
    public uint reserved;
    public ulong body_a;
    public ulong body_b;
    public ulong joint;
}

// --- plumb/worlds.h
// plumb.worlds/1: many worlds of one backend whose steps are taken together. Since 1.2.

/// <summary>A device takes thousands of small worlds in the time of one, if it is given their steps at once.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbWorldsTable
{
    public uint struct_size;
    public uint reserved;
    /// <summary>[world, each of them] From now on the steps of this world and of the others are taken together: what
    /// step begins may not run before one of them is waited for, and runs then with what the others have begun. So
    /// begin the step of each, on any threads, and then wait for each; a world that takes no part is left out by not
    /// stepping it. No result changes, and each world is called, reports and is destroyed as before. others: worlds of
    /// the same backend, all different, none within a step (PLUMB_E_WRONG_PHASE); count 0: this one is by itself again.
    /// Who was in another group leaves it. A backend on which that is no gain does nothing.</summary>
    public IntPtr group;
    /// <summary>[world, each of its group] As borrow of plumb.state/1, of all worlds of the group: worlds x rows x
    /// columns, this world first and the others as they were named. Whose rows they are tells each world's
    /// plumb.state/1. All must have as many rows, and none may be gone since. Of a world in no group its own.</summary>
    public IntPtr borrow_all;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Group(PlumbWorld* world, PlumbWorld** others, uint count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int BorrowAll(
        PlumbWorld* world, PlumbStateRequest* request, PlumbDLManagedTensor** tensor, PlumbFence* fence
    );
}

// --- plumb/plumb.h
// Plumb: a stable interface to rigid-body physics engines.

[UnmanagedFunctionPointer(CallingConvention.Cdecl)]
public unsafe delegate void PlumbTask(void* context, uint index);

/// <summary>Lives as long as the process. Every pointer may be null: a backend works without any of it. A backend keeps
/// what the first opening of it in the process lent.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbHost
{
    public uint struct_size;
    /// <summary>threads behind run, the caller's included; 0: run is null</summary>
    public uint worker_count;
    public void* user;
    /// <summary>[any] One line, no newline at its end.</summary>
    public IntPtr log;
    /// <summary>[any] Calls task(context, i) for every i &lt; count, in any order and on any thread, and returns when
    /// all are done.</summary>
    public IntPtr run;
    /// <summary>[any] Memory for what grows with a scene; PLUMB_CAP_HOST_MEMORY says what a backend takes from it.
    /// bytes &gt; 0; alignment is a power of two, at most 256. Null where there is no more: the call that asked for it
    /// fails with PLUMB_E_OUT_OF_MEMORY. release is given what allocate gave, never null. Both functions or neither.
    /// Since 1.2.</summary>
    public IntPtr allocate;
    public IntPtr release;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void Log(void* user, uint level, byte* line);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void Run(void* user, IntPtr task, void* context, uint count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void* Allocate(void* user, UIntPtr bytes, UIntPtr alignment);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void Release(void* user, void* memory);
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbBackendInfo
{
    public uint struct_size;
    public uint determinism;
    /// <summary>"bullet": what a user types</summary>
    public byte* name;
    /// <summary>of the engine: "3.24"</summary>
    public byte* version;
    /// <summary>changes whenever the results or times of this library may: version, compiler, flags</summary>
    public byte* build;
    /// <summary>one line</summary>
    public byte* description;
    /// <summary>"cpu" or the device's name</summary>
    public byte* device;
    /// <summary>two backends of one group cannot be open in one process; "" for none</summary>
    public byte* exclusion_group;
    /// <summary>of the engine's arithmetic</summary>
    public uint precision;
    /// <summary>that a world can use</summary>
    public uint max_threads;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbBackendTable
{
    public uint struct_size;
    /// <summary>that was negotiated</summary>
    public uint version;
    /// <summary>[any] Lives as long as the process.</summary>
    public IntPtr info;
    /// <summary>[any] What is unknown to the backend is PLUMB_NONE. note (may be null) receives a sentence or "", never
    /// null; it lives as long as the process.</summary>
    public IntPtr capability;
    /// <summary>[any] The table of an extension ("plumb.joints/1"), or null. Lives as long as the process.</summary>
    public IntPtr extension;
    /// <summary>[any]</summary>
    public IntPtr create_world;
    /// <summary>[world] Takes null. All handles of the world are gone; lent state lives on.</summary>
    public IntPtr destroy_world;
    /// <summary>[any] Text of the last failure: of this world, or with null of this thread's last create_world. Never
    /// null; lives until the next call on the world.</summary>
    public IntPtr error_text;
    /// <summary>Shapes and bodies. [world] All or none. stride is sizeof the caller's descriptor. Destroying a shape
    /// that a body or compound still uses is PLUMB_E_IN_USE, and so is destroying a body that still has
    /// joints.</summary>
    public IntPtr create_shapes;
    public IntPtr destroy_shapes;
    public IntPtr create_bodies;
    public IntPtr destroy_bodies;
    /// <summary>[world] Live bodies in order of creation.</summary>
    public IntPtr list_bodies;
    /// <summary>[world] user_data of the descriptor.</summary>
    public IntPtr user_data;
    /// <summary>[world] One row a body. ids null: the first count live bodies in order of creation. stride: bytes
    /// between rows.</summary>
    public IntPtr read;
    public IntPtr write;
    /// <summary>[world] m/s2</summary>
    public IntPtr set_gravity;
    /// <summary>[world] step begins a step and may return before it is done; until wait returns, nothing else may be
    /// called (but what manifolds.h has). wait fills the report (may be null).</summary>
    public IntPtr step;
    public IntPtr wait;
    /// <summary>[world] Of the last step. out[capacity]; *count is how many there are, also when PLUMB_TRUNCATED.
    /// stride is sizeof the caller's row. Events also hold what destroying bodies since the step before has
    /// ended.</summary>
    public IntPtr contacts;
    public IntPtr events;

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate PlumbBackendInfo* Info();

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Capability(uint kind, uint a, uint b, byte** note);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void* Extension(byte* name);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int CreateWorld(PlumbWorldDesc* desc, PlumbWorld** world);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void DestroyWorld(PlumbWorld* world);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate byte* ErrorText(PlumbWorld* world);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int CreateShapes(
        PlumbWorld* world, PlumbShapeDesc* descs, UIntPtr stride, uint count, ulong* ids
    );

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int DestroyShapes(PlumbWorld* world, ulong* ids, uint count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int CreateBodies(
        PlumbWorld* world, PlumbBodyDesc* descs, UIntPtr stride, uint count, ulong* ids
    );

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int DestroyBodies(PlumbWorld* world, ulong* ids, uint count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int ListBodies(PlumbWorld* world, ulong* ids, uint capacity, uint* count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int UserData(PlumbWorld* world, ulong id, ulong* user_data);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Read(
        PlumbWorld* world, uint field, uint type, ulong* ids, uint count, void* rows, UIntPtr stride
    );

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Write(
        PlumbWorld* world, uint field, uint type, ulong* ids, uint count, void* rows, UIntPtr stride
    );

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int SetGravity(PlumbWorld* world, PlumbVec3* gravity);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Step(PlumbWorld* world, PlumbStepDesc* desc);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Wait(PlumbWorld* world, PlumbStepReport* report);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Contacts(
        PlumbWorld* world, PlumbContact* @out, UIntPtr stride, uint capacity, uint* count
    );

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int Events(PlumbWorld* world, PlumbEvent* @out, UIntPtr stride, uint capacity, uint* count);
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbOpenRequest
{
    public uint struct_size;
    /// <summary>what the host can speak</summary>
    public uint min_version;
    /// <summary>what the host can speak</summary>
    public uint max_version;
    public uint reserved;
    /// <summary>may be null</summary>
    public PlumbHost* host;
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbOpenReply
{
    public uint struct_size;
    /// <summary>chosen, within the range of the request</summary>
    public uint version;
    public PlumbBackendTable* table;
    /// <summary>why not, when the result is below 0: one sentence that says what to do</summary>
    public fixed byte message[256];
}

[UnmanagedFunctionPointer(CallingConvention.Cdecl)]
public unsafe delegate int plumb_backend_open(PlumbOpenRequest* request, PlumbOpenReply* reply);

[UnmanagedFunctionPointer(CallingConvention.Cdecl)]
public unsafe delegate int PlumbOpenFunction(PlumbOpenRequest* request, PlumbOpenReply* reply);

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbLimit_6
{
    private PlumbLimit at0, at1, at2, at3, at4, at5;

    public PlumbLimit this[int index]
    {
        get { Check(index); fixed (PlumbLimit* rows = &at0) return rows[index]; }
        set { Check(index); fixed (PlumbLimit* rows = &at0) rows[index] = value; }
    }

    private static void Check(int index)
    {
        if (index < 0 || index >= 6) throw new IndexOutOfRangeException();
    }
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbMotor_6
{
    private PlumbMotor at0, at1, at2, at3, at4, at5;

    public PlumbMotor this[int index]
    {
        get { Check(index); fixed (PlumbMotor* rows = &at0) return rows[index]; }
        set { Check(index); fixed (PlumbMotor* rows = &at0) rows[index] = value; }
    }

    private static void Check(int index)
    {
        if (index < 0 || index >= 6) throw new IndexOutOfRangeException();
    }
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbSpring_6
{
    private PlumbSpring at0, at1, at2, at3, at4, at5;

    public PlumbSpring this[int index]
    {
        get { Check(index); fixed (PlumbSpring* rows = &at0) return rows[index]; }
        set { Check(index); fixed (PlumbSpring* rows = &at0) rows[index] = value; }
    }

    private static void Check(int index)
    {
        if (index < 0 || index >= 6) throw new IndexOutOfRangeException();
    }
}

[StructLayout(LayoutKind.Sequential)]
public unsafe struct PlumbVec3_4
{
    private PlumbVec3 at0, at1, at2, at3;

    public PlumbVec3 this[int index]
    {
        get { Check(index); fixed (PlumbVec3* rows = &at0) return rows[index]; }
        set { Check(index); fixed (PlumbVec3* rows = &at0) rows[index] = value; }
    }

    private static void Check(int index)
    {
        if (index < 0 || index >= 4) throw new IndexOutOfRangeException();
    }
}

public static class Constants
{
    // --- plumb/types.h
    // Plain values that cross the wall: results, handles, vectors, poses.
    /// <summary>The revision of this interface. Minor versions only append; nothing that is here moves or changes its
    /// meaning.</summary>
    public static uint PLUMB_MAKE_VERSION(uint major, uint minor)
    {
        return ((uint)major << 16) | (uint)minor;
    }
    public static uint PLUMB_VERSION_MAJOR(uint version)
    {
        return (uint)version >> 16;
    }
    public static uint PLUMB_VERSION_MINOR(uint version)
    {
        return (uint)version & 0xffffu;
    }
    public const uint PLUMB_VERSION = 65538u;

    // PlumbResult, int. 0: done. Above 0: done, with a remark. Below 0: failed and nothing changed, except after
    // WORLD_LOST and DEVICE_LOST, when only destroying the world and reading the error text remain legal.
    public const int PLUMB_OK = 0;
    /// <summary>the caller's array was too short: it is full, and the count says how many there are</summary>
    public const int PLUMB_TRUNCATED = 1;
    /// <summary>a capacity had to grow; this call cost more than usual</summary>
    public const int PLUMB_GROWN = 2;
    /// <summary>state was copied because it could not be lent</summary>
    public const int PLUMB_COPIED = 3;
    /// <summary>a value out of its range, not finite, or a null where none is allowed</summary>
    public const int PLUMB_E_INVALID_ARGUMENT = -1;
    /// <summary>the handle never existed here, or its object is gone</summary>
    public const int PLUMB_E_STALE_HANDLE = -2;
    /// <summary>the engine cannot do this; the text says what is missing</summary>
    public const int PLUMB_E_UNSUPPORTED = -3;
    /// <summary>needs a bit that PlumbWorldDesc.needs did not declare</summary>
    public const int PLUMB_E_NOT_DECLARED = -4;
    public const int PLUMB_E_OUT_OF_MEMORY = -5;
    /// <summary>for example a read between step and wait</summary>
    public const int PLUMB_E_WRONG_PHASE = -6;
    /// <summary>two callers at a time where only one is allowed</summary>
    public const int PLUMB_E_WRONG_THREAD = -7;
    /// <summary>host and backend have no interface version in common</summary>
    public const int PLUMB_E_VERSION = -8;
    /// <summary>a backend of the same exclusion group is already open in this process</summary>
    public const int PLUMB_E_EXCLUDED = -9;
    /// <summary>the shape still has bodies, or the body still has joints</summary>
    public const int PLUMB_E_IN_USE = -10;
    /// <summary>a snapshot, trace or cooked shape that is foreign, torn or of another version</summary>
    public const int PLUMB_E_CORRUPT = -11;
    /// <summary>an exception inside the backend; its text is the error text</summary>
    public const int PLUMB_E_INTERNAL = -12;
    public const int PLUMB_E_WORLD_LOST = -13;
    public const int PLUMB_E_DEVICE_LOST = -14;

    // PlumbShape, ulong. Handles are values: the slot in the low 32 bits, the slot's generation (from 1) in the high
    // 32. 0 is no object. A handle of a destroyed object stays stale for ever and is answered with
    // PLUMB_E_STALE_HANDLE.

    // PlumbBody, ulong.

    // PlumbJoint, ulong.

    // PlumbDegree, int. How truly an engine has a thing. Ordered: a larger value is better.
    /// <summary>absent: asking for it is PLUMB_E_UNSUPPORTED</summary>
    public const int PLUMB_NONE = 0;
    /// <summary>there, with a meaning that differs from the interface's; the note says how</summary>
    public const int PLUMB_APPROXIMATE = 1;
    /// <summary>there with the right meaning, made by the adapter out of other things</summary>
    public const int PLUMB_EMULATED = 2;
    public const int PLUMB_NATIVE = 3;

    // PlumbDataType, uint.
    public const uint PLUMB_F32 = 1u;
    public const uint PLUMB_F64 = 2u;

    // --- plumb/shapes.h
    // Collision shapes. A shape may be shared by any number of bodies of its world, and stays what it is; but for
    // meshes and height fields, which modify.h lets become others where the backend can.

    // PlumbShapeType, uint.
    /// <summary>radius</summary>
    public const uint PLUMB_SPHERE = 0u;
    /// <summary>half_extents</summary>
    public const uint PLUMB_BOX = 1u;
    /// <summary>radius, half_height of the segment along local y</summary>
    public const uint PLUMB_CAPSULE = 2u;
    /// <summary>radius, half_height along local y</summary>
    public const uint PLUMB_CYLINDER = 3u;
    /// <summary>vertices: the hull of them</summary>
    public const uint PLUMB_CONVEX_HULL = 4u;
    /// <summary>vertices, indices: counter-clockwise seen from outside</summary>
    public const uint PLUMB_TRIANGLE_MESH = 5u;
    /// <summary>heights, rows, columns, spacing</summary>
    public const uint PLUMB_HEIGHT_FIELD = 6u;
    /// <summary>the half space y &lt;= 0 of the local frame; static bodies only</summary>
    public const uint PLUMB_PLANE = 7u;
    /// <summary>children</summary>
    public const uint PLUMB_COMPOUND = 8u;
    public const uint PLUMB_SHAPE_TYPE_COUNT = 9u;
    /// <summary>In PlumbShapeDesc.triangle_materials: the material of the body that has the shape. Since 1.2</summary>
    public const uint PLUMB_BODY_MATERIAL = 4294967295u;

    // --- plumb/bodies.h
    // Bodies, and the fields in which their state is read and written in batches.

    // PlumbMotion, uint.
    /// <summary>never moves of itself; may be teleported by writing its pose</summary>
    public const uint PLUMB_STATIC = 0u;
    /// <summary>moves as the host says and is moved by nothing</summary>
    public const uint PLUMB_KINEMATIC = 1u;
    public const uint PLUMB_DYNAMIC = 2u;
    public const uint PLUMB_MOTION_COUNT = 3u;

    // PlumbBodyDesc.flags
    /// <summary>reports overlaps as events, pushes nothing; needs PLUMB_NEED_SENSORS. Sees every body that its filter
    /// lets it see, but where both are static</summary>
    public const uint PLUMB_BODY_SENSOR = 1u << 0;
    /// <summary>must not pass through others however fast it is; needs PLUMB_NEED_CCD</summary>
    public const uint PLUMB_BODY_CCD = 1u << 1;
    /// <summary>a particle: orientation and angular velocity stay as they are</summary>
    public const uint PLUMB_BODY_NO_ROTATION = 1u << 2;
    /// <summary>starts asleep; needs PLUMB_NEED_SLEEPING</summary>
    public const uint PLUMB_BODY_ASLEEP = 1u << 3;
    public const uint PLUMB_BODY_NEVER_SLEEPS = 1u << 4;
    /// <summary>its manifolds are shown to the host before they are solved (manifolds.h); needs
    /// PLUMB_NEED_CONTACT_MODIFICATION. Since 1.2</summary>
    public const uint PLUMB_BODY_MODIFY_CONTACTS = 1u << 5;

    // PlumbBodyDesc.locks: motion along or about the world's axes that is taken away; needs PLUMB_NEED_AXIS_LOCKS.
    public const uint PLUMB_LOCK_LINEAR_X = 1u << 0;
    public const uint PLUMB_LOCK_LINEAR_Y = 1u << 1;
    public const uint PLUMB_LOCK_LINEAR_Z = 1u << 2;
    public const uint PLUMB_LOCK_ANGULAR_X = 1u << 3;
    public const uint PLUMB_LOCK_ANGULAR_Y = 1u << 4;
    public const uint PLUMB_LOCK_ANGULAR_Z = 1u << 5;

    // PlumbMassMode, uint.
    /// <summary>mass, centre of mass and inertia of the shape filled with density</summary>
    public const uint PLUMB_MASS_FROM_DENSITY = 0u;
    /// <summary>as above, scaled so that the mass is mass; a body without a shape has inertia 0</summary>
    public const uint PLUMB_MASS_FROM_TOTAL = 1u;
    /// <summary>mass, centre_of_mass, inertia and inertia_orientation as given</summary>
    public const uint PLUMB_MASS_EXPLICIT = 2u;

    // PlumbField, uint. A field is a row of numbers for every body. Pose and velocity rows are state: a write sets
    // them. Force to impulse rows act: a write adds to what acts on the body in the next step and is spent by it.
    /// <summary>7: position, orientation x y z w; of the body frame</summary>
    public const uint PLUMB_FIELD_POSE = 0u;
    /// <summary>6: linear of the centre of mass, angular; world axes</summary>
    public const uint PLUMB_FIELD_VELOCITY = 1u;
    /// <summary>3: N at the centre of mass, write only; needs PLUMB_NEED_FORCES</summary>
    public const uint PLUMB_FIELD_FORCE = 2u;
    /// <summary>3: N m, world axes, write only</summary>
    public const uint PLUMB_FIELD_TORQUE = 3u;
    /// <summary>3: N s at the centre of mass, write only; changes the velocity at once</summary>
    public const uint PLUMB_FIELD_IMPULSE = 4u;
    /// <summary>3: N m s, write only; changes the velocity at once</summary>
    public const uint PLUMB_FIELD_ANGULAR_IMPULSE = 5u;
    /// <summary>6: force, world point, write only</summary>
    public const uint PLUMB_FIELD_FORCE_AT_POINT = 6u;
    /// <summary>6: impulse, world point, write only</summary>
    public const uint PLUMB_FIELD_IMPULSE_AT_POINT = 7u;
    /// <summary>1: 0 asleep, 1 awake; what is not dynamic never sleeps</summary>
    public const uint PLUMB_FIELD_AWAKE = 8u;
    /// <summary>7: pose that a kinematic body reaches in exactly the next step, write only. After that step it reads
    /// the velocity that led there; without a new target it stands still in the one after</summary>
    public const uint PLUMB_FIELD_KINEMATIC_TARGET = 9u;
    /// <summary>11: mass, centre of mass (3), principal inertia (3), inertia orientation (4); read only</summary>
    public const uint PLUMB_FIELD_MASS = 10u;
    /// <summary>2: friction, restitution</summary>
    public const uint PLUMB_FIELD_MATERIAL = 11u;
    /// <summary>1</summary>
    public const uint PLUMB_FIELD_GRAVITY_SCALE = 12u;
    /// <summary>2: linear, angular, 1/s</summary>
    public const uint PLUMB_FIELD_DAMPING = 13u;
    /// <summary>3: m/s, body frame</summary>
    public const uint PLUMB_FIELD_SURFACE_VELOCITY = 14u;
    /// <summary>3: category, mask, group, as whole numbers</summary>
    public const uint PLUMB_FIELD_FILTER = 15u;
    /// <summary>2: rolling, spinning, m. Since 1.2</summary>
    public const uint PLUMB_FIELD_ROLLING_FRICTION = 16u;
    public const uint PLUMB_FIELD_COUNT = 17u;

    // --- plumb/queries.h
    // plumb.queries/1: rays, shape casts and overlaps against the world as the last step left it. Always in batches.
    public const string PLUMB_EXT_QUERIES = "plumb.queries/1";

    // PlumbQueryKind, uint. First argument of PLUMB_CAP_QUERY; the second is the shape type that is cast or overlapped
    // (0 for rays).
    public const uint PLUMB_QUERY_RAY = 0u;
    public const uint PLUMB_QUERY_CAST = 1u;
    public const uint PLUMB_QUERY_OVERLAP = 2u;
    /// <summary>since 1.2</summary>
    public const uint PLUMB_QUERY_PENETRATION = 3u;
    /// <summary>since 1.2</summary>
    public const uint PLUMB_QUERY_TURNING_CAST = 4u;
    public const uint PLUMB_QUERY_KIND_COUNT = 5u;

    // PlumbHitMode, uint.
    /// <summary>hits has one row a query, in its order; body 0 where nothing was hit</summary>
    public const uint PLUMB_HIT_CLOSEST = 0u;
    /// <summary>hits has all rows, sorted by query, then fraction, then body slot: one a body</summary>
    public const uint PLUMB_HIT_ALL = 1u;

    // --- plumb/closest.h
    // plumb.closest/1: which bodies are near a convex shape, how far away, and where, in the world as the last step
    // left it. Always in batches. Since 1.2.
    public const string PLUMB_EXT_CLOSEST = "plumb.closest/1";

    // --- plumb/collide.h
    // plumb.collide/1: collision without a step. Posed shapes in, contacts and distances out.
    public const string PLUMB_EXT_COLLIDE = "plumb.collide/1";

    // --- plumb/cooking.h
    // plumb.cooking/1: shapes worked out ahead, in a build step or on threads that load, and made from bytes in a
    // world. Since 1.2.
    public const string PLUMB_EXT_COOKING = "plumb.cooking/1";

    // --- plumb/debug.h
    // plumb.debug/1: what the engine sees, for pictures and for tests that want no back door.
    public const string PLUMB_EXT_DEBUG = "plumb.debug/1";

    // --- plumb/exceptions.h
    // plumb.exceptions/1: excluded pairs: bodies that do not touch, whatever their filters say.
    public const string PLUMB_EXT_EXCEPTIONS = "plumb.exceptions/1";

    // --- plumb/joints.h
    // plumb.joints/1: joints between two bodies, or between a body and the world.
    public const string PLUMB_EXT_JOINTS = "plumb.joints/1";

    // PlumbJointType, uint.
    /// <summary>origins coincide</summary>
    public const uint PLUMB_JOINT_BALL = 0u;
    /// <summary>origins and x axes coincide; free axis 3</summary>
    public const uint PLUMB_JOINT_HINGE = 1u;
    /// <summary>orientations equal, b's origin on a's x axis; free axis 0</summary>
    public const uint PLUMB_JOINT_SLIDER = 2u;
    /// <summary>distance of the origins: rest_length, or within limits[0]; spring on axis 0</summary>
    public const uint PLUMB_JOINT_DISTANCE = 3u;
    /// <summary>frames coincide</summary>
    public const uint PLUMB_JOINT_FIXED = 4u;
    /// <summary>origins coincide, a's x axis stays square to b's y axis; free axes 3 and 4</summary>
    public const uint PLUMB_JOINT_UNIVERSAL = 5u;
    /// <summary>axis_modes say which of the six axes are free, locked or limited</summary>
    public const uint PLUMB_JOINT_GENERIC = 6u;
    /// <summary>origins coincide; axes 3 4 5 are a twist and a swing (head of joints.h)</summary>
    public const uint PLUMB_JOINT_SWING_TWIST = 7u;
    /// <summary>turns about both x axes (head of joints.h). Since 1.2</summary>
    public const uint PLUMB_JOINT_GEAR = 8u;
    /// <summary>a's turn about its x axis and b's way along its own. Since 1.2</summary>
    public const uint PLUMB_JOINT_RACK_AND_PINION = 9u;
    public const uint PLUMB_JOINT_TYPE_COUNT = 10u;

    // PlumbAxisMode, uint.
    public const uint PLUMB_AXIS_FREE = 0u;
    public const uint PLUMB_AXIS_LOCKED = 1u;
    public const uint PLUMB_AXIS_LIMITED = 2u;

    // PlumbSpringMode, uint. What a spring's two numbers are. By stiffness needs PLUMB_JOINT_HAS_STIFFNESS.
    /// <summary>frequency and damping ratio with the pair's effective mass on the axis</summary>
    public const uint PLUMB_SPRING_FREQUENCY = 0u;
    /// <summary>stiffness and damping: force = -stiffness (x - rest) - damping dx/dt. A stiffness of 0 is a damper;
    /// with rest as the target it is a PD controller.</summary>
    public const uint PLUMB_SPRING_STIFFNESS = 1u;

    // PlumbJointField, uint. Rows of a joint, read in batches.
    /// <summary>6: coordinates of the six axes (angles in -pi..pi)</summary>
    public const uint PLUMB_JOINT_COORDINATES = 0u;
    /// <summary>6: force, torque on body b at frame b's origin in the last step, world axes; N, N m</summary>
    public const uint PLUMB_JOINT_REACTION = 1u;
    /// <summary>12: target velocity and max force of axis 0, of axis 1, ...; also written</summary>
    public const uint PLUMB_JOINT_MOTOR = 2u;
    /// <summary>6: rest of the spring of axis 0, of axis 1, ...: the targets of PD controllers; of a distance joint the
    /// first is its rest_length, &gt;= 0. Also written, which needs PLUMB_JOINT_HAS_TARGETS. Since 1.2.</summary>
    public const uint PLUMB_JOINT_SPRING_REST = 3u;
    public const uint PLUMB_JOINT_FIELD_COUNT = 4u;

    // PlumbJointFeature, uint. What a joint type may have beyond itself; second argument of PLUMB_CAP_JOINT_FEATURE.
    public const uint PLUMB_JOINT_HAS_LIMITS = 0u;
    public const uint PLUMB_JOINT_HAS_MOTORS = 1u;
    public const uint PLUMB_JOINT_HAS_SPRINGS = 2u;
    public const uint PLUMB_JOINT_BREAKS = 3u;
    public const uint PLUMB_JOINT_HAS_REACTION = 4u;
    /// <summary>springs by PLUMB_SPRING_STIFFNESS</summary>
    public const uint PLUMB_JOINT_HAS_STIFFNESS = 5u;
    /// <summary>its PLUMB_JOINT_SPRING_REST rows can be written</summary>
    public const uint PLUMB_JOINT_HAS_TARGETS = 6u;
    public const uint PLUMB_JOINT_FEATURE_COUNT = 7u;

    // --- plumb/manifolds.h
    // plumb.manifolds/1: contact modification: what touches is shown to the host before the solver sees it. Since 1.2.
    public const string PLUMB_EXT_MANIFOLDS = "plumb.manifolds/1";

    // PlumbManifoldChange.what: the members that count; the others are not read.
    /// <summary>in this step the two do not touch there: no contact, no event, no impact</summary>
    public const uint PLUMB_MANIFOLD_DISABLED = 1u << 0;
    /// <summary>needs PLUMB_NEED_FRICTION</summary>
    public const uint PLUMB_MANIFOLD_FRICTION = 1u << 1;
    /// <summary>needs PLUMB_NEED_RESTITUTION</summary>
    public const uint PLUMB_MANIFOLD_RESTITUTION = 1u << 2;
    /// <summary>needs PLUMB_NEED_SURFACE_VELOCITY</summary>
    public const uint PLUMB_MANIFOLD_SURFACE_VELOCITY = 1u << 3;
    public const uint PLUMB_MANIFOLD_CHANGE_COUNT = 4u;
    public const uint PLUMB_MANIFOLD_POINTS = 4u;

    // --- plumb/modify.h
    // plumb.modify/1: bodies, joints and shapes that become others while they live. Since 1.2.
    public const string PLUMB_EXT_MODIFY = "plumb.modify/1";

    // PlumbBodyChange.what: the members that count; the others are not read.
    /// <summary>motion. What becomes dynamic keeps the velocity that it had, and the mass of when it was dynamic last;
    /// a body that never was needs PLUMB_MODIFY_MASS, too. What becomes kinematic or static stands still. Joints may be
    /// left between bodies that are not dynamic: they do nothing until one of the two is.</summary>
    public const uint PLUMB_MODIFY_MOTION = 1u << 0;
    /// <summary>shape; 0: none. The mass stays as it is without PLUMB_MODIFY_MASS</summary>
    public const uint PLUMB_MODIFY_SHAPE = 1u << 1;
    /// <summary>mass_mode and what it reads, with the shape that the body has after this call; dynamic bodies only. The
    /// body goes on as it moved: when its centre of mass is elsewhere, its linear velocity is that of the new
    /// one.</summary>
    public const uint PLUMB_MODIFY_MASS = 1u << 2;
    /// <summary>flags, but PLUMB_BODY_ASLEEP (write PLUMB_FIELD_AWAKE). A body that is to turn and had
    /// PLUMB_BODY_NO_ROTATION needs PLUMB_MODIFY_MASS, too.</summary>
    public const uint PLUMB_MODIFY_FLAGS = 1u << 3;
    /// <summary>locks; velocity along what is locked is gone</summary>
    public const uint PLUMB_MODIFY_LOCKS = 1u << 4;
    public const uint PLUMB_MODIFY_BODY_COUNT = 5u;

    // PlumbJointChange.what
    /// <summary>frame_a, frame_b: the joint pulls its bodies there</summary>
    public const uint PLUMB_MODIFY_FRAMES = 1u << 0;
    /// <summary>limits; rest_length of a distance joint; axis_modes of a generic one</summary>
    public const uint PLUMB_MODIFY_LIMITS = 1u << 1;
    /// <summary>motors; PLUMB_JOINT_MOTOR rows change less and cost less</summary>
    public const uint PLUMB_MODIFY_MOTORS = 1u << 2;
    /// <summary>springs; likewise PLUMB_JOINT_SPRING_REST rows</summary>
    public const uint PLUMB_MODIFY_SPRINGS = 1u << 3;
    /// <summary>break_force, break_torque</summary>
    public const uint PLUMB_MODIFY_STRENGTH = 1u << 4;
    /// <summary>collide_connected</summary>
    public const uint PLUMB_MODIFY_COLLIDE_CONNECTED = 1u << 5;
    /// <summary>enabled; a joint that is not lets its bodies go and touch, and waits for 1</summary>
    public const uint PLUMB_MODIFY_ENABLED = 1u << 6;
    public const uint PLUMB_MODIFY_JOINT_COUNT = 7u;

    // --- plumb/settings.h
    // plumb.settings/1: an engine's knobs by name, so that a host can list and sweep them without knowing the engine.
    public const string PLUMB_EXT_SETTINGS = "plumb.settings/1";

    // PlumbSettingType, uint.
    public const uint PLUMB_SETTING_BOOL = 0u;
    public const uint PLUMB_SETTING_INT = 1u;
    public const uint PLUMB_SETTING_FLOAT = 2u;
    public const uint PLUMB_SETTING_CHOICE = 3u;

    // PlumbSettingRole, uint.
    /// <summary>more of it costs time and buys accuracy</summary>
    public const uint PLUMB_ROLE_QUALITY = 0u;
    /// <summary>changes time, not results (within the engine's determinism)</summary>
    public const uint PLUMB_ROLE_SPEED = 1u;
    /// <summary>another model, not more or less of the same</summary>
    public const uint PLUMB_ROLE_BEHAVIOUR = 2u;

    // PlumbSettingInfo.flags
    /// <summary>only through PlumbWorldDesc.settings</summary>
    public const uint PLUMB_SETTING_CREATION_ONLY = 1u << 0;

    // --- plumb/snapshot.h
    // plumb.snapshot/1: save and restore a world in memory (rollback, save games), and a 64-bit hash of its state.
    public const string PLUMB_EXT_SNAPSHOT = "plumb.snapshot/1";

    // --- plumb/state.h
    // plumb.state/1: state rows lent without a copy, as DLPack tensors (the 1.x versioned layout of dmlc/dlpack).
    public const string PLUMB_EXT_STATE = "plumb.state/1";

    // --- plumb/world.h
    // A world, its step, and what comes out of a step: the report, contacts and events.

    // PlumbNeeds, ulong. What a scene needs. A backend may leave out all the rest; using what was not declared is
    // PLUMB_E_NOT_DECLARED, declaring what the engine lacks (PLUMB_CAP_NEED is none) makes create_world fail with
    // PLUMB_E_UNSUPPORTED.
    public const ulong PLUMB_NEED_ROTATION = 1ul << 0;
    public const ulong PLUMB_NEED_COLLISION = 1ul << 1;
    public const ulong PLUMB_NEED_FRICTION = 1ul << 2;
    public const ulong PLUMB_NEED_RESTITUTION = 1ul << 3;
    public const ulong PLUMB_NEED_JOINTS = 1ul << 4;
    public const ulong PLUMB_NEED_CCD = 1ul << 5;
    public const ulong PLUMB_NEED_SLEEPING = 1ul << 6;
    /// <summary>contact, sleep and joint events</summary>
    public const ulong PLUMB_NEED_EVENTS = 1ul << 7;
    /// <summary>contact points can be read after a step</summary>
    public const ulong PLUMB_NEED_CONTACTS = 1ul << 8;
    /// <summary>and carry their impulses</summary>
    public const ulong PLUMB_NEED_CONTACT_IMPULSES = 1ul << 9;
    public const ulong PLUMB_NEED_SENSORS = 1ul << 10;
    public const ulong PLUMB_NEED_KINEMATIC = 1ul << 11;
    /// <summary>the term -w x I w of bodies that are not isotropic</summary>
    public const ulong PLUMB_NEED_GYROSCOPIC = 1ul << 12;
    public const ulong PLUMB_NEED_DAMPING = 1ul << 13;
    /// <summary>forces, torques and impulses from the host</summary>
    public const ulong PLUMB_NEED_FORCES = 1ul << 14;
    public const ulong PLUMB_NEED_AXIS_LOCKS = 1ul << 15;
    /// <summary>filters other than "everything touches everything"</summary>
    public const ulong PLUMB_NEED_FILTERS = 1ul << 16;
    public const ulong PLUMB_NEED_QUERIES = 1ul << 17;
    public const ulong PLUMB_NEED_SURFACE_VELOCITY = 1ul << 18;
    public const ulong PLUMB_NEED_JOINT_REACTIONS = 1ul << 19;
    public const ulong PLUMB_NEED_SNAPSHOT = 1ul << 20;
    /// <summary>manifolds.h. Since 1.2</summary>
    public const ulong PLUMB_NEED_CONTACT_MODIFICATION = 1ul << 21;
    /// <summary>rolling and spinning friction of bodies. Since 1.2</summary>
    public const ulong PLUMB_NEED_ROLLING_FRICTION = 1ul << 22;
    public const uint PLUMB_NEED_COUNT = 23u;
    public const ulong PLUMB_NEED_ALL = 8388607ul;

    // PlumbPhase, uint. Phases of a step for which a backend may report its time.
    /// <summary>bounds and candidate pairs</summary>
    public const uint PLUMB_PHASE_BROAD = 0u;
    /// <summary>contacts of candidate pairs</summary>
    public const uint PLUMB_PHASE_NARROW = 1u;
    /// <summary>graph, colouring, sleeping</summary>
    public const uint PLUMB_PHASE_ISLANDS = 2u;
    /// <summary>joints and contacts</summary>
    public const uint PLUMB_PHASE_SOLVE = 3u;
    /// <summary>forces to velocities to poses</summary>
    public const uint PLUMB_PHASE_INTEGRATE = 4u;
    public const uint PLUMB_PHASE_CONTINUOUS = 5u;
    /// <summary>events, contacts and state rows</summary>
    public const uint PLUMB_PHASE_OUTPUT = 6u;
    /// <summary>room for one more</summary>
    public const uint PLUMB_PHASE_COUNT = 8u;

    // PlumbStepReport.remarks
    /// <summary>the chosen solver gave up and another finished the step</summary>
    public const uint PLUMB_REMARK_SOLVER_FELL_BACK = 1u << 0;
    public const uint PLUMB_REMARK_CAPACITY_GREW = 1u << 1;
    public const uint PLUMB_REMARK_STEP_REPEATED = 1u << 2;
    /// <summary>it would have made energy: solved again finer, or the gain taken out</summary>
    public const uint PLUMB_REMARK_ENERGY_BOUNDED = 1u << 3;

    // PlumbEventType, uint.
    /// <summary>body_a, body_b began to touch</summary>
    public const uint PLUMB_EVENT_CONTACT_BEGIN = 0u;
    /// <summary>also when one of them was destroyed: its handle is stale by then</summary>
    public const uint PLUMB_EVENT_CONTACT_END = 1u;
    /// <summary>body_a is the sensor</summary>
    public const uint PLUMB_EVENT_SENSOR_ENTER = 2u;
    public const uint PLUMB_EVENT_SENSOR_LEAVE = 3u;
    /// <summary>body_a</summary>
    public const uint PLUMB_EVENT_WAKE = 4u;
    /// <summary>body_a</summary>
    public const uint PLUMB_EVENT_SLEEP = 5u;
    /// <summary>joint; it is gone from the step on</summary>
    public const uint PLUMB_EVENT_JOINT_BROKEN = 6u;
    public const uint PLUMB_EVENT_COUNT = 7u;

    // --- plumb/worlds.h
    // plumb.worlds/1: many worlds of one backend whose steps are taken together. Since 1.2.
    public const string PLUMB_EXT_WORLDS = "plumb.worlds/1";

    // --- plumb/plumb.h
    // Plumb: a stable interface to rigid-body physics engines.

    // PlumbLogLevel, uint.
    public const uint PLUMB_LOG_DEBUG = 0u;
    public const uint PLUMB_LOG_INFO = 1u;
    public const uint PLUMB_LOG_WARNING = 2u;
    public const uint PLUMB_LOG_ERROR = 3u;

    // PlumbDeterminism, uint. From run to run of the same program on the same machine, each level including those
    // before.
    public const uint PLUMB_DETERMINISM_NONE = 0u;
    /// <summary>the same calls give the same bits</summary>
    public const uint PLUMB_DETERMINISM_RUN = 1u;
    /// <summary>for any number of threads</summary>
    public const uint PLUMB_DETERMINISM_THREADS = 2u;
    /// <summary>on the CPU and on the GPU</summary>
    public const uint PLUMB_DETERMINISM_DEVICE = 3u;

    // PlumbCapability, uint. Questions to PlumbBackendTable.capability: kind, and up to two arguments.
    /// <summary>shape type, motion</summary>
    public const uint PLUMB_CAP_SHAPE = 0u;
    /// <summary>shape type, shape type (symmetric); the first may be dynamic: contacts and their solution</summary>
    public const uint PLUMB_CAP_PAIR = 1u;
    /// <summary>joint type</summary>
    public const uint PLUMB_CAP_JOINT = 2u;
    /// <summary>joint type, PlumbJointFeature</summary>
    public const uint PLUMB_CAP_JOINT_FEATURE = 3u;
    /// <summary>PlumbQueryKind, shape type that is cast or overlapped (0 for rays)</summary>
    public const uint PLUMB_CAP_QUERY = 4u;
    /// <summary>field</summary>
    public const uint PLUMB_CAP_FIELD_READ = 5u;
    /// <summary>field</summary>
    public const uint PLUMB_CAP_FIELD_WRITE = 6u;
    /// <summary>index of a PLUMB_NEED_ bit</summary>
    public const uint PLUMB_CAP_NEED = 7u;
    /// <summary>event type</summary>
    public const uint PLUMB_CAP_EVENT = 8u;
    /// <summary>PlumbPhase</summary>
    public const uint PLUMB_CAP_PHASE_TIME = 9u;
    public const uint PLUMB_CAP_RESIDUAL = 10u;
    /// <summary>0: of what moves, 1: of the whole world</summary>
    public const uint PLUMB_CAP_SNAPSHOT = 11u;
    /// <summary>runs its tasks on PlumbHost.run</summary>
    public const uint PLUMB_CAP_HOST_JOBS = 12u;
    /// <summary>materials of compound children</summary>
    public const uint PLUMB_CAP_CHILD_MATERIAL = 13u;
    /// <summary>0: bodies, 1: joints; index of a PLUMB_MODIFY_ bit. 2: shapes; type. Since 1.2</summary>
    public const uint PLUMB_CAP_MODIFY = 14u;
    /// <summary>index of a PLUMB_MANIFOLD_ bit. Since 1.2</summary>
    public const uint PLUMB_CAP_MANIFOLD = 15u;
    /// <summary>shape type of the probe: bodies of every shape are seen. Since 1.2</summary>
    public const uint PLUMB_CAP_CLOSEST = 16u;
    /// <summary>shape type: PlumbShapeDesc.materials. Since 1.2</summary>
    public const uint PLUMB_CAP_TRIANGLE_MATERIAL = 17u;
    /// <summary>shape type: native where the engine's work is in the bytes. Since 1.2</summary>
    public const uint PLUMB_CAP_COOKING = 18u;
    /// <summary>takes what grows with a scene from PlumbHost.allocate. Since 1.2</summary>
    public const uint PLUMB_CAP_HOST_MEMORY = 19u;
    public const uint PLUMB_CAP_COUNT = 20u;
    /// <summary>The one symbol of a backend. [any] May be called again: the same table comes back for the same
    /// version.</summary>
    public const string PLUMB_OPEN_SYMBOL = "plumb_backend_open";
}
}
