#include "cooking/mesh_tree.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::bullet {
namespace {

/// Of numbers alone, without padding.
struct Head {
  btScalar low[3], high[3], quantization[3];
  std::uint32_t nodes, subtrees;
};
struct Subtree {
  std::uint16_t low[3], high[3];
  std::int32_t root, size;
};
static_assert(sizeof(btQuantizedBvhNode) == 16, "of numbers alone");

void put(const btVector3& from, btScalar (&to)[3]) { std::copy_n(from.m_floats, 3, to); }
btVector3 taken(const btScalar (&from)[3]) { return {from[0], from[1], from[2]}; }

}  // namespace

void MeshTree::cook(backend::CookedWriter& out) const {
  Head head;
  std::memset(&head, 0, sizeof head);
  put(m_bvhAabbMin, head.low);
  put(m_bvhAabbMax, head.high);
  put(m_bvhQuantization, head.quantization);
  head.nodes = static_cast<std::uint32_t>(m_curNodeIndex);
  head.subtrees = static_cast<std::uint32_t>(m_SubtreeHeaders.size());
  out.value(head);
  out.items(&m_quantizedContiguousNodes[0], head.nodes);
  for (int i = 0; i < m_SubtreeHeaders.size(); ++i) {
    const btBvhSubtreeInfo& from = m_SubtreeHeaders[i];
    Subtree subtree{{}, {}, from.m_rootNodeIndex, from.m_subtreeSize};
    std::copy_n(from.m_quantizedAabbMin, 3, subtree.low);
    std::copy_n(from.m_quantizedAabbMax, 3, subtree.high);
    out.value(subtree);
  }
}

MeshTree::MeshTree(backend::CookedReader& in, std::uint32_t triangles) {
  const auto head = in.value<Head>();
  m_bvhAabbMin = taken(head.low);
  m_bvhAabbMax = taken(head.high);
  m_bvhQuantization = taken(head.quantization);
  m_useQuantization = true;
  const auto nodes = in.take(head.nodes, sizeof(btQuantizedBvhNode));
  const auto subtrees = in.list<Subtree>(head.subtrees);
  if (head.nodes != 2 * std::uint64_t{triangles} - 1) backend::CookedReader::corrupt("has no tree of its triangles");
  m_curNodeIndex = static_cast<int>(head.nodes);
  m_quantizedContiguousNodes.resize(m_curNodeIndex);
  std::memcpy(static_cast<void*>(&m_quantizedContiguousNodes[0]), nodes.data(), nodes.size());
  for (const Subtree& from : subtrees) {
    btBvhSubtreeInfo& subtree = m_SubtreeHeaders.expand(btBvhSubtreeInfo());
    std::copy_n(from.low, 3, subtree.m_quantizedAabbMin);
    std::copy_n(from.high, 3, subtree.m_quantizedAabbMax);
    subtree.m_rootNodeIndex = from.root;
    subtree.m_subtreeSize = from.size;
  }
  m_subtreeHeaderCount = m_SubtreeHeaders.size();
  if (!is_sound(triangles)) backend::CookedReader::corrupt("has no tree of its triangles");
}

/// Leaves name triangles that there are, and whoever leaves out a subtree comes further, but not beyond the end.
bool MeshTree::is_sound(std::uint32_t triangles) const {
  bool sound = true;
  for (int k = 0; k < 3; ++k)
    sound = sound && std::isfinite(m_bvhAabbMin[k]) && std::isfinite(m_bvhAabbMax[k]) && m_bvhQuantization[k] > 0 &&
            std::isfinite(m_bvhQuantization[k]) && m_bvhAabbMin[k] <= m_bvhAabbMax[k] &&
            (m_bvhAabbMax[k] - m_bvhAabbMin[k]) * m_bvhQuantization[k] < 65536;
  for (int i = 0; i < m_curNodeIndex; ++i) {
    const int number = m_quantizedContiguousNodes[i].m_escapeIndexOrTriangleIndex;
    sound = sound && (number >= 0 ? static_cast<std::uint32_t>(number) < triangles : number >= i - m_curNodeIndex);
  }
  for (int i = 0; i < m_SubtreeHeaders.size(); ++i) {
    const int root = m_SubtreeHeaders[i].m_rootNodeIndex, size = m_SubtreeHeaders[i].m_subtreeSize;
    sound = sound && root >= 0 && size >= 0 && root <= m_curNodeIndex && size <= m_curNodeIndex - root;
  }
  return sound;
}

}  // namespace plumb::bullet
