// The trees of queries, built when somebody asks for the first time after a change. That of the statics stays as long
// as they do.
#pragma once

#include <span>

#include "exec/reduce.hpp"
#include "queries/query_scene.hpp"

namespace plumb::impulse {

/// Bodies with shapes, uploaded and listed, as they are now.
struct PlacedProxies {
  Bodies bodies;
  Proxies proxies;
  const ProxyFilter* filters;
  std::uint32_t rows;  ///< of proxies
  ProxyRows movers, statics;
  ProxyRows planes;                       ///< they are in no tree
  bool several;                           ///< whether a body may have more than one proxy
  Position origin;                        ///< a place near most of them
  std::uint32_t types;                    ///< a bit for each ShapeType among all of these
  std::uint64_t version, static_version;  ///< change when any body or any static may have
};

/// How hits name what they hit.
struct HitNames {
  std::span<const PlumbBody> bodies;        ///< by slot
  std::span<const std::uint32_t> children;  ///< by proxy, as far as one is not 0
  std::uint64_t version;                    ///< changes with them
};

class QueryTrees {
 public:
  /// Whether the trees are those of this version of the bodies.
  [[nodiscard]] bool fresh(std::uint64_t version) const { return version_ == version; }
  /// Enqueues what it takes to be up to date.
  void update(Executor& executor, const PlacedProxies& placed, const HitNames& names);
  /// Of what was updated last, where kernels run.
  [[nodiscard]] QueryScene scene(const PlacedProxies& placed);

 private:
  void place(Executor& executor, const PlacedProxies& placed, const ProxyRows& list);
  void build(Executor& executor, const PlacedProxies& placed, const ProxyRows& list, Lbvh& tree);

  std::uint64_t version_ = 0, static_version_ = 0, names_version_ = 0;
  Position origin_{0, 0, 0};
  Buffer<Box> boxes_;  // by proxy
  Buffer<Target> targets_;
  Mirror<PlumbBody> ids_;
  Mirror<std::uint32_t> children_;
  std::uint32_t child_count_ = 0;
  Reduce<SceneExtent> reduce_;
  Buffer<SceneExtent> extent_;
  Lbvh movers_, statics_;
};

}  // namespace plumb::impulse
