/* A host in C that knows nothing but plumb.h: loads a backend, lets a tower of ten boxes stand for five seconds, and
 * prints how high the centre of the top box is in the end. Status 3: the backend cannot do this, and says why. */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include "plumb/plumb.h"

enum { BOXES = 10, STEPS = 300 };

static int refuse(const char* what, const char* why, PlumbResult result) {
  fprintf(stderr, "%s: %s\n", what, why);
  return result == PLUMB_E_UNSUPPORTED ? 3 : 1;
}

int main(int argc, char** argv) {
  void* library = argc == 2 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : NULL;
  if (library == NULL) return refuse("usage: tower BACKEND.so", argc == 2 ? dlerror() : "which backend?", PLUMB_OK);
  PlumbOpenFunction open = NULL;
  void* symbol = dlsym(library, PLUMB_OPEN_SYMBOL);
  memcpy(&open, &symbol, sizeof open);
  if (open == NULL) return refuse(argv[1], "no Plumb backend", PLUMB_OK);
  PlumbOpenRequest request = {sizeof request, PLUMB_VERSION, PLUMB_VERSION, 0, NULL};
  PlumbOpenReply reply = {sizeof reply, 0, NULL, ""};
  PlumbResult result = open(&request, &reply);
  if (result < 0) return refuse(argv[1], reply.message, result);
  const PlumbBackendTable* table = reply.table;

  PlumbWorldDesc desc = {0};
  desc.struct_size = sizeof desc;
  desc.needs = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;
  desc.gravity.y = -9.81;
  PlumbWorld* world = NULL;
  result = table->create_world(&desc, &world);
  if (result < 0) return refuse("world", table->error_text(NULL), result);

  PlumbShapeDesc shapes[2] = {{sizeof shapes[0], PLUMB_BOX}, {sizeof shapes[0], PLUMB_BOX}};
  shapes[0].half_extents = (PlumbVec3){50, 1, 50};
  shapes[1].half_extents = (PlumbVec3){0.5, 0.5, 0.5};
  PlumbShape shape_ids[2];
  result = table->create_shapes(world, shapes, sizeof shapes[0], 2, shape_ids);
  if (result < 0) return refuse("shapes", table->error_text(world), result);

  PlumbBodyDesc bodies[1 + BOXES] = {{0}};
  PlumbBody ids[1 + BOXES];
  for (int i = 0; i <= BOXES; ++i) {
    bodies[i].struct_size = sizeof bodies[i];
    bodies[i].motion = i == 0 ? PLUMB_STATIC : PLUMB_DYNAMIC;
    bodies[i].shape = shape_ids[i != 0];
    bodies[i].pose.position.y = i == 0 ? -1 : i - 0.5;
    bodies[i].pose.orientation.w = bodies[i].inertia_orientation.w = 1;
    bodies[i].density = 1000;
    bodies[i].gravity_scale = 1;
    bodies[i].material.friction = 0.5;
    bodies[i].filter = (PlumbFilter){1, UINT32_MAX, 0, 0};
  }
  result = table->create_bodies(world, bodies, sizeof bodies[0], 1 + BOXES, ids);
  if (result < 0) return refuse("bodies", table->error_text(world), result);

  const PlumbStepDesc step = {sizeof step, 0, 1.0 / 60};
  for (int i = 0; i < STEPS && result >= 0; ++i) {
    result = table->step(world, &step);
    if (result >= 0) result = table->wait(world, NULL);
  }
  double pose[7];
  if (result >= 0) result = table->read(world, PLUMB_FIELD_POSE, PLUMB_F64, &ids[BOXES], 1, pose, sizeof pose);
  if (result < 0) return refuse("step", table->error_text(world), result);
  printf("%s: top at %.3f m\n", table->info()->name, pose[1]);
  table->destroy_world(world);
  return 0;
}
