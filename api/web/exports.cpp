// The functions of a backend's .wasm that plumb.mjs calls: numbers and addresses of arrays in, a PlumbResult out.
// Below 0, plumb_error() is the sentence. A backend is linked in, as nothing is loaded at run time.
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

#include "plumb/loader.hpp"

#define PLUMB_WEB(result, name) extern "C" __attribute__((export_name(#name))) result name

namespace {

using plumb::IPhysicsWorld;

std::string last_error;

/// call() answers a PlumbResult, or throws.
template <class Call>
PlumbResult guarded(const Call& call) {
  try {
    return call();
  } catch (const plumb::Error& error) {
    last_error = error.what();
    return error.code();
  } catch (const std::exception& error) {
    last_error = error.what();
    return PLUMB_E_INTERNAL;
  }
}

PlumbResult told(const IPhysicsWorld& world, PlumbResult result) {
  if (result < 0) last_error = world.error_text();
  return result;
}

const plumb::Backend& backend() {
  static const plumb::Backend only(plumb::negotiate(&plumb_backend_open, "linked into this .wasm"));
  return only;
}

template <class Value>
void copy(Value& to, const double*& from) {
  static_assert(sizeof(Value) % sizeof(double) == 0);
  std::memcpy(&to, from, sizeof to);
  from += sizeof to / sizeof(double);
}

template <class Byte>
plumb::BasicRows<Byte> rows_at(Byte* numbers, std::uint32_t count, PlumbField field) {
  return {numbers, count, plumb::columns_of(field) * sizeof(double), PLUMB_F64};
}

}  // namespace

PLUMB_WEB(void*, plumb_allocate)(std::uint32_t bytes) { return std::malloc(bytes); }
PLUMB_WEB(void, plumb_release)(void* memory) { std::free(memory); }
PLUMB_WEB(const char*, plumb_error)() { return last_error.c_str(); }

/// 0: the backend's name, 1: its version, 2: its build.
PLUMB_WEB(const char*, plumb_info)(std::uint32_t which) {
  const PlumbBackendInfo& info = backend().info();
  return which == 0 ? info.name : which == 1 ? info.version : info.build;
}

/// settings: count of them as they lie in memory here, which plumb_setting fills.
PLUMB_WEB(PlumbResult, plumb_create_world)
(PlumbNeeds needs, const double* gravity, const PlumbSetting* settings, std::uint32_t count, IPhysicsWorld** world) {
  return guarded([&] {
    PlumbWorldDesc desc = plumb::world_desc(needs);
    copy(desc.gravity, gravity);
    desc.settings = settings;
    desc.setting_count = count;
    *world = backend().create_world(desc).release();
    return PLUMB_OK;
  });
}
PLUMB_WEB(void, plumb_destroy_world)(IPhysicsWorld* world) { delete world; }

PLUMB_WEB(std::uint32_t, plumb_setting_size)() { return sizeof(PlumbSetting); }
/// The strings must live as long as the setting is used. choice: null where it is a number.
PLUMB_WEB(PlumbResult, plumb_setting)
(PlumbSetting* settings, std::uint32_t index, const char* name, double number, const char* choice) {
  return guarded([&] {
    for (const PlumbSettingInfo* info : backend().settings())
      if (std::strcmp(info->name, name) == 0) {
        settings[index] = {info->name, {info->type, 0, number, choice}};
        return PLUMB_OK;
      }
    throw plumb::Error(PLUMB_E_INVALID_ARGUMENT, std::string("there is no setting \"") + name + "\"");
  });
}

/// numbers: radius, half height, half extents.
PLUMB_WEB(PlumbResult, plumb_create_shape)
(IPhysicsWorld* world, PlumbShapeType type, const double* numbers, const double* vertices, std::uint32_t vertex_count,
 const std::uint32_t* indices, std::uint32_t triangle_count, PlumbShape* id) {
  PlumbShapeDesc desc = plumb::shape_desc(type);
  copy(desc.radius, numbers);
  copy(desc.half_height, numbers);
  copy(desc.half_extents, numbers);
  desc.vertices = vertices;
  desc.vertex_count = vertex_count;
  desc.indices = indices;
  desc.triangle_count = triangle_count;
  return told(*world, world->create_shapes({&desc, 1}, {id, 1}));
}
PLUMB_WEB(PlumbResult, plumb_destroy_shape)(IPhysicsWorld* world, PlumbShape shape) {
  return told(*world, world->destroy_shapes({&shape, 1}));
}

/// numbers: pose, velocities, density, mass (0: by density), friction, restitution, gravity scale, linear and angular
/// damping.
PLUMB_WEB(PlumbResult, plumb_create_body)
(IPhysicsWorld* world, PlumbMotion motion, std::uint32_t flags, PlumbShape shape, const double* numbers,
 PlumbBody* id) {
  PlumbBodyDesc desc = plumb::body_desc(motion);
  desc.flags = flags;
  desc.shape = shape;
  copy(desc.pose, numbers);
  copy(desc.linear_velocity, numbers);
  copy(desc.angular_velocity, numbers);
  copy(desc.density, numbers);
  copy(desc.mass, numbers);
  if (desc.mass != 0) desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
  copy(desc.material.friction, numbers);
  copy(desc.material.restitution, numbers);
  copy(desc.gravity_scale, numbers);
  copy(desc.linear_damping, numbers);
  copy(desc.angular_damping, numbers);
  return told(*world, world->create_bodies({&desc, 1}, {id, 1}));
}
PLUMB_WEB(PlumbResult, plumb_destroy_body)(IPhysicsWorld* world, PlumbBody body) {
  return told(*world, world->destroy_bodies({&body, 1}));
}

/// numbers: frames in a and in b, rest length.
PLUMB_WEB(PlumbResult, plumb_create_joint)
(IPhysicsWorld* world, PlumbJointType type, PlumbBody a, PlumbBody b, const double* numbers, PlumbJoint* id) {
  PlumbJointDesc desc = plumb::joint_desc(type);
  desc.body_a = a;
  desc.body_b = b;
  copy(desc.frame_a, numbers);
  copy(desc.frame_b, numbers);
  copy(desc.rest_length, numbers);
  plumb::IJoints* joints = world->joints();
  return guarded([&] {
    if (joints == nullptr) throw plumb::Error(PLUMB_E_UNSUPPORTED, "this backend has no joints");
    return told(*world, joints->create_joints({&desc, 1}, {id, 1}));
  });
}
PLUMB_WEB(PlumbResult, plumb_destroy_joint)(IPhysicsWorld* world, PlumbJoint joint) {
  return told(*world, world->joints()->destroy_joints({&joint, 1}));
}

PLUMB_WEB(std::uint32_t, plumb_columns)(PlumbField field) { return plumb::columns_of(field); }
PLUMB_WEB(std::uint32_t, plumb_body_count)(IPhysicsWorld* world) {
  return static_cast<std::uint32_t>(world->bodies().size());
}
/// Without ids the first bodies in order of creation.
PLUMB_WEB(PlumbResult, plumb_read)
(IPhysicsWorld* world, PlumbField field, const PlumbBody* ids, std::uint32_t count, std::byte* rows) {
  return told(*world, world->read(field, {ids, ids == nullptr ? 0 : std::size_t{count}}, rows_at(rows, count, field)));
}
PLUMB_WEB(PlumbResult, plumb_write)(IPhysicsWorld* world, PlumbField field, PlumbBody body, const std::byte* row) {
  return told(*world, world->write(field, {&body, 1}, rows_at(row, 1, field)));
}
PLUMB_WEB(PlumbResult, plumb_set_gravity)(IPhysicsWorld* world, const double* gravity) {
  PlumbVec3 value;
  copy(value, gravity);
  return told(*world, world->set_gravity(value));
}

/// A step, done when this returns.
PLUMB_WEB(PlumbResult, plumb_step)(IPhysicsWorld* world, double dt) {
  PlumbStepReport report{};
  const PlumbResult started = world->step(dt);
  return told(*world, started < 0 ? started : world->wait(report));
}

/// numbers: origin and translation in; fraction, position and normal out. body: 0 where nothing was hit.
PLUMB_WEB(PlumbResult, plumb_cast_ray)(IPhysicsWorld* world, double* numbers, PlumbBody* body) {
  return guarded([&] {
    if (world->queries() == nullptr) throw plumb::Error(PLUMB_E_UNSUPPORTED, "this backend has no queries");
    PlumbRay ray{};
    ray.filter = plumb::body_desc().filter;
    const double* in = numbers;
    copy(ray.origin, in);
    copy(ray.translation, in);
    const plumb::Hits found = world->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1});
    if (found.result < 0) return told(*world, found.result);
    const PlumbHit& hit = found.hits.front();
    *body = hit.body;
    const double out[] = {hit.fraction, hit.position.x, hit.position.y, hit.position.z,
                          hit.normal.x, hit.normal.y,   hit.normal.z};
    std::memcpy(numbers, out, sizeof out);
    return found.result;
  });
}

PLUMB_WEB(PlumbResult, plumb_hash)(IPhysicsWorld* world, std::uint64_t* value) {
  return told(*world, world->hash(*value));
}
