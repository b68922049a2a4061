#include "record/scene_layers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "measure/instruments/referee_view.hpp"
#include "record/joint_layer.hpp"

namespace plumb::harness {

namespace {

// The referee's overlaps cost milliseconds from a few hundred bodies on, and lists of contacts and boxes megabytes.
constexpr std::size_t bodies_looked_at_each_frame = 400;
constexpr std::uint64_t frames_between_debug_layers = 4;

constexpr auto not_told = std::numeric_limits<float>::quiet_NaN();

float narrow(double value) { return static_cast<float>(value); }

std::uint32_t folded(std::uint64_t feature) { return static_cast<std::uint32_t>(feature ^ feature >> 32); }

std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

}  // namespace

struct SceneLayers::State {
  using Look = LayerData (State::*)(Simulation&, const LayerSpec&);
  struct Layer {
    LayerSpec spec;
    std::uint64_t every;
    std::string source;
    Look look;
  };

  State(Simulation& simulation, const Backend& used, PlumbNeeds needs)
      : scene(simulation.scene()), view(scene), backend(used), declared(needs), joint_rows(simulation) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      index[simulation.handle(i)] = static_cast<std::uint32_t>(i);
      if (scene.bodies[i].desc.motion != PLUMB_STATIC) moving.push_back(i);
    }
  }

  Scene scene;
  RefereeView view;
  const Backend& backend;
  PlumbNeeds declared;
  JointLayer joint_rows;
  std::vector<std::size_t> moving;
  std::unordered_map<PlumbBody, std::uint32_t> index;
  std::uint64_t spread = 1;  ///< frames between looks at what costs
  std::vector<Layer> layers;
  Json without = Json::object();
  referee::WorldPenetration overlaps;  ///< of the frame that is being looked at

  [[nodiscard]] std::uint32_t index_of(PlumbBody body) const {
    const auto found = index.find(body);
    return found == index.end() ? std::numeric_limits<std::uint32_t>::max() : found->second;
  }
  [[nodiscard]] bool has_need(PlumbNeeds need) const { return (declared & need) != 0; }

  void add_scene_layers();
  void add_debug_layers(Simulation& simulation);
  void add_graph_layers(Simulation& simulation);
  template <class Ask>
  bool shows(Simulation& simulation, const char* layer, const Ask& ask);

  LayerData series(Simulation& simulation, const LayerSpec& spec);
  LayerData joints(Simulation& simulation, const LayerSpec&) { return joint_rows.look(simulation); }
  LayerData penetration(Simulation& simulation, const LayerSpec& spec);
  LayerData contacts(Simulation& simulation, const LayerSpec& spec);
  LayerData overlaps_as_contacts(Simulation& simulation, const LayerSpec& spec);
  LayerData asleep(Simulation& simulation, const LayerSpec& spec);
  LayerData boxes(Simulation& simulation, const LayerSpec& spec);
  LayerData axes(Simulation& simulation, const LayerSpec& spec);
  LayerData islands(Simulation& simulation, const LayerSpec& spec);
  LayerData constraints(Simulation& simulation, const LayerSpec& spec);
};

void SceneLayers::State::add_scene_layers() {
  spread =
      std::max<std::uint64_t>(1, (scene.bodies.size() + bodies_looked_at_each_frame - 1) / bodies_looked_at_each_frame);
  layers.push_back(
      {{"series",
        LayerRows::one,
        {{"kinetic", "f64"}, {"potential", "f64"}, {"momentum", "f64", 3}, {"momenta", "f64"}, {"contacts", "u32"}}},
       1,
       "the referee; the number of contacts is the engine's",
       &State::series});
  if (scene.joints.empty()) {
    without["joints"] = "the scene has no joints";
  } else {
    layers.push_back({JointLayer::spec(), spread, "the referee", &State::joints});
  }
  if (has_need(PLUMB_NEED_COLLISION)) {
    layers.push_back(
        {{"penetration", LayerRows::moving, {{"penetration", "f32"}}}, spread, "the referee", &State::penetration});
    const LayerSpec points{"contacts",
                           LayerRows::list,
                           {{"body_a", "u32"},
                            {"body_b", "u32"},
                            {"point", "f32", 3},
                            {"normal", "f32", 3},
                            {"depth", "f32"},
                            {"force", "f32"},
                            {"id", "u32"},
                            {"engine_depth", "f32"}}};
    if (has_need(PLUMB_NEED_CONTACTS)) {
      layers.push_back(
          {points, spread, "the engine; depths are the referee's where it sees an overlap", &State::contacts});
    } else {
      layers.push_back(
          {points, spread, "the referee's overlaps: the engine tells no contacts", &State::overlaps_as_contacts});
    }
  } else {
    without["penetration"] = without["contacts"] = "nothing touches in this scene";
  }
  if (!has_need(PLUMB_NEED_SLEEPING)) {
    without["asleep"] = "the scene lets nothing fall asleep";
  } else if (backend.capability(PLUMB_CAP_FIELD_READ, PLUMB_FIELD_AWAKE) == PLUMB_NONE) {
    without["asleep"] = "the engine does not tell who sleeps";
  } else {
    layers.push_back({{"asleep", LayerRows::moving, {{"asleep", "u8"}}}, 1, "the engine", &State::asleep});
  }
}

// Whether an engine can show a layer is known only by asking for it.
template <class Ask>
bool SceneLayers::State::shows(Simulation& simulation, const char* layer, const Ask& ask) {
  if (simulation.world().debug() == nullptr) {
    without[layer] = "the engine shows nothing of its inside";
    return false;
  }
  if (ask() != PLUMB_E_UNSUPPORTED) return true;
  without[layer] = simulation.world().error_text();
  return false;
}

void SceneLayers::State::add_debug_layers(Simulation& simulation) {
  IDebug* debug = simulation.world().debug();
  const std::uint64_t every = frames_between_debug_layers * spread;
  std::span<const PlumbDebugBox> some_boxes;
  if (shows(simulation, "boxes", [&] { return debug->tree_boxes(some_boxes); })) {
    layers.push_back({{"boxes",
                       LayerRows::list,
                       {{"lower", "f32", 3}, {"upper", "f32", 3}, {"depth", "i32"}, {"body", "i32"}, {"tree", "u32"}}},
                      every,
                      "the engine's broad phase",
                      &State::boxes});
  }
  std::span<const PlumbDebugAxis> some_axes;
  if (shows(simulation, "axes", [&] { return debug->separating_axes(some_axes); })) {
    layers.push_back(
        {{"axes", LayerRows::list, {{"body_a", "u32"}, {"body_b", "u32"}, {"axis", "f32", 3}, {"separation", "f32"}}},
         every,
         "the engine's narrow phase",
         &State::axes});
  }
}

void SceneLayers::State::add_graph_layers(Simulation& simulation) {
  IDebug* debug = simulation.world().debug();
  const std::uint64_t every = spread;
  std::span<const PlumbDebugBody> some_bodies;
  if (shows(simulation, "islands", [&] { return debug->body_states(some_bodies); }))
    layers.push_back({{"islands", LayerRows::moving, {{"islands", "i32"}}}, every, "the engine", &State::islands});
  std::span<const PlumbDebugConstraint> some_constraints;
  if (shows(simulation, "constraints", [&] { return debug->solved_constraints(some_constraints); })) {
    layers.push_back({{"constraints", LayerRows::list, {{"body_a", "u32"}, {"body_b", "u32"}, {"colour", "i32"}}},
                      every,
                      "the engine's solver; a joint with the world has its body twice",
                      &State::constraints});
  }
}

LayerData SceneLayers::State::series(Simulation& simulation, const LayerSpec& spec) {
  LayerData data(spec);
  const std::vector<referee::BodyState> states = view.states(simulation);
  const referee::Energy energy = referee::energy(states, referee::vec(scene.gravity));
  const referee::Vec3 momentum = referee::linear_momentum(states);
  data.put(0, energy.kinetic());
  data.put(1, energy.potential);
  for (int axis = 0; axis < 3; ++axis) data.put(2, momentum[axis]);
  data.put(3, referee::sum_of_momenta(states));
  data.put(4, simulation.report().contacts);
  return data;
}

LayerData SceneLayers::State::penetration(Simulation& simulation, const LayerSpec& spec) {
  LayerData data(spec);
  overlaps = view.penetration(simulation.poses());
  std::vector<float> deepest(scene.bodies.size(), 0.0f);
  for (const referee::Overlap& overlap : overlaps.overlaps) {
    const float depth = narrow(overlap.penetration.depth);
    deepest[overlap.a] = std::max(deepest[overlap.a], depth);
    deepest[overlap.b] = std::max(deepest[overlap.b], depth);
  }
  for (const std::size_t body : moving) data.put(0, deepest[body]);
  return data;
}

LayerData SceneLayers::State::contacts(Simulation& simulation, const LayerSpec& spec) {
  LayerData data(spec);
  std::unordered_map<std::uint64_t, double> depths;
  for (const referee::Overlap& overlap : overlaps.overlaps)
    depths[pair_key(overlap.a, overlap.b)] = overlap.penetration.depth;
  for (const PlumbContact& contact : simulation.world().contacts()) {
    const std::uint32_t a = index_of(contact.body_a), b = index_of(contact.body_b);
    if (std::max(a, b) >= scene.bodies.size()) continue;  // of a body that the measure added
    const auto found = depths.find(pair_key(a, b));
    data.put(0, a);
    data.put(1, b);
    data.put(2, contact.position);
    data.put(3, contact.normal);
    data.put(4, narrow(found == depths.end() ? contact.depth : found->second));
    data.put(5, narrow(contact.normal_impulse / scene.dt));
    data.put(6, folded(contact.feature));
    data.put(7, narrow(contact.depth));
    ++data.rows;
  }
  return data;
}

LayerData SceneLayers::State::overlaps_as_contacts(Simulation&, const LayerSpec& spec) {
  LayerData data(spec);
  for (const auto& [a, b, found] : overlaps.overlaps) {
    data.put(0, a);
    data.put(1, b);
    data.put(2, referee::plain(found.point));
    data.put(3, referee::plain(found.normal));
    data.put(4, narrow(found.depth));
    data.put(5, not_told);
    data.put(6, std::uint32_t{0});
    data.put(7, not_told);
    ++data.rows;
  }
  return data;
}

LayerData SceneLayers::State::asleep(Simulation& simulation, const LayerSpec& spec) {
  LayerData data(spec);
  std::vector<PlumbBody> bodies;
  for (const std::size_t body : moving) bodies.push_back(simulation.handle(body));
  std::vector<double> awake(bodies.size(), 1);
  if (!bodies.empty())
    check(simulation.world(), simulation.world().read(PLUMB_FIELD_AWAKE, bodies, rows_over(std::span(awake))));
  for (const double is_awake : awake) data.put(0, static_cast<std::uint8_t>(is_awake == 0));
  return data;
}

LayerData SceneLayers::State::boxes(Simulation& simulation, const LayerSpec& spec) {
  LayerData data(spec);
  std::span<const PlumbDebugBox> boxes;
  check(simulation.world(), simulation.world().debug()->tree_boxes(boxes));
  for (const PlumbDebugBox& box : boxes) {
    data.put(0, box.lower);
    data.put(1, box.upper);
    data.put(2, box.depth);
    data.put(3, box.body == 0 ? -1 : static_cast<std::int32_t>(index_of(box.body)));
    data.put(4, box.tree);
    ++data.rows;
  }
  return data;
}

LayerData SceneLayers::State::axes(Simulation& simulation, const LayerSpec& spec) {
  LayerData data(spec);
  std::span<const PlumbDebugAxis> axes;
  check(simulation.world(), simulation.world().debug()->separating_axes(axes));
  for (const PlumbDebugAxis& axis : axes) {
    const std::uint32_t a = index_of(axis.body_a), b = index_of(axis.body_b);
    if (std::max(a, b) >= scene.bodies.size()) continue;
    data.put(0, a);
    data.put(1, b);
    data.put(2, axis.axis);
    data.put(3, narrow(axis.separation));
    ++data.rows;
  }
  return data;
}

LayerData SceneLayers::State::islands(Simulation& simulation, const LayerSpec& spec) {
  LayerData data(spec);
  std::span<const PlumbDebugBody> bodies;
  check(simulation.world(), simulation.world().debug()->body_states(bodies));
  std::vector<std::int32_t> island(scene.bodies.size(), -1);
  for (const PlumbDebugBody& body : bodies)
    if (const std::uint32_t i = index_of(body.body); i < island.size()) island[i] = body.island;
  for (const std::size_t body : moving) data.put(0, island[body]);
  return data;
}

LayerData SceneLayers::State::constraints(Simulation& simulation, const LayerSpec& spec) {
  LayerData data(spec);
  std::span<const PlumbDebugConstraint> constraints;
  check(simulation.world(), simulation.world().debug()->solved_constraints(constraints));
  for (const PlumbDebugConstraint& constraint : constraints) {
    const std::uint32_t b = index_of(constraint.body_b);
    const std::uint32_t a = constraint.body_a == 0 ? b : index_of(constraint.body_a);
    if (std::max(a, b) >= scene.bodies.size()) continue;
    data.put(0, a);
    data.put(1, b);
    data.put(2, constraint.colour);
    ++data.rows;
  }
  return data;
}

SceneLayers::SceneLayers(Simulation& simulation, const Backend& backend, PlumbNeeds declared, bool debug)
    : state_(std::make_unique<State>(simulation, backend, declared)) {
  state_->add_scene_layers();
  if (!debug) return;
  state_->add_graph_layers(simulation);
  state_->add_debug_layers(simulation);
}

SceneLayers::~SceneLayers() = default;

std::vector<LayerSpec> SceneLayers::specs() const {
  std::vector<LayerSpec> specs;
  for (const State::Layer& layer : state_->layers) specs.push_back(layer.spec);
  return specs;
}

Json SceneLayers::description() const {
  Json every = Json::object(), source = Json::object();
  for (const State::Layer& layer : state_->layers) {
    every[layer.spec.name] = layer.every;
    source[layer.spec.name] = layer.source;
  }
  return {{"every", every}, {"source", source}, {"without", state_->without}};
}

FrameLayers SceneLayers::look(Simulation& simulation, std::uint64_t frame) {
  FrameLayers frames;
  for (const State::Layer& layer : state_->layers) {
    frames.emplace_back();
    if (frame % layer.every == 0) frames.back() = ((*state_).*layer.look)(simulation, layer.spec);
  }
  return frames;
}

PlumbNeeds needs_of_layers(const Backend& backend) {
  PlumbNeeds needs = 0;
  for (const PlumbNeeds need : {PLUMB_NEED_CONTACTS, PLUMB_NEED_CONTACT_IMPULSES}) {
    std::uint32_t bit = 0;
    while (need >> bit != 1) ++bit;
    if (backend.capability(PLUMB_CAP_NEED, bit) != PLUMB_NONE) needs |= need;
  }
  return needs;
}

}  // namespace plumb::harness
