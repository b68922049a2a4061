// Contact modification (plumb.manifolds/1): what touches is shown to the host before it is solved, and changed as the
// host says. A step is two halves, and there is this memory, from the first body on that asks for it.
#pragma once

#include <span>

#include "bodies/body.hpp"
#include "contacts/contact_record.hpp"
#include "exec/executor.hpp"
#include "exec/sort.hpp"
#include "narrowphase/contact_cache.hpp"
#include "narrowphase/manifold_change.hpp"

namespace plumb::impulse {

/// A manifold as the host is shown it, and what it would be solved with.
struct ShownManifold {
  ContactRecord contact;  ///< without impulses
  Vec velocity;           ///< of b against a at the mean of the points, m/s
  Real friction, restitution;
  Vec surface_velocity;  ///< of b's against a's, m/s
};

class ContactModification {
 public:
  void reserve(std::uint32_t pairs);

  /// What there is to be shown.
  struct Input {
    ContactCache cache;
    Count candidates;
    Bodies bodies;
    Proxies proxies;
    const Vec* surface_velocities;  ///< by proxy, or null
  };
  /// Between the search for contacts and their numbering.
  void show(Executor& executor, const Input& input);
  /// When that is done: those of which one body asks for it, in the order of the candidates. They live until the next
  /// step.
  [[nodiscard]] std::span<const ShownManifold> shown(Executor& executor);
  [[nodiscard]] std::uint32_t shown_count() const { return *count_.host(); }

  /// What becomes of them: by row of shown(), as many as there are.
  void change(Executor& executor, std::span<const ManifoldChange> changes);
  /// Takes away those that are disabled, before they are numbered.
  void disable(Executor& executor, const ContactCache& cache, Count candidates);
  [[nodiscard]] ManifoldChanges changes() { return {is_shown_.data(), place_.data(), changes_.device()}; }

 private:
  Scan scan_;
  Buffer<std::uint32_t> is_shown_, place_;  // by candidate
  Mirror<ShownManifold> shown_;
  Mirror<ManifoldChange> changes_;
  Mirror<std::uint32_t> count_;
};

}  // namespace plumb::impulse
