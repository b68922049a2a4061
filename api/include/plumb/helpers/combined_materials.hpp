// The coefficients of a pair by a rule of the game's. Unless somebody changes them friction is the geometric mean of
// both bodies', and restitution the larger (shapes.h).
#pragma once

#include <unordered_map>

#include "plumb/helpers/contact_modification.hpp"

namespace plumb::helpers {

/// The coefficient of a pair from those of its bodies; the same whichever of them comes first.
using CombineRule = double (*)(double a, double b);
[[nodiscard]] double geometric_mean(double a, double b);
[[nodiscard]] double average(double a, double b);
[[nodiscard]] double smaller(double a, double b);
[[nodiscard]] double larger(double a, double b);
[[nodiscard]] double product(double a, double b);

/// Of pairs of which both bodies are known here, and at least one has PLUMB_BODY_MODIFY_CONTACTS. What the rule gives
/// for restitution counts up to 1. Materials by triangle and of a compound's children are not seen.
class CombinedMaterials {
 public:
  static constexpr PlumbNeeds needs = PLUMB_NEED_COLLISION | PLUMB_NEED_CONTACT_MODIFICATION;

  explicit CombinedMaterials(CombineRule friction, CombineRule restitution = &larger)
      : friction_(friction), restitution_(restitution) {}

  /// What the body's material is from now on.
  void set(PlumbBody body, double friction, double restitution) { known_[body] = {friction, restitution}; }
  void remove(PlumbBody body) { known_.erase(body); }

  /// As ModifyContacts.
  void operator()(std::span<const PlumbManifold> manifolds, std::vector<PlumbManifoldChange>& changes) const;

 private:
  struct Coefficients {
    double friction, restitution;
  };
  CombineRule friction_, restitution_;
  std::unordered_map<PlumbBody, Coefficients> known_;
};

}  // namespace plumb::helpers
