// Who lives in a world and of what, as a snapshot of the whole has it (plumb.snapshot/1, save_world). Many bodies are
// made alike, and so are the joints of many machines: what they are made of is written once a kind.
#pragma once

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "plumb/backend/checks.hpp"
#include "slot_table.hpp"

namespace plumb::backend {

/// What a body is made of, beside where it is and how fast it goes. Equal bytes are equal bodies.
struct BodyKind {
  PlumbShape shape;
  PlumbMotion motion;
  std::uint32_t flags, locks, reserved;
  double mass_row[11];
  double pose[7];  ///< of static bodies; else 0
  double material[2], surface_velocity[3], gravity_scale[1], damping[2], filter[3], rolling_friction[2];
};
/// Likewise; the descriptor names no bodies and has no user_data.
struct JointKind {
  PlumbJointDesc desc;
  std::uint32_t enabled, reserved;
};

/// A shape that bodies have: restored where one of the same geometry lives under its handle.
struct SavedShape {
  PlumbShape shape;
  std::uint64_t content;  ///< hash of its geometry
};
struct SavedBody {
  std::uint64_t user_data;
  std::uint32_t kind, reserved;
};
struct SavedJoint {
  PlumbBody body_a, body_b;
  std::uint64_t user_data;
  std::uint32_t kind, reserved;
};

/// The kinds met so far.
template <class Kind>
class Kinds {
 public:
  /// The number of this one.
  std::uint32_t number(const Kind& kind) {
    if (!all_.empty() && same(all_[last_], kind)) return last_;
    const std::string_view bytes(reinterpret_cast<const char*>(&kind), sizeof kind);
    const auto [known, is_new] = numbers_.try_emplace(std::string(bytes), static_cast<std::uint32_t>(all_.size()));
    if (is_new) all_.push_back(kind);
    return last_ = known->second;
  }
  [[nodiscard]] std::vector<Kind> take() { return std::move(all_); }

  [[nodiscard]] static bool same(const Kind& a, const Kind& b) { return std::memcmp(&a, &b, sizeof(Kind)) == 0; }

 private:
  std::vector<Kind> all_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::uint32_t last_ = 0;
};

struct SavedWorld {
  PlumbNeeds needs = 0;
  std::uint64_t steps = 0;
  Slots body_slots, joint_slots;
  std::vector<SavedShape> shapes;
  std::vector<BodyKind> body_kinds;
  std::vector<SavedBody> bodies;  ///< in order of creation
  std::vector<JointKind> joint_kinds;
  std::vector<SavedJoint> joints;  ///< likewise

  [[nodiscard]] const BodyKind& kind_of_body(std::size_t i) const { return body_kinds[bodies[i].kind]; }
  [[nodiscard]] const JointKind& kind_of_joint(std::size_t i) const { return joint_kinds[joints[i].kind]; }

  [[nodiscard]] std::vector<std::byte> pack() const {
    std::vector<std::byte> bytes;
    each_part(*this, [&bytes](const auto& part) {
      const std::uint64_t count = part.size();
      const auto head = std::as_bytes(std::span(&count, 1));
      const auto rows = std::as_bytes(std::span(part));
      bytes.insert(bytes.end(), head.begin(), head.end());
      bytes.insert(bytes.end(), rows.begin(), rows.end());
    });
    return bytes;
  }
  /// Throws PLUMB_E_CORRUPT where the bytes are of no world.
  [[nodiscard]] static SavedWorld unpack(std::span<const std::byte> bytes) {
    SavedWorld world;
    each_part(world, [&bytes](auto& part) {
      using Row = typename std::decay_t<decltype(part)>::value_type;
      std::uint64_t count = 0;
      if (bytes.size() < sizeof count) refuse_it();
      std::memcpy(&count, bytes.data(), sizeof count);
      bytes = bytes.subspan(sizeof count);
      if (bytes.size() / sizeof(Row) < count) refuse_it();
      part.resize(static_cast<std::size_t>(count));
      if (count != 0) std::memcpy(static_cast<void*>(part.data()), bytes.data(), part.size() * sizeof(Row));
      bytes = bytes.subspan(part.size() * sizeof(Row));
    });
    if (!bytes.empty() || !world.is_consistent()) refuse_it();
    return world;
  }

 private:
  [[noreturn]] static void refuse_it() {
    refuse(PLUMB_E_CORRUPT, "the snapshot has bodies or joints that cannot be of one world");
  }
  template <class World, class F>
  static void each_part(World& world, const F& f) {
    std::vector<std::uint64_t> numbers = {world.needs, world.steps};
    f(numbers);
    if (numbers.size() != 2) refuse_it();
    if constexpr (!std::is_const_v<World>) {
      world.needs = numbers[0];
      world.steps = numbers[1];
    }
    f(world.body_slots.order);
    f(world.body_slots.free);
    f(world.joint_slots.order);
    f(world.joint_slots.free);
    f(world.shapes);
    f(world.body_kinds);
    f(world.bodies);
    f(world.joint_kinds);
    f(world.joints);
  }
  [[nodiscard]] bool is_consistent() const {
    const auto all = [](const auto& rows, const auto& holds) { return std::all_of(rows.begin(), rows.end(), holds); };
    const SlotTable<char> living(body_slots, std::vector<char>(body_slots.order.size()));
    return body_slots.are_distinct() && joint_slots.are_distinct() && bodies.size() == body_slots.order.size() &&
           joints.size() == joint_slots.order.size() &&
           all(bodies, [&](const SavedBody& body) { return body.kind < body_kinds.size(); }) &&
           all(joints, [&](const SavedJoint& joint) {
             return joint.kind < joint_kinds.size() && living.alive(joint.body_b) &&
                    (joint.body_a == 0 || living.alive(joint.body_a));
           });
  }
};

}  // namespace plumb::backend
