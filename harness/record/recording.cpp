#include "record/recording.hpp"

#include <algorithm>
#include <cmath>

#include "plumb/assert.hpp"
#include "record/trajectory_header.hpp"
#include "simulation/scene_nature.hpp"

namespace plumb::harness {

namespace {

constexpr double frame_rate = 60;
constexpr double fewest_frames = 150;     // of a scene that is over in a blink
constexpr double most_poses = 3'000'000;  // in a file: bodies times frames

Json header_of(const RecordingRequest& request, const Simulation& simulation, const SceneLayers& layers) {
  Json header = replay_header(simulation.scene(), simulation.poses());
  header.update(request.about);
  const SceneNature nature = nature_of(simulation.scene());
  header["driven"] = nature.driven || nature.stores;
  header["closed"] = nature.closed;
  header["recorded"] = layers.description();
  return header;
}

std::uint64_t stride_of(const Scene& scene) {
  const double rate = std::max(frame_rate, fewest_frames / scene.seconds);
  const double most_frames = std::max(fewest_frames, most_poses / static_cast<double>(scene.bodies.size() + 1));
  PLUMB_ASSERT(scene.seconds > 0 && scene.dt > 0);
  const double interval = std::max(1 / rate, scene.seconds / most_frames);
  return static_cast<std::uint64_t>(std::max(1.0, std::round(interval / scene.dt)));
}

}  // namespace

void record_start(const RecordingRequest& request, const Scene& scene) {
  std::vector<PoseRow> poses;
  for (const SceneBody& body : scene.bodies) poses.push_back({body.desc.pose.position, body.desc.pose.orientation});
  Json header = replay_header(scene, poses);
  header.update(request.about);
  TrajectoryWriter(request.file, std::move(header), {}).finish();
}

Recording::Recording(const RecordingRequest& request, Simulation& simulation, const Backend& backend,
                     PlumbNeeds declared)
    : layers_(simulation, backend, declared, request.debug),
      writer_(request.file, header_of(request, simulation, layers_), layers_.specs()),
      stride_(stride_of(simulation.scene())) {
  const std::vector<SceneBody>& bodies = simulation.scene().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].desc.motion != PLUMB_STATIC) moving_.push_back(i);
  add_frame(simulation);
}

void Recording::stepped(Simulation& simulation) {
  if (simulation.steps() % stride_ == 0) add_frame(simulation);
}

void Recording::add_frame(Simulation& simulation) {
  PLUMB_ASSERT(moving_.empty() || moving_.back() < simulation.poses().size());
  std::vector<PoseRow> poses;
  poses.reserve(moving_.size());
  for (const std::size_t body : moving_) poses.push_back(simulation.poses()[body]);
  writer_.add_frame(static_cast<std::uint32_t>(simulation.steps()), poses, layers_.look(simulation, frames_));
  ++frames_;
}

}  // namespace plumb::harness
