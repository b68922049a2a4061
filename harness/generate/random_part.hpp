// A body of chance: its shape and mass.
#pragma once

#include "convert/builder.hpp"
#include "generate/features.hpp"

namespace plumb::harness {

struct RandomPart {
  std::vector<LinkShape> shapes;
  double radius = 0;  ///< m; all of it is within this from the origin of its frame
  double mass = 0;    ///< kg
};

/// mass_ratio: of the heaviest part to the lightest; 5 kg is in the middle.
[[nodiscard]] RandomPart random_part(Chance& chance, const Features& features, double mass_ratio);

}  // namespace plumb::harness
