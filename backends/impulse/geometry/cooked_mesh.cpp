// A mesh in bytes: the rows of its pool as they are. Whoever made them may have made a checksum that is right, so that
// all that names another row, and every way through the tree, is looked at before a kernel follows it.
#include "geometry/cooked_bytes.hpp"
#include "geometry/surface_pool.hpp"

namespace plumb::impulse {

namespace {

using backend::CookedReader;
using backend::CookedWriter;

/// Of numbers alone, without padding.
struct MeshCounts {
  std::uint32_t vertices, corners, triangles, neighbours;
  std::uint64_t closed;  ///< 0 or 1
  PlumbVec3 centre;
};

template <class T>
void take(Buffer<T>& buffer, const CookedItems<T>& items) {
  buffer.from_bytes(items.bytes().data(), items.size());
}

template <class T>
void take(Table<T>& table, const CookedItems<T>& items) {
  table.grow(items.size());
  if (items.size() == 0) return;
  static_cast<void>(table.edit(items.size() - 1));  // from the first to here they travel
  std::memcpy(static_cast<void*>(&table.edit(0)), items.bytes().data(), items.bytes().size());
}

/// Nodes of doubles have padding, which must not be what happened to be in memory.
void cook_nodes(const std::vector<TreeNode>& nodes, CookedWriter& bytes) {
  std::vector<std::byte> clean(nodes.size() * sizeof(TreeNode));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto put = [&](std::size_t offset, const auto& member) {
      std::memcpy(clean.data() + i * sizeof(TreeNode) + offset, &member, sizeof member);
    };
    put(offsetof(TreeNode, low), nodes[i].low);
    put(offsetof(TreeNode, child), nodes[i].child);
    put(offsetof(TreeNode, high), nodes[i].high);
    put(offsetof(TreeNode, next), nodes[i].next);
  }
  bytes.items(clean.data(), clean.size());
}

/// Whether corners are numbered by their first vertices, and all have one.
bool numbers_all(const CookedItems<std::uint32_t>& corner_of, std::uint32_t corners) {
  std::uint32_t known = 0;
  for (std::size_t v = 0; v < corner_of.size(); ++v) {
    if (corner_of[v] > known) return false;
    if (corner_of[v] == known) ++known;
  }
  return known == corners;
}

/// Whether each list begins where the one before ended, and the last ends with all.
bool are_lists(const CookedItems<std::uint32_t>& first, std::uint32_t count) {
  bool rises = first[0] == 0;
  for (std::size_t i = 1; i < first.size(); ++i) rises &= first[i] >= first[i - 1];
  return rises && first[first.size() - 1] == count;
}

/// Whether the nodes are one tree, in which every search comes to its end: from child to child and on to what follows
/// each node is met once, what follows a first child is the second one, and what follows that is what follows both.
bool is_tree(const CookedItems<TreeNode>& nodes, std::uint32_t leaves) {
  const TreeView shape = {nullptr, leaves};
  std::vector<bool> met(nodes.size());
  std::size_t count = 0;
  for (std::uint32_t id = shape.root(); id != TreeView::kEnd; ++count) {
    if (id >= nodes.size() || met[id]) return false;
    met[id] = true;
    const TreeNode node = nodes[id];
    const bool inner = TreeView::is_inner(id);
    if (node.child >= (inner ? nodes.size() : leaves)) return false;
    if (inner) {
      const std::uint32_t second = nodes[node.child].next;
      if (second >= nodes.size() || nodes[second].next != node.next) return false;
    }
    id = inner ? node.child : node.next;
  }
  return count == nodes.size();
}

}  // namespace

void SurfacePool::Materials::cook(CookedWriter& bytes) const {
  const std::vector<Material> given = rows.to_host(rows.size());
  const std::vector<std::uint32_t> triangles = of.to_host(of.size());
  bytes.value(static_cast<std::uint32_t>(given.size()));
  bytes.value(static_cast<std::uint32_t>(triangles.size()));
  bytes.items(given.data(), given.size());
  bytes.items(triangles.data(), triangles.size());
}

SurfacePool::Materials::Materials(CookedReader& bytes) {
  const auto count = bytes.value<std::uint32_t>(), triangles = bytes.value<std::uint32_t>();
  const CookedItems<Material> given(bytes, count);
  const CookedItems<std::uint32_t> of_triangles(bytes, triangles);
  const bool sound = given.all([](const Material& m) {
    return m.friction >= 0 && m.restitution >= 0 && m.restitution <= 1;
  }) && of_triangles.all([count](std::uint32_t row) { return row < count || row == PLUMB_BODY_MATERIAL; });
  if (!sound) CookedReader::corrupt("has materials that are none");
  take(rows, given);
  take(of, of_triangles);
}

void SurfacePool::Mesh::cook(CookedWriter& bytes) const {
  materials.cook(bytes);
  const auto size = [](const auto& rows) { return static_cast<std::uint32_t>(rows.size()); };
  bytes.value(
      MeshCounts{size(corner_of), size(corners), size(triangles), size(neighbours), closed ? 1U : 0U, added.centre});
  bytes.value(added.half);
  bytes.value(added.reach);
  bytes.items(corner_of.data(), corner_of.size());
  bytes.items(&corners[0], corners.size());
  bytes.items(&triangles[0], triangles.size());
  bytes.items(first_neighbour.to_host(first_neighbour.size()).data(), first_neighbour.size());
  bytes.items(neighbours.to_host(neighbours.size()).data(), neighbours.size());
  cook_nodes(nodes.to_host(2 * triangles.size() - 1), bytes);
}

SurfacePool::Mesh::Mesh(CookedReader& bytes) : materials(bytes) {
  const auto counts = bytes.value<MeshCounts>();
  added = {0, counts.centre, bytes.value<Vec>(), bytes.value<Real>()};
  if (counts.corners == 0 || counts.triangles == 0) CookedReader::corrupt("is of no mesh");
  const CookedItems<std::uint32_t> vertices(bytes, counts.vertices);
  const CookedItems<Vec> places(bytes, counts.corners);
  const CookedItems<MeshTriangle> joined(bytes, counts.triangles);
  const CookedItems<std::uint32_t> first(bytes, std::uint64_t{counts.corners} + 1), others(bytes, counts.neighbours);
  const CookedItems<TreeNode> tree(bytes, std::uint64_t{2} * counts.triangles - 1);
  bytes.finish();
  const auto is_corner = [n = counts.corners](std::uint32_t corner) { return corner < n; };
  const auto is_corner_or_none = [n = counts.corners](std::uint32_t corner) { return corner + 1 <= n; };
  static_assert(kNoCorner + 1 == 0);
  const bool sound = counts.closed <= 1 && std::isfinite(counts.centre.x) && std::isfinite(counts.centre.y) &&
                     std::isfinite(counts.centre.z) && is_in_range(added.half) && is_finite(added.reach) &&
                     (materials.of.size() == 0 || materials.of.size() == counts.triangles) &&
                     numbers_all(vertices, counts.corners) && places.all(is_in_range) &&
                     joined.all([&](const MeshTriangle& t) {
                       bool in_bounds = true;
                       for (int k = 0; k < 3; ++k)
                         in_bounds = in_bounds && is_corner(t.corner[k]) && is_corner_or_none(t.across[k]);
                       return in_bounds;
                     }) &&
                     are_lists(first, counts.neighbours) && others.all(is_corner) && is_tree(tree, counts.triangles);
  if (!sound) CookedReader::corrupt("is of no mesh");
  closed = counts.closed != 0;
  corner_of.resize(counts.vertices);
  std::memcpy(corner_of.data(), vertices.bytes().data(), vertices.bytes().size());
  take(corners, places);
  take(triangles, joined);
  take(first_neighbour, first);
  take(neighbours, others);
  take(nodes, tree);
}

std::vector<std::byte> SurfacePool::cook_mesh(Executor& executor, const PlumbShapeDesc& desc) {
  CookedWriter bytes;
  Mesh(executor, desc).cook(bytes);
  return bytes.take();
}

AddedSurface SurfacePool::add_cooked_mesh(CookedReader& bytes) { return add(std::make_unique<Mesh>(bytes)); }

}  // namespace plumb::impulse
