// One lane of vectors and matrices, to read or to write.
#pragma once

#include "math/mat33.hpp"
#include "math/wide.hpp"

namespace plumb::impulse {

template <class N>
PLUMB_HD void put_lane(Vec3<N>& lanes, std::uint32_t lane, const Vec& v) {
  lane_of(lanes.x, lane) = v.x;
  lane_of(lanes.y, lane) = v.y;
  lane_of(lanes.z, lane) = v.z;
}
template <class N>
PLUMB_HD void put_lane(Sym33<N>& lanes, std::uint32_t lane, const Sym& s) {
  lane_of(lanes.xx, lane) = s.xx;
  lane_of(lanes.yy, lane) = s.yy;
  lane_of(lanes.zz, lane) = s.zz;
  lane_of(lanes.xy, lane) = s.xy;
  lane_of(lanes.xz, lane) = s.xz;
  lane_of(lanes.yz, lane) = s.yz;
}
template <class N>
PLUMB_HD Vec vector_in_lane(const Vec3<N>& lanes, std::uint32_t lane) {
  return {lane_of(lanes.x, lane), lane_of(lanes.y, lane), lane_of(lanes.z, lane)};
}
/// The same vector in all lanes.
PLUMB_HD inline Vec3<Lanes> in_all_lanes(const Vec& v) { return {Lanes(v.x), Lanes(v.y), Lanes(v.z)}; }

}  // namespace plumb::impulse
