// Shapes of a scene file.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene/build.hpp"
#include "scene/limits.hpp"
#include "scene/model.hpp"

namespace plumb::harness {
namespace {

/// Which keys a type reads, beside type and user_data.
const std::vector<std::vector<std::string>>& keys_by_type() {
  static const std::vector<std::vector<std::string>> keys{
      {"radius"},   {"half_extents"},        {"radius", "half_height"}, {"radius", "half_height"},
      {"vertices"}, {"vertices", "indices"}, {"heights", "spacing"},    {},
      {"children"}};
  return keys;
}

void read_vertices(const Node& node, SceneShape& shape, SceneBuilder& builder) {
  builder.add_vertices(node, node.elements().size());
  for (const Node& vertex : node.elements()) {
    const PlumbVec3 v = vertex.vector();
    shape.vertices.insert(shape.vertices.end(), {v.x, v.y, v.z});
  }
}

void read_indices(const Node& node, SceneShape& shape) {
  const auto count = static_cast<std::int64_t>(shape.vertices.size() / 3);
  for (const Node& triangle : node.elements()) {
    const auto corners = triangle.elements();
    if (corners.size() != 3) triangle.fail("a triangle has three indices");
    for (const Node& corner : corners)
      shape.indices.push_back(static_cast<std::uint32_t>(corner.integer(0, std::max<std::int64_t>(0, count - 1))));
  }
}

/// An expression over x and z, places in a shape's frame, which it alone knows; without one 0.
class PlaceExpression {
 public:
  explicit PlaceExpression(std::optional<Node> node) : node_(std::move(node)) {
    for (const char* name : {"x", "z"}) {
      if (!node_) return;
      node_->check_new_name(name);
      node_->expressions().set(name, 0);
    }
  }
  ~PlaceExpression() {
    for (const char* name : {"x", "z"})
      if (node_) node_->expressions().erase(name);
  }
  PlaceExpression(const PlaceExpression&) = delete;
  PlaceExpression& operator=(const PlaceExpression&) = delete;

  [[nodiscard]] double at(double x, double z) const {
    if (!node_) return 0;
    node_->expressions().set("x", x);
    node_->expressions().set("z", z);
    return node_->number();
  }

 private:
  std::optional<Node> node_;
};

/// A square of cells about the origin, in two triangles each.
void read_grid(const Node& node, const std::optional<Node>& height, SceneShape& shape, SceneBuilder& builder) {
  const auto numbers = node.elements();
  if (numbers.size() != 2) node.fail("a grid has two numbers: cells a side, and the side of one");
  const auto cells = static_cast<std::uint32_t>(numbers[0].integer(1, 2048));
  const double side = numbers[1].number();
  if (!(side > 0)) numbers[1].fail(fmt::format("the side of a cell is above 0, not {:g}", side));
  builder.add_vertices(node, std::size_t{cells + 1} * (cells + 1));
  const PlaceExpression y(height);
  for (std::uint32_t row = 0; row <= cells; ++row)
    for (std::uint32_t column = 0; column <= cells; ++column) {
      const double x = (column - cells / 2.0) * side, z = (row - cells / 2.0) * side;
      shape.vertices.insert(shape.vertices.end(), {x, y.at(x, z), z});
    }
  for (std::uint32_t row = 0; row < cells; ++row)
    for (std::uint32_t column = 0; column < cells; ++column) {
      const std::uint32_t near = row * (cells + 1) + column, far = near + cells + 1;
      shape.indices.insert(shape.indices.end(), {near, far, near + 1, near + 1, far, far + 1});
    }
}

void read_heights(const Node& node, SceneShape& shape, SceneBuilder& builder) {
  const auto rows = node.elements();
  for (const Node& row : rows) builder.add_vertices(row, row.elements().size());
  if (rows.size() < 2) node.fail("a height field has two rows or more");
  for (const Node& row : rows) {
    const auto columns = row.elements();
    if (columns.size() != rows.front().json().size() || columns.size() < 2)
      row.fail("all rows of a height field have the same number of columns, two or more");
    for (const Node& height : columns) shape.heights.push_back(height.number());
  }
  shape.desc.rows = static_cast<std::uint32_t>(rows.size());
  shape.desc.columns = static_cast<std::uint32_t>(shape.heights.size() / rows.size());
}

/// The middle of each triangle of a mesh or height field, in its frame.
std::vector<PlumbVec3> middles_of(const SceneShape& shape) {
  std::vector<PlumbVec3> middles;
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    PlumbVec3 sum{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double* corner = &shape.vertices[std::size_t{3} * shape.indices[i + k]];
      sum = {sum.x + corner[0], sum.y + corner[1], sum.z + corner[2]};
    }
    middles.push_back({sum.x / 3, sum.y / 3, sum.z / 3});
  }
  const PlumbShapeDesc& field = shape.desc;
  for (std::uint32_t row = 0; row + 1 < field.rows; ++row)
    for (std::uint32_t column = 0; column + 1 < field.columns; ++column)
      for (const double third : {1.0 / 3, 2.0 / 3})
        middles.push_back({(column + third - (field.columns - 1) / 2.0) * field.spacing.x, 0,
                           (row + third - (field.rows - 1) / 2.0) * field.spacing.z});
  return middles;
}

/// Materials by triangle, and which each has: a list, or an expression over the place of its middle.
void read_materials(const Node& node, SceneShape& shape) {
  const auto materials = node.find("materials"), of = node.find("triangle_materials");
  if (!materials && !of) return;
  if (!materials || !of) node.fail("\"materials\" and \"triangle_materials\" go together");
  for (const Node& row : materials->elements()) {
    row.only(scene_keys().at("triangle_material"));
    PlumbMaterial material{};
    material.friction = row.number_or("friction", 0.5);
    material.restitution = row.number_or("restitution", 0);
    check_values(row, material);
    shape.materials.push_back(material);
  }
  if (shape.materials.empty()) materials->fail("a shape with materials has one or more");
  const auto last = static_cast<std::int64_t>(shape.materials.size()) - 1;
  const std::vector<PlumbVec3> middles = middles_of(shape);
  const auto take = [&](const Node& number) {
    shape.triangle_materials.push_back(static_cast<std::uint32_t>(number.integer(-1, last)));  // -1: the body's
  };
  if (of->json().is_array()) {
    if (of->json().size() != middles.size())
      of->fail(fmt::format("the shape has {} triangles, not {}", middles.size(), of->json().size()));
    for (const Node& number : of->elements()) take(number);
    return;
  }
  const PlaceExpression row(*of);
  for (const PlumbVec3& middle : middles) {
    (void)row.at(middle.x, middle.z);
    take(*of);
  }
}

/// A model of a package. Where the machine lacks it the scene says so and cannot be built.
void read_model(const Node& node, SceneShape& shape, Scene& scene) {
  node.only(scene_keys().at("model"));
  ModelRequest request;
  request.file = node.at("file").text();
  request.size = node.number_or("size", 1);
  request.orientation = node.orientation_or("orientation", request.orientation);
  if (!(request.size > 0)) node.at("size").fail(fmt::format("the size of a model is above 0, not {}", request.size));
  const bool hull = shape.desc.type == PLUMB_CONVEX_HULL;
  if (hull != node.find("corners").has_value())
    node.fail(hull ? "a hull of a model says its \"corners\"" : "a mesh of a model has all its corners");
  std::optional<Model> model;
  try {
    model = load_model(request);
  } catch (const std::runtime_error& error) {
    node.at("file").fail(fmt::format("{}: {}", request.file.string(), error.what()));
  }
  if (!model) {
    scene.lacks =
        fmt::format("the scene needs {}; install the package {}", request.file.string(), node.at("package").text());
    return;
  }
  if (hull) {
    shape.vertices = extreme_points(*model, static_cast<std::size_t>(node.at("corners").integer(4, 4096)));
  } else {
    shape.vertices = std::move(model->vertices);
    shape.indices = std::move(model->indices);
  }
}

SceneShape::Child read_child(const Node& node, const SceneBuilder& builder) {
  node.only(scene_keys().at("child"));
  SceneShape::Child child{};
  child.shape = find_name(node.at("shape"), "shape", builder.shape_index);
  child.pose = {node.vector_or("position", {}), node.orientation_or("orientation", {0, 0, 0, 1})};
  if (node.find("friction") || node.find("restitution") || node.find("surface_velocity")) {
    PlumbMaterial material{};
    material.friction = node.number_or("friction", 0.5);
    material.restitution = node.number_or("restitution", 0);
    material.surface_velocity = node.vector_or("surface_velocity", {});
    check_values(node, material);
    child.material = material;
  }
  return child;
}

SceneShape read_shape(const Node& node, const std::string& name, SceneBuilder& builder) {
  SceneShape shape;
  shape.name = name;
  const std::size_t type = node.at("type").word("shape", shape_words());
  shape.desc = shape_desc(static_cast<PlumbShapeType>(type));
  const auto grid = node.find("grid"), model = node.find("model");
  const bool as_grid = grid && type == PLUMB_TRIANGLE_MESH;
  const bool as_model = model && (type == PLUMB_TRIANGLE_MESH || type == PLUMB_CONVEX_HULL);
  for (const auto& [key, member] : node.members()) {
    const auto& keys = keys_by_type()[type];
    if ((as_grid && (key == "grid" || key == "height")) || (as_model && key == "model")) continue;
    const bool of_surface = key == "materials" || key == "triangle_materials";
    if (of_surface && (type == PLUMB_TRIANGLE_MESH || type == PLUMB_HEIGHT_FIELD)) continue;
    if (key == "type" || key == "user_data" || std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    member.fail(fmt::format("a {} has no {}", shape_words()[type], key));
  }
  if (as_grid) read_grid(*grid, node.find("height"), shape, builder);
  if (as_model) read_model(*model, shape, builder.scene);
  for (const std::string& key : keys_by_type()[type]) {
    if (as_grid || as_model) break;
    const Node value = node.at(key.c_str());
    if (key == "radius") shape.desc.radius = value.number();
    if (key == "half_height") shape.desc.half_height = value.number();
    if (key == "half_extents") shape.desc.half_extents = value.vector();
    if (key == "vertices") read_vertices(value, shape, builder);
    if (key == "indices") read_indices(value, shape);
    if (key == "heights") read_heights(value, shape, builder);
    if (key == "spacing") shape.desc.spacing = value.vector();
    if (key == "children")
      for (const Node& child : value.elements())
        for_each_repeat(child, [&] { shape.children.push_back(read_child(child, builder)); });
  }
  if (const auto data = node.find("user_data"))
    shape.desc.user_data = static_cast<std::uint64_t>(data->integer(0, std::int64_t{1} << 53));
  shape.desc.vertex_count = static_cast<std::uint32_t>(shape.vertices.size() / 3);
  shape.desc.triangle_count = static_cast<std::uint32_t>(shape.indices.size() / 3);
  if (builder.scene.lacks.empty() || !as_model) read_materials(node, shape);
  if (builder.scene.lacks.empty() || !as_model) check_values(node, shape);
  return shape;
}

}  // namespace

void SceneBuilder::add_vertices(const Node& place, std::size_t count) {
  vertices += count;
  if (vertices > most_vertices)
    place.fail(
        fmt::format("with this the scene's shapes have more than {} vertices: is a count mistaken?", most_vertices));
}

void read_shapes(const Node& shapes, SceneBuilder& builder) {
  for (const auto& [name, node] : shapes.members()) {
    node.only(scene_keys().at("shape"));
    node.check_shown_name(name);
  }
  // Compounds come last, so that all their children have smaller indices; a compound in a compound is thus unknown.
  for (const bool compounds : {false, true}) {
    for (const auto& [name, node] : shapes.members()) {
      if ((node.at("type").name() == "compound") != compounds) continue;
      SceneShape shape = read_shape(node, name, builder);
      add_name(node, "shape", name, builder.shape_index, builder.scene.shapes.size());
      builder.scene.shapes.push_back(std::move(shape));
    }
  }
}

}  // namespace plumb::harness
