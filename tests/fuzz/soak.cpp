// A small busy scene for very many steps: bodies come and go, fall asleep and are woken, joints break, a door swings, a
// bullet flies, a host looks around and takes snapshots. Nothing may go wrong, and memory may not grow.
//
// usage: soak BACKEND STEPS [SEED]
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "plumb/loader.hpp"

namespace {

using namespace plumb;

constexpr double kStep = 1.0 / 60;
constexpr std::size_t kMostBodies = 24, kFewestBodies = 8, kMostJoints = 6;
/// Of this many steps bodies are let be in the second half, and may fall asleep.
constexpr std::uint64_t kRound = 600;
constexpr double kAllowedGrowth = 16;  // MB; what allocators take is not even

/// What the allocator keeps of memory given back to it is no growth.
double resident_megabytes() {
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  double size = 0, resident = 0;
  file >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

[[noreturn]] void broken(const char* what, std::uint64_t step) {
  std::fprintf(stderr, "soak: %s in step %llu\n", what, static_cast<unsigned long long>(step));
  std::exit(1);
}

class Soak {
 public:
  Soak(const Backend& backend, std::uint64_t seed) : backend_(backend), random_(seed) {
    constexpr PlumbNeeds kWanted =
        PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_RESTITUTION | PLUMB_NEED_JOINTS |
        PLUMB_NEED_CCD | PLUMB_NEED_SLEEPING | PLUMB_NEED_EVENTS | PLUMB_NEED_SENSORS | PLUMB_NEED_KINEMATIC |
        PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_QUERIES | PLUMB_NEED_SNAPSHOT | PLUMB_NEED_CONTACT_MODIFICATION;
    PlumbNeeds needs = 0;
    for (std::uint32_t bit = 0; bit < PLUMB_NEED_COUNT; ++bit)
      if ((kWanted >> bit & 1) != 0 && backend.capability(PLUMB_CAP_NEED, bit) != PLUMB_NONE)
        needs |= PlumbNeeds{1} << bit;
    needs_ = needs;
    world_ = backend.create_world(world_desc(needs));
    joints_ = can(PLUMB_NEED_JOINTS) ? world_->joints() : nullptr;
    breaks_ = joints_ != nullptr &&
              backend.capability(PLUMB_CAP_JOINT_FEATURE, PLUMB_JOINT_FIXED, PLUMB_JOINT_BREAKS) != PLUMB_NONE;
    furnish();
  }

  void step(std::uint64_t number) {
    if (number % kRound < kRound / 2) stir();
    if (hinge_ != 0 && number % kRound == 0) aim_ = -aim_;
    if (pusher_ != 0) push(number);
    if (number % 50 == 0) look();
    if (number % 5000 == 4999) go_back();
    if (number % 500 == 0) remember();
    if (number % 500 == 40) take_back();
    PlumbStepReport report{};
    check(*world_, world_->step(kStep));
    if (can(PLUMB_NEED_CONTACT_MODIFICATION)) modify_contacts(number);
    check(*world_, world_->wait(report));
    if (report.nonfinite != 0) broken("a body that is not finite", number);
    read_events(number);
    look_at_colours(number);
    clear_away(number);
    slept_ += report.awake < bodies_.size();
  }

  void tell(std::uint64_t steps) const {
    std::printf("%llu steps: %llu came, %llu went, %llu joints broke, %llu steps with sleepers, %llu touches begun\n",
                static_cast<unsigned long long>(steps), static_cast<unsigned long long>(came_),
                static_cast<unsigned long long>(went_), static_cast<unsigned long long>(broke_),
                static_cast<unsigned long long>(slept_), static_cast<unsigned long long>(begun_));
  }

 private:
  [[nodiscard]] bool can(PlumbNeeds need) const { return (needs_ & need) != 0; }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::size_t below(std::size_t n) { return random_() % n; }

  PlumbShape make(const PlumbShapeDesc& desc) {
    PlumbShape id = 0;
    check(*world_, world_->create_shapes({&desc, 1}, {&id, 1}));
    return id;
  }
  PlumbBody add(PlumbBodyDesc desc, PlumbShape shape, const PlumbVec3& position) {
    desc.shape = shape;
    desc.pose.position = position;
    PlumbBody id = 0;
    check(*world_, world_->create_bodies({&desc, 1}, {&id, 1}));
    return id;
  }

  /// A box without a lid, and what moves in it by itself.
  void furnish() {
    PlumbShapeDesc box = shape_desc(PLUMB_BOX);
    box.half_extents = {4, 0.5, 4};
    add(body_desc(PLUMB_STATIC), make(box), {0, -0.5, 0});
    box.half_extents = {0.5, 2, 4};
    const PlumbShape wall = make(box);
    for (const double side : {-4.5, 4.5}) add(body_desc(PLUMB_STATIC), wall, {side, 1, 0});
    box.half_extents = {4, 2, 0.5};
    const PlumbShape across = make(box);
    for (const double side : {-4.5, 4.5}) add(body_desc(PLUMB_STATIC), across, {0, 1, side});
    box.half_extents = {0.3, 0.2, 0.4};
    shapes_.push_back(make(box));
    bullet_ = shapes_.back();
    PlumbShapeDesc round = shape_desc(PLUMB_SPHERE);
    round.radius = 0.3;
    shapes_.push_back(make(round));
    round.type = PLUMB_CAPSULE;
    round.radius = round.half_height = 0.2;
    if (backend_.capability(PLUMB_CAP_SHAPE, PLUMB_CAPSULE, PLUMB_DYNAMIC) != PLUMB_NONE)
      shapes_.push_back(make(round));
    if (can(PLUMB_NEED_SENSORS)) {
      PlumbBodyDesc sensor = body_desc(PLUMB_STATIC);
      sensor.flags |= PLUMB_BODY_SENSOR;
      add(sensor, across, {0, 3, 0});
    }
    if (can(PLUMB_NEED_KINEMATIC)) pusher_ = add(body_desc(PLUMB_KINEMATIC), shapes_[0], {-3, 0.3, 0});
    if (joints_ != nullptr && backend_.capability(PLUMB_CAP_JOINT, PLUMB_JOINT_HINGE) != PLUMB_NONE) {
      PlumbJointDesc hinge = joint_desc(PLUMB_JOINT_HINGE);
      hinge.body_b = door_ = add(body_desc(), shapes_[0], {2, 1.5, 2});
      hinge.frame_a.position = {2, 1.5, 2};
      check(*world_, joints_->create_joints({&hinge, 1}, {&hinge_, 1}));
    }
  }

  void stir() {
    if (bodies_.size() < kMostBodies && below(20) == 0) come();
    if (bodies_.size() > kFewestBodies && below(25) == 0) go(below(bodies_.size()));
    if (breaks_ && joined_.size() < kMostJoints && below(30) == 0 && bodies_.size() > 1) join();
    if (below(40) == 0 && !bodies_.empty()) {
      const double row[6] = {between(-5, 5), between(0, 5), between(-5, 5), between(-9, 9), 0, between(-9, 9)};
      const PlumbBody any = bodies_[below(bodies_.size())];
      check(*world_, world_->write(PLUMB_FIELD_VELOCITY, {&any, 1},
                                   ConstRows(reinterpret_cast<const std::byte*>(row), 1, sizeof row, PLUMB_F64)));
    }
  }
  void come() {
    PlumbBodyDesc desc = body_desc();
    desc.linear_velocity = {between(-3, 3), between(-3, 3), between(-3, 3)};
    desc.angular_velocity = {between(-5, 5), between(-5, 5), between(-5, 5)};
    desc.material.restitution = can(PLUMB_NEED_RESTITUTION) ? between(0, 0.8) : 0;
    desc.rolling_friction = can(PLUMB_NEED_ROLLING_FRICTION) && below(2) == 0 ? between(0, 0.05) : 0;
    if (can(PLUMB_NEED_CONTACT_MODIFICATION) && below(2) == 0) desc.flags |= PLUMB_BODY_MODIFY_CONTACTS;
    const bool is_bullet = can(PLUMB_NEED_CCD) && below(4) == 0;
    if (is_bullet) {
      desc.flags |= PLUMB_BODY_CCD;
      desc.linear_velocity = {between(-200, 200), -50, between(-200, 200)};
    }
    const PlumbShape shape = is_bullet ? bullet_ : shapes_[below(shapes_.size())];
    bodies_.push_back(add(desc, shape, {between(-3, 3), between(1, 4), between(-3, 3)}));
    ++came_;
  }
  void go(std::size_t place) {
    const PlumbBody gone = bodies_[place];
    for (auto joint = joined_.begin(); joint != joined_.end();) {
      if (joint->second.first != gone && joint->second.second != gone) {
        ++joint;
        continue;
      }
      check(*world_, joints_->destroy_joints({&joint->first, 1}));
      joint = joined_.erase(joint);
    }
    check(*world_, world_->destroy_bodies({&gone, 1}));
    bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(place));
    ++went_;
    PlumbPose pose{};
    if (world_->read(PLUMB_FIELD_POSE, {&gone, 1}, rows_over(std::span<PlumbPose>(&pose, 1))) != PLUMB_E_STALE_HANDLE) {
      std::fprintf(stderr, "soak: a handle of the dead was taken\n");
      std::exit(1);
    }
  }
  /// Where they are, until something pulls harder than this.
  void join() {
    PlumbJointDesc fixed = joint_desc(PLUMB_JOINT_FIXED);
    fixed.body_a = bodies_[below(bodies_.size())];
    fixed.body_b = bodies_[below(bodies_.size())];
    if (fixed.body_a == fixed.body_b) return;
    fixed.frame_a.position = {0, 0.5, 0};
    fixed.frame_b.position = {0, -0.5, 0};
    fixed.break_force = 3000;
    PlumbJoint id = 0;
    check(*world_, joints_->create_joints({&fixed, 1}, {&id, 1}));
    joined_[id] = {fixed.body_a, fixed.body_b};
  }
  void push(std::uint64_t number) {
    const std::uint64_t phase = number % kRound;
    if (phase >= kRound / 2) return;
    const double way = static_cast<double>(phase < kRound / 4 ? phase : kRound / 2 - phase) * 0.02;
    const PlumbPose pose = {{-3 + way, 0.3, 0}, {0, 0, 0, 1}};
    check(*world_, world_->write(PLUMB_FIELD_KINEMATIC_TARGET, {&pusher_, 1},
                                 const_rows_over(std::span<const PlumbPose>(&pose, 1))));
    if (hinge_ == 0) return;
    const double row[6] = {0, 0, 0, aim_, 0, 0};
    check(*world_, world_->write(PLUMB_FIELD_VELOCITY, {&door_, 1},
                                 ConstRows(reinterpret_cast<const std::byte*>(row), 1, sizeof row, PLUMB_F64)));
  }
  /// Bodies pass through each other now and then, and slide; the box holds.
  void modify_contacts(std::uint64_t number) {
    std::span<const PlumbManifold> rows;
    while (check(*world_, world_->manifolds()->read_manifolds(rows)), !rows.empty()) {
      std::vector<PlumbManifoldChange> changes;
      for (std::uint32_t row = 0; row < rows.size(); ++row) {
        const auto is_in = [this](PlumbBody body) { return std::ranges::find(bodies_, body) != bodies_.end(); };
        if (!is_in(rows[row].body_a) && !is_in(rows[row].body_b)) broken("contacts of others are shown", number);
        if (below(8) != 0) continue;
        changes.push_back(manifold_change(row));
        const bool passes = is_in(rows[row].body_a) && is_in(rows[row].body_b);
        changes.back().what = passes ? PLUMB_MANIFOLD_DISABLED : PLUMB_MANIFOLD_FRICTION;
        changes.back().friction = between(0, 2);
      }
      check(*world_, world_->manifolds()->modify_manifolds(changes));
    }
  }
  void look() {
    if (!can(PLUMB_NEED_QUERIES)) return;
    const PlumbRay ray = {{between(-3, 3), 6, between(-3, 3)}, {between(-1, 1), -7, between(-1, 1)}, {1, ~0U, 0, 0}};
    static_cast<void>(world_->queries()->cast_rays(PLUMB_HIT_ALL, {&ray, 1}));
  }
  /// To this very state: what a snapshot holds, it holds.
  void go_back() {
    ISnapshot* const snapshot = can(PLUMB_NEED_SNAPSHOT) ? world_->snapshot() : nullptr;
    if (snapshot == nullptr) return;
    std::span<const std::byte> data;
    check(*world_, snapshot->save(data));
    const std::vector<std::byte> kept(data.begin(), data.end());
    check(*world_, snapshot->restore(kept));
  }
  /// To how the world was forty steps ago, whoever came, went or broke since: as a game does it over a network.
  void remember() {
    if (!can(PLUMB_NEED_SNAPSHOT) || backend_.capability(PLUMB_CAP_SNAPSHOT, 1) == PLUMB_NONE) return;
    std::span<const std::byte> data;
    check(*world_, world_->snapshot()->save_world(data));
    remembered_ = {{data.begin(), data.end()}, bodies_, joined_, begun_, ended_};
  }
  void take_back() {
    if (remembered_.world.empty()) return;
    check(*world_, world_->snapshot()->restore(remembered_.world));
    bodies_ = remembered_.bodies;
    joined_ = remembered_.joined;
    begun_ = remembered_.begun;
    ended_ = remembered_.ended;
    awake_.clear();
  }
  void read_events(std::uint64_t number) {
    for (const PlumbEvent& event : world_->events()) {
      if (event.type == PLUMB_EVENT_JOINT_BROKEN) broke_ += joined_.erase(event.joint);
      if (event.type == PLUMB_EVENT_CONTACT_BEGIN) ++begun_;
      if (event.type == PLUMB_EVENT_CONTACT_END) ++ended_;
    }
    if (ended_ > begun_) broken("more touches ended than begun", number);
  }
  /// Contacts of a colour are solved at once: no two of them may push the same body. Only who was awake before the step
  /// as well as after it was pushed in it for certain.
  void look_at_colours(std::uint64_t number) {
    IDebug* const debug = world_->debug();
    if (debug == nullptr || !tells_colours_) return;
    std::span<const PlumbDebugBody> bodies;
    std::span<const PlumbDebugConstraint> constraints;
    try {
      check(*world_, debug->body_states(bodies));
      check(*world_, debug->solved_constraints(constraints));
    } catch (const Error&) {
      tells_colours_ = false;
      return;
    }
    std::set<PlumbBody> awake;
    for (const PlumbDebugBody& each : bodies)
      if (each.asleep == 0 && (each.body == door_ || std::ranges::find(bodies_, each.body) != bodies_.end()))
        awake.insert(each.body);
    std::set<std::pair<std::int32_t, PlumbBody>> pushed;
    for (const PlumbDebugConstraint& each : constraints) {
      if (each.colour < 0 || each.joint != 0) continue;
      for (const PlumbBody body : {each.body_a, each.body_b})
        if (awake.contains(body) && awake_.contains(body) && !pushed.emplace(each.colour, body).second)
          broken("two contacts of a colour that push the same body", number);
    }
    awake_ = std::move(awake);
  }
  /// What has left the box is taken away.
  void clear_away(std::uint64_t number) {
    if (bodies_.empty()) return;
    std::vector<PlumbPose> poses(bodies_.size());
    check(*world_, world_->read(PLUMB_FIELD_POSE, bodies_, rows_over(std::span<PlumbPose>(poses))));
    for (std::size_t i = bodies_.size(); i-- > 0;) {
      const PlumbVec3& p = poses[i].position;
      if (!std::isfinite(p.x + p.y + p.z)) broken("a pose that is not finite", number);
      if (p.y < -5 || p.y > 50 || std::abs(p.x) > 50 || std::abs(p.z) > 50) go(i);
    }
  }

  Backend backend_;
  std::mt19937_64 random_;
  PlumbNeeds needs_ = 0;
  std::unique_ptr<IPhysicsWorld> world_;
  IJoints* joints_ = nullptr;
  bool breaks_ = false;
  std::vector<PlumbShape> shapes_;
  PlumbShape bullet_ = 0;
  PlumbBody pusher_ = 0, door_ = 0;
  PlumbJoint hinge_ = 0;
  double aim_ = 3;
  bool tells_colours_ = true;
  std::set<PlumbBody> awake_;
  std::vector<PlumbBody> bodies_;
  std::map<PlumbJoint, std::pair<PlumbBody, PlumbBody>> joined_;
  struct {
    std::vector<std::byte> world;
    std::vector<PlumbBody> bodies;
    std::map<PlumbJoint, std::pair<PlumbBody, PlumbBody>> joined;
    std::uint64_t begun, ended;
  } remembered_{};
  std::uint64_t came_ = 0, went_ = 0, broke_ = 0, slept_ = 0, begun_ = 0, ended_ = 0;
};

int run(const char* name, std::uint64_t steps, std::uint64_t seed) {
  const Backend backend = open_backend(name);
  if (backend.capability(PLUMB_CAP_SHAPE, PLUMB_BOX, PLUMB_DYNAMIC) == PLUMB_NONE) {
    std::printf("%s has no boxes: nothing to do\n", backend.info().name);
    return 0;
  }
  Soak soak(backend, seed);
  double early = 0;
  for (std::uint64_t i = 0; i < steps; ++i) {
    soak.step(i);
    if (i + 1 == steps / 4) early = resident_megabytes();
  }
  const double late = resident_megabytes();
  soak.tell(steps);
  std::printf("%.1f MB after a quarter, %.1f MB at the end\n", early, late);
  if (late - early <= kAllowedGrowth) return 0;
  std::fprintf(stderr, "soak: memory grew by %.1f MB\n", late - early);
  return 1;
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) {
    std::fprintf(stderr, "usage: soak BACKEND STEPS [SEED]\n");
    return 2;
  }
  try {
    return run(words[1], std::strtoull(words[2], nullptr, 10), count > 3 ? std::strtoull(words[3], nullptr, 10) : 1);
  } catch (const plumb::Error& error) {
    std::fprintf(stderr, "soak: %s\n", error.what());
    return 1;
  }
}
