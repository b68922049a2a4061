#include "hosts/ogre/view/meshes.hpp"

#include <OgreManualObject.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

namespace plumb::ogre {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kAround = 32;  // segments of a circle
constexpr int kQuarter = 8;  // segments from an equator to a pole

Ogre::Vector3 vector(double x, double y, double z) {
  return {static_cast<Ogre::Real>(x), static_cast<Ogre::Real>(y), static_cast<Ogre::Real>(z)};
}

class Builder {
 public:
  explicit Builder(Ogre::ManualObject& object) : object_(object) {}

  std::uint32_t vertex(const Ogre::Vector3& position, const Ogre::Vector3& normal) {
    object_.position(position);
    object_.normal(normal);
    return count_++;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { object_.triangle(a, b, c); }

 private:
  Ogre::ManualObject& object_;
  std::uint32_t count_ = 0;
};

void build_box(Builder& builder, const PlumbVec3& half) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Ogre::Vector3 normal(0, 0, 0), u(0, 0, 0), v(0, 0, 0);
      normal[static_cast<std::size_t>(axis)] = static_cast<Ogre::Real>(side);
      u[static_cast<std::size_t>((axis + 1) % 3)] = 1;
      v[static_cast<std::size_t>((axis + 2) % 3)] = static_cast<Ogre::Real>(side);
      const Ogre::Vector3 size = vector(half.x, half.y, half.z);
      const std::uint32_t a = builder.vertex((normal - u - v) * size, normal);
      const std::uint32_t b = builder.vertex((normal + u - v) * size, normal);
      const std::uint32_t c = builder.vertex((normal + u + v) * size, normal);
      const std::uint32_t d = builder.vertex((normal - u + v) * size, normal);
      builder.triangle(a, b, c);
      builder.triangle(a, c, d);
    }
}

/// A point of an outline that is turned about y.
struct Ring {
  double radius, height;
  double out, up;  // its normal
};

void build_turned(Builder& builder, const std::vector<Ring>& rings) {
  for (const Ring& ring : rings)
    for (int i = 0; i <= kAround; ++i) {
      const double angle = 2 * kPi * (i % kAround) / kAround;
      builder.vertex(vector(ring.radius * std::cos(angle), ring.height, ring.radius * std::sin(angle)),
                     vector(ring.out * std::cos(angle), ring.up, ring.out * std::sin(angle)));
    }
  constexpr std::uint32_t row = kAround + 1;
  for (std::uint32_t r = 0; r + 1 < rings.size(); ++r)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t at = r * row + i;
      // What has shrunk to a pole has no second triangle.
      if (rings[r + 1].radius > 0) builder.triangle(at, at + row, at + row + 1);
      if (rings[r].radius > 0) builder.triangle(at, at + row + 1, at + 1);
    }
}

/// From the lower pole to the upper; half_height is 0 of a sphere.
std::vector<Ring> outline_of_capsule(double radius, double half_height) {
  std::vector<Ring> rings;
  for (int i = -kQuarter; i <= kQuarter; ++i) {
    const double angle = kPi / 2 * i / kQuarter;
    const double out = std::abs(i) == kQuarter ? 0 : std::cos(angle), up = std::sin(angle);
    if (i <= 0) rings.push_back({radius * out, radius * up - half_height, out, up});
    if (i > 0 || (i == 0 && half_height > 0)) rings.push_back({radius * out, radius * up + half_height, out, up});
  }
  return rings;
}

std::vector<Ring> outline_of_cylinder(double radius, double half_height) {
  return {{0, -half_height, 0, -1},    {radius, -half_height, 0, -1}, {radius, -half_height, 1, 0},
          {radius, half_height, 1, 0}, {radius, half_height, 0, 1},   {0, half_height, 0, 1}};
}

void build(Builder& builder, const PlumbShapeDesc& shape) {
  switch (shape.type) {
    case PLUMB_BOX: return build_box(builder, shape.half_extents);
    case PLUMB_SPHERE: return build_turned(builder, outline_of_capsule(shape.radius, 0));
    case PLUMB_CAPSULE: return build_turned(builder, outline_of_capsule(shape.radius, shape.half_height));
    case PLUMB_CYLINDER: return build_turned(builder, outline_of_cylinder(shape.radius, shape.half_height));
    default: break;
  }
  throw std::invalid_argument("the window draws no shapes of type " + std::to_string(shape.type));
}

}  // namespace

Ogre::MeshPtr make_mesh(Ogre::SceneManager& scene, const PlumbShapeDesc& shape, const std::string& name,
                        const std::string& material) {
  Ogre::ManualObject* object = scene.createManualObject();
  object->begin(material, Ogre::RenderOperation::OT_TRIANGLE_LIST);
  Builder builder(*object);
  build(builder, shape);
  object->end();
  Ogre::MeshPtr mesh = object->convertToMesh(name);
  mesh->buildEdgeList();
  scene.destroyManualObject(object);
  return mesh;
}

}  // namespace plumb::ogre
