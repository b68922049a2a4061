// A character that is a capsule moved by shape casts: collide and slide (Fauerby 2003; the plane clipping of Quake),
// with slopes, steps, a floor to stick to, platforms that carry it and bodies that it pushes.
//
// The capsule is no body of the world: it sees bodies and is not seen. It is swept, never placed, so it passes through
// nothing at any speed or dt. Between it and what it touches a skin stays, so that casts do not begin in contact.
#pragma once

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

struct CharacterSettings {
  double radius = 0.3;                       ///< m
  double half_height = 0.6;                  ///< m, of the capsule's segment
  double max_slope = 0.87;                   ///< rad: steeper is no ground
  double step_up = 0.35;                     ///< m
  double stick_down = 0.35;                  ///< m: ground so far below is followed while walking
  double skin = 0.02;                        ///< m
  double air_acceleration = 20;              ///< m/s2 sideways towards `walk` while in the air
  double max_push = 500;                     ///< N on what it walks into
  double mass = 80;                          ///< kg: its weight on dynamic ground
  PlumbVec3 gravity{0, -9.81, 0};            ///< m/s2; up is against it
  PlumbFilter filter{1, 0xffffffffu, 0, 0};  ///< what the capsule sees
};

enum class CharacterGround { on_ground, steep, in_air };

class CharacterController {
 public:
  static constexpr PlumbNeeds needs = PLUMB_NEED_QUERIES | PLUMB_NEED_COLLISION | PLUMB_NEED_FORCES;

  /// Makes a capsule of its own in the world, which outlives this. position (m): the capsule's middle. Throws Error
  /// when a setting is out of range or the world does not cast capsules.
  CharacterController(IPhysicsWorld& world, const PlumbVec3& position, const CharacterSettings& settings = {});
  CharacterController(const CharacterController&) = delete;
  CharacterController& operator=(const CharacterController&) = delete;
  ~CharacterController();

  /// Between steps of the world. walk: m/s against the ground that it stands on, of which the horizontal part counts;
  /// jump: m/s upwards, taken when it stands. dt: s, > 0.
  void move(const PlumbVec3& walk, double dt, double jump = 0);
  /// Sets it down elsewhere, at rest, without a sweep.
  void teleport(const PlumbVec3& position);

  [[nodiscard]] const PlumbVec3& position() const { return position_; }
  [[nodiscard]] const PlumbVec3& velocity() const { return velocity_; }
  void set_velocity(const PlumbVec3& velocity) { velocity_ = velocity; }
  [[nodiscard]] CharacterGround ground() const { return ground_; }
  /// 0 in the air.
  [[nodiscard]] PlumbBody ground_body() const { return ground_body_; }
  [[nodiscard]] const PlumbVec3& ground_normal() const { return ground_normal_; }

 private:
  struct Sweep {
    double distance;  // m that it may go
    PlumbHit hit;     // body 0: all of it
  };
  [[nodiscard]] Sweep sweep(const PlumbVec3& from, const PlumbVec3& by);
  [[nodiscard]] bool walkable(const PlumbVec3& normal) const;
  [[nodiscard]] bool stands_on_edge(const PlumbHit& hit, const PlumbVec3& heading);
  void ride(double dt);
  void part();
  void part_by_casts();
  void slide(PlumbVec3 by, double dt, bool walking);
  bool climb(const PlumbVec3& by);
  void find_ground(double reach);
  void weigh(double dt);
  void push(const PlumbHit& hit, double speed, double dt);

  IPhysicsWorld& world_;
  IQueries& queries_;
  CharacterSettings settings_;
  PlumbVec3 up_;
  PlumbShape capsule_ = 0;
  PlumbVec3 position_;
  PlumbVec3 velocity_{};
  PlumbVec3 carried_{};  // m/s, by the ground
  CharacterGround ground_ = CharacterGround::in_air;
  PlumbBody ground_body_ = 0;
  PlumbPose ground_pose_{};  // when it was last looked at
  PlumbVec3 ground_normal_{};
};

}  // namespace plumb::helpers
