// In place of the reader where MuJoCo was not found.
#include "convert/mjcf/read_mjcf.hpp"

namespace plumb::harness {

Imported read_mjcf(const ModelFolders& folders) {
  throw UsageError(
      folders.file.string() +
      ": this program was built without MuJoCo, whose compiler reads MJCF; install libmujoco-dev and build "
      "it again");
}

}  // namespace plumb::harness
