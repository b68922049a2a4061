#include "convert/gltf/gltf_distance.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "convert/gltf/gltf_file.hpp"

namespace plumb::harness {
namespace {

using nlohmann::json;

}  // namespace

bool is_distance(const json& limits) {
  return !limits.empty() && std::all_of(limits.begin(), limits.end(), [](const json& limit) {
    return limit.contains("linearAxes") && limit.at("linearAxes").size() == 3 && member(limit, "max", 1.0) != 0;
  });
}

void set_distance(PlumbJointDesc& desc, const json& joint, const std::string& name, Remarks& remarks) {
  constexpr double far = 1e6;  // m: what says no limit
  for (const json& limit : joint.at("limits")) {
    const double lower = member(limit, "min", 0.0), upper = member(limit, "max", far);
    if (!(0 <= lower && lower <= upper))
      throw UsageError(fmt::format("joint \"{}\": its distance from {} to {} is none", name, lower, upper));
    const bool soft = limit.contains("stiffness");
    if (lower == upper) desc.rest_length = lower;
    if (soft && lower == upper)
      desc.springs[0] = {0, limit.at("stiffness").get<double>(), member(limit, "damping", 0.0), 1,
                         PLUMB_SPRING_STIFFNESS};
    else if (lower != upper)
      desc.limits[0] = {lower, upper, 1, 0};
    if (soft && lower != upper) remarks.add("soft limits are hard", name);
  }
  if (joint.contains("drives")) remarks.add("drives of what keeps a distance are left out", name);
}

}  // namespace plumb::harness
