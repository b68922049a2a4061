// A scene for queries without a world about it: shapes, proxies on bodies at poses, and their trees.
#pragma once

#include <vector>

#include "geometry/hull_pool.hpp"
#include "queries/closest_batch.hpp"
#include "queries/query_batch.hpp"
#include "queries/query_trees.hpp"

namespace plumb::impulse {

struct QueryRig {
  explicit QueryRig(std::uint32_t threads = 1) : executor(nullptr, threads) {}

  std::uint32_t add_shape(const Shape& shape) {
    shapes.push_back(shape);
    return static_cast<std::uint32_t>(shapes.size()) - 1;
  }
  /// Returns the slot; the body's handle is slot + 1 in the high half.
  std::uint32_t add_body(const Position& at, const Quat& orientation) {
    positions.push_back(at);
    orientations.push_back(orientation);
    const auto slot = static_cast<std::uint32_t>(positions.size()) - 1;
    ids.push_back(std::uint64_t{1} << 32 | slot);
    return slot;
  }
  /// Puts the shape on the body, there at `frame`.
  void add_proxy(std::uint32_t body, std::uint32_t shape, const Frame& frame, bool moves) {
    Proxy proxy{};
    proxy.body = body;
    proxy.shape = shape;
    proxy.frame = frame;
    (moves ? movers : statics).push_back(static_cast<std::uint32_t>(proxies.size()));
    proxies.push_back(proxy);
    filters.push_back({body, 1, ~0U, 0, 0});
  }
  std::uint32_t add(std::uint32_t shape, const Position& at, const Quat& orientation, bool moves) {
    const std::uint32_t body = add_body(at, orientation);
    add_proxy(body, shape, {{0, 0, 0}, {0, 0, 0, 1}}, moves);
    return body;
  }

  /// Brings all to where kernels run, and the trees up to date.
  void update(const Position& origin, bool several = false) {
    on_device.positions.from_host(positions.data(), positions.size());
    on_device.orientations.from_host(orientations.data(), orientations.size());
    on_device.proxies.from_host(proxies.data(), proxies.size());
    on_device.filters.from_host(filters.data(), filters.size());
    on_device.shapes.from_host(shapes.data(), shapes.size());
    on_device.movers.from_host(movers.data(), movers.size());
    on_device.statics.from_host(statics.data(), statics.size());
    hulls.upload(executor);
    ++version;
    PlacedProxies placed{};
    placed.bodies.position = on_device.positions.data();
    placed.bodies.orientation = on_device.orientations.data();
    placed.proxies = {on_device.proxies.data(), on_device.shapes.data(), hulls.device()};
    placed.filters = on_device.filters.data();
    placed.rows = static_cast<std::uint32_t>(proxies.size());
    placed.movers = {on_device.movers.data(), static_cast<std::uint32_t>(movers.size())};
    placed.statics = {on_device.statics.data(), static_cast<std::uint32_t>(statics.size())};
    placed.several = several;
    for (const Proxy& proxy : proxies) placed.types |= bit_of(shapes[proxy.shape].type);
    placed.origin = origin;
    placed.version = placed.static_version = version;
    trees.update(executor, placed, {ids, {}, version});
    executor.wait();
    scene = trees.scene(placed);
  }

  std::span<const PlumbHit> rays(PlumbHitMode mode, const std::vector<PlumbRay>& rays) {
    return batch.rays(executor, scene, mode, rays);
  }

  std::span<const PlumbHit> overlaps(const std::vector<PlumbOverlap>& overlaps) {
    return batch.overlaps(executor, scene, overlaps);
  }

  std::span<const PlumbHit> casts(PlumbHitMode mode, const std::vector<PlumbCast>& casts) {
    return batch.casts(executor, scene, mode, casts);
  }

  std::span<const PlumbHit> turning_casts(const std::vector<PlumbTurningCast>& casts) {
    return batch.turning_casts(executor, scene, PLUMB_HIT_CLOSEST, casts);
  }

  std::span<const PlumbPenetration> penetrations(const std::vector<PlumbOverlap>& overlaps) {
    return batch.penetrations(executor, scene, overlaps);
  }

  std::span<const PlumbClosest> closest(PlumbHitMode mode, const std::vector<PlumbProbe>& probes) {
    return near.find(executor, scene, mode, probes);
  }

  Executor executor;
  std::vector<Position> positions;
  std::vector<Quat> orientations;
  std::vector<Proxy> proxies;
  std::vector<ProxyFilter> filters;
  std::vector<Shape> shapes;
  std::vector<PlumbBody> ids;
  std::vector<std::uint32_t> movers, statics;
  HullPool hulls;
  QueryTrees trees;
  QueryScene scene{};
  QueryBatch batch;
  ClosestBatch near;

 private:
  struct {
    Buffer<Position> positions;
    Buffer<Quat> orientations;
    Buffer<Proxy> proxies;
    Buffer<ProxyFilter> filters;
    Buffer<Shape> shapes;
    Buffer<std::uint32_t> movers, statics;
  } on_device;
  std::uint64_t version = 0;
};

}  // namespace plumb::impulse
