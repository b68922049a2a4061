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
      {"determinism.run", "the same calls give the same bits", &repeatable},
      {"state.hash", "the hash sees what changes", &hash_is_sensitive},
  };
  return checks;
}

}  // namespace plumb::harness::conform
