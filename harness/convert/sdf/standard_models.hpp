// The two models that most of Gazebo's worlds include and few machines have: the ground and the sun.
#pragma once

#include <filesystem>
#include <string>

namespace plumb::harness {

class StandardModels {
 public:
  StandardModels() = default;
  ~StandardModels();  ///< and its files are gone
  StandardModels(const StandardModels&) = delete;
  StandardModels& operator=(const StandardModels&) = delete;

  /// A folder with the model of model://ground_plane or model://sun; "" for any other URI.
  [[nodiscard]] std::string find(const std::string& uri);

 private:
  std::filesystem::path folder_;
};

}  // namespace plumb::harness
