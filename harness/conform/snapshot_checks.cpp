// Snapshots and determinism: what is promised comes back to the bit.
#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace {

/// A heap of cubes and spheres on the ground.
std::vector<PlumbBody> heap(Probe& probe) {
  probe.ground();
  const PlumbShape shapes[2] = {probe.lump(0.5), probe.sphere(0.5)};
  std::vector<PlumbBody> bodies;
  for (int i = 0; i < 24; ++i)
    bodies.push_back(probe.dynamic(shapes[i % 2], {0.9 * (i % 3), 1 + 1.1 * (i / 6), 0.8 * (i / 3 % 2)}));
  return bodies;
}

void save_and_restore(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SNAPSHOT;
  c.require_needs(needs);
  const PlumbDegree degree = c.require(PLUMB_CAP_SNAPSHOT, 0, 0, "snapshots");
  Probe probe(c, needs);
  const std::vector<PlumbBody> bodies = heap(probe);
  probe.step(60);
  std::span<const std::byte> saved;
  check(probe.world(), probe.world().snapshot()->save(saved));
  const std::vector<std::byte> bytes(saved.begin(), saved.end());
  const std::uint64_t at_save = probe.hash();
  probe.step(100);
  const std::uint64_t first = probe.hash();
  const Vec first_position = probe.position(bodies[0]);
  check(probe.world(), probe.world().snapshot()->restore(bytes));
  c.expect(probe.hash() == at_save, "the state after restoring is not the one that was saved");
  probe.step(100);
  if (degree >= PLUMB_EMULATED)
    c.expect(probe.hash() == first, "100 steps after restoring the state differs");
  else
    c.expect((probe.position(bodies[0]) - first_position).norm() < 1,
             "100 steps after restoring a body is {:.3f} m away", (probe.position(bodies[0]) - first_position).norm());
}

/// A heap from the day before, after one in which it has changed beyond recognition.
struct ChangedHeap {
  explicit ChangedHeap(Conformance& c)
      : has_joints(c.backend().capability(PLUMB_CAP_JOINT, PLUMB_JOINT_BALL) != PLUMB_NONE),
        probe(c, kPlainNeeds | PLUMB_NEED_SNAPSHOT | (has_joints ? PLUMB_NEED_JOINTS : 0)),
        ball(probe.sphere(0.4)),
        bodies(heap(probe)) {
    if (has_joints) joints.push_back(hook(bodies[22]));
    probe.step(30);
    std::span<const std::byte> bytes;
    check(probe.world(), probe.world().snapshot()->save_world(bytes));
    saved.assign(bytes.begin(), bytes.end());
  }

  PlumbJoint hook(PlumbBody body) {
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_BALL);
    desc.body_b = body;
    const Vec at = probe.position(body) + Vec(0, 2, 0);
    desc.frame_a.position = {at.x(), at.y(), at.z()};
    desc.frame_b.position = {0, 2, 0};
    return probe.joint(desc);
  }
  PlumbBody comer() {
    PlumbBodyDesc desc = probe.free_desc({4, 3, 4});
    desc.shape = ball;
    return probe.body(desc);
  }
  /// Bodies and the joint go, others come, also in their slots.
  void change() {
    if (has_joints) check(probe.world(), probe.world().joints()->destroy_joints(joints));
    for (const std::size_t i : {3, 22, 11}) probe.destroy(bodies[i]);
    for (int i = 0; i < 5; ++i) comer();
    probe.write(PLUMB_FIELD_MATERIAL, bodies[5], {0.9, 0});
    probe.step(20);
  }

  bool has_joints;
  Probe probe;
  PlumbShape ball;
  std::vector<PlumbBody> bodies;
  std::vector<PlumbJoint> joints;
  std::vector<std::byte> saved;
};

PlumbDegree require_world_snapshots(Conformance& c) {
  c.require_needs(kPlainNeeds | PLUMB_NEED_SNAPSHOT);
  return c.require(PLUMB_CAP_SNAPSHOT, 1, 0, "snapshots of the whole world");
}

void save_and_restore_a_world(Conformance& c) {
  const PlumbDegree degree = require_world_snapshots(c);
  ChangedHeap day(c);
  Probe& probe = day.probe;
  const auto living = [&] {
    const std::span<const PlumbBody> bodies = probe.world().bodies();
    return std::vector<PlumbBody>(bodies.begin(), bodies.end());
  };
  const std::vector<PlumbBody> lived = living();
  const std::uint64_t at_save = probe.hash();
  const PlumbBody next = day.comer();
  probe.step(60);
  const std::uint64_t first = probe.hash();
  const Vec place = probe.position(day.bodies[5]);
  day.change();
  check(probe.world(), probe.world().snapshot()->restore(day.saved));
  c.expect(living() == lived, "other bodies live after restoring than when the world was saved");
  c.expect(probe.hash() == at_save, "the state after restoring is not the one that was saved");
  const double friction = probe.read(PLUMB_FIELD_MATERIAL, day.bodies[5])[0];
  c.expect(friction == 0.5, "a body's friction of .5 is {} after restoring", friction);
  c.expect(day.comer() == next, "who comes next gets another handle than whoever came next then");
  probe.step(60);
  if (degree >= PLUMB_EMULATED)
    c.expect(probe.hash() == first, "60 steps after restoring the state differs");
  else
    c.expect((probe.position(day.bodies[5]) - place).norm() < 1, "60 steps after restoring a body is {:.3f} m away",
             (probe.position(day.bodies[5]) - place).norm());
  if (day.has_joints) {
    check(probe.world(), probe.world().joints()->destroy_joints(day.joints));
    c.expect(probe.world().destroy_bodies({&day.bodies[22], 1}) == PLUMB_OK,
             "a body that is joined no more cannot be destroyed: {}", probe.world().error_text());
  }
}

void refuse_a_world_of_other_shapes(Conformance& c) {
  (void)require_world_snapshots(c);
  ChangedHeap day(c);
  Probe& probe = day.probe;
  const PlumbShape marble = probe.sphere(0.1);
  const PlumbBody body = probe.dynamic(marble, {5, 1, 5});
  std::span<const std::byte> bytes;
  check(probe.world(), probe.world().snapshot()->save_world(bytes));
  const std::vector<std::byte> saved(bytes.begin(), bytes.end());
  probe.destroy(body);
  c.expect(probe.world().snapshot()->restore(saved) == PLUMB_OK, "a body of a shape that lives does not come back: {}",
           probe.world().error_text());
  probe.destroy(body);
  check(probe.world(), probe.world().destroy_shapes({&marble, 1}));
  const std::uint64_t before = probe.hash();
  c.expect(probe.world().snapshot()->restore(saved) == PLUMB_E_CORRUPT, "a body comes back without its shape");
  (void)probe.sphere(0.3);
  c.expect(probe.world().snapshot()->restore(saved) == PLUMB_E_CORRUPT, "a body comes back with another shape");
  c.expect(probe.hash() == before, "a snapshot that was refused has changed the world");
}

void repeatable(Conformance& c) {
  if (c.backend().info().determinism == PLUMB_DETERMINISM_NONE) throw Skipped{"no determinism is claimed"};
  std::uint64_t hashes[2];
  for (std::uint64_t& hash : hashes) {
    Probe probe(c, c.available(kPlainNeeds));
    heap(probe);
    probe.step(200);
    hash = probe.hash();
  }
  c.expect(hashes[0] == hashes[1], "two runs of the same calls end in different bits");
}

void hash_is_sensitive(Conformance& c) {
  Probe probe(c, c.available(kPlainNeeds));
  const std::vector<PlumbBody> bodies = heap(probe);
  const std::uint64_t before = probe.hash();
  c.expect(probe.hash() == before, "asking twice gives two hashes");
  const Vec p = probe.position(bodies[3]);
  probe.write_pose(PLUMB_FIELD_POSE, bodies[3], p + Vec(1e-3, 0, 0));
  c.expect(probe.hash() != before, "a body moved by a millimetre does not change the hash");
}

}  // namespace

std::span<const Check> snapshot_checks() {
  static constexpr Check checks[] = {
      {"snapshot.restore", "save, step, restore, step", &save_and_restore},
      {"snapshot.world", "bodies and joints that came and went since are undone", &save_and_restore_a_world},
      {"snapshot.world_shapes", "a world is not restored without its shapes", &refuse_a_world_of_other_shapes},
      {"determinism.run", "the same calls give the same bits", &repeatable},
      {"state.hash", "the hash sees what changes", &hash_is_sensitive},
  };
  return checks;
}

}  // namespace plumb::harness::conform
