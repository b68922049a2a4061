// A host may call in any rounding and with flushing to zero: every entry of every table gives the same bits, and the
// host finds its mode as it left it.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>
#include <memory>

#include "plugin/decorated_tables.hpp"
#include "plugin/open.hpp"
#include "tests/rigs/engine.hpp"
#include "tests/rigs/host_modes.hpp"

namespace plumb::impulse::test {
namespace {

using modes::kModeBits, modes::kNearest;

/// The host's thread is in this mode while it calls, and in its own while the test computes.
struct HostMode {
  HostMode() : own(simd::control_word()) {
    simd::set_control_word((own & ~kModeBits) | mode);
    ++calls;
  }
  ~HostMode() {
    if ((simd::control_word() & kModeBits) != mode) ++lost;
    simd::set_control_word(own);
  }
  std::uint64_t own;
  static inline std::uint64_t mode = kNearest;
  static inline int calls = 0, lost = 0;
};

PlumbResult open_from_any_mode(const PlumbOpenRequest* request, PlumbOpenReply* reply) {
  const PlumbResult result = open(request, reply);
  if (result >= 0) reply->table = DecoratedTables<HostMode>::of(*reply->table);
  return result;
}

/// FNV-1a over the bits of numbers.
class Digest {
 public:
  void add(std::uint64_t bits) {
    for (int byte = 0; byte < 8; ++byte) value_ = (value_ ^ (bits >> (8 * byte) & 0xff)) * 0x100000001b3U;
  }
  void add(double number) {
    add(std::bit_cast<std::uint64_t>(number == number ? number : std::numeric_limits<double>::quiet_NaN()));
  }
  void add(std::int32_t number) { add(static_cast<std::uint64_t>(number)); }
  void add(const PlumbVec3& v) {
    for (const double x : {v.x, v.y, v.z}) add(x);
  }
  void add(const Hits& hits) {
    for (const PlumbHit& hit : hits.hits) {
      add(hit.body);
      add(hit.fraction);
      add(hit.position);
      add(hit.normal);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

void ask_queries(Scene& scene, Digest& digest) {
  PlumbBodyDesc ball = body_desc();
  const PlumbShape shapes[] = {scene.sphere(0.3), scene.box({0.3, 0.2, 0.1})};
  std::vector<PlumbRay> rays;
  std::vector<PlumbCast> casts;
  std::vector<PlumbOverlap> overlaps;
  for (int i = 0; i < 16; ++i) {
    const PlumbPose pose = {{0.37 * i - 3, 4.1, 0.29 * i - 2}, {0.1, 0.7, 0.1, 0.7}};
    rays.push_back({pose.position, {0.3, -9, 0.1}, ball.filter});
    casts.push_back({shapes[i % 2], pose, {0.3, -9, 0.1}, ball.filter});
    overlaps.push_back({shapes[i % 2], {{pose.position.x, 0.4, pose.position.z}, pose.orientation}, ball.filter});
  }
  IQueries& queries = *scene.world().queries();
  digest.add(queries.cast_rays(PLUMB_HIT_ALL, rays));
  digest.add(queries.cast_shapes(PLUMB_HIT_CLOSEST, casts));
  digest.add(queries.overlap_shapes(overlaps));

  const PlumbPosedPair pair = {
      shapes[0], shapes[1], {{0.1, 0.2, 0.3}, {0, 0, 0, 1}}, {{0.3, 0.4, 0.3}, {0.6, 0, 0, 0.8}}};
  PlumbPairResult result{};
  std::span<const PlumbPairPoint> points;
  check(scene.world(), scene.world().collide()->collide_pairs({&pair, 1}, {&result, 1}, points));
  digest.add(result.distance);
  for (const PlumbPairPoint& point : points) digest.add(point.position);
}

void ask_what_the_engine_sees(Scene& scene, Digest& digest) {
  IDebug& debug = *scene.world().debug();
  std::span<const PlumbDebugBox> boxes;
  std::span<const PlumbDebugAxis> axes;
  check(scene.world(), debug.tree_boxes(boxes));
  for (const PlumbDebugBox& box : boxes) {
    digest.add(box.lower);
    digest.add(box.upper);
  }
  check(scene.world(), debug.separating_axes(axes));
  for (const PlumbDebugAxis& axis : axes) {
    digest.add(axis.axis);
    digest.add(axis.separation);
  }
}

void ask_how_it_solved(Scene& scene, Digest& digest) {
  IDebug& debug = *scene.world().debug();
  std::span<const PlumbDebugPair> pairs;
  std::span<const PlumbDebugBody> bodies;
  std::span<const PlumbDebugConstraint> constraints;
  check(scene.world(), debug.candidate_pairs(pairs));
  for (const PlumbDebugPair& pair : pairs) {
    digest.add(pair.body_a);
    digest.add(pair.body_b);
  }
  check(scene.world(), debug.body_states(bodies));
  for (const PlumbDebugBody& body : bodies) {
    digest.add(body.body);
    digest.add(body.island);
  }
  digest.add(debug.solved_constraints(constraints));  // not every solver has colours
  for (const PlumbDebugConstraint& constraint : constraints) {
    digest.add(constraint.body_a);
    digest.add(constraint.body_b);
    digest.add(constraint.joint);
    digest.add(constraint.colour);
  }
}

template <class T>
void add_numbers(const PlumbDLTensor& tensor, Digest& digest) {
  const auto count = static_cast<std::size_t>(tensor.shape[0] * tensor.shape[1]);
  for (const T x : std::span(static_cast<const T*>(tensor.data), count)) digest.add(static_cast<double>(x));
}

void borrow_rows(Scene& scene, Digest& digest) {
  IState& state = *scene.world().state();
  for (const PlumbField field : {PLUMB_FIELD_POSE, PLUMB_FIELD_VELOCITY}) {
    PlumbDLManagedTensor* tensor = nullptr;
    check(scene.world(), state.borrow({sizeof(PlumbStateRequest), field, 1, 1}, tensor, nullptr));
    const std::unique_ptr<PlumbDLManagedTensor, void (*)(PlumbDLManagedTensor*)> lent(tensor, tensor->deleter);
    if (lent->dl_tensor.dtype.bits == 64)
      add_numbers<double>(lent->dl_tensor, digest);
    else
      add_numbers<float>(lent->dl_tensor, digest);
  }
  std::span<const PlumbBody> rows;
  std::uint64_t generation = 0;
  check(scene.world(), state.row_map(rows, generation));
  for (const PlumbBody body : rows) digest.add(body);
}

/// The first body goes through all others for a while.
void except_pairs(Scene& scene, Digest& digest) {
  IExceptions& exceptions = *scene.world().exceptions();
  const std::span<const PlumbBody> bodies = scene.world().bodies();
  std::vector<PlumbBodyPair> pairs;
  for (const PlumbBody body : bodies.subspan(1)) pairs.push_back({bodies[0], body});
  for (const bool touch : {false, true}) {
    check(scene.world(), exceptions.set_exceptions(pairs, touch));
    std::span<const PlumbBodyPair> listed;
    check(scene.world(), exceptions.list_exceptions(listed));
    for (const PlumbBodyPair& pair : listed) digest.add(pair.body_b);
    scene.run(3);
    digest.add(scene.hash());
  }
}

void read_rows(Scene& scene, Digest& digest) {
  for (const PlumbField field : {PLUMB_FIELD_MASS, PLUMB_FIELD_POSE, PLUMB_FIELD_VELOCITY}) {
    for (const PlumbBody body : scene.world().bodies()) {
      std::vector<double> row(columns_of(field));
      check(scene.world(), scene.world().read(field, {&body, 1},
                                              Rows(reinterpret_cast<std::byte*>(row.data()), 1,
                                                   row.size() * sizeof(double), PLUMB_F64)));
      for (const double x : row) digest.add(x);
    }
  }
}

void read_contacts(Scene& scene, Digest& digest) {
  for (const PlumbContact& contact : scene.world().contacts()) {
    digest.add(contact.position);
    digest.add(contact.normal_impulse);
  }
}

/// The first joint's rows; its motor gets other targets and the scene a few steps with them.
void drive_first_joint(Scene& scene, Digest& digest) {
  IJoints& joints = *scene.world().joints();
  std::array<double, 6> coordinates{}, reaction{};
  std::array<double, 12> motor{};
  const auto row = [](auto& numbers) { return rows_over(std::span(&numbers, 1)); };
  check(scene.world(), joints.read_joints(PLUMB_JOINT_COORDINATES, {}, row(coordinates)));
  check(scene.world(), joints.read_joints(PLUMB_JOINT_REACTION, {}, row(reaction)));
  check(scene.world(), joints.read_joints(PLUMB_JOINT_MOTOR, {}, row(motor)));
  for (const double x : coordinates) digest.add(x);
  for (const double x : reaction) digest.add(x);
  for (double& x : motor) digest.add(x), x *= 0.7;
  // a joint without one says so
  digest.add(
      joints.write_joints(PLUMB_JOINT_MOTOR, {}, const_rows_over(std::span<const std::array<double, 12>>(&motor, 1))));
  scene.run(3);
  digest.add(scene.hash());
}

void ask_settings(Scene& scene, Digest& digest) {
  for (const char* name : {"substeps", "contact_hertz", "threads"}) {
    PlumbSettingValue value{};
    digest.add(scene.world().settings()->get_setting(name, value));
    digest.add(value.number);
  }
}

void read_events(Scene& scene, Digest& digest) {
  for (const PlumbEvent& event : scene.world().events()) {
    digest.add(static_cast<std::int32_t>(event.type));
    digest.add(event.body_a);
    digest.add(event.body_b);
  }
}

/// Everything that a scene says of itself when the host is in this mode.
std::uint64_t digest_of(const NamedScene& recorded, std::uint64_t mode) {
  HostMode::mode = mode;
  const Backend backend(negotiate(&open_from_any_mode, "impulse"));
  NamedScene all = recorded;
  all.needs |= PLUMB_NEED_QUERIES | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES | PLUMB_NEED_SNAPSHOT;
  if ((all.needs & PLUMB_NEED_COLLISION) == 0) all.needs = recorded.needs | PLUMB_NEED_SNAPSHOT;
  all.needs |= PLUMB_NEED_EVENTS;
  const bool jointed = (all.needs & PLUMB_NEED_JOINTS) != 0;
  if (jointed) all.needs |= PLUMB_NEED_JOINT_REACTIONS;
  const std::unique_ptr<Scene> scene = build(backend, all, 1);
  scene->run(15);
  std::span<const std::byte> lent;
  check(scene->world(), scene->world().snapshot()->save(lent));
  const std::vector<std::byte> saved(lent.begin(), lent.end());
  Digest digest;
  digest.add(scene->hash());
  read_rows(*scene, digest);
  if ((all.needs & PLUMB_NEED_CONTACTS) != 0) read_contacts(*scene, digest);
  read_events(*scene, digest);
  ask_settings(*scene, digest);
  if ((all.needs & PLUMB_NEED_QUERIES) != 0) {
    ask_queries(*scene, digest);
    ask_what_the_engine_sees(*scene, digest);
  }
  ask_how_it_solved(*scene, digest);
  borrow_rows(*scene, digest);
  check(scene->world(), scene->world().set_gravity({0.1, -9.7, 0.3}));
  check(scene->world(), scene->world().snapshot()->restore(saved));
  digest.add(scene->hash());
  if (jointed) drive_first_joint(*scene, digest);
  except_pairs(*scene, digest);
  HostMode::mode = kNearest;
  return digest.value();
}

class Rounding : public ::testing::TestWithParam<NamedScene> {};

TEST_P(Rounding, OfTheHostChangesNoBit) {
  HostMode::calls = HostMode::lost = 0;
  const std::uint64_t nearest = digest_of(GetParam(), kNearest);
  EXPECT_GT(HostMode::calls, 20);
  for (const std::uint64_t mode : {modes::kDown, modes::kUp, modes::kToZero, modes::kFlush}) {
    EXPECT_EQ(digest_of(GetParam(), mode), nearest) << "control word " << std::hex << mode;
    EXPECT_EQ(HostMode::lost, 0) << "the host's mode was not put back, control word " << std::hex << mode;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Rounding, ::testing::ValuesIn(named_scenes()), [](const auto& scene) {
  std::string name = scene.param.name;
  for (char& letter : name)
    if (letter == '-') letter = '_';
  return name;
});

}  // namespace
}  // namespace plumb::impulse::test
