// The two models that most of Gazebo's worlds include and few machines have: the ground and the sun.
#pragma once

#include <optional>
#include <string>

#include "base/temporary_folder.hpp"

namespace plumb::harness {

class StandardModels {
 public:
  /// A folder with the model of model://ground_plane or model://sun; "" for any other URI.
  [[nodiscard]] std::string find(const std::string& uri);

 private:
  std::optional<TemporaryFolder> folder_;
};

}  // namespace plumb::harness
