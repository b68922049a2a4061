// Contact modification: what a step has found, and that it is solved as the host says, in that step alone.
#include <functional>

#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace {

constexpr PlumbNeeds kNeeds = kPlainNeeds | PLUMB_NEED_CONTACT_MODIFICATION;
using Manifolds = std::span<const PlumbManifold>;
using Changes = std::vector<PlumbManifoldChange>;
using Modify = std::function<void(Manifolds, Changes&)>;

void require(Conformance& c, std::uint32_t what, PlumbNeeds needs = 0) {
  c.require_needs(kNeeds | needs);
  if (what != 0) {
    const auto index = static_cast<std::uint32_t>(std::countr_zero(what));
    c.require(PLUMB_CAP_MANIFOLD, index, 0, "such a change of contacts");
  }
}

/// Steps, with each part's manifolds changed by modify.
void step(Probe& probe, const Modify& modify, int steps = 1, double dt = 1.0 / 60) {
  IManifolds& manifolds = *probe.world().manifolds();
  for (int i = 0; i < steps; ++i) {
    check(probe.world(), probe.world().step(dt));
    for (;;) {
      Manifolds rows;
      check(probe.world(), manifolds.read_manifolds(rows));
      if (rows.empty()) break;
      Changes changes;
      modify(rows, changes);
      check(probe.world(), manifolds.modify_manifolds(changes));
    }
    PlumbStepReport report;
    check(probe.world(), probe.world().wait(report));
  }
}

/// Changes all of them likewise.
Modify all(const PlumbManifoldChange& like) {
  return [like](Manifolds rows, Changes& changes) {
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
      changes.push_back(like);
      changes.back().manifold = row;
    }
  };
}
PlumbManifoldChange disabled() {
  PlumbManifoldChange change = manifold_change(0);
  change.what = PLUMB_MANIFOLD_DISABLED;
  return change;
}
const Modify kNothing = [](Manifolds, Changes&) {};

PlumbBody shown_body(Probe& probe, const Vec& at, const Vec& velocity = Vec::Zero(), double restitution = 0) {
  PlumbBodyDesc desc = dynamic_desc(probe.lump(0.5), at, velocity);
  desc.flags = PLUMB_BODY_MODIFY_CONTACTS;
  if (probe.declares(PLUMB_NEED_RESTITUTION)) desc.material.restitution = restitution;
  return probe.body(desc);
}

bool is_of(const PlumbManifold& row, PlumbBody a, PlumbBody b) {
  return (row.body_a == a && row.body_b == b) || (row.body_a == b && row.body_b == a);
}

void are_shown(Conformance& c) {
  require(c, 0);
  Probe probe(c, kNeeds);
  const PlumbBody ground = probe.ground();
  const PlumbBody shown = shown_body(probe, {0, 0.499, 0}, {0.5, 0, 0});
  const PlumbBody other = probe.dynamic(probe.lump(0.5), {5, 0.5, 0});
  int seen = 0;
  step(probe, [&](Manifolds rows, Changes&) {
    for (const PlumbManifold& row : rows) {
      c.expect(!is_of(row, other, ground), "a contact of two that do not ask for it is shown");
      if (!is_of(row, shown, ground)) continue;
      ++seen;
      const double up = row.body_a == ground ? 1 : -1;
      c.expect((vec(row.normal) - Vec(0, up, 0)).norm() < 1e-3,
               "the normal is ({:.3f}, {:.3f}, {:.3f}), not up or down", row.normal.x, row.normal.y, row.normal.z);
      c.expect(std::abs(up * row.velocity.x - 0.5) < 1e-3, "the body slides at {:.4f} m/s instead of .5",
               up * row.velocity.x);
      c.expect(std::abs(row.friction - 0.5) < 1e-6, "friction is {:.6f} instead of .5", row.friction);
      c.expect(row.restitution == 0, "restitution is {} instead of 0", row.restitution);
      for (std::uint32_t p = 0; p < row.point_count; ++p) {
        c.expect(std::abs(row.depth[p] - 1e-3) < 5e-4, "a point is {:.2f} mm deep instead of 1", 1e3 * row.depth[p]);
        c.expect(std::abs(row.position[p].y) < 2e-3 && std::abs(row.position[p].x) < 0.51,
                 "a point is at ({:.3f}, {:.3f}), not where they touch", row.position[p].x, row.position[p].y);
      }
    }
  });
  c.expect(seen > 0, "what lies on the ground and asks for it is not shown");
}

void nothing_changed(Conformance& c) {
  require(c, 0);
  const auto hash = [&](const std::function<void(Probe&)>& go) {
    Probe probe(c, kNeeds);
    probe.ground();
    for (int i = 0; i < 3; ++i) shown_body(probe, {0.1 * i, 0.6 + 1.1 * i, 0});
    go(probe);
    return probe.hash();
  };
  const std::uint64_t plain = hash([](Probe& probe) { probe.step(60); });
  c.expect(hash([](Probe& probe) { step(probe, kNothing, 60); }) == plain,
           "a host that reads manifolds and changes none gets another state than one that does not read them");
  const auto half = [](Probe& probe) {
    for (int i = 0; i < 60; ++i) {
      check(probe.world(), probe.world().step(1.0 / 60));
      Manifolds rows;
      check(probe.world(), probe.world().manifolds()->read_manifolds(rows));
      const std::size_t once = rows.size();
      check(probe.world(), probe.world().manifolds()->read_manifolds(rows));
      if (rows.size() != once) throw Error(PLUMB_E_INTERNAL, "manifolds that are read again are others");
      PlumbStepReport report;
      check(probe.world(), probe.world().wait(report));
    }
  };
  c.expect(hash(half) == plain, "a host that reads manifolds and does not go on gets another state");
}

void falls_when_disabled(Conformance& c) {
  const PlumbNeeds events = c.available(PLUMB_NEED_EVENTS | PLUMB_NEED_CONTACTS);
  require(c, PLUMB_MANIFOLD_DISABLED);
  Probe probe(c, kNeeds | events);
  const PlumbBody ground = probe.ground();
  const PlumbBody one = shown_body(probe, {-2, 0.5, 0}), other = shown_body(probe, {2, 0.5, 0});
  const Modify drop_one = [&](Manifolds rows, Changes& changes) {
    for (std::uint32_t row = 0; row < rows.size(); ++row)
      if (is_of(rows[row], one, ground)) {
        changes.push_back(disabled());
        changes.back().manifold = row;
      }
  };
  step(probe, kNothing, 30);
  step(probe, drop_one, 12);
  // 12 steps of fall, from rest.
  const double fallen = 0.5 - probe.position(one).y(), expected = 9.81 / 2 * 0.2 * 0.2;
  c.expect(std::abs(fallen - expected) < 0.15 * expected + 0.005,
           "a body whose contacts are disabled fell {:.3f} m in .2 s instead of {:.3f}", fallen, expected);
  c.expect(std::abs(probe.position(other).y() - 0.5) < 0.02, "a body beside it went to {:.3f} m, too",
           probe.position(other).y());
  if (events == (PLUMB_NEED_EVENTS | PLUMB_NEED_CONTACTS))
    for (const PlumbContact& contact : probe.contacts())
      c.expect(contact.body_a != one && contact.body_b != one, "a disabled contact is told as one of the step");
  step(probe, kNothing, 1);
  c.expect(probe.velocity(one).y() > -1.95, "a contact that was disabled in the steps before still does not hold");
}

void friction_is_changed(Conformance& c) {
  require(c, PLUMB_MANIFOLD_FRICTION);
  const auto slide = [&](const Modify& modify) {
    Probe probe(c, kNeeds);
    probe.ground();
    const PlumbBody body = shown_body(probe, {0, 0.5, 0});
    step(probe, kNothing, 20);
    probe.write(PLUMB_FIELD_VELOCITY, body, {3, 0, 0, 0, 0, 0});
    step(probe, modify, 12);
    return probe.velocity(body).x();
  };
  PlumbManifoldChange change = manifold_change(0);
  change.what = PLUMB_MANIFOLD_FRICTION;
  const auto expect = [&](double speed, double expected, const char* what) {
    c.expect(std::abs(speed - expected) < 0.12, "after .2 s {} slides at {:.3f} m/s instead of {:.3f}", what, speed,
             expected);
  };
  expect(slide(all(change)), 3, "what has no friction in these steps");
  change.friction = 0.8;  // from 1 on a cube tips over
  expect(slide(all(change)), 3 - 0.8 * 9.81 * 0.2, "what has friction .8 in these steps");
  expect(slide(kNothing), 3 - 0.5 * 9.81 * 0.2, "what has its own");
}

void restitution_is_changed(Conformance& c) {
  const PlumbNeeds needs = kNeeds | PLUMB_NEED_RESTITUTION;
  require(c, PLUMB_MANIFOLD_RESTITUTION, PLUMB_NEED_RESTITUTION);
  const auto bounce = [&](double own, const Modify& modify) {
    Probe probe(c, needs);
    probe.ground();
    PlumbBodyDesc desc = dynamic_desc(probe.sphere(0.5), {0, 1.5, 0});
    desc.flags = PLUMB_BODY_MODIFY_CONTACTS;
    desc.material.restitution = own;
    const PlumbBody body = probe.body(desc);
    double fastest = 0;
    for (int i = 0; i < 60; ++i) {
      step(probe, modify);
      fastest = std::max(fastest, probe.velocity(body).y());
    }
    return fastest / std::sqrt(2 * 9.81 * 1);
  };
  PlumbManifoldChange change = manifold_change(0);
  change.what = PLUMB_MANIFOLD_RESTITUTION;
  change.restitution = 0.5;
  c.expect(std::abs(bounce(0, all(change)) - 0.5) < 0.1, "a ball bounces with {:.3f} of its speed instead of .5",
           bounce(0, all(change)));
  change.restitution = 0;
  c.expect(bounce(0.8, all(change)) < 0.15, "a ball bounces with {:.3f} of its speed instead of 0",
           bounce(0.8, all(change)));
}

void surfaces_run(Conformance& c) {
  require(c, PLUMB_MANIFOLD_SURFACE_VELOCITY, PLUMB_NEED_SURFACE_VELOCITY);
  Probe probe(c, kNeeds | PLUMB_NEED_SURFACE_VELOCITY);
  const PlumbBody ground = probe.ground();
  const PlumbBody body = shown_body(probe, {0, 0.5, 0}), other = probe.dynamic(probe.lump(0.5), {0, 0.5, 3});
  step(probe, kNothing, 20);
  // The ground runs along x under this one alone.
  step(
      probe,
      [&](Manifolds rows, Changes& changes) {
        for (std::uint32_t row = 0; row < rows.size(); ++row) {
          changes.push_back(manifold_change(row));
          changes.back().what = PLUMB_MANIFOLD_SURFACE_VELOCITY;
          changes.back().surface_velocity = {rows[row].body_b == ground ? 1.0 : -1.0, 0, 0};
        }
      },
      60);
  c.expect(std::abs(probe.velocity(body).x() - 1) < 0.05, "on a surface that runs at 1 m/s a body goes at {:.3f}",
           probe.velocity(body).x());
  c.expect(std::abs(probe.velocity(other).x()) < 0.01, "a body beside it goes along at {:.3f} m/s",
           probe.velocity(other).x());
  step(probe, kNothing, 60);
  c.expect(std::abs(probe.velocity(body).x()) < 0.02,
           "a second after the surface has stopped a body goes at {:.3f} m/s", probe.velocity(body).x());
}

void wrong_changes(Conformance& c) {
  require(c, 0);
  Probe probe(c, kNeeds);
  probe.ground();
  const PlumbBody body = shown_body(probe, {0, 0.5, 0});
  IPhysicsWorld& world = probe.world();
  IManifolds& manifolds = *world.manifolds();
  Manifolds rows;
  const auto refused = [&](PlumbResult result, PlumbResult expected, const char* what) {
    c.expect(result == expected, "{} is answered {} instead of {}: {}", what, result, expected, world.error_text());
  };
  refused(manifolds.read_manifolds(rows), PLUMB_E_WRONG_PHASE, "reading manifolds outside of a step");
  refused(manifolds.modify_manifolds({}), PLUMB_E_WRONG_PHASE, "changing manifolds outside of a step");
  check(world, world.step(1.0 / 60));
  refused(manifolds.modify_manifolds({}), PLUMB_E_WRONG_PHASE, "changing manifolds before they are read");
  check(world, manifolds.read_manifolds(rows));
  c.expect(!rows.empty(), "what lies on the ground is not shown");
  const auto count = static_cast<std::uint32_t>(rows.size());
  const auto change = [](std::uint32_t row, std::uint32_t what, double friction = 0) {
    PlumbManifoldChange made = manifold_change(row);
    made.what = what;
    made.friction = friction;
    return made;
  };
  const auto invalid = [&](const Changes& changes, const char* what) {
    refused(manifolds.modify_manifolds(changes), PLUMB_E_INVALID_ARGUMENT, what);
  };
  const PlumbManifoldChange good = change(0, PLUMB_MANIFOLD_DISABLED);
  invalid({good, change(count, PLUMB_MANIFOLD_DISABLED)}, "a manifold that was not read");
  invalid({good, good}, "a manifold that is changed twice");
  invalid({change(0, 0)}, "a change of nothing");
  invalid({change(0, 1U << PLUMB_MANIFOLD_CHANGE_COUNT)}, "a change of what is not known");
  if (c.backend().capability(PLUMB_CAP_MANIFOLD, 1) != PLUMB_NONE) {
    invalid({change(0, PLUMB_MANIFOLD_FRICTION, -1)}, "friction below 0");
    invalid({change(0, PLUMB_MANIFOLD_FRICTION, std::numeric_limits<double>::quiet_NaN())},
            "friction that is no number");
  }
  if (c.backend().capability(PLUMB_CAP_MANIFOLD, 2) != PLUMB_NONE)
    refused(manifolds.modify_manifolds(Changes{change(0, PLUMB_MANIFOLD_RESTITUTION)}), PLUMB_E_NOT_DECLARED,
            "restitution that was not declared");
  // All or none: the good change of a refused call is not made.
  check(world, manifolds.modify_manifolds({}));
  PlumbStepReport report;
  check(world, world.wait(report));
  c.expect(std::abs(probe.velocity(body).y()) < 0.1, "a change of a call that was refused is made");
  PlumbBodyDesc desc = dynamic_desc(probe.lump(0.5), {5, 5, 0});
  desc.flags = PLUMB_BODY_MODIFY_CONTACTS;
  Probe plain(c, kPlainNeeds);
  desc.shape = plain.lump(0.5);
  PlumbBody id = 0;
  refused(plain.world().create_bodies({&desc, 1}, {&id, 1}), PLUMB_E_NOT_DECLARED,
          "a body whose contacts are modified in a world that declares nothing of it");
}

void sleepers_are_not_shown(Conformance& c) {
  require(c, PLUMB_MANIFOLD_DISABLED, PLUMB_NEED_SLEEPING);
  Probe probe(c, kNeeds | PLUMB_NEED_SLEEPING);
  probe.ground();
  const PlumbBody body = shown_body(probe, {0, 0.5, 0});
  const auto awake = [&] { return probe.read(PLUMB_FIELD_AWAKE, body)[0] != 0; };
  for (int i = 0; i < 600 && awake(); ++i) step(probe, kNothing);
  if (awake()) throw Skipped{"the body does not fall asleep in ten seconds"};
  int seen = 0;
  step(
      probe, [&](Manifolds rows, Changes&) { seen += static_cast<int>(rows.size()); }, 10);
  c.expect(seen == 0, "{} manifolds of one who sleeps are shown", seen);
  probe.write(PLUMB_FIELD_AWAKE, body, {1});
  step(probe, all(disabled()), 12);
  c.expect(probe.position(body).y() < 0.4, "a body that was woken stands on a contact that is disabled");
}

}  // namespace

std::span<const Check> manifold_checks() {
  static constexpr Check checks[] = {
      {"manifolds.shown", "contacts of bodies that ask for it are shown before they are solved", &are_shown},
      {"manifolds.nothing", "reading them without a change changes no bit", &nothing_changed},
      {"manifolds.disabled", "what is disabled does not touch in that step", &falls_when_disabled},
      {"manifolds.friction", "friction is what the host says, in that step", &friction_is_changed},
      {"manifolds.restitution", "and so is restitution", &restitution_is_changed},
      {"manifolds.surfaces", "a surface runs where the host says", &surfaces_run},
      {"manifolds.refusals", "what is wrong is refused, and nothing is half done", &wrong_changes},
      {"manifolds.sleep", "sleepers are not shown", &sleepers_are_not_shown},
  };
  return checks;
}

}  // namespace plumb::harness::conform
