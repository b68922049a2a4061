// The guard of plumb.manifolds/1: only within a step, only what was read, and only numbers that a material could have.
#pragma once

#include "guarded_snapshot.hpp"

namespace plumb::backend {

class GuardedManifolds : public GuardedSnapshot {
 public:
  using GuardedSnapshot::GuardedSnapshot;

  PlumbResult read_manifolds(PlumbManifold* out, std::size_t stride, std::uint32_t capacity, std::uint32_t* count) {
    IManifolds& extension = require_manifolds("read");
    std::span<const PlumbManifold> manifolds;
    const PlumbResult remark = done(extension.read_manifolds(manifolds));
    const PlumbResult result = hand_out(manifolds, out, stride, capacity, count);
    manifolds_read_ = static_cast<std::uint32_t>(manifolds.size());
    return result == PLUMB_OK ? remark : result;
  }

  PlumbResult modify_manifolds(const PlumbManifoldChange* changes, std::size_t stride, std::uint32_t count) {
    IManifolds& extension = require_manifolds("modified");
    if (!manifolds_read_)
      refuse(PLUMB_E_WRONG_PHASE, "manifolds are modified before they are read; read them first, once for each modify");
    const std::vector<PlumbManifoldChange> adopted = adopt_rows(changes, stride, count, "changes");
    std::vector<bool> changed(*manifolds_read_);
    for (std::uint32_t i = 0; i < count; ++i) examine_manifold_change({"changes", i}, adopted[i], changed);
    const PlumbResult result = *manifolds_read_ == 0 ? PLUMB_OK : done(extension.modify_manifolds(adopted));
    manifolds_read_.reset();
    return result;
  }

 private:
  IManifolds& require_manifolds(const char* what) const {
    IManifolds& extension = require_extension(world_->manifolds(), PLUMB_EXT_MANIFOLDS);
    require_need(init_.desc.needs, PLUMB_NEED_CONTACT_MODIFICATION, true, "modifying contacts");
    if (!stepping_)
      refuse(PLUMB_E_WRONG_PHASE, std::string("manifolds are ") + what + " outside of a step; call step first");
    return extension;
  }

  void examine_manifold_change(const Where& where, const PlumbManifoldChange& change,
                               std::vector<bool>& changed) const {
    if (change.manifold >= changed.size())
      refuse_value(where, "manifold", change.manifold,
                   ("below " + std::to_string(changed.size()) + ", which is how many were read").c_str());
    if (changed[change.manifold])
      refuse(PLUMB_E_INVALID_ARGUMENT,
             where.member("manifold") + " is " + std::to_string(change.manifold) + " again; change it once");
    changed[change.manifold] = true;
    if (change.what == 0 || change.what >> PLUMB_MANIFOLD_CHANGE_COUNT != 0)
      refuse_value(where, "what", change.what, "PLUMB_MANIFOLD_ bits");
    for (std::uint32_t bit = 0; bit < PLUMB_MANIFOLD_CHANGE_COUNT; ++bit)
      if ((change.what >> bit & 1) != 0)
        require_capability(PLUMB_CAP_MANIFOLD, bit, 0,
                           std::string("way to modify a contact's ") + manifold_change_name(bit));
    const auto changes = [&](std::uint32_t what) { return (change.what & what) != 0; };
    const auto need = [&](std::uint32_t what, PlumbNeeds bit, const char* member) {
      require_need(init_.desc.needs, bit, changes(what), where.member(member));
    };
    need(PLUMB_MANIFOLD_FRICTION, PLUMB_NEED_FRICTION, "friction");
    need(PLUMB_MANIFOLD_RESTITUTION, PLUMB_NEED_RESTITUTION, "restitution");
    need(PLUMB_MANIFOLD_SURFACE_VELOCITY, PLUMB_NEED_SURFACE_VELOCITY, "surface_velocity");
    if (changes(PLUMB_MANIFOLD_FRICTION)) require_not_negative(where, "friction", change.friction);
    if (changes(PLUMB_MANIFOLD_RESTITUTION) && !(change.restitution >= 0 && change.restitution <= 1))
      refuse_value(where, "restitution", change.restitution, "from 0 to 1");
    if (changes(PLUMB_MANIFOLD_SURFACE_VELOCITY)) require_finite(where, "surface_velocity", change.surface_velocity);
  }
};

}  // namespace plumb::backend
