// Memory of the system: of the mechanisms that are solved exactly (joint_system.hpp).
#pragma once

#include "exec/memory.hpp"
#include "joints/joint_order.hpp"
#include "joints/joint_system.hpp"

namespace plumb::impulse {

class JointSystemMemory {
 public:
  struct Content {
    std::vector<SystemMechanism> mechanisms;  ///< in order of their columns
    std::vector<std::uint32_t> pushed;        ///< bodies, by place: mechanism after mechanism, and in each ascending
  };
  Content put(const OrderedJoints& ordered, const Table<BodyMass>& masses);

  [[nodiscard]] JointSystem view(const JointView& joints) {
    return {joints,
            base_,
            small_count_,
            mechanism_count_,
            mechanisms_.data(),
            level_first_.data(),
            entries_.data(),
            column_first_.data(),
            row_entries_.data(),
            row_first_.data(),
            products_.data(),
            product_first_.data(),
            scaled_.data(),
            whole_.data(),
            turned_.data(),
            body_count_,
            bodies_.data(),
            body_first_.data(),
            on_body_.data(),
            changes_.data()};
  }

 private:
  std::uint32_t base_ = 0, small_count_ = 0, mechanism_count_ = 0, body_count_ = 0;
  Buffer<SystemMechanism> mechanisms_;
  Buffer<std::uint32_t> level_first_, column_first_, row_entries_, row_first_, product_first_, bodies_, body_first_;
  Buffer<JointEntry> entries_;
  Buffer<JointProduct> products_;
  Buffer<JointOnBody> on_body_;
  Buffer<JointBlock> scaled_, whole_, turned_;
  Buffer<std::uint32_t> changes_;
};

}  // namespace plumb::impulse
