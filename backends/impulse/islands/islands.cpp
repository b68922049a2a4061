#include "islands/islands.hpp"

#include "exec/union_find.hpp"

namespace plumb::impulse {

namespace {

PLUMB_HD inline bool is_pushed(const Bodies& bodies, std::uint32_t body) {
  return bodies.velocity[body].inverse_mass > 0;
}
PLUMB_HD inline bool moves(const Velocity& velocity) {
  return length_squared(velocity.linear) > 0 || length_squared(velocity.angular) > 0;
}

struct IslandParents {
  std::uint32_t* parent;
  PLUMB_HD std::uint32_t* operator()(std::uint32_t i) const { return &parent[i]; }
};

struct Graph {
  Bodies bodies;
  std::uint32_t *parent, *restless;

  /// Two bodies touch or are joined. What moves by itself lets nobody rest.
  PLUMB_HD void join(std::uint32_t a, std::uint32_t b) const {
    const bool push_a = is_pushed(bodies, a), push_b = is_pushed(bodies, b);
    if (push_a && push_b) return unite(IslandParents{parent}, a, b);
    if (push_a && moves(bodies.velocity[b])) keep_awake(a);
    if (push_b && moves(bodies.velocity[a])) keep_awake(b);
  }
  PLUMB_HD void keep_awake(std::uint32_t body) const { atomic_or(&restless[body], 1U); }
};

struct Alone {
  std::uint32_t *parent, *restless, *awake, *count;
  PLUMB_HD void operator()(std::uint32_t i) const {
    parent[i] = i;
    restless[i] = awake[i] = 0;
    if (i == 0) *count = 0;
  }
};

struct JoinTouching {
  Graph graph;
  ContactCache cache;
  Proxies proxies;
  const Vec* surface_velocities;
  ManifoldChanges changes;
  PLUMB_HD void operator()(std::uint32_t row) const {
    const std::uint32_t candidate = cache.candidate[row];
    const Pair pair = cache.pairs[candidate];
    const std::uint32_t a = proxies.rows[pair.a].body, b = proxies.rows[pair.b].body;
    graph.join(a, b);
    if (surface_velocities == nullptr || !surface_runs(candidate, pair)) return;
    graph.keep_awake(a);
    graph.keep_awake(b);
  }

 private:
  [[nodiscard]] PLUMB_HD bool surface_runs(std::uint32_t candidate, const Pair& pair) const {
    const ManifoldChange* change = changes.find(candidate, PLUMB_MANIFOLD_SURFACE_VELOCITY);
    return change != nullptr ? length_squared(change->surface_velocity) > 0 : runs(surface_velocities, pair);
  }
};

/// A motor that goes slower than that, relative to its target, stands: at a stop, or under what it can't move.
constexpr Real kMotorStands = Real(0.01);

struct JoinJointed {
  Graph graph;
  JointEdges edges;
  PLUMB_HD void operator()(std::uint32_t j) const {
    const Joint& joint = edges.joints[j];
    if (joint.body_a != kWorld) graph.join(joint.body_a, joint.body_b);
    if (!is_driven_on(joint)) return;
    graph.keep_awake(joint.body_b);
    if (joint.body_a != kWorld) graph.keep_awake(joint.body_a);
  }

 private:
  /// A motor moves it, however slowly.
  [[nodiscard]] PLUMB_HD bool is_driven_on(const Joint& joint) const {
    const JointDrive& drive = edges.drives[joint.slot];
    Real target = 0, turn = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (drive.max_force[axis] > 0) target = max(target, abs(drive.velocity[axis]));
      if (drive.max_force[axis + 3] > 0) turn = max(turn, abs(drive.velocity[axis + 3]));
    }
    if (target == 0 && turn == 0) return false;
    Velocity apart = graph.bodies.velocity[joint.body_b];
    if (joint.body_a != kWorld) {
      const Velocity& a = graph.bodies.velocity[joint.body_a];
      apart.linear -= a.linear;
      apart.angular -= a.angular;
    }
    const auto goes = [](const Vec& speed, Real wanted) {
      return wanted > 0 && length_squared(speed) > kMotorStands * kMotorStands * wanted * wanted;
    };
    return goes(apart.linear, target) || goes(apart.angular, turn);
  }
};

struct FindRoot {
  std::uint32_t *parent, *root;
  PLUMB_HD void operator()(std::uint32_t i) const { root[i] = find_root(IslandParents{parent}, i); }
};

struct KeepAwake {
  Bodies bodies;
  const Real* rest;
  Real time;
  const std::uint32_t *root, *restless;
  std::uint32_t* awake;
  PLUMB_HD void operator()(std::uint32_t i) const {
    if (is_pushed(bodies, i) && (rest[i] < time || restless[i] != 0)) atomic_or(&awake[root[i]], 1U);
  }
};

struct ListResting {
  Bodies bodies;
  const std::uint32_t *root, *awake;
  std::uint32_t *resting, *count;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const bool rests = is_pushed(bodies, i) && awake[root[i]] == 0;
    resting[i] = rests ? root[i] + 1 : 0;
    if (rests) atomic_add(count, 1U);
  }
};

}  // namespace

void Islands::reserve(std::uint32_t bodies) {
  for (Buffer<std::uint32_t>* buffer : {&parent_, &root_, &restless_, &awake_, &resting_}) buffer->grow(bodies);
  count_.grow(1);
}

void Islands::find_resting(Executor& executor, const Input& input) {
  const Bodies& bodies = input.bodies;
  const std::uint32_t count = input.body_count;
  executor.run(count, Alone{parent_.data(), restless_.data(), awake_.data(), count_.device()});
  const Graph graph = {bodies, parent_.data(), restless_.data()};
  executor.run(input.manifolds,
               JoinTouching{graph, input.cache, input.proxies, input.surface_velocities, input.changes});
  executor.run(input.joints.count, JoinJointed{graph, input.joints});
  executor.run(count, FindRoot{parent_.data(), root_.data()});
  executor.run(count, KeepAwake{bodies, input.rest, input.time, root_.data(), restless_.data(), awake_.data()});
  executor.run(count, ListResting{bodies, root_.data(), awake_.data(), resting_.data(), count_.device()});
  executor.to_host(count_, 1);
}

}  // namespace plumb::impulse
