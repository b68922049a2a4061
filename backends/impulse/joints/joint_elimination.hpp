// In which order the joints of a mechanism are eliminated, worked out on the host when joints change.
//
// All joints of a mechanism are solved at once by a sparse L D L^T of their matrix J M^-1 J^T, whose block (i, j) is
// not 0 where joints i and j share a body that moves. A chain or a tree has hardly any fill in a good order (Baraff,
// "Linear-Time Dynamics using Lagrange Multipliers", SIGGRAPH 1996). Here joints go in rounds: each takes joints with
// few neighbours left of which no two are neighbours, so that those of a round are worked on at once; a chain of n
// joints takes about log2(n) rounds (cyclic reduction).
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace plumb::impulse {

/// A block of L below the diagonal.
struct JointEntry {
  std::uint32_t row, column;
};

/// What an entry (i, j) loses by an earlier column k: L(i, k) D(k) L(j, k)^T.
struct JointProduct {
  std::uint32_t left, right;  ///< entries (i, k) and (j, k)
};

/// One mechanism by itself. Joints are numbered from 0 on, in the order of their numbers in the world.
struct MechanismElimination {
  bool has_loop = false;   ///< through what stands still, too
  bool is_closed = false;  ///< has a loop of bodies that move
  bool too_full = false;   ///< it is solved joint by joint, and there is nothing below but its length
  std::uint32_t length =
      0;  ///< joints of the longest way through it that takes no joint twice, as long as it is a tree
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> level_first;
  std::vector<JointEntry> entries;  ///< by column
  std::vector<std::uint32_t> column_first;
  std::vector<JointProduct> products;  ///< by entry
  std::vector<std::uint32_t> product_first;
};

/// What of the whole is a mechanism's: its columns, level by level.
struct MechanismColumns {
  std::uint32_t first_level, level_end;
  std::uint32_t first_column, column_end;
};

/// All of a world, one mechanism after the other, by their first joints.
struct JointElimination {
  std::vector<std::uint32_t> order;       ///< the joints that are eliminated; rows and columns count in this order
  std::vector<std::uint32_t> one_by_one;  ///< joints of mechanisms that would fill too much, in order of their numbers
  std::vector<bool> in_loop;              ///< by joint: whether its mechanism has a loop, through what stands still too
  std::vector<bool> is_closed;            ///< by joint: MechanismElimination::is_closed
  std::vector<std::uint32_t> length;      ///< by joint: MechanismElimination::length
  std::vector<std::uint32_t> mechanism;   ///< by joint: the number of its mechanism
  std::vector<MechanismColumns> columns;  ///< of mechanisms that are eliminated
  std::vector<std::uint32_t> level_first;  ///< columns of each round, and the end
  std::vector<JointEntry> entries;         ///< by column
  std::vector<std::uint32_t> column_first;
  std::vector<std::uint32_t> row_entries;  ///< entries by row, ascending columns
  std::vector<std::uint32_t> row_first;
  std::vector<JointProduct> products;  ///< by entry
  std::vector<std::uint32_t> product_first;
};

/// The moving bodies of a joint.
using Join = std::pair<std::uint32_t, std::uint32_t>;

/// Mechanisms are eliminated one by one, and those of one shape alike: what was found for a shape is kept while there
/// is a mechanism of it, so that a joint that comes or goes has only its own mechanism worked out anew.
class JointEliminator {
 public:
  /// A body number of `none` is no body.
  [[nodiscard]] JointElimination eliminate(const std::vector<Join>& joins, std::uint32_t none);

 private:
  /// Of a mechanism's joints in their order both bodies, numbered as they first appear; or kNoBody.
  using Shape = std::vector<std::uint32_t>;
  struct Hash {
    std::size_t operator()(const Shape& shape) const;
  };
  struct Known {
    MechanismElimination elimination;
    std::uint64_t used = 0;  // in which call
  };

  std::unordered_map<Shape, Known, Hash> known_;
  std::uint64_t calls_ = 0;
};

}  // namespace plumb::impulse
