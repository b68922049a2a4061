// Records one simulation to a trajectory's file as it runs.
#pragma once

#include <string>

#include "record/scene_layers.hpp"
#include "record/trajectory.hpp"

namespace plumb::harness {

/// What a request says of the recording: {"file","debug","about"}; about goes into the header.
struct RecordingRequest {
  std::string file;
  bool debug = false;
  Json about = Json::object();  ///< "title", "params", "backend", "label", "cell"
};

/// Writes a recording without frames: the scene as it would have begun, where nothing could run.
void record_start(const RecordingRequest& request, const Scene& scene);

class Recording {
 public:
  /// Writes the header and the frame of the start. declared: the needs of the simulation's world. Throws Error when the
  /// file cannot be written.
  Recording(const RecordingRequest& request, Simulation& simulation, const Backend& backend, PlumbNeeds declared);
  /// Adds a frame when one is due: about 60 a second of simulated time, more in short scenes and fewer in crowds.
  void stepped(Simulation& simulation);
  void finish() { writer_.finish(); }

 private:
  void add_frame(Simulation& simulation);

  SceneLayers layers_;
  TrajectoryWriter writer_;
  std::vector<std::size_t> moving_;
  std::uint64_t stride_ = 1, frames_ = 0;
};

}  // namespace plumb::harness
