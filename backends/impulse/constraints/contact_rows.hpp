// Contact constraints as the solver reads them: structures of arrays in blocks of 32, so that neighbouring threads of a
// GPU and neighbouring lanes of a CPU read neighbouring numbers. 60 bytes a point in float and 120 a manifold.
#pragma once

#include <cstdint>

#include "math/wide.hpp"
#include "narrowphase/manifold.hpp"

namespace plumb::impulse {

constexpr std::uint32_t kRowBlock = 32;

enum RowField : std::uint32_t {
  kNormal = 0,
  kTangent = 3,
  kCentreA = 6,  ///< mean of the points, from the centre of mass of a, m
  kCentreB = 9,  ///< and from that of b
  kFriction = 12,
  kRestitution = 13,
  kRowFields = 14
};
enum PointField : std::uint32_t {
  kArm = 0,         ///< from the mean of the points, m
  kSeparation = 3,  ///< at the start of the step, m
  kNormalMass = 4,  ///< effective, kg
  kNormalGive = 5,  ///< 1 over it, 1/kg
  kOpen = 6,  ///< speed that a point may approach with in the relaxing pass: 0, or without bound where it is apart
  kTangentMass = 7,   ///< 2 by 2 symmetric: 11, 12, 22
  kTangentStep = 10,  ///< smallest eigenvalue of the tangent mass, kg
  kNormalImpulse = 11,
  kTangentImpulse = 12,  ///< along tangent and bitangent
  kImpactSpeed = 14,  ///< relative normal velocity when the point was first pushed in this step, m/s; below 0: closing
  kPointFields = 15
};
/// The matrix that gives all points' speeds for all points' impulses, symmetric: beside its diagonal, which is
/// kNormalGive, 12 13 14 23 24 34.
constexpr std::uint32_t kCoupling = kRowFields + kManifoldPoints * kPointFields;
constexpr std::uint32_t kCouplingFields = kManifoldPoints * (kManifoldPoints - 1) / 2;
/// Its inverse: 11 12 13 14 22 23 ... 44.
constexpr std::uint32_t kBlockInverse = kCoupling + kCouplingFields;
constexpr std::uint32_t kBlockFields = kManifoldPoints * (kManifoldPoints + 1) / 2;
constexpr std::uint32_t kAllFields = kBlockInverse + kBlockFields;
/// Impulses of a point summed over the sub-steps so far, N s: normal, tangent, bitangent.
constexpr std::uint32_t kSumFields = 3 * kManifoldPoints;

/// Place of p, q (p < q) among the numbers beside the diagonal.
PLUMB_HD constexpr int coupling_of(int p, int q) { return p * (2 * kManifoldPoints - p - 1) / 2 + (q - p - 1); }

struct ContactRows {
  std::uint32_t* body_a;
  std::uint32_t* body_b;
  std::uint32_t* count;  ///< points; 0 in slots that fill up a colour to whole lanes
  std::uint32_t* row;    ///< of the contact cache
  Real* numbers;
  Real* sums;  ///< null where nobody asks for them

  /// Where the numbers of a slot begin; field f is at [f * kRowBlock].
  PLUMB_HD Real* at(std::uint32_t slot) const {
    return numbers + std::size_t{slot / kRowBlock} * (kAllFields * kRowBlock) + slot % kRowBlock;
  }
  PLUMB_HD Real* sums_at(std::uint32_t slot) const {
    if (sums == nullptr) return nullptr;
    return sums + std::size_t{slot / kRowBlock} * (kSumFields * kRowBlock) + slot % kRowBlock;
  }
};
PLUMB_HD constexpr std::uint32_t point_field(int point, std::uint32_t field) {
  return kRowFields + static_cast<std::uint32_t>(point) * kPointFields + field;
}

/// Reads and writes the fields of kLanes neighbouring slots.
template <class N>
struct RowAccess {
  Real* base;
  Real* sums;

  PLUMB_HD RowAccess(const ContactRows& rows, std::uint32_t slot) : base(rows.at(slot)), sums(rows.sums_at(slot)) {}

  PLUMB_HD N get(std::uint32_t field) const { return read(base + field * kRowBlock); }
  PLUMB_HD void put(std::uint32_t field, const N& value) const { write(base + field * kRowBlock, value); }
  /// Adds to the impulses of the step.
  PLUMB_HD void add_to_sum(int point, std::uint32_t direction, const N& impulse) const {
    if (sums == nullptr) return;
    Real* at = sums + (static_cast<std::uint32_t>(point) * 3 + direction) * kRowBlock;
    write(at, read(at) + impulse);
  }
  PLUMB_HD Vec3<N> vector(std::uint32_t field) const { return {get(field), get(field + 1), get(field + 2)}; }

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
