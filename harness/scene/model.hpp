// Real geometry: models that a package of the machine ships, read where they lie and never copied.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "plumb/types.h"

namespace plumb::harness {

/// What a shape asks of its model.
struct ModelRequest {
  std::filesystem::path file;
  double size = 1;                    ///< longest side of its bounding box, m
  PlumbQuat orientation{0, 0, 0, 1};  ///< turned by this about the middle of the box
};

/// A surface of triangles, counter-clockwise seen from outside; the middle of its bounding box is the origin.
struct Model {
  std::vector<double> vertices;        ///< xyz triples, m; no two are the same
  std::vector<std::uint32_t> indices;  ///< 3 a triangle, none with a corner twice
};

/// All meshes of a file in one of the formats that assimp reads (OBJ, 3DS, PLY, STL, glTF, ...). None where there is no
/// such file; throws std::runtime_error with assimp's words for one that holds no triangles.
[[nodiscard]] std::optional<Model> load_model(const ModelRequest& request);

/// All meshes of a file as they lie in it, each coordinate times its scale (of a mirrored one the triangles are turned
/// round). Throws UsageError for a file that holds no triangles.
[[nodiscard]] Model load_surface(const std::filesystem::path& file, const PlumbVec3& scale);

/// Unit vectors spread evenly over the sphere (Gonzalez 2010, "Measurement of areas on a sphere using Fibonacci and
/// latitude-longitude lattices").
[[nodiscard]] std::vector<PlumbVec3> even_directions(std::size_t count);

/// The model's furthest points along so many even directions, each once: corners of a hull as fine as that.
[[nodiscard]] std::vector<double> extreme_points(const Model& model, std::size_t count);

}  // namespace plumb::harness
