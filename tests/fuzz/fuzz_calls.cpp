// Random calls through a backend's table: most make sense, many do not. Nothing may crash, hang or leak; each failure
// has a text; and a world that was given up is replaced. With another backend that promises the same bits: the same
// calls through both, with the same answers and the same state.
//
// usage: fuzz_calls BACKEND CALLS [SEED [OTHER_BACKEND]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "cooked_bytes.hpp"
#include "odd_numbers.hpp"
#include "plumb/loader.hpp"
#include "shape_arrays.hpp"

namespace {

using plumb::fuzz::ShapeArrays;

class Fuzzer : private plumb::fuzz::OddNumbers {
 public:
  Fuzzer(const plumb::Backend& backend, std::uint64_t seed)
      : OddNumbers(seed),
        table_(backend.table()),
        backend_(backend),
        cooking_(static_cast<const PlumbCookingTable*>(table_.extension(PLUMB_EXT_COOKING))) {
    joints_ = static_cast<const PlumbJointsTable*>(table_.extension(PLUMB_EXT_JOINTS));
    queries_ = static_cast<const PlumbQueriesTable*>(table_.extension(PLUMB_EXT_QUERIES));
    settings_ = static_cast<const PlumbSettingsTable*>(table_.extension(PLUMB_EXT_SETTINGS));
    snapshot_ = static_cast<const PlumbSnapshotTable*>(table_.extension(PLUMB_EXT_SNAPSHOT));
    collide_ = static_cast<const PlumbCollideTable*>(table_.extension(PLUMB_EXT_COLLIDE));
    debug_ = static_cast<const PlumbDebugTable*>(table_.extension(PLUMB_EXT_DEBUG));
    exceptions_ = static_cast<const PlumbExceptionsTable*>(table_.extension(PLUMB_EXT_EXCEPTIONS));
    modify_ = static_cast<const PlumbModifyTable*>(table_.extension(PLUMB_EXT_MODIFY));
    manifolds_ = static_cast<const PlumbManifoldsTable*>(table_.extension(PLUMB_EXT_MANIFOLDS));
    state_ = static_cast<const PlumbStateTable*>(table_.extension(PLUMB_EXT_STATE));
    worlds_ = static_cast<const PlumbWorldsTable*>(table_.extension(PLUMB_EXT_WORLDS));
    closest_ = static_cast<const PlumbClosestTable*>(table_.extension(PLUMB_EXT_CLOSEST));
    fresh_world();
  }
  ~Fuzzer() {
    table_.destroy_world(world_);
    table_.destroy_world(companion_);
  }

  /// Makes one call; false when a rule was broken.
  bool call() {
    one_call();
    if (++calls_ % 2000 == 0) fresh_world();
    if (broken_ != nullptr)
      std::fprintf(stderr, "rule broken in call %llu: %s (last error text: %s)\n",
                   static_cast<unsigned long long>(calls_), broken_, table_.error_text(world_));
    return broken_ == nullptr;
  }
  [[nodiscard]] std::uint64_t calls() const { return calls_; }
  /// Of all results so far, and of the state after each step.
  [[nodiscard]] std::uint64_t digest() const { return digest_; }
  [[nodiscard]] std::uint64_t refused() const { return refused_; }
  [[nodiscard]] std::uint64_t done() const { return done_; }
  [[nodiscard]] std::uint64_t worlds_lost() const { return worlds_lost_; }

  /// Which bodies are not where they are in the other's world, and under which settings.
  void tell_difference(const Fuzzer& other) const {
    std::fprintf(stderr, "the last step was of %.9g s\n", last_dt_);
    for (std::uint32_t i = 0; settings_ != nullptr && i < settings_->count; ++i) {
      const PlumbSettingInfo& info = *settings_->describe(i);
      PlumbSettingValue value{};
      if (settings_->get(world_, info.name, &value) < 0) continue;
      if (info.type == PLUMB_SETTING_CHOICE)
        std::fprintf(stderr, "%s = %s\n", info.name, value.choice);
      else
        std::fprintf(stderr, "%s = %g\n", info.name, value.number);
    }
    for (const PlumbBody body : bodies_)
      for (const PlumbField field : {PLUMB_FIELD_POSE, PLUMB_FIELD_VELOCITY}) {
        const std::vector<double> own = row_of(body, field), its = other.row_of(body, field);
        if (std::memcmp(own.data(), its.data(), own.size() * sizeof own[0]) == 0) continue;
        std::fprintf(stderr, "body %llx, %s\n", static_cast<unsigned long long>(body),
                     field == PLUMB_FIELD_POSE ? "pose" : "velocity");
        for (const std::vector<double>* row : {&own, &its}) {
          for (const double number : *row) std::fprintf(stderr, " %.9g", number);
          std::fprintf(stderr, "\n");
        }
      }
  }

 private:
  std::uint64_t handle(const std::vector<std::uint64_t>& pool) {
    if (pool.empty() || chance(25)) return random_() >> below(64);
    return pool[below(static_cast<std::uint32_t>(pool.size()))];
  }
  PlumbFilter filter() {
    return {1u << below(3), chance(3) ? below(8) : ~0u, static_cast<std::int32_t>(below(5)) - 2, 0};
  }

  /// What every result must obey. True when the call was done.
  bool judge(PlumbResult result) {
    if (result < 0) note(static_cast<std::uint64_t>(-static_cast<std::int64_t>(result)));
    if (result < PLUMB_E_DEVICE_LOST || result > PLUMB_COPIED) broken_ = "a result that plumb.h does not name";
    if (result >= 0) return ++done_, true;
    ++refused_;
    if (*table_.error_text(world_) == '\0') broken_ = "a failure without a text";
    if (result == PLUMB_E_WORLD_LOST || result == PLUMB_E_DEVICE_LOST) {
      ++worlds_lost_;
      fresh_world();
    }
    return false;
  }

  void note(std::uint64_t number) { digest_ = (digest_ ^ number) * 0x100000001b3U; }

  void fresh_world() {
    table_.destroy_world(world_);
    world_ = nullptr;
    table_.destroy_world(companion_);
    companion_ = nullptr;
    shapes_.clear();
    surfaces_.clear();
    bodies_.clear();
    joint_ids_.clear();
    PlumbNeeds offered = 0;
    for (std::uint32_t i = 0; i < PLUMB_NEED_COUNT; ++i)
      if (backend_.capability(PLUMB_CAP_NEED, i) != PLUMB_NONE) offered |= PlumbNeeds{1} << i;
    PlumbWorldDesc desc = plumb::world_desc(offered);
    if (chance(2)) desc.needs &= random_() | PLUMB_NEED_SNAPSHOT;
    if (table_.create_world(&desc, &world_) < 0) {
      desc.needs = offered;  // some only go with others
      if (table_.create_world(&desc, &world_) < 0) broken_ = "a plain world cannot be made";
    }
    if (table_.create_world(&desc, &companion_) < 0) broken_ = "a second world cannot be made";
  }

  ShapeArrays shape_of(PlumbShapeType type) {
    ShapeArrays made;
    PlumbShapeDesc& desc = made.desc;
    desc.type = type;
    desc.radius = positive();
    desc.half_height = positive();
    desc.half_extents = {positive(), positive(), positive()};
    made.vertices.resize(3 * (3 + below(12)));
    for (double& v : made.vertices) v = chance(400) ? number() : std::uniform_real_distribution<double>(-1, 1)(random_);
    desc.vertex_count = static_cast<std::uint32_t>(made.vertices.size() / 3);
    made.indices.resize(3 * (1 + below(8)));
    for (std::uint32_t& index : made.indices) index = below(desc.vertex_count + (chance(50) ? 1 : 0));
    desc.triangle_count = static_cast<std::uint32_t>(made.indices.size() / 3);
    made.heights.resize(36);
    for (double& h : made.heights) h = std::uniform_real_distribution<double>(-0.2, 0.2)(random_);
    desc.rows = desc.columns = below(7);
    desc.spacing = {positive(), 0, positive()};
    made.children.resize(below(4));
    for (PlumbCompoundChild& child : made.children)
      child = {handle(shapes_), {vector(), unit()}, chance(4) ? 1u : 0u, 0, {0.5, 0, {0, 0, 0}}};
    desc.child_count = static_cast<std::uint32_t>(made.children.size());
    made.materials.resize(3);
    for (PlumbMaterial& material : made.materials) material = {positive(), chance(4) ? positive() : 0, {0, 0, 0}};
    made.triangle_materials.resize(50);  // as many as a shape has here at most
    for (std::uint32_t& row : made.triangle_materials)
      row = chance(3) ? PLUMB_BODY_MATERIAL : below(chance(1000) ? 4 : 3);
    desc.material_count = chance(3) ? 3 : 0;
    return made;
  }

  void create_shape() {
    ShapeArrays made = shape_of(below(PLUMB_SHAPE_TYPE_COUNT + 1));
    PlumbShapeDesc desc = *made.pointing();
    if (chance(40)) desc.vertices = nullptr;
    if (chance(60)) desc.struct_size = below(500);
    PlumbShape id = 0;
    const PlumbShapeDesc* given = chance(200) ? nullptr : &desc;
    const bool cooks = table_.extension(PLUMB_EXT_COOKING) != nullptr && chance(3);
    if (const std::string_view problem = cooks ? cooking_.cook(given, random_) : ""; !problem.empty()) {
      if (problem != "refused") broken_ = problem.data();
      return;
    }
    if (!judge(cooks ? cooking_.create(world_, &id) : table_.create_shapes(world_, given, sizeof desc, 1, &id))) return;
    shapes_.push_back(id);
    if (desc.type == PLUMB_TRIANGLE_MESH || desc.type == PLUMB_HEIGHT_FIELD)
      surfaces_.emplace_back(id, std::move(made));
  }

  /// A surface becomes another, or bends where it was.
  void modify_shape() {
    if (modify_ == nullptr || surfaces_.empty()) return;
    auto& [known, before] = surfaces_[below(static_cast<std::uint32_t>(surfaces_.size()))];
    ShapeArrays other = before;
    if (chance(4)) {
      other = shape_of(before.desc.type);
    } else {
      for (std::vector<double>* places : {&other.vertices, &other.heights})
        for (double& x : *places)
          if (chance(3)) x += std::uniform_real_distribution<double>(-0.1, 0.1)(random_);
    }
    const PlumbShape id = chance(20) ? handle(shapes_) : known;
    if (judge(modify_->shapes(world_, chance(60) ? nullptr : &id, other.pointing(), chance(60) ? 8 : sizeof other.desc,
                              1)) &&
        id == known)
      before = std::move(other);
  }

  void create_bodies() {
    PlumbBodyDesc descs[3];
    const std::uint32_t count = 1 + below(3);
    for (PlumbBodyDesc& desc : descs) {
      desc = plumb::body_desc(below(PLUMB_MOTION_COUNT + (chance(40) ? 1 : 0)));
      desc.shape = chance(6) ? 0 : handle(shapes_);
      desc.pose = pose();
      if (desc.motion != PLUMB_STATIC && chance(2)) desc.linear_velocity = vector();
      desc.flags = chance(4) ? below(70) : 0;
      desc.locks = chance(8) ? below(64) : 0;
      desc.mass_mode = below(3 + (chance(40) ? 1 : 0));
      desc.mass = positive();
      desc.density = 100 * positive();
      desc.inertia = {positive(), positive(), positive()};
      desc.material = {positive(), chance(4) ? positive() : 0, {0, 0, 0}};
      desc.linear_damping = chance(5) ? positive() : 0;
      desc.rolling_friction = chance(4) ? positive() : 0;
      desc.spinning_friction = chance(4) ? positive() : 0;
      if (chance(5)) desc.filter = filter();
    }
    PlumbBody ids[3];
    if (judge(table_.create_bodies(world_, descs, chance(100) ? 8 : sizeof(PlumbBodyDesc), count, ids)))
      bodies_.insert(bodies_.end(), ids, ids + count);
  }

  PlumbSpring spring() {
    return {0, positive(), positive(), chance(8) ? 1u : 0u,
            chance(3) ? PLUMB_SPRING_STIFFNESS : PLUMB_SPRING_FREQUENCY};
  }

  void give_cone(PlumbJointDesc& desc) {
    for (std::size_t axis = 4; axis < 6; ++axis) {
      const double half = std::clamp(positive(), 0.01, 3.1);
      desc.limits[axis] = {-half, half, desc.limits[4].enabled, 0};
    }
  }

  /// A gear or a rack, with nothing on its axes.
  void mesh(PlumbJointDesc& desc) {
    desc.type = chance(2) ? PLUMB_JOINT_GEAR : PLUMB_JOINT_RACK_AND_PINION;
    for (std::size_t axis = 0; axis < 6; ++axis)
      desc.limits[axis].enabled = desc.motors[axis].enabled = desc.springs[axis].enabled = 0;
    desc.ratio = chance(8) ? number() : 1 + positive();
  }
  void create_joint() {
    if (joints_ == nullptr) return;
    PlumbJointDesc desc = plumb::joint_desc(below(PLUMB_JOINT_TYPE_COUNT));
    desc.body_a = chance(3) ? 0 : handle(bodies_);
    desc.body_b = handle(bodies_);
    desc.frame_a = {vector(), unit()};
    desc.frame_b = {vector(), unit()};
    desc.collide_connected = below(2);
    for (std::size_t axis = 0; axis < 6; ++axis) {
      desc.axis_modes[axis] = below(3);
      desc.limits[axis] = {-positive(), positive(), chance(4) ? 1u : 0u, 0};
      desc.motors[axis] = {number(), positive(), chance(6) ? 1u : 0u, 0};
      desc.springs[axis] = spring();
    }
    if (desc.type == PLUMB_JOINT_SWING_TWIST && !chance(8)) give_cone(desc);
    if (chance(3)) mesh(desc);
    desc.rest_length = positive();
    desc.break_force = chance(4) ? 1000 * positive() : 0;
    PlumbJoint id = 0;
    if (judge(joints_->create(world_, &desc, sizeof desc, 1, &id))) joint_ids_.push_back(id);
  }

  void write_row() {
    const PlumbField field = below(PLUMB_FIELD_COUNT + (chance(30) ? 5 : 0));
    double row[12];
    for (double& value : row) value = number();
    if (field == PLUMB_FIELD_POSE || field == PLUMB_FIELD_KINEMATIC_TARGET) {
      const PlumbQuat q = unit();
      row[3] = q.x, row[4] = q.y, row[5] = q.z, row[6] = q.w;
    }
    const PlumbBody id = handle(bodies_);
    judge(table_.write(world_, field, PLUMB_F64, &id, 1, chance(100) ? nullptr : row, chance(50) ? 3 : sizeof row));
    const PlumbJoint joint = handle(joint_ids_);
    for (int axis = 0; axis < 6; ++axis) row[2 * axis + 1] = std::abs(row[2 * axis + 1]);  // forces of motors
    if (joints_ != nullptr && chance(3))
      judge(joints_->write(world_, PLUMB_JOINT_MOTOR + below(2), PLUMB_F64, &joint, 1, row, sizeof row));
  }

  void read_rows() {
    std::vector<double> rows(12 * 80);
    const PlumbBody id = handle(bodies_);
    const bool all = chance(2);
    const auto count = all ? std::min<std::uint32_t>(static_cast<std::uint32_t>(bodies_.size()), 80) : 1;
    judge(table_.read(world_, below(PLUMB_FIELD_COUNT), 1 + below(2 + (chance(40) ? 1 : 0)), all ? nullptr : &id, count,
                      rows.data(), 12 * sizeof(double)));
  }

  void outputs() {
    PlumbContact contacts[8];
    PlumbEvent events[8];
    PlumbBody ids[8];
    std::uint32_t count = 0;
    std::uint64_t value = 0;
    judge(table_.contacts(world_, contacts, sizeof contacts[0], below(9), &count));
    judge(table_.events(world_, events, sizeof events[0], below(9), &count));
    judge(table_.list_bodies(world_, ids, below(9), &count));
    judge(table_.user_data(world_, handle(bodies_), &value));
    if (snapshot_ != nullptr) judge(snapshot_->hash(world_, &value));
    if (debug_ != nullptr) {
      PlumbDebugPair pairs[8];
      PlumbDebugBox boxes[8];
      PlumbDebugAxis axes[8];
      PlumbDebugBody states[8];
      PlumbDebugConstraint constraints[8];
      judge(debug_->pairs(world_, pairs, below(9), &count));
      judge(debug_->boxes(world_, boxes, below(9), &count));
      judge(debug_->axes(world_, axes, below(9), &count));
      if (plumb::has(*debug_, &PlumbDebugTable::bodies)) judge(debug_->bodies(world_, states, below(9), &count));
      if (plumb::has(*debug_, &PlumbDebugTable::constraints))
        judge(debug_->constraints(world_, constraints, below(9), &count));
    }
  }

  void query() {
    if (queries_ == nullptr) return;
    PlumbHit hits[16];
    std::uint32_t count = 0;
    const PlumbRay rays[2] = {{vector(), vector(), filter()}, {vector(), vector(), filter()}};
    const PlumbCast cast = {handle(shapes_), pose(), vector(), filter()};
    const PlumbOverlap overlap = {handle(shapes_), pose(), filter()};
    judge(queries_->rays(world_, below(2), rays, sizeof rays[0], 2, hits, below(17), &count));
    judge(queries_->casts(world_, below(2), &cast, sizeof cast, 1, hits, below(17), &count));
    judge(queries_->overlaps(world_, &overlap, sizeof overlap, 1, hits, below(17), &count));
    const PlumbTurningCast turning = {handle(shapes_), pose(), vector(), vector(), filter()};
    judge(queries_->turning_casts(world_, below(2), &turning, sizeof turning, 1, hits, below(17), &count));
    PlumbPenetration penetrations[16];
    judge(queries_->penetrations(world_, &overlap, sizeof overlap, 1, penetrations, below(17), &count));
    if (closest_ != nullptr) {
      PlumbProbe probes[2] = {};
      for (PlumbProbe& probe : probes)
        probe = {handle(shapes_), pose(), chance(2) ? 10 * positive() : positive(), filter()};
      PlumbClosest rows[16];
      judge(closest_->bodies(world_, below(2), probes, sizeof probes[0], 2, rows, below(17), &count));
    }
    if (collide_ != nullptr) {
      const PlumbPosedPair pair = {handle(shapes_), handle(shapes_), pose(), pose()};
      PlumbPairResult result{};
      PlumbPairPoint points[8];
      judge(collide_->pairs(world_, &pair, sizeof pair, 1, &result, points, below(9), &count));
    }
  }

  void change_setting() {
    if (settings_ == nullptr || settings_->count == 0) return;
    const PlumbSettingInfo& info = *settings_->describe(below(settings_->count));
    PlumbSettingValue value = info.default_value;
    if (info.type == PLUMB_SETTING_CHOICE && info.choice_count != 0)
      value.choice = chance(20) ? "nonsense" : info.choices[below(info.choice_count)];
    if (info.type != PLUMB_SETTING_CHOICE && chance(10)) value.number = number();
    judge(settings_->set(world_, chance(50) ? "no_such_setting" : info.name, &value));
  }

  void save_and_restore() {
    if (snapshot_ == nullptr) return;
    std::vector<std::byte> data(4096);
    std::size_t size = 0;
    const auto save = chance(50) ? snapshot_->save_world : snapshot_->save;
    PlumbResult result = save(world_, data.data(), data.size(), &size);
    if (result == PLUMB_TRUNCATED) {
      data.resize(size);
      result = save(world_, data.data(), data.size(), &size);
    }
    if (!judge(result)) return;
    if (chance(2)) data[below(static_cast<std::uint32_t>(size))] ^= std::byte{0x40};
    judge(snapshot_->restore(world_, data.data(), chance(4) ? size / 2 : size));
  }

  void borrow() {
    if (state_ == nullptr) return;
    const PlumbStateRequest request = {sizeof request, below(3), 1 + static_cast<std::int32_t>(below(2)), below(2)};
    PlumbDLManagedTensor* tensor = nullptr;
    const std::uint64_t digest = digest_;  // where the rows are lent is each backend's own affair
    if (judge(state_->borrow(world_, &request, &tensor, nullptr))) tensor->deleter(tensor);
    digest_ = digest;
  }

  /// With a world in which nothing is, which takes part in some steps.
  void group() {
    if (worlds_ == nullptr) return;
    PlumbWorld* const others[2] = {chance(20) ? nullptr : companion_, chance(2) ? world_ : companion_};
    judge(worlds_->group(world_, chance(60) ? nullptr : others, chance(20) ? 2 : chance(4) ? 0 : 1));
    const PlumbStateRequest request = {sizeof request, below(3), 1 + static_cast<std::int32_t>(below(2)), below(2)};
    PlumbDLManagedTensor* tensor = nullptr;
    const std::uint64_t digest = digest_;
    if (judge(worlds_->borrow_all(world_, &request, &tensor, nullptr))) tensor->deleter(tensor);
    digest_ = digest;
  }

  void except() {
    if (exceptions_ == nullptr) return;
    PlumbBodyPair pairs[3];
    for (PlumbBodyPair& pair : pairs) pair = {handle(bodies_), handle(bodies_)};
    judge(exceptions_->set(world_, chance(60) ? nullptr : pairs, chance(60) ? 8 : sizeof pairs[0], below(4),
                           chance(30) ? below(9) : below(2)));
    std::uint32_t count = 0;
    if (!judge(exceptions_->list(world_, pairs, below(4), &count))) return;
    if (count > bodies_.size() * bodies_.size()) broken_ = "more pair exceptions than pairs";
  }

  void modify_bodies() {
    if (modify_ == nullptr) return;
    PlumbBodyChange changes[2];
    for (PlumbBodyChange& change : changes) {
      change = plumb::body_change(handle(bodies_));
      change.what = chance(30) ? below(200) : 1u << below(PLUMB_MODIFY_BODY_COUNT);
      if (chance(2)) change.what |= PLUMB_MODIFY_MASS;
      change.motion = below(PLUMB_MOTION_COUNT + (chance(40) ? 1 : 0));
      change.flags = chance(2) ? below(70) : 0;
      change.locks = below(64);
      change.shape = chance(6) ? 0 : handle(shapes_);
      change.mass_mode = below(3);
      change.density = 100 * positive();
      change.mass = positive();
      change.centre_of_mass = chance(3) ? vector() : PlumbVec3{0, 0, 0};
      change.inertia = {positive(), positive(), positive()};
      change.inertia_orientation = unit();
    }
    judge(modify_->bodies(world_, chance(60) ? nullptr : changes, chance(60) ? 8 : sizeof changes[0], 1 + below(2)));
  }

  void modify_joint() {
    if (modify_ == nullptr) return;
    PlumbJointChange change = plumb::joint_change(handle(joint_ids_));
    change.what = chance(30) ? below(600) : 1u << below(PLUMB_MODIFY_JOINT_COUNT);
    change.enabled = below(2);
    change.collide_connected = below(2);
    change.frame_a = {vector(), unit()};
    change.frame_b = {vector(), unit()};
    for (std::size_t axis = 0; axis < 6; ++axis) {
      change.axis_modes[axis] = below(3);
      change.limits[axis] = {-positive(), positive(), chance(4) ? 1u : 0u, 0};
      change.motors[axis] = {number(), positive(), chance(6) ? 1u : 0u, 0};
      change.springs[axis] = spring();
    }
    change.rest_length = positive();
    change.break_force = chance(4) ? 1000 * positive() : 0;
    judge(modify_->joints(world_, &change, sizeof change, 1));
  }

  void destroy_some() {
    const PlumbBody body = handle(bodies_);
    const PlumbShape shape = handle(shapes_);
    if (joints_ != nullptr && chance(2)) {
      const PlumbJoint joint = handle(joint_ids_);
      if (judge(joints_->destroy(world_, &joint, 1))) std::erase(joint_ids_, joint);
    }
    if (judge(table_.destroy_bodies(world_, &body, 1))) std::erase(bodies_, body);
    if (chance(3) && judge(table_.destroy_shapes(world_, &shape, 1))) std::erase(shapes_, shape);
  }

  void step() {
    constexpr double usual[] = {1.0 / 60, 1.0 / 60, 1.0 / 30, 1.0 / 240};
    const PlumbStepDesc desc = {sizeof desc, 0, chance(50) ? number() : usual[below(std::size(usual))]};
    last_dt_ = desc.dt;
    PlumbStepReport report{};
    report.struct_size = chance(20) ? below(sizeof report) : sizeof report;
    const PlumbStepDesc own = {sizeof own, 0, 1.0 / 60};
    const std::uint64_t lost = worlds_lost_;  // with one goes the other
    const bool together = chance(2) && table_.step(companion_, &own) >= 0;
    if (judge(table_.step(world_, chance(200) ? nullptr : &desc))) {
      if (chance(100)) judge(table_.step(world_, &desc));  // one is under way
      if (chance(2)) modify_manifolds();
      judge(table_.wait(world_, &report));
      note_state();
    }
    if (together && worlds_lost_ == lost && table_.wait(companion_, nullptr) < 0)
      broken_ = "an empty world cannot be stepped";
    if (chance(100)) judge(table_.wait(world_, &report));  // none is
  }

  /// Of 8 numbers, and what there is not is 0.
  [[nodiscard]] std::vector<double> row_of(PlumbBody body, PlumbField field) const {
    std::vector<double> row(8);
    table_.read(world_, field, PLUMB_F64, &body, 1, row.data(), row.size() * sizeof row[0]);
    return row;
  }

  void note_state() {
    std::uint64_t hash = 0;
    if (snapshot_ != nullptr && snapshot_->hash(world_, &hash) >= 0) note(hash);
  }

  void modify_manifolds() {
    if (manifolds_ == nullptr) return;
    std::uint32_t count = 0;
    for (std::uint32_t round = below(6); round != 0; --round) {
      PlumbManifold rows[8];
      const std::uint32_t capacity = below(9);
      const bool whole = !chance(60);
      if (!judge(manifolds_->read(world_, chance(60) ? nullptr : rows, whole ? sizeof rows[0] : 8, capacity, &count)))
        continue;
      for (std::uint32_t row = 0; whole && row < std::min(capacity, count); ++row)
        if (rows[row].point_count == 0 || rows[row].point_count > PLUMB_MANIFOLD_POINTS)
          broken_ = "a manifold without points";
      PlumbManifoldChange changes[3];
      for (PlumbManifoldChange& change : changes) {
        change = plumb::manifold_change(below(count + 1));
        change.what = chance(30) ? below(40) : 1u << below(PLUMB_MANIFOLD_CHANGE_COUNT);
        change.friction = chance(20) ? number() : positive();
        change.restitution = chance(20) ? number() : 0.5;
        change.surface_velocity = vector();
      }
      judge(manifolds_->modify(world_, chance(60) ? nullptr : changes, chance(60) ? 8 : sizeof changes[0], below(3)));
    }
  }

  void one_call() {
    const bool full = bodies_.size() > 40;
    switch (below(20)) {
      case 0: return shapes_.size() < 30 ? create_shape() : destroy_some();
      case 1:
      case 2: return full ? destroy_some() : create_bodies();
      case 3: return joint_ids_.size() < 20 ? create_joint() : destroy_some();
      case 4:
      case 5: return write_row();
      case 6: return read_rows();
      case 7: return outputs();
      case 8: return query();
      case 9: return change_setting();
      case 10: return chance(10) ? save_and_restore() : step();
      case 11: return borrow();
      case 12: return destroy_some();
      case 13: return except();
      case 14:
      case 15: return chance(3) ? modify_shape() : chance(2) ? modify_bodies() : modify_joint();
      case 16: return chance(10) ? group() : step();
      default: return step();
    }
  }

  const PlumbBackendTable& table_;
  const plumb::Backend& backend_;
  PlumbWorld *world_ = nullptr, *companion_ = nullptr;
  const PlumbJointsTable* joints_ = nullptr;
  const PlumbQueriesTable* queries_ = nullptr;
  const PlumbSettingsTable* settings_ = nullptr;
  const PlumbSnapshotTable* snapshot_ = nullptr;
  const PlumbCollideTable* collide_ = nullptr;
  const PlumbDebugTable* debug_ = nullptr;
  const PlumbStateTable* state_ = nullptr;
  const PlumbExceptionsTable* exceptions_ = nullptr;
  const PlumbModifyTable* modify_ = nullptr;
  const PlumbManifoldsTable* manifolds_ = nullptr;
  const PlumbWorldsTable* worlds_ = nullptr;
  const PlumbClosestTable* closest_ = nullptr;
  plumb::fuzz::CookedBytes cooking_;
  std::vector<std::uint64_t> shapes_, bodies_, joint_ids_;
  std::vector<std::pair<PlumbShape, ShapeArrays>> surfaces_;  ///< with what they are; some are gone
  double last_dt_ = 0;
  std::uint64_t calls_ = 0, digest_ = 0xcbf29ce484222325U, refused_ = 0, done_ = 0, worlds_lost_ = 0;
  const char* broken_ = nullptr;
};

/// Makes that many calls, of two backends in step with each other.
bool run(std::uint64_t calls, Fuzzer& fuzzer, Fuzzer* other) {
  for (std::uint64_t i = 0; i < calls; ++i) {
    if (!fuzzer.call() || (other != nullptr && !other->call())) return false;
    if (other == nullptr || fuzzer.digest() == other->digest()) continue;
    std::fprintf(stderr, "after call %llu the two backends differ\n", static_cast<unsigned long long>(fuzzer.calls()));
    fuzzer.tell_difference(*other);
    return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: fuzz_calls BACKEND CALLS [SEED [OTHER_BACKEND]]\n");
    return 2;
  }
  try {
    const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
    const plumb::Backend backend = plumb::open_backend(argv[1]);
    Fuzzer fuzzer(backend, seed);
    std::optional<plumb::Backend> other_backend;
    std::optional<Fuzzer> other;
    if (argc > 4) {
      other_backend.emplace(plumb::open_backend(argv[4]));
      other.emplace(*other_backend, seed);
    }
    const bool kept = run(std::strtoull(argv[2], nullptr, 10), fuzzer, other ? &*other : nullptr);
    std::printf("%llu calls done, %llu refused, %llu worlds lost\n", static_cast<unsigned long long>(fuzzer.done()),
                static_cast<unsigned long long>(fuzzer.refused()),
                static_cast<unsigned long long>(fuzzer.worlds_lost()));
    return kept ? 0 : 1;
  } catch (const plumb::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
