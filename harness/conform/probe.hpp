// A small world for one check: adds bodies, steps, and reads them with few words. Every failing call throws Error.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <vector>

#include "conform/conformance.hpp"

namespace plumb::harness::conform {

using Vec = Eigen::Vector3d;

[[nodiscard]] inline Vec vec(const PlumbVec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline PlumbVec3 vec3(const Vec& v) { return {v.x(), v.y(), v.z()}; }

/// Needs of nearly every check: bodies that turn, collide and rub.
inline constexpr PlumbNeeds kPlainNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;
/// And of queries, which see whatever there is.
inline constexpr PlumbNeeds kQueryNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_QUERIES;
inline constexpr PlumbFilter kSeesAll = {1, ~0u, 0, 0};

class Probe {
 public:
  /// Throws Skipped when the backend lacks one of the needs; a check that can do with fewer asks for
  /// Conformance::available, so that a backend of few claims is tested in those.
  Probe(Conformance& conformance, PlumbNeeds needs, const Vec& gravity = {0, -9.81, 0});
  /// The same with settings.
  Probe(Conformance& conformance, PlumbNeeds needs, const Vec& gravity, std::span<const PlumbSetting> settings,
        std::uint32_t threads = 1);

  [[nodiscard]] IPhysicsWorld& world() { return *world_; }

  // Shapes, all about 1 m across unless sizes are given.
  PlumbShape shape(const PlumbShapeDesc& desc);
  PlumbShape sphere(double radius);
  PlumbShape box(const Vec& half_extents);
  /// A cube of that half edge, or a ball of that radius where the backend has no boxes.
  PlumbShape lump(double size) { return has_boxes_ ? box({size, size, size}) : sphere(size); }
  /// One of every type, with a flat top at y = 0.5 where the type has one when it stands as it is (see probe.cpp).
  PlumbShape standard(PlumbShapeType type);

  /// Without the rotation or friction that the world did not declare.
  [[nodiscard]] PlumbBodyDesc declared(PlumbBodyDesc desc) const;
  /// What is declared of it.
  PlumbBody body(const PlumbBodyDesc& desc);
  /// A ball of 1 m without friction, or a particle where rotation was not declared.
  PlumbBodyDesc free_desc(const Vec& position, const Vec& velocity = Vec::Zero());
  PlumbBody free_body(const Vec& position, const Vec& velocity = Vec::Zero()) {
    return body(free_desc(position, velocity));
  }
  PlumbBody dynamic(PlumbShape shape, const Vec& position, const Vec& velocity = Vec::Zero());
  PlumbBody fixed(PlumbShape shape, const Vec& position);
  /// A static lump 200 m wide whose top is at y = 0 above the origin, friction .5.
  PlumbBody ground();

  /// Steps of 1/60 s (or dt); the last one's report.
  PlumbStepReport step(int steps = 1, double dt = 1.0 / 60);
  PlumbStepReport seconds(double time) { return step(static_cast<int>(time * 60 + 0.5)); }

  [[nodiscard]] Vec position(PlumbBody body);
  [[nodiscard]] Eigen::Quaterniond orientation(PlumbBody body);
  [[nodiscard]] Vec velocity(PlumbBody body);
  [[nodiscard]] Vec angular_velocity(PlumbBody body);
  [[nodiscard]] std::vector<double> read(PlumbField field, PlumbBody body);
  void write(PlumbField field, PlumbBody body, std::span<const double> row);
  void write(PlumbField field, PlumbBody body, std::initializer_list<double> row) {
    write(field, body, std::span(row.begin(), row.size()));
  }
  void write_pose(PlumbField field, PlumbBody body, const Vec& position,
                  const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity());
  void destroy(PlumbBody body) { check(*world_, world_->destroy_bodies({&body, 1})); }
  [[nodiscard]] std::uint64_t hash();
  [[nodiscard]] std::vector<PlumbEvent> events();
  [[nodiscard]] std::vector<PlumbContact> contacts();

  PlumbJoint joint(const PlumbJointDesc& desc);
  [[nodiscard]] std::vector<double> read_joint(PlumbJointField field, PlumbJoint joint);
  void write_joint(PlumbJointField field, PlumbJoint joint, std::span<const double> row);

  [[nodiscard]] bool declares(PlumbNeeds need) const { return (needs_ & need) == need; }

 private:
  PlumbNeeds needs_;
  bool has_boxes_;
  std::unique_ptr<IPhysicsWorld> world_;
};

/// A dynamic body with this shape: what dynamic() makes, for changing before it is added.
[[nodiscard]] PlumbBodyDesc dynamic_desc(PlumbShape shape, const Vec& position, const Vec& velocity = Vec::Zero());

}  // namespace plumb::harness::conform
