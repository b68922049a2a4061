// Memory that the host lends: it is taken as a scene grows, given back when a world goes, and where there is no more of
// it a call fails and nothing else.
#include "conform/memory_host.hpp"
#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace {

PlumbDegree require_memory(Conformance& c) {
  c.require_needs(kPlainNeeds);
  return c.require(PLUMB_CAP_HOST_MEMORY, 0, 0, "memory of the host");
}

/// Balls in a square, at rest on nothing, none of which touch.
std::vector<PlumbBodyDesc> balls(PlumbShape shape, int count) {
  std::vector<PlumbBodyDesc> descs;
  for (int i = 0; i < count; ++i) {
    const int column = i % 40, row = i / 40;
    descs.push_back(dynamic_desc(shape, Vec(2.0 * column, 2.0 * row, 0)));
  }
  return descs;
}

/// Bytes held by a world of so many balls after a step.
std::size_t held_by(Conformance& c, int count) {
  MemoryHost& memory = MemoryHost::instance();
  const std::size_t before = memory.held().bytes;
  Probe world(c, kPlainNeeds, Vec::Zero());
  std::vector<PlumbBody> ids(static_cast<std::size_t>(count));
  check(world.world(), world.world().create_bodies(balls(world.sphere(0.5), count), ids));
  world.step(1);
  return memory.held().bytes - before;
}

void taken(Conformance& c) {
  const PlumbDegree degree = require_memory(c);
  MemoryHost& memory = MemoryHost::instance();
  (void)held_by(c, 10);  // what is kept for the next world is kept now
  const MemoryHost::Held before = memory.held();
  const std::size_t few = held_by(c, 10), many = held_by(c, 2000);
  // A pose, a velocity and a mass are 15 numbers.
  const std::size_t least = degree == PLUMB_NATIVE ? 1990 * 15 * sizeof(float) : 1990;
  c.expect(many > few + least, "1,990 bodies more take {} bytes of the host's memory; at least {} are expected",
           many - std::min(few, many), least);
  const MemoryHost::Held after = memory.held();
  c.expect(after.blocks == before.blocks && after.bytes == before.bytes,
           "{} blocks of {} bytes are not given back when worlds are destroyed", after.blocks - before.blocks,
           after.bytes - before.bytes);
  c.expect(memory.mistakes() == 0, "{} blocks were asked for or given back wrongly", memory.mistakes());
}

/// act() is refused memory sooner or later, until it gets all that it asks for. It answers a result; after one that is
/// refused recover() is called, with memory.
template <class Act, class Recover>
void refuse_each(Conformance& c, const char* what, const Act& act, const Recover& recover) {
  MemoryHost& memory = MemoryHost::instance();
  for (std::size_t next = 0; next < 100'000; next += 1 + next / 8) {
    memory.refuse_after(next);
    const PlumbResult result = act();
    const bool refused = memory.allow();
    if (!refused) {
      c.expect(result >= 0, "{} is answered {} though no memory was refused", what, result);
      return;
    }
    c.expect(result == PLUMB_E_OUT_OF_MEMORY || result == PLUMB_E_WORLD_LOST || result >= 0,
             "{} is answered {} where memory is refused", what, result);
    recover(result);
  }
  c.expect(false, "{} asks for memory without end", what);
}

PlumbResult result_of(const auto& call) {
  try {
    return call();
  } catch (const Error& error) {
    return error.code();
  }
}

/// A call that was refused memory has changed nothing, and does all when it is made again.
void refused_to_bodies(Conformance& c) {
  require_memory(c);
  Probe world(c, kPlainNeeds, Vec::Zero());
  const PlumbShape ball = world.sphere(0.5);
  constexpr std::size_t kMore = 200;
  std::vector<PlumbBody> ids(kMore);
  const std::vector<PlumbBodyDesc> descs = balls(ball, kMore);
  refuse_each(
      c, "creating bodies", [&] { return result_of([&] { return world.world().create_bodies(descs, ids); }); },
      [&](PlumbResult result) {
        const std::size_t count = world.world().bodies().size();
        c.expect(count == (result < 0 ? 0 : kMore), "{} bodies live after creating {} was answered {}", count, kMore,
                 result);
        if (result >= 0) check(world.world(), world.world().destroy_bodies(ids));
      });
  c.expect(world.world().bodies().size() == kMore, "{} of {} bodies live at last", world.world().bodies().size(),
           kMore);
  const PlumbStepReport report = world.step(2);
  c.expect(report.bodies == kMore && report.nonfinite == 0, "a step then sees {} bodies, {} of them without numbers",
           report.bodies, report.nonfinite);
}

/// A step that was refused memory leaves a world that goes on, or one that is lost and says so; either can be
/// destroyed, and gives back what it held.
void refused_to_steps(Conformance& c) {
  c.require_needs(kPlainNeeds);
  c.require_exact(PLUMB_CAP_HOST_MEMORY, 0, 0, "memory of the host");  // else steps may take none of it
  MemoryHost& memory = MemoryHost::instance();
  (void)held_by(c, 10);
  const MemoryHost::Held before = memory.held();
  std::unique_ptr<Probe> world;
  const auto build = [&] {
    world.reset();
    world = std::make_unique<Probe>(c, kPlainNeeds, Vec(0, -10, 0));
    world->fixed(world->box({10, 0.5, 10}), Vec(0, -0.5, 0));
    std::vector<PlumbBodyDesc> heap;
    const PlumbShape ball = world->sphere(0.5);
    for (int i = 0; i < 729; ++i) {
      const int column = i % 9, layer = i / 9 % 9, row = i / 81;
      heap.push_back(dynamic_desc(ball, 0.8 * Vec(column, 0.5 + layer, row)));
    }
    std::vector<PlumbBody> ids(heap.size());
    check(world->world(), world->world().create_bodies(heap, ids));
  };
  build();
  refuse_each(
      c, "a step",
      [&] {
        return result_of([&] {
          PlumbStepReport report{};
          report.struct_size = sizeof report;
          const PlumbResult begun = world->world().step(1.0 / 60);
          return begun < 0 ? begun : world->world().wait(report);
        });
      },
      [&](PlumbResult result) {
        if (result != PLUMB_E_WORLD_LOST) {
          const PlumbStepReport report = world->step(2);
          c.expect(report.nonfinite == 0, "{} bodies have no numbers after a step without memory", report.nonfinite);
        }
        build();
      });
  world.reset();
  const MemoryHost::Held after = memory.held();
  c.expect(after.blocks == before.blocks, "{} blocks are not given back by worlds whose steps were refused memory",
           after.blocks - before.blocks);
}

/// The same of shapes that are much, of bodies of several, of joints, and of answers to queries.
void refused_to_all(Conformance& c) {
  require_memory(c);
  const PlumbNeeds needs = kPlainNeeds | c.available(PLUMB_NEED_JOINTS | PLUMB_NEED_QUERIES);
  Probe in(c, needs, Vec::Zero());
  IPhysicsWorld& world = in.world();
  const auto has = [&](PlumbShapeType type, PlumbMotion motion) {
    return c.backend().capability(PLUMB_CAP_SHAPE, type, motion) != PLUMB_NONE;
  };
  const PlumbShape ball = in.sphere(0.5);
  if (has(PLUMB_HEIGHT_FIELD, PLUMB_STATIC)) {
    const std::vector<double> heights(32 * 32, 0.25);
    PlumbShapeDesc field = shape_desc(PLUMB_HEIGHT_FIELD);
    field.heights = heights.data();
    field.rows = field.columns = 32;
    field.spacing = {1, 0, 1};
    PlumbShape shape = 0;
    const auto create = [&] { return result_of([&] { return world.create_shapes({&field, 1}, {&shape, 1}); }); };
    refuse_each(c, "creating a height field", create, [&](PlumbResult result) {
      if (result >= 0) check(world, world.destroy_shapes({&shape, 1}));
    });
    PlumbBody ground = in.fixed(shape, Vec(0, -40, 0));
    in.step(1);
    in.destroy(ground);
  }
  PlumbShape last = ball;
  if (has(PLUMB_COMPOUND, PLUMB_DYNAMIC)) {
    PlumbCompoundChild children[6];
    for (int i = 0; i < 6; ++i) {
      children[i] = {ball, identity_pose(), 0, 0, {}};
      children[i].pose.position.z = 0.9 * i;
    }
    PlumbShapeDesc compound = shape_desc(PLUMB_COMPOUND);
    compound.children = children;
    compound.child_count = 6;
    refuse_each(
        c, "creating a compound",
        [&] { return result_of([&] {
                return world.create_shapes({&compound, 1}, {&last, 1});
              }); },
        [&](PlumbResult result) {
          if (result >= 0) check(world, world.destroy_shapes({&last, 1}));
        });
  }
  std::vector<PlumbBody> ids(60);
  const std::vector<PlumbBodyDesc> descs = balls(last, 60);
  refuse_each(
      c, "creating bodies of several shapes",
      [&] { return result_of([&] { return world.create_bodies(descs, ids); }); },
      [&](PlumbResult result) {
        if (result >= 0) check(world, world.destroy_bodies(ids));
        c.expect(world.bodies().empty(), "{} bodies live after creating 60 was answered {}", world.bodies().size(),
                 result);
      });
  if (in.declares(PLUMB_NEED_JOINTS) && world.joints() != nullptr) {
    std::vector<PlumbJointDesc> joints;
    for (std::size_t i = 0; i + 1 < ids.size(); ++i) {
      joints.push_back(joint_desc(PLUMB_JOINT_BALL));
      joints.back().body_a = ids[i];
      joints.back().body_b = ids[i + 1];
      joints.back().frame_a.position = {1, 0, 0};
      joints.back().frame_b.position = {-1, 0, 0};
    }
    std::vector<PlumbJoint> made(joints.size());
    refuse_each(
        c, "creating joints", [&] { return result_of([&] { return world.joints()->create_joints(joints, made); }); },
        [&](PlumbResult result) {
          if (result >= 0) check(world, world.joints()->destroy_joints(made));
        });
    in.step(3);
  }
  if (in.declares(PLUMB_NEED_QUERIES) && world.queries() != nullptr) {
    std::vector<PlumbRay> rays;
    for (int i = 0; i < 300; ++i) {
      const int column = i % 40, row = i / 40;
      rays.push_back({{2.0 * column, 2.0 * row, 9}, {0, 0, -20}, kSeesAll});
    }
    refuse_each(
        c, "asking rays",
        [&] { return result_of([&] { return world.queries()->cast_rays(PLUMB_HIT_ALL, rays).result; }); },
        [](PlumbResult) {});
    const Hits hits = world.queries()->cast_rays(PLUMB_HIT_ALL, rays);
    c.expect(hits.result >= 0 && hits.hits.size() >= 30, "{} hits after memory was refused to rays", hits.hits.size());
  }
  const PlumbStepReport report = in.step(2);
  c.expect(report.nonfinite == 0, "{} bodies have no numbers", report.nonfinite);
}

}  // namespace

std::span<const Check> memory_checks() {
  static constexpr Check checks[] = {
      {"memory.taken", "the host's memory is taken as a scene grows, and given back", &taken},
      {"memory.bodies", "bodies that no memory is left for are not created, and can be later", &refused_to_bodies},
      {"memory.others", "the same of shapes, joints and queries", &refused_to_all},
      {"memory.steps", "a step without memory fails, and nothing is left behind", &refused_to_steps},
  };
  return checks;
}

}  // namespace plumb::harness::conform
