// A scene as a text for MuJoCo and a program that steps it with mj_step.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <cstring>
#include <memory>
#include <sstream>

#include "scenes.hpp"

namespace scenes {

struct NativeScene {
  explicit NativeScene(const Scene& scene) : of_(scene) {
    std::ostringstream out;
    out.precision(17);
    out << "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\"/>"
        << "<option timestep=\"" << 1.0 / 60 / 8 << "\" gravity=\"0 -9.81 0\"><flag filterparent=\"disable\"/></option>"
        << "<worldbody>";
    for (std::size_t i = 0; i < scene.items.size(); ++i)
      if (joint_of(i) == nullptr || joint_of(i)->a < 0) write(out, i);
    out << "</worldbody><contact>";
    for (const Joint& joint : scene.joints)
      if (joint.a >= 0) out << "<exclude body1=\"b" << joint.a << "\" body2=\"b" << joint.b << "\"/>";
    out << "</contact></mujoco>";
    const std::string text = out.str();
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "s.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char why[500] = "";
    model = mj_loadXML("s.xml", files.get(), why, sizeof why);
    mj_deleteVFS(files.get());
    if (model == nullptr) throw std::runtime_error(why);
    double mass = 0, count = 0;
    for (const Item& item : scene.items)
      if (!item.is_static) mass += item.mass, ++count;
    model->stat.meaninertia = mass / count;  // as the adapter scales the solver's tolerance
    model->nconmax = 4000;
    model->njmax = 5000;
    model->nstack = 20000000;
    data = mj_makeData(model);
    mj_kinematics(model, data);
  }
  ~NativeScene() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  NativeScene(const NativeScene&) = delete;
  NativeScene& operator=(const NativeScene&) = delete;

  void step() {
    for (int i = 0; i < 8; ++i) mj_step(model, data);
    mj_kinematics(model, data);
  }
  PlumbVec3 position(std::size_t i) const {
    const mjtNum* at = data->xpos + 3 * mj_name2id(model, mjOBJ_BODY, ("b" + std::to_string(i)).c_str());
    return {at[0], at[1], at[2]};
  }

 private:
  const Joint* joint_of(std::size_t item) const {
    for (const Joint& joint : of_.joints)
      if (joint.b == static_cast<int>(item)) return &joint;
    return nullptr;
  }
  void write(std::ostream& out, std::size_t i) const {
    const Item& item = of_.items[i];
    const Joint* joint = joint_of(i);
    PlumbVec3 at = item.pose.position;
    if (joint != nullptr && joint->a >= 0) {  // all of them stand straight
      const PlumbVec3 from = of_.items[static_cast<std::size_t>(joint->a)].pose.position;
      at = {at.x - from.x, at.y - from.y, at.z - from.z};
    }
    const PlumbQuat& q = item.pose.orientation;
    out << "<body name=\"b" << i << "\" pos=\"" << at.x << ' ' << at.y << ' ' << at.z << "\" quat=\"" << q.w << ' '
        << q.x << ' ' << q.y << ' ' << q.z << "\">";
    if (!item.is_static) {
      const PlumbVec3 moments = inertia(item);
      out << "<inertial pos=\"0 0 0\" mass=\"" << item.mass << "\" diaginertia=\"" << moments.x << ' ' << moments.y
          << ' ' << moments.z << "\"/>";
      if (joint == nullptr)
        out << "<freejoint/>";
      else
        out << "<joint type=\"" << (joint->is_hinge ? "hinge" : "ball") << "\" axis=\"0 0 1\" pos=\"" << joint->in_b.x
            << ' ' << joint->in_b.y << ' ' << joint->in_b.z << "\"/>";
    }
    out << "<geom friction=\"" << kPlumbFriction << "\" type=\"" << (item.is_sphere ? "sphere" : "box") << "\" size=\""
        << item.half.x << ' ' << item.half.y << ' ' << item.half.z << "\"/>";
    for (const Joint& child : of_.joints)
      if (child.a == static_cast<int>(i)) write(out, static_cast<std::size_t>(child.b));
    out << "</body>";
  }

  const Scene& of_;
  mjModel* model = nullptr;
  mjData* data = nullptr;
};

}  // namespace scenes
