// A host of physics plugins, as gz-sim is one, without its templates: the tests' window to a world.
#pragma once

#include <cstdint>
#include <ignition/math/AxisAlignedBox.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>
#include <memory>
#include <string>
#include <vector>

namespace plumb::gazebo::tests {

using Vector = ignition::math::Vector3d;
using Pose = ignition::math::Pose3d;

struct ContactSeen {
  std::string first, second;  ///< names of the collisions
  Vector point, normal, force;
  double depth = 0;
};

/// Links are named "model::link", joints "model::joint".
class Host {
 public:
  /// engine: a backend of Plumb, or "dartsim" for Debian's plugin.
  explicit Host(const std::string& engine);
  ~Host();

  /// Makes the first world of a text of SDF; false where the plugin gives none.
  bool load(const std::string& sdf);
  /// The same one piece after the other, as gz-sim does.
  bool load_in_pieces(const std::string& sdf);
  /// A link of no mass in a model of its own, which files cannot say; false where it is refused.
  bool add_massless();
  void step(double dt, int steps = 1);
  /// How many links' poses the last step told as changed.
  [[nodiscard]] std::size_t changed() const;

  [[nodiscard]] Pose pose(const std::string& link) const;
  [[nodiscard]] Vector velocity(const std::string& link) const;
  [[nodiscard]] Vector spin(const std::string& link) const;
  [[nodiscard]] Vector acceleration(const std::string& link) const;
  [[nodiscard]] Pose model_pose(const std::string& model) const;
  [[nodiscard]] ignition::math::AxisAlignedBox bounds(const std::string& model) const;
  void push(const std::string& link, const Vector& force, const Vector& at);
  void twist(const std::string& link, const Vector& torque);

  [[nodiscard]] bool has_model(const std::string& model) const;
  [[nodiscard]] bool has_joint(const std::string& joint) const;
  [[nodiscard]] std::size_t links(const std::string& model) const;
  [[nodiscard]] std::size_t shapes(const std::string& link) const;
  bool remove(const std::string& model);

  [[nodiscard]] bool is_free(const std::string& model) const;
  void place(const std::string& model, const Pose& pose);
  void move(const std::string& model, const Vector& velocity, const Vector& spin);

  [[nodiscard]] double position(const std::string& joint, std::size_t axis = 0) const;
  [[nodiscard]] double rate(const std::string& joint, std::size_t axis = 0) const;
  void set_position(const std::string& joint, double value, std::size_t axis = 0);
  void set_rate(const std::string& joint, double value, std::size_t axis = 0);
  void set_force(const std::string& joint, double value, std::size_t axis = 0);
  void command(const std::string& joint, double velocity, std::size_t axis = 0);
  void limit(const std::string& joint, double lower, double upper);
  [[nodiscard]] Vector transmitted_force(const std::string& joint) const;
  void detach(const std::string& joint);
  /// Fixed, by the name "weld", as they are now.
  bool weld(const std::string& child, const std::string& parent);
  void detach_weld();

  [[nodiscard]] std::vector<ContactSeen> contacts() const;
  void set_mask(const std::string& link, std::uint16_t mask);
  void set_gravity(const Vector& gravity);
  [[nodiscard]] Vector gravity() const;
  void set_solver(const std::string& solver);
  [[nodiscard]] std::string solver() const;
  /// A tetrahedron with these corners, as a mesh.
  bool attach_tetrahedron(const std::string& link, const std::vector<Vector>& corners);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb::gazebo::tests
