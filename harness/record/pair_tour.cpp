#include "record/pair_tour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "measure/instruments/mechanics.hpp"
#include "record/pair_shapes.hpp"
#include "record/trajectory.hpp"
#include "record/trajectory_header.hpp"
#include "referee/penetration.hpp"
#include "simulation/support.hpp"

namespace plumb::harness {

namespace {

constexpr std::size_t frames = 300;
constexpr double frames_a_second = 30;
constexpr double turn = 2 * std::numbers::pi;
constexpr auto unanswered = std::numeric_limits<double>::quiet_NaN();

const std::vector<LayerSpec> tour_layers{
    {"answers",
     LayerRows::one,
     {{"distance", "f32"}, {"true_distance", "f32"}, {"depth_error", "f32"}, {"contacts", "u32"}}},
    {"penetration", LayerRows::moving, {{"penetration", "f32"}}},
    {"contacts",
     LayerRows::list,
     {{"body_a", "u32"},
      {"body_b", "u32"},
      {"point", "f32", 3},
      {"normal", "f32", 3},
      {"depth", "f32"},
      {"id", "u32"}}},
    {"axes", LayerRows::list, {{"body_a", "u32"}, {"body_b", "u32"}, {"axis", "f32", 3}, {"separation", "f32"}}}};

/// What somebody says of one pose.
struct PairAnswer {
  double distance = unanswered;  ///< m, negative: overlap
  std::vector<PlumbPairPoint> points;
  std::optional<PlumbPairPoint> axis;
};

PlumbQuat about(double x, double y, double z, double angle) {
  return {x * std::sin(angle / 2), y * std::sin(angle / 2), z * std::sin(angle / 2), std::cos(angle / 2)};
}
PlumbQuat product(const PlumbQuat& a, const PlumbQuat& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

// Around what moves on a spiral from pole to pole; over what lies there on a rosette. Six times into it and out again.
PlumbPose pose_at(double share, const KindOfShape& a, const KindOfShape& b) {
  const double wave = std::cos(6 * turn * share);
  const double touch = a.reach + b.reach;
  const PlumbQuat orientation = product(about(0, 1, 0, 2.3 * turn * share), about(0.6, 0, 0.8, 1.7 * turn * share));
  if (!a.moves) {
    const double radius = 0.6 * std::sin(1.5 * turn * share), angle = turn * share;
    return {{radius * std::cos(angle), touch * (0.85 + 0.45 * wave), radius * std::sin(angle)}, orientation};
  }
  const double polar = (0.1 + 0.8 * share) * std::numbers::pi, angle = 3 * turn * share;
  const double r = touch * (0.9 + 0.4 * wave);
  return {{r * std::sin(polar) * std::cos(angle), r * std::cos(polar), r * std::sin(polar) * std::sin(angle)},
          orientation};
}

PairTour tour_of(const KindOfShape& a, const KindOfShape& b) {
  PairTour tour{a.name + "-" + b.name, {}, {}};
  Scene& scene = tour.scene;
  scene.id = "pair " + tour.name;
  scene.needs = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION;
  scene.gravity = {0, 0, 0};
  scene.dt = 1 / frames_a_second;
  scene.seconds = frames / frames_a_second;
  for (const bool moves : {false, true}) {
    const KindOfShape& kind = moves ? b : a;  // which may be one and the same
    const std::size_t before = scene.shapes.size();
    for (SceneShape shape : kind.shapes) {
      for (SceneShape::Child& child : shape.children) child.shape += before;
      scene.shapes.push_back(std::move(shape));
    }
    scene.bodies.push_back({kind.name, scene.shapes.size() - 1, body_desc(moves ? PLUMB_DYNAMIC : PLUMB_STATIC)});
  }
  for (std::size_t i = 0; i < frames; ++i) tour.poses.push_back(pose_at(static_cast<double>(i) / (frames - 1), a, b));
  scene.bodies[1].desc.pose = tour.poses.front();
  return tour;
}

std::vector<PlumbShape> create_shapes(IPhysicsWorld& world, const Scene& scene) {
  std::vector<PlumbShape> handles;
  for (const SceneShape& shape : scene.shapes) {
    std::vector<PlumbCompoundChild> children;
    for (const SceneShape::Child& child : shape.children) {
      PlumbCompoundChild row{};
      row.shape = handles.at(child.shape);
      row.pose = child.pose;
      children.push_back(row);
    }
    PlumbShapeDesc desc = shape.descriptor();
    desc.children = children.data();
    desc.child_count = static_cast<std::uint32_t>(children.size());
    handles.emplace_back();
    check(world, world.create_shapes({&desc, 1}, {&handles.back(), 1}));
  }
  return handles;
}

std::vector<PairAnswer> answers_of(Backend& backend, const PairTour& tour) {
  const Scene& scene = tour.scene;
  if (const std::string lacking = missing_support(backend, scene); !lacking.empty())
    throw Error(PLUMB_E_UNSUPPORTED, lacking);
  const std::unique_ptr<IPhysicsWorld> world = backend.create_world(world_desc(scene.needs));
  if (world->collide() == nullptr) throw Error(PLUMB_E_UNSUPPORTED, "collision without a step");
  const std::vector<PlumbShape> handles = create_shapes(*world, scene);
  std::vector<PlumbPosedPair> pairs;
  for (const PlumbPose& pose : tour.poses)
    pairs.push_back({handles[*scene.bodies[0].shape], handles[*scene.bodies[1].shape], identity_pose(), pose});
  std::vector<PlumbPairResult> results(pairs.size());
  std::span<const PlumbPairPoint> points;
  check(*world, world->collide()->collide_pairs(pairs, results, points));
  std::vector<PairAnswer> answers;
  for (const PlumbPairResult& result : results) {
    PairAnswer answer{result.distance, {}, {}};
    for (const PlumbPairPoint& point : points.subspan(result.first_point, result.point_count)) {
      answer.points.push_back(point);
      if (!answer.axis || point.depth > answer.axis->depth) answer.axis = point;
    }
    answers.push_back(std::move(answer));
  }
  return answers;
}

std::vector<PairAnswer> truth_of(const PairTour& tour) {
  const Scene& scene = tour.scene;
  const referee::ShapePtr a = shape_of(scene, *scene.bodies[0].shape), b = shape_of(scene, *scene.bodies[1].shape);
  std::vector<PairAnswer> answers;
  for (const PlumbPose& pose : tour.poses) {
    const referee::Penetration found = referee::penetration(*a, referee::Pose{}, *b, referee::pose(pose));
    const auto plain = [](const referee::Vec3& v) { return PlumbVec3{v.x(), v.y(), v.z()}; };
    const PlumbPairPoint point{plain(found.point), plain(found.normal), found.depth, 0};
    PairAnswer answer{-found.depth, {}, point};
    if (found.depth >= 0) answer.points.push_back(point);
    answers.push_back(std::move(answer));
  }
  return answers;
}

FrameLayers layers_of(const PairAnswer& answer, double true_distance) {
  const bool both_overlap = answer.distance < 0 && true_distance < 0;
  FrameLayers layers(tour_layers.size());
  LayerData& numbers = layers[0].emplace(tour_layers[0]);
  numbers.put(0, static_cast<float>(answer.distance));
  numbers.put(1, static_cast<float>(true_distance));
  numbers.put(2, static_cast<float>(both_overlap ? std::abs(answer.distance - true_distance) : unanswered));
  numbers.put(3, static_cast<std::uint32_t>(answer.points.size()));
  layers[1].emplace(tour_layers[1]).put(0, static_cast<float>(std::max(0.0, -true_distance)));
  LayerData& points = layers[2].emplace(tour_layers[2]);
  for (const PlumbPairPoint& point : answer.points) {
    points.put(0, std::uint32_t{0});
    points.put(1, std::uint32_t{1});
    points.put(2, point.position);
    points.put(3, point.normal);
    points.put(4, static_cast<float>(point.depth));
    points.put(5, static_cast<std::uint32_t>(point.feature ^ point.feature >> 32));
    ++points.rows;
  }
  LayerData& axes = layers[3].emplace(tour_layers[3]);
  if (answer.axis) {
    axes.put(0, std::uint32_t{0});
    axes.put(1, std::uint32_t{1});
    axes.put(2, answer.axis->normal);
    axes.put(3, static_cast<float>(-answer.axis->depth));
    axes.rows = 1;
  }
  return layers;
}

void write(const PairTour& tour, const std::string& who, const std::vector<PairAnswer>& answers,
           const std::string& file) {
  const std::vector<PairAnswer> truth = truth_of(tour);
  const PoseRow start[] = {{{0, 0, 0}, {0, 0, 0, 1}}, {tour.poses[0].position, tour.poses[0].orientation}};
  Json header = replay_header(tour.scene, start);
  header.update({{"kind", "pairs"},
                 {"pair", {tour.scene.bodies[0].name, tour.scene.bodies[1].name}},
                 {"title", tour.scene.bodies[0].name + " and " + tour.scene.bodies[1].name},
                 {"params", Json::object()},
                 {"backend", who},
                 {"label", who},
                 {"cell", "pair-" + tour.name + "-" + who},
                 {"units", {{"distance", "m"}, {"true_distance", "m"}, {"depth_error", "m"}, {"contacts", "1"}}},
                 {"recorded",
                  {{"source",
                    {{"penetration", "the referee"},
                     {"contacts", who + "; depths are its own"},
                     {"axes", "the normal of the deepest point of " + who}}}}}});
  TrajectoryWriter writer(file, header, tour_layers);
  for (std::size_t i = 0; i < tour.poses.size(); ++i) {
    const PoseRow pose{tour.poses[i].position, tour.poses[i].orientation};
    writer.add_frame(static_cast<std::uint32_t>(i), {&pose, 1}, layers_of(answers[i], truth[i].distance));
  }
  writer.finish();
  end_trajectory(file, {{"status", "ok"}, {"reason", ""}});
}

}  // namespace

std::vector<PairTour> all_pair_tours() {
  const std::vector<KindOfShape> kinds = kinds_of_shapes();
  std::vector<PairTour> tours;
  for (std::size_t b = 0; b < kinds.size(); ++b)
    for (std::size_t a = b; kinds[b].moves && a < kinds.size(); ++a) tours.push_back(tour_of(kinds[a], kinds[b]));
  return tours;
}

void record_pair(Backend& backend, const PairTour& tour, const std::string& file) {
  write(tour, backend.info().name, answers_of(backend, tour), file);
}

void record_pair_of_referee(const PairTour& tour, const std::string& file) {
  write(tour, "referee", truth_of(tour), file);
}

Json answer_pair_request(Backend& backend, const Json& request) {
  const std::string name = request.at("pair");
  for (const PairTour& tour : all_pair_tours()) {
    if (tour.name != name) continue;
    try {
      record_pair(backend, tour, request.at("file"));
      return {{"status", "ok"}, {"reason", ""}};
    } catch (const Error& error) {
      return {{"status", error.code() == PLUMB_E_UNSUPPORTED ? "unsupported" : "error"}, {"reason", error.what()}};
    }
  }
  return {{"status", "error"}, {"reason", "no pair is called " + name}};
}

}  // namespace plumb::harness
