// In place of the reader where tinygltf was not found.
#include "convert/gltf/read_gltf.hpp"

namespace plumb::harness {

Imported read_gltf(const ModelFolders& folders) {
  throw UsageError(folders.file.string() +
                   ": this program was built without tinygltf, which reads glTF; install libtinygltf-dev and build it "
                   "again");
}

}  // namespace plumb::harness
