// Contact constraints as the solver reads them: structures of arrays in blocks of 32, so that neighbouring threads of a
// GPU and neighbouring lanes of a CPU read neighbouring numbers. 84 bytes a point in float and 88 a manifold.
#pragma once

#include <cstdint>

#include "math/wide.hpp"
#include "narrowphase/manifold.hpp"

namespace plumb::impulse {

constexpr std::uint32_t kRowBlock = 32;

enum RowField : std::uint32_t { kNormal = 0, kTangent = 3, kFriction = 6, kRestitution = 7, kRowFields = 8 };
enum PointField : std::uint32_t {
  kArmA = 0,  ///< from the centre of mass of a
  kArmB = 3,
  kSeparation = 6,   ///< at the start of the step, m
  kNormalMass = 7,   ///< effective, kg
  kTangentMass = 8,  ///< 2 by 2 symmetric: 11, 12, 22
  kNormalImpulse = 11,
  kTangentImpulse = 12,  ///< along tangent and bitangent
  kImpactSpeed = 14,  ///< relative normal velocity when the point was first pushed in this step, m/s; below 0: closing
  kStepImpulse = 15,  ///< sums over the sub-steps so far, N s: normal, tangent, bitangent
  kTangentStep = 18,  ///< smallest eigenvalue of the tangent mass, kg
  kOpen = 19,  ///< speed that a point may approach with in the relaxing pass: 0, or without bound where it is apart
  kNormalGive = 20,  ///< 1 over the effective mass, 1/kg
  kPointFields = 21
};
/// Inverse of the matrix that gives all points' speeds for all points' impulses, symmetric: 11 12 13 14 22 23 ... 44.
constexpr std::uint32_t kBlockInverse = kRowFields + kManifoldPoints * kPointFields;
constexpr std::uint32_t kAllFields = kBlockInverse + 10;

struct ContactRows {
  std::uint32_t* body_a;
  std::uint32_t* body_b;
  std::uint32_t* count;  ///< points; 0 in slots that fill up a colour to whole lanes
  std::uint32_t* row;    ///< of the contact cache
  Real* numbers;

  /// Where the numbers of a slot begin; field f is at [f * kRowBlock].
  PLUMB_HD Real* at(std::uint32_t slot) const {
    return numbers + std::size_t{slot / kRowBlock} * (kAllFields * kRowBlock) + slot % kRowBlock;
  }
};
PLUMB_HD constexpr std::uint32_t point_field(int point, std::uint32_t field) {
  return kRowFields + static_cast<std::uint32_t>(point) * kPointFields + field;
}

/// Reads and writes the fields of kLanes neighbouring slots.
template <class N>
struct RowAccess {
  Real* base;

  PLUMB_HD N get(std::uint32_t field) const {
    if constexpr (sizeof(N) == sizeof(Real)) {
      return base[field * kRowBlock];
    } else {
      N lanes;
      __builtin_memcpy(&lanes, base + field * kRowBlock, sizeof lanes);
      return lanes;
    }
  }
  PLUMB_HD void put(std::uint32_t field, const N& value) const {
    if constexpr (sizeof(N) == sizeof(Real))
      base[field * kRowBlock] = value;
    else
      __builtin_memcpy(base + field * kRowBlock, &value, sizeof value);
  }
  PLUMB_HD Vec3<N> vector(std::uint32_t field) const { return {get(field), get(field + 1), get(field + 2)}; }
};

}  // namespace plumb::impulse
