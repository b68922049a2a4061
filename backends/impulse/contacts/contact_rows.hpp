// Contact constraints as the solver reads them, in blocks of 32 slots: neighbouring threads of a GPU, and neighbouring
// lanes of a CPU, read neighbouring numbers. 104 numbers a contact, in float 104 bytes for each of its four points.
//
//   slots   | colour 0                         | colour 1          | ... | those without, one by one | spare |
//           | c c c c c c c c  c c c - - - - - | c c c c c - - -   | ...
//             '-- 8 lanes --'  '-- 8 lanes --'     -: no points, and nobody's body
//
//   a block, on a CPU: a field of 32 slots              on a GPU: a quad of 32 slots
//     normal.x      s0 s1 s2 s3 ...... s31                normal, friction       s0 xyzf  s1 xyzf ...... s31 xyzf
//     normal.y      s0 s1 s2 s3 ...... s31                tangent, restitution   s0 xyzr  s1 xyzr ...... s31 xyzr
//     ...           '--- lanes ---'                       ...
//
//   quads    0- 3   the manifold: normal, tangent, where it touches a and b
//            4-15   three for each point: place, separation; impulses; its row of the normals' inverse
//           16-24   the matrix of the contact's frame (contact_frame.hpp), how many points there are, radii that roll
//              25   speed of surfaces, read only in worlds that have some
//
// Why so. A pass over the contacts reads nearly all of these numbers and writes little more than a quad a point, and a
// step has many passes: numbers lie as passes read them, and not as a struct would hold them. The fields of a contact
// make whole quads. A GPU keeps a quad together and moves it at once: four neighbouring threads share a contact
// (per_point.hpp), and the eight contacts of a warp are neighbours in their block. A CPU, whose lanes each take one
// contact, keeps a field together, and so reads a field of eight contacts as one vector, without a gather; only their
// bodies are gathered (body_lanes.hpp). Points that are not there are zeros: they are solved along and find nothing,
// with the same bits as where there is no room for them. A block ends after 32 slots so that a field's distance from
// its slot is a constant, however many slots there are.
//
// A slot is a place in the order by colour (colouring.hpp), and another one in each step; what outlives a step goes
// back to the row of the contact cache that `row` names. Colours are filled up to whole lanes on every device, so that
// slots are the same everywhere. Impulses summed over the step lie apart, for most worlds do not ask for them.
#pragma once

#include <cstdint>

#include "contacts/per_point.hpp"
#include "math/vec3.hpp"
#include "math/wide.hpp"
#include "narrowphase/manifold.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

constexpr std::uint32_t kRowBlock = 32;

enum RowField : std::uint32_t {
  kNormal = 0,
  kFriction = 3,
  kTangent = 4,
  kRestitution = 7,
  kCentreA = 8,   ///< mean of the points where they touch a, from its centre of mass, m
  kPull = 11,     ///< what forces add to the speed with which b leaves a in a sub-step, m/s; 0 where nothing bounces
  kCentreB = 12,  ///< where they touch b, from the centre of mass of b
  kTangentStep = 15,  ///< impulse against a slip, kg: no more than would stop it at any point
  kRowFields = 16
};
enum PointField : std::uint32_t {
  kPlace = 0,       ///< from the mean of the points, along tangent and bitangent, m
  kSeparation = 2,  ///< at the start of the step, m
  kNoted = 3,  ///< of solvers that take the step whole: normal velocity with which a point came that was pushed in this
               ///< step, m/s, 0 or less; above 0: not pushed yet (kNotPushedYet). Of tgs_soft on mechanisms: the normal
               ///< impulse with which the sub-step began, N s
  kNormalImpulse = 4,
  kTangentImpulse = 5,  ///< along tangent and bitangent
  kAllowedApproach =
      7,  ///< speed that a point may approach with in the relaxing pass: 0, or without bound where it is apart
  /// Row of the inverse of the matrix that gives all points' normal speeds for all points' normal impulses, kg.
  kBlockInverse = 8,
  kPointFields = 12
};
/// kNoted of a point that has not been pushed: kNotPushedYet / 2, or kNotPushedYet less the speed with which it came.
constexpr Real kNotPushedYet = 2;
/// How the bodies give way to a wrench at the mean of the points (contact_frame.hpp), and how many points there are.
constexpr std::uint32_t kDelassus = kRowFields + kManifoldPoints * kPointFields;
constexpr std::uint32_t kDelassusFields = 33;
constexpr std::uint32_t kPointCount = kDelassus + kDelassusFields;
/// Radii of a and b where they are round there and roll (rolling.hpp), m.
constexpr std::uint32_t kRollingRadius = kPointCount + 1;
/// How fast the surface of b runs over that of a though neither body moves, along tangent and bitangent, m/s
/// (surface_velocity.hpp).
constexpr std::uint32_t kSurfaceSpeed = kRollingRadius + 2;
constexpr std::uint32_t kAllFields = kSurfaceSpeed + 4;
static_assert(kManifoldPoints == 4 && kAllFields % 4 == 0 && kSurfaceSpeed % 4 == 0);
/// Impulses of a point summed over the sub-steps so far, N s: normal, tangent, bitangent.
constexpr std::uint32_t kSumFields = 3 * kManifoldPoints;
/// Of rolling friction (rolling_friction.hpp): the moment along tangent and bitangent and about the normal, N m s; and
/// how large it may be along them and about it, relative to the normal impulse, m.
constexpr std::uint32_t kMoment = 0, kMostMoment = 3, kMomentFields = 5;

/// Where a field is, from the first number of its slot.
PLUMB_HD constexpr std::uint32_t place_of(std::uint32_t field) {
  return kLanes == 1 ? field / 4 * (4 * kRowBlock) + field % 4 : field * kRowBlock;
}

struct ContactTurns;

struct ContactRows {
  std::uint32_t* body_a;
  std::uint32_t* body_b;
  std::uint32_t* count;  ///< points; 0 in slots that fill up a colour to whole lanes
  std::uint32_t* row;    ///< of the contact cache
  Real* numbers;
  Real* sums;           ///< null where nobody asks for them
  Real* moments;        ///< null in worlds without rolling friction; a copy for each thread of a contact
  ContactTurns* turns;  ///< null on a CPU (hand_over.hpp)
  std::uint32_t spare;  ///< slot of no contact, for threads that have none to work on

  /// The first number of a slot.
  PLUMB_HD Real* at(std::uint32_t slot) const {
    PLUMB_ASSERT(slot <= spare);
    const std::uint32_t in_block = slot % kRowBlock;
    return numbers + std::size_t{slot / kRowBlock} * (kAllFields * kRowBlock) + (kLanes == 1 ? 4 * in_block : in_block);
  }
  PLUMB_HD Real* sums_at(std::uint32_t slot) const {
    if (sums == nullptr) return nullptr;
    return sums + std::size_t{slot / kRowBlock} * (kSumFields * kRowBlock) + slot % kRowBlock;
  }
  PLUMB_HD Real* moment_at(std::uint32_t slot, std::uint32_t copy, std::uint32_t field) const {
    constexpr std::uint32_t kBlock = kMomentFields * kContactThreads * kRowBlock;
    return moments + std::size_t{slot / kRowBlock} * kBlock + (field * kContactThreads + copy) * kRowBlock +
           slot % kRowBlock;
  }
  /// Those of a thread; null where there are none.
  PLUMB_HD Real* own_moments_at(std::uint32_t slot) const {
    if (moments == nullptr) return nullptr;
    return moment_at(slot, kContactThreads == 1 ? 0U : static_cast<std::uint32_t>(point_of(0)), 0);
  }
};
PLUMB_HD constexpr std::uint32_t point_field(int point, std::uint32_t field) {
  return kRowFields + static_cast<std::uint32_t>(point) * kPointFields + field;
}

/// Four neighbouring fields of one contact.
struct alignas(4 * sizeof(Real)) Quad {
  Real at[4];
};

/// All fields of one contact, or of kLanes of them from neighbouring slots.
template <class N>
struct ContactNumbers {
  N at[kAllFields];

  PLUMB_HD void put(std::uint32_t field, const Vec3<N>& v) {
    at[field] = v.x;
    at[field + 1] = v.y;
    at[field + 2] = v.z;
  }
  PLUMB_HD void store(Real* slot) const {
    PLUMB_UNROLL
    for (std::uint32_t f = 0; f < kAllFields; f += 4) {
      if constexpr (kLanes == 1)
        *reinterpret_cast<Quad*>(slot + place_of(f)) = {at[f], at[f + 1], at[f + 2], at[f + 3]};
      else
        for (std::uint32_t i = f; i < f + 4; ++i) __builtin_memcpy(slot + place_of(i), &at[i], sizeof(N));
    }
  }
};

/// Reads and writes the fields of kLanes neighbouring slots.
template <class N>
struct RowAccess {
  Real *base, *sums, *moments;

  PLUMB_HD RowAccess(const ContactRows& rows, std::uint32_t slot)
      : base(rows.at(slot)), sums(rows.sums_at(slot)), moments(rows.own_moments_at(slot)) {}

  /// Fields f to f + 3, f being the first of a quad.
  PLUMB_HD void get_quad(std::uint32_t f, N (&quad)[4]) const {
    if constexpr (kLanes == 1) {
      const Quad read = *reinterpret_cast<const Quad*>(base + place_of(f));
      for (int i = 0; i < 4; ++i) quad[i] = read.at[i];
    } else {
      for (std::uint32_t i = 0; i < 4; ++i) quad[i] = read(base + place_of(f + i));
    }
  }
  PLUMB_HD void put_quad(std::uint32_t f, const N& x, const N& y, const N& z, const N& w) const {
    if constexpr (kLanes == 1) {
      *reinterpret_cast<Quad*>(base + place_of(f)) = {x, y, z, w};
    } else {
      write(base + place_of(f), x);
      write(base + place_of(f + 1), y);
      write(base + place_of(f + 2), z);
      write(base + place_of(f + 3), w);
    }
  }
  PLUMB_HD void put(std::uint32_t field, const N& value) const { write(base + place_of(field), value); }
  /// No impulses of the step yet.
  PLUMB_HD void clear_sums() const {
    if (sums == nullptr) return;
    for (std::uint32_t f = 0; f < kSumFields; ++f) write(sums + f * kRowBlock, N(0));
  }
  /// Adds to the impulses of the step.
  PLUMB_HD void add_to_sum(int point, std::uint32_t direction, const N& impulse) const {
    if (sums == nullptr) return;
    Real* at = sums + (static_cast<std::uint32_t>(point) * 3 + direction) * kRowBlock;
    write(at, read(at) + impulse);
  }
  /// Of rolling friction.
  [[nodiscard]] PLUMB_HD bool has_moments() const { return moments != nullptr; }
  PLUMB_HD N moment(std::uint32_t field) const { return read(moments + field * kContactThreads * kRowBlock); }
  PLUMB_HD void put_moment(std::uint32_t field, const N& value) const {
    write(moments + field * kContactThreads * kRowBlock, value);
  }
  /// Of lanes that have no contact, too.
  PLUMB_HD void clear_moments() const {
    if (moments == nullptr) return;
    for (std::uint32_t f = 0; f < kMomentFields; ++f) put_moment(f, N(0));
  }

 private:
  PLUMB_HD static N read(const Real* at) {
    if constexpr (sizeof(N) == sizeof(Real)) {
      return *at;
    } else {
      N lanes;
      __builtin_memcpy(&lanes, at, sizeof lanes);
      return lanes;
    }
  }
  PLUMB_HD static void write(Real* at, const N& value) {
    if constexpr (sizeof(N) == sizeof(Real))
      *at = value;
    else
      __builtin_memcpy(at, &value, sizeof value);
  }
};

}  // namespace plumb::impulse
