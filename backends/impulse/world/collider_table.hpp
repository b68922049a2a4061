// Shapes in memory, and the proxies that place them on bodies. A body may have several proxies, or none.
#pragma once

#include "broadphase/pair_filter.hpp"
#include "contacts/surface_velocity.hpp"
#include "exec/table.hpp"
#include "geometry/hull_pool.hpp"
#include "geometry/surface_pool.hpp"

namespace plumb::impulse {

struct ColliderTable {
  Table<Proxy> proxies;
  Table<ProxyFilter> filters;            ///< by proxy
  SurfaceVelocities surface_velocities;  ///< by proxy, in worlds that have them
  Table<Shape> shapes;
  HullPool hulls;
  SurfacePool surfaces;
  std::uint32_t count = 0;  ///< proxy rows in use; those among them without a shape are nobody's

  /// Room for that many proxies. New rows have no shape. Where memory runs out, there are as many as before.
  void grow(std::size_t rows, bool with_surface_velocity) {
    const std::size_t before = proxies.size();
    filters.grow(rows);
    if (with_surface_velocity) surface_velocities.grow(rows);
    proxies.grow(rows);
    for (std::size_t i = before; i < rows; ++i) proxies.edit(i).shape = kNone;
  }
  /// Whether steps and queries see the proxy.
  [[nodiscard]] bool is_seen(std::uint32_t proxy) const {
    return proxies[proxy].shape != kNone && (filters[proxy].flags & kProxyUnseen) == 0;
  }
  [[nodiscard]] ShapeType type(std::uint32_t proxy) const { return shapes[proxies[proxy].shape].type; }

  /// Enqueues what was touched.
  void upload_shapes(Executor& executor) {
    shapes.upload(executor);
    hulls.upload(executor);
    surfaces.upload(executor);
  }
  void upload(Executor& executor) {
    proxies.upload(executor);
    filters.upload(executor);
    upload_shapes(executor);
  }
  [[nodiscard]] Proxies view() { return {proxies.device(), shapes.device(), hulls.device(), surfaces.device()}; }
};

}  // namespace plumb::impulse
