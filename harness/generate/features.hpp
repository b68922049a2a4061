// What a random scene may have. A scene has each with a probability of a half, and so scenes differ in what is missing,
// too: what hides behind one feature is found where another is left out (swarm testing; Groce, Zhang, Eide, Chen,
// Regehr: "Swarm Testing", ISSTA 2012, section 2).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "generate/chance.hpp"

namespace plumb::harness {

enum class Feature {
  joints,      ///< bodies are joined to trees, which hang or are thrown
  loops,       ///< joints that close a tree's loops
  limits,      ///< of axes, and joints that slide
  friction,    ///< joints resist by a motor that wants to stand still
  motors,      ///< joints are driven
  springs,     ///< of joints, by stiffness and damping
  generic,     ///< joints of which each axis is free, locked or limited
  hulls,       ///< convex hulls and cylinders, beside boxes, spheres and capsules
  compounds,   ///< shapes of two parts
  slender,     ///< rods and plates, up to twenty times as long as thick
  heap,        ///< bodies that nothing joins
  load,        ///< a box of up to ten times the others' mass falls upon them
  bounce,      ///< restitution
  terrain,     ///< a height field instead of a plane
  mover,       ///< a platform that the host moves to and fro
  belt,        ///< a ground whose surface moves
  spin,        ///< what is thrown is fast
  gyroscopic,  ///< the need of this name is declared
  sockets,     ///< ball joints tell swing and twist, within cones, on springs and motors of their own
  targets,     ///< the host leads springs of joints to and fro
};
inline constexpr std::size_t feature_count = 20;

/// By value.
[[nodiscard]] const std::vector<std::string>& feature_words();
/// Throws UsageError with the nearest right word.
[[nodiscard]] Feature feature_of(const std::string& word);

class Features {
 public:
  /// Each that is not left out, with a probability of a half.
  Features(Chance chance, const std::vector<Feature>& without);
  [[nodiscard]] bool has(Feature feature) const { return has_[static_cast<std::size_t>(feature)]; }
  /// "joints, limits, heap"; "nothing" for none.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<bool> has_;
};

}  // namespace plumb::harness
