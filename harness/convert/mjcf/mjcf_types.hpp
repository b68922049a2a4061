// MuJoCo's arrays as the harness's vectors: quaternions begin with w.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

#include "referee/pose.hpp"

namespace plumb::harness {

struct FreeModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct FreeData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPtr = std::unique_ptr<mjModel, FreeModel>;
using DataPtr = std::unique_ptr<mjData, FreeData>;

[[nodiscard]] inline referee::Vec3 vec_at(const mjtNum* rows, int row) {
  return {rows[3 * row], rows[3 * row + 1], rows[3 * row + 2]};
}

[[nodiscard]] inline referee::Mat3 rotation_at(const mjtNum* rows, int row) {
  const mjtNum* q = rows + 4 * row;
  return referee::Quat(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

/// Of a thing without a name the kind and its number.
[[nodiscard]] inline std::string name_of(const mjModel& model, mjtObj kind, int index, const char* word) {
  const char* name = mj_id2name(&model, kind, index);
  return name != nullptr ? name : word + std::to_string(index);
}

}  // namespace plumb::harness
