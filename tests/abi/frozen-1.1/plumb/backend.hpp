// How to write a backend: derive a class from plumb::IPhysicsWorld, and say PLUMB_BACKEND(YourWorld) once.
//
// Your class has, beside the virtual functions:
//
//   explicit YourWorld(const plumb::WorldInit&);                     // throws plumb::Error to refuse
//   static const PlumbBackendInfo& info();
//   static PlumbDegree capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char*& note);
//   static std::span<const PlumbSettingInfo> setting_infos();        // only when it derives from ISettings
//   static std::string unmet_requirement();                          // optional: why this machine cannot run it, or ""
//
// For each extension, derive from its interface too (IJoints, IQueries, ...) and override its getter to return this.
//
// What stands between the table and your class (the library plumb::backend, which plumb_add_backend links), in every
// build: exceptions become results;
// stale handles, numbers that are not finite or out of range, undeclared needs and unsupported capabilities are refused
// in words before your class is called; handles are allotted, mass properties worked out, and bodies(), hash(),
// user_data, PLUMB_FIELD_MASS, the list of pair exceptions and shapes in use answered for you. A Plumb call that fails
// must have changed nothing: throw before you change, or undo. Throw PLUMB_E_WORLD_LOST when you cannot.
//
// For the taking: backend/settings_table.hpp keeps settings in the members of a struct; backend/usual_capability.hpp
// answers what most engines have, so that you name only what yours lacks; backend/small_math.hpp has quaternions and
// poses; backend/mass_properties.hpp an inertia matrix from principal moments; backend/touch_tracker.hpp makes begin
// and end events out of "who touches whom"; backend/convex_hull.hpp gives the faces of a hull.
#pragma once

#include "plumb/backend/tables.hpp"

#define PLUMB_BACKEND(WorldClass)                                                                                  \
  extern "C" PLUMB_EXPORT PlumbResult plumb_backend_open(const PlumbOpenRequest* request, PlumbOpenReply* reply) { \
    return plumb::backend::open<WorldClass>(request, reply);                                                       \
  }
