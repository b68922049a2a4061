// MuJoCo's model and data of a world as it is now, and which of ours each of its things is.
#pragma once

#include <memory>
#include <vector>

#include "errors.hpp"
#include "joints/tree.hpp"
#include "settings.hpp"

namespace plumb::mujoco {

struct ModelFree {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataFree {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

struct Geom {
  Body* body;
  const Shape* shape;
  std::uint32_t child;
  PlumbPose at;  ///< of the shape in the body's frame
  const PlumbMaterial* material;
};

struct Model {
  std::unique_ptr<mjModel, ModelFree> model;
  std::unique_ptr<mjData, DataFree> data;
  std::vector<Body*> bodies;  ///< by MuJoCo's id; null for the world
  std::vector<Geom> geoms;

  [[nodiscard]] int first_dof(const Body& body) const { return model->body_dofadr[body.id]; }
};

/// Throws Error (PLUMB_E_UNSUPPORTED) with MuJoCo's words for what it will not have.
[[nodiscard]] Model make_model(const Tree& tree, const std::vector<std::unique_ptr<Joint>>& joints,
                               const Settings& settings, PlumbNeeds needs);

/// Of a body's frame, as MuJoCo's kinematics were last worked out.
[[nodiscard]] PlumbPose pose_in(const mjData& data, const Body& body);

/// Motors of links, at any time.
void apply_motors(Model& model, const Joint& joint);

/// New data with half as much room again for contacts, constraints and MuJoCo's stack. What moves must be written anew.
/// Throws Error (PLUMB_E_WORLD_LOST) where MuJoCo cannot have more.
void grow_data(Model& model);

}  // namespace plumb::mujoco
