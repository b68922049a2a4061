#include "simulation/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/median.hpp"
#include "plumb/assert.hpp"
#include "plumb/backend/small_math.hpp"
#include "referee/hash.hpp"
#include "simulation/host.hpp"
#include "simulation/part_refused.hpp"
#include "simulation/support.hpp"

namespace plumb::harness {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

struct MassRow {
  double mass;
  PlumbVec3 centre_of_mass, inertia;
  PlumbQuat inertia_orientation;
};

bool is_finite(const PoseRow& row) {
  const auto& [p, q] = row;
  return std::isfinite(p.x + p.y + p.z + q.x + q.y + q.z + q.w);
}

}  // namespace

struct Simulation::State {
  Scene scene;
  SimulationOptions options;
  std::unique_ptr<Host> host;
  std::unique_ptr<IPhysicsWorld> world;
  std::vector<PlumbShape> shapes;
  std::vector<PlumbBody> bodies;
  std::vector<PlumbJoint> joints;
  std::uint64_t steps_total = 0;
  std::uint64_t steps = 0;
  std::vector<PoseRow> poses;
  std::vector<VelocityRow> velocities;
  bool velocities_fresh = false;
  std::vector<MassRow> masses;
  bool finite = true;
  PlumbStepReport report{};
  StepStatistics statistics;
  Clock::time_point step_start;
  std::array<std::vector<double>, PLUMB_PHASE_COUNT> phases;

  void create_shapes();
  void create_bodies();
  void create_joints();
  void read_poses();
  void take_stock();
};

void Simulation::State::create_shapes() {
  shapes.resize(scene.shapes.size());
  // Compounds name the handles of their children, so the others come first, in one batch.
  std::vector<PlumbShapeDesc> descs;
  std::vector<std::size_t> simple;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    if (scene.shapes[i].desc.type == PLUMB_COMPOUND) continue;
    descs.push_back(scene.shapes[i].descriptor());
    simple.push_back(i);
  }
  std::vector<PlumbShape> handles(descs.size());
  naming_parts(
      "shapes", [&](std::size_t k) { return scene.shapes.at(simple.at(k)).name; },
      [&] {
        if (!descs.empty()) check(*world, world->create_shapes(descs, handles));
      });
  for (std::size_t k = 0; k < simple.size(); ++k) shapes[simple[k]] = handles[k];

  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const SceneShape& shape = scene.shapes[i];
    if (shape.desc.type != PLUMB_COMPOUND) continue;
    std::vector<PlumbCompoundChild> children;
    for (const SceneShape::Child& child : shape.children) {
      PlumbCompoundChild row{};
      row.shape = shapes.at(child.shape);
      PLUMB_ASSERT(row.shape != 0);  // made before it, as a compound is no child
      row.pose = child.pose;
      row.has_material = child.material ? 1 : 0;
      if (child.material) row.material = *child.material;
      children.push_back(row);
    }
    PlumbShapeDesc desc = shape.descriptor();
    desc.children = children.data();
    desc.child_count = static_cast<std::uint32_t>(children.size());
    naming_parts(
        "shapes", [&](std::size_t) { return shape.name; },
        [&] { check(*world, world->create_shapes(std::span(&desc, 1), std::span(&shapes[i], 1))); });
  }
}

void Simulation::State::create_bodies() {
  std::vector<PlumbBodyDesc> descs;
  descs.reserve(scene.bodies.size());
  for (const SceneBody& body : scene.bodies) {
    descs.push_back(body.desc);
    descs.back().shape = body.shape ? shapes.at(*body.shape) : 0;
  }
  bodies.resize(descs.size());
  naming_parts(
      "bodies", [&](std::size_t i) { return scene.bodies.at(i).name; },
      [&] {
        if (!descs.empty()) check(*world, world->create_bodies(descs, bodies));
      });
}

void Simulation::State::create_joints() {
  if (scene.joints.empty()) return;
  IJoints* extension = world->joints();
  if (extension == nullptr) throw Error(PLUMB_E_UNSUPPORTED, "joints");
  std::vector<PlumbJointDesc> descs;
  descs.reserve(scene.joints.size());
  for (const SceneJoint& joint : scene.joints) {
    descs.push_back(joint.desc);
    descs.back().body_a = joint.body_a ? bodies.at(*joint.body_a) : 0;
    descs.back().body_b = bodies.at(joint.body_b);
  }
  joints.resize(descs.size());
  naming_parts(
      "joints", [&](std::size_t i) { return scene.joints.at(i).name; },
      [&] { check(*world, extension->create_joints(descs, joints)); });
}

void Simulation::State::read_poses() {
  if (!poses.empty()) check(*world, world->read(PLUMB_FIELD_POSE, {}, rows_over(std::span(poses))));
}

// What the step's report and poses say, added to the statistics.
void Simulation::State::take_stock() {
  const auto lost = static_cast<std::uint32_t>(
      std::count_if(poses.begin(), poses.end(), [](const PoseRow& row) { return !is_finite(row); }));
  finite = finite && lost == 0;
  statistics.nonfinite = std::max({statistics.nonfinite, lost, report.nonfinite});
  statistics.contacts_max = std::max(statistics.contacts_max, report.contacts);
  statistics.dropped += report.dropped;
  if ((report.remarks & PLUMB_REMARK_SOLVER_FELL_BACK) != 0) ++statistics.solver_fallbacks;
  if ((report.remarks & PLUMB_REMARK_ENERGY_BOUNDED) != 0) ++statistics.energy_bounded;
  if ((report.remarks & PLUMB_REMARK_STEP_REPEATED) != 0) ++statistics.steps_repeated;
  for (std::size_t phase = 0; phase < phases.size(); ++phase) {
    if (std::isfinite(report.phase_seconds[phase])) phases[phase].push_back(1e3 * report.phase_seconds[phase]);
  }
}

Simulation::Simulation(Backend& backend, const Scene& scene, const SimulationOptions& options)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.scene = scene;
  s.options = options;
  s.host = std::make_unique<Host>(s.scene);
  if (const std::string lacking = missing_support(backend, scene); !lacking.empty())
    throw Error(PLUMB_E_UNSUPPORTED, lacking);
  s.steps_total = static_cast<std::uint64_t>(std::max(0.0, std::ceil(scene.seconds / scene.dt - 1e-6)));

  std::vector<PlumbSetting> settings;
  for (const auto& [name, value] : options.settings) settings.push_back({name.c_str(), value});
  PlumbWorldDesc desc = world_desc(scene.needs | (options.needs_all ? needs_of(backend) : 0));
  desc.threads = options.threads;
  desc.gravity = scene.gravity;
  desc.body_capacity = static_cast<std::uint32_t>(scene.bodies.size());
  desc.joint_capacity = static_cast<std::uint32_t>(scene.joints.size());
  desc.settings = settings.data();
  desc.setting_count = static_cast<std::uint32_t>(settings.size());

  {
    const EngineAtWork at_work(options.clock);
    const auto start = Clock::now();
    s.world = backend.create_world(desc);
    s.create_shapes();
    s.create_bodies();
    s.create_joints();
    s.statistics.setup_ms = milliseconds_since(start);
    PLUMB_ASSERT(s.bodies.size() == scene.bodies.size() && s.joints.size() == scene.joints.size());
    s.poses.resize(s.bodies.size());
    s.read_poses();
  }
  s.velocities.resize(s.bodies.size());
  s.statistics.step_ms.reserve(s.steps_total);
  std::fill(std::begin(s.report.phase_seconds), std::end(s.report.phase_seconds), not_known);
  s.take_stock();
  if (s.options.observer) s.options.observer->started(*this);
}

Simulation::Simulation(Simulation&&) noexcept = default;

Simulation::~Simulation() {
  if (!state_) return;
  if (state_->options.observer) state_->options.observer->ended(*this);
  const EngineAtWork at_work(state_->options.clock);
  state_->world.reset();
}

const Scene& Simulation::scene() const { return state_->scene; }
IPhysicsWorld& Simulation::world() {
  if (state_->options.clock != nullptr) state_->options.clock->engine();
  return *state_->world;
}
PlumbBody Simulation::handle(std::size_t body) const { return state_->bodies.at(body); }
PlumbJoint Simulation::joint_handle(std::size_t joint) const { return state_->joints.at(joint); }

bool Simulation::begin_step() {
  State& s = *state_;
  if (s.steps >= s.steps_total) return false;
  PLUMB_ASSERT(s.statistics.step_ms.size() == s.steps);
  const EngineAtWork at_work(s.options.clock);
  s.host->before_step(*this);
  s.step_start = Clock::now();
  check(*s.world, s.world->step(s.scene.dt));
  return true;
}

void Simulation::finish_step() {
  State& s = *state_;
  PlumbStepReport report{};
  report.struct_size = sizeof(report);
  {
    const EngineAtWork at_work(s.options.clock);
    check(*s.world, s.world->wait(report));
    s.read_poses();
    s.statistics.step_ms.push_back(milliseconds_since(s.step_start));
  }
  s.report = report;
  ++s.steps;
  s.velocities_fresh = false;
  s.take_stock();
  if (s.options.observer) s.options.observer->stepped(*this);
}

bool Simulation::advance() {
  if (!begin_step()) return false;
  finish_step();
  return true;
}

void Simulation::run(const std::function<void(Simulation&)>& observe) {
  while (advance()) {
    if (observe) observe(*this);
  }
}

double Simulation::time() const { return static_cast<double>(state_->steps) * state_->scene.dt; }
std::uint64_t Simulation::steps() const { return state_->steps; }
std::span<const PoseRow> Simulation::poses() const { return state_->poses; }

std::span<const VelocityRow> Simulation::velocities() {
  State& s = *state_;
  if (!s.velocities_fresh && !s.velocities.empty()) {
    const EngineAtWork at_work(s.options.clock);
    check(*s.world, s.world->read(PLUMB_FIELD_VELOCITY, {}, rows_over(std::span(s.velocities))));
    s.velocities_fresh = true;
  }
  return s.velocities;
}

std::span<const PlumbContact> Simulation::contacts() {
  if ((state_->scene.needs & (PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES)) == 0)
    throw Error(PLUMB_E_NOT_DECLARED, "scene " + state_->scene.id + " reads contacts without the need \"contacts\"");
  const EngineAtWork at_work(state_->options.clock);
  return state_->world->contacts();
}

std::span<const PlumbEvent> Simulation::events() {
  const EngineAtWork at_work(state_->options.clock);
  return state_->world->events();
}
const PlumbStepReport& Simulation::report() const { return state_->report; }

PlumbVec3 Simulation::centre_of_mass(std::size_t body) const {
  State& s = *state_;
  if (s.masses.empty()) {
    const EngineAtWork at_work(s.options.clock);
    s.masses.resize(s.bodies.size());
    check(*s.world, s.world->read(PLUMB_FIELD_MASS, {}, rows_over(std::span(s.masses))));
  }
  const PoseRow& pose = s.poses.at(body);
  const PlumbVec3& local = s.masses.at(body).centre_of_mass;
  return backend::add(pose.position, backend::multiply(backend::rotation_matrix(pose.orientation), local));
}

bool Simulation::finite() const { return state_->finite; }

void Simulation::write(PlumbField field, std::size_t body, std::span<const double> row) {
  State& s = *state_;
  if (row.size() != columns_of(field))
    throw std::logic_error("a row of field " + std::to_string(field) + " has " + std::to_string(columns_of(field)) +
                           " numbers, not " + std::to_string(row.size()));
  const PlumbBody id = handle(body);
  const ConstRows rows(reinterpret_cast<const std::byte*>(row.data()), 1, row.size_bytes(), PLUMB_F64);
  const EngineAtWork at_work(s.options.clock);
  naming_parts(
      "bodies", [&](std::size_t) { return s.scene.bodies.at(body).name; },
      [&] { check(*s.world, s.world->write(field, std::span(&id, 1), rows)); });
  s.velocities_fresh = false;
  if (field == PLUMB_FIELD_POSE) s.read_poses();
}

void Simulation::set_gravity(const PlumbVec3& gravity) {
  const EngineAtWork at_work(state_->options.clock);
  check(*state_->world, state_->world->set_gravity(gravity));
}

const StepStatistics& Simulation::statistics() const {
  State& s = *state_;
  s.statistics.phase_ms.clear();
  for (const std::vector<double>& phase : s.phases) s.statistics.phase_ms.push_back(median(phase));
  return s.statistics;
}

std::uint64_t Simulation::state_hash() {
  static_cast<void>(velocities());  // as of now
  return referee::state_hash<PoseRow, VelocityRow>(state_->poses, state_->velocities);
}

}  // namespace plumb::harness
