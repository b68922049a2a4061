// Bodies split into as many parts as they have contacts, and who the parts are: what the solver jacobi works on.
#pragma once

#include "bodies/step_counters.hpp"
#include "contacts/body_parts.hpp"
#include "contacts/colouring.hpp"
#include "exec/sort.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

class SplitBodies {
 public:
  void reserve(std::uint32_t bodies, std::uint32_t manifolds);
  /// Lists each body's contacts, in the order of the rows. Colours must be left out (Colouring::leave_out).
  void list(Executor& executor, const ContactCache& cache, const Velocity* velocities, const Proxy* proxies,
            const StepCounters* counters);
  [[nodiscard]] BodyParts parts() { return {ranges_.data(), sorted_ends_.data(), changes_.data()}; }

 private:
  std::uint32_t bodies_ = 0, ends_capacity_ = 0;
  Buffer<PartRange> ranges_;  // by body
  Buffer<std::uint32_t> end_count_, owners_, ends_, sorted_owners_, sorted_ends_;
  Buffer<PartChange> changes_;  // by end
  RadixSort<std::uint32_t> sort_;
};

}  // namespace plumb::impulse
