// One row of a constraint that PhysX's joints have not, or not truly: gears and racks that hold whatever their wheels
// are held by, motors that count as forces of the joint, springs of turns by their angles, springs between two points.
#pragma once

#include "physx_math.hpp"

namespace plumb::px {

struct Ends;

class OwnRow final : public PxConstraintConnector {
 public:
  enum class Kind : std::uint8_t { gear, rack, distance_spring, spring, motor };
  struct What {
    Kind kind;
    std::uint8_t axis = 0;  ///< of a spring or motor
  };

  OwnRow(What what, const PlumbJointDesc& desc, const Ends& ends);
  OwnRow(const OwnRow&) = delete;
  OwnRow& operator=(const OwnRow&) = delete;
  ~OwnRow() override;

  /// From the descriptor, as it is by now.
  void drive(const PlumbJointDesc& desc);
  /// Before each step: gears count how far their wheels have turned.
  void remember_turns();
  [[nodiscard]] const PxConstraint& constraint() const { return *constraint_; }

  void* prepareData() override { return &block_; }
  bool updatePvdProperties(pvdsdk::PvdDataStream&, const PxConstraint*, PxPvdUpdateType::Enum) const override {
    return true;
  }
  void updateOmniPvdProperties() const override {}
  void onConstraintRelease() override {}
  void onComShift(PxU32) override { place(); }
  void onOriginShift(const PxVec3&) override {}
  void* getExternalReference(PxU32& type) override;
  PxBase* getSerializable() override { return nullptr; }
  PxConstraintSolverPrep getPrep() const override;
  const void* getConstantBlock() const override { return &block_; }

  /// What the solver is given, copied by PhysX.
  struct Block {
    PxTransform in_a, in_b;  ///< frames, from the centres of mass
    PlumbJointType type;
    What what;
    float ratio, error;  ///< of gears and racks, and what has come together, rad
    float rest, stiffness, damping;
    bool by_mass;             ///< the numbers are of accelerations
    float speed, most_force;  ///< of a motor
    /// Whether the joint holds b's origin at a's, and what the bodies then resist with.
    bool pinned;
    struct Inverse {
      float mass;
      PxVec3 inertia;  ///< about the axes of the centre of mass
    } of_a, of_b;
  };

 private:
  [[nodiscard]] bool counts_turns() const { return block_.what.kind == Kind::gear || block_.what.kind == Kind::rack; }
  void place();
  [[nodiscard]] PxTransform frame_a() const;
  [[nodiscard]] PxTransform frame_b() const;

  Block block_{};
  PxRigidActor *a_, *b_;
  PxTransform at_a_, at_b_;  ///< frames in the actors
  PxTransform was_a_{PxIdentity}, was_b_{PxIdentity};
  PxConstraint* constraint_ = nullptr;
};

}  // namespace plumb::px
