// The order in which joints are eliminated: against a plain elimination over sets, for mechanisms that come and go.
#include "joints/joint_elimination.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "math/real.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr std::uint32_t kNone = ~0U;

/// What is to come out, by definition: nothing is kept, nothing is shared.
struct Plain {
  using Sets = std::map<std::uint32_t, std::set<std::uint32_t>>;
  std::vector<std::vector<std::uint32_t>> rounds;  ///< of one mechanism after the other
  std::vector<std::size_t> levels_of;              ///< by mechanism: how many of those
  std::vector<std::uint32_t> one_by_one;
  std::map<std::uint32_t, bool> in_loop;
  Sets below;

  explicit Plain(const std::vector<Join>& joins) {
    std::vector<bool> done(joins.size());
    for (std::uint32_t first = 0; first < joins.size(); ++first) {
      if (done[first]) continue;
      std::set<std::uint32_t> members = {first};
      for (std::size_t before = 0; before != members.size();) {
        before = members.size();
        for (std::uint32_t j = 0; j < joins.size(); ++j)
          if (std::any_of(members.begin(), members.end(), [&](std::uint32_t m) { return shared(joins[m], joins[j]); }))
            members.insert(j);
      }
      for (const std::uint32_t j : members) done[j] = true;
      eliminate({members.begin(), members.end()}, joins);
    }
    std::sort(one_by_one.begin(), one_by_one.end());
  }

 private:
  static bool shared(const Join& a, const Join& b) {
    const auto on = [&](std::uint32_t body) { return body != kNone && (b.first == body || b.second == body); };
    return on(a.first) || on(a.second);
  }
  void eliminate(const std::vector<std::uint32_t>& members, const std::vector<Join>& joins) {
    std::set<std::uint32_t> bodies;
    Sets neighbours;
    std::size_t links = 0;
    for (const std::uint32_t j : members) {
      bodies.insert({joins[j].first, joins[j].second});
      for (const std::uint32_t body : {joins[j].first, joins[j].second})
        for (const std::uint32_t k : members) {
          if (k == j || body == kNone || !shared({body, kNone}, joins[k])) continue;
          ++links;
          neighbours[j].insert(k);
        }
    }
    for (const std::uint32_t j : members) {
      in_loop[j] = members.size() + 1 > bodies.size();
    }
    std::vector<std::vector<std::uint32_t>> own;
    Sets own_below;
    std::size_t products = 0;
    std::vector<std::uint32_t> left = members;
    bool too_full = links > 128 * members.size();
    while (!left.empty() && !too_full) {
      std::size_t most = ~std::size_t{0};
      for (const std::uint32_t j : left) most = std::min(most, neighbours[j].size());
      most = std::max<std::size_t>(most, 2);
      std::set<std::uint32_t> blocked;
      std::vector<std::uint32_t> round, later;
      for (const std::uint32_t j : left) {
        const bool goes = neighbours[j].size() <= most && !blocked.contains(j);
        (goes ? round : later).push_back(j);
        if (goes) blocked.insert(neighbours[j].begin(), neighbours[j].end());
      }
      for (const std::uint32_t j : round) {
        const std::set<std::uint32_t> around = neighbours[j];
        products += around.size() * (around.size() + 1) / 2;
        for (const std::uint32_t i : around) {
          neighbours[i].erase(j);
          for (const std::uint32_t k : around)
            if (k != i) neighbours[i].insert(k);
        }
        own_below[j] = around;
      }
      too_full = products > 64 * members.size();
      own.push_back(round);
      left = later;
    }
    if (too_full) {
      one_by_one.insert(one_by_one.end(), members.begin(), members.end());
      return;
    }
    levels_of.push_back(own.size());
    rounds.insert(rounds.end(), own.begin(), own.end());
    below.merge(own_below);
  }
};

using Numbers = std::vector<std::uint32_t>;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

void expect_as_plain(const JointElimination& found, const std::vector<Join>& joins) {
  const Plain plain(joins);
  Numbers order, level_first;
  for (const Numbers& round : plain.rounds) {
    level_first.push_back(static_cast<std::uint32_t>(order.size()));
    order.insert(order.end(), round.begin(), round.end());
  }
  level_first.push_back(static_cast<std::uint32_t>(order.size()));
  ASSERT_EQ(found.order, order);
  ASSERT_EQ(found.level_first, level_first);
  ASSERT_EQ(found.columns.size(), plain.levels_of.size());
  for (std::uint32_t m = 0, level = 0; m < found.columns.size(); ++m) {
    const MechanismColumns& columns = found.columns[m];
    EXPECT_EQ(columns.first_level, level) << m;
    level += static_cast<std::uint32_t>(plain.levels_of[m]);
    EXPECT_EQ(columns.level_end, level) << m;
    EXPECT_EQ(columns.first_column, level_first[columns.first_level]) << m;
    EXPECT_EQ(columns.column_end, level_first[level]) << m;
  }
  ASSERT_EQ(found.one_by_one, plain.one_by_one);
  for (std::uint32_t j = 0; j < joins.size(); ++j) {
    EXPECT_EQ(found.in_loop[j], plain.in_loop.at(j)) << j;
  }

  Numbers place(joins.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  Pairs entries, by_row;
  for (const std::uint32_t j : order) {
    Pairs column;
    for (const std::uint32_t i : plain.below.at(j)) column.emplace_back(place[i], place[j]);
    std::sort(column.begin(), column.end());
    entries.insert(entries.end(), column.begin(), column.end());
  }
  ASSERT_EQ(found.entries.size(), entries.size());
  ASSERT_EQ(found.column_first.size(), order.size() + 1);
  ASSERT_EQ(found.row_first.size(), order.size() + 1);
  for (std::uint32_t e = 0; e < entries.size(); ++e) {
    EXPECT_EQ(Join(found.entries[e].row, found.entries[e].column), entries[e]) << e;
    EXPECT_LE(found.column_first[entries[e].second], e);
    EXPECT_LT(e, found.column_first[entries[e].second + 1]);
  }
  for (std::uint32_t row = 0; row < order.size(); ++row)
    for (std::uint32_t i = found.row_first[row]; i < found.row_first[row + 1]; ++i) {
      EXPECT_EQ(entries[found.row_entries[i]].first, row);
      EXPECT_TRUE(i == found.row_first[row] || found.row_entries[i - 1] < found.row_entries[i]);
    }
  std::map<Join, Pairs> products;  // by place of what they change, in order of the column that they come from
  for (std::uint32_t column = 0; column < order.size(); ++column)
    for (std::uint32_t e = found.column_first[column]; e < found.column_first[column + 1]; ++e)
      for (std::uint32_t f = found.column_first[column]; f < e; ++f)
        products[{entries[e].first, entries[f].first}].emplace_back(e, f);
  ASSERT_EQ(found.product_first.size(), entries.size() + 1);
  for (std::uint32_t e = 0; e < entries.size(); ++e) {
    Pairs own;
    for (std::uint32_t p = found.product_first[e]; p < found.product_first[e + 1]; ++p)
      own.emplace_back(found.products[p].left, found.products[p].right);
    EXPECT_EQ(own, products[entries[e]]) << e;
  }
}

/// Trees, loops, stars and what hangs on the world, as n joints among a few bodies make them.
std::vector<Join> some_joins(Random& random, std::uint32_t n, std::uint32_t bodies) {
  std::vector<Join> joins;
  for (std::uint32_t j = 0; j < n; ++j) {
    const auto any = [&] { return static_cast<std::uint32_t>(random.next() % bodies); };
    const std::uint32_t a = any(), near = (a + 1 + static_cast<std::uint32_t>(random.next() % 3)) % bodies;
    joins.emplace_back(random.uniform() < 0.1 ? kNone : a, random.uniform() < 0.05 ? kNone : near);
  }
  return joins;
}

TEST(JointElimination, IsThatOfThePlainOne) {
  Random random(5);
  for (const auto& [n, bodies] : {std::pair{1U, 2U}, {5U, 6U}, {30U, 60U}, {60U, 55U}, {80U, 400U}, {150U, 40U}})
    for (int i = 0; i < 10; ++i) {
      const std::vector<Join> joins = some_joins(random, n, bodies);
      JointEliminator eliminator;
      expect_as_plain(eliminator.eliminate(joins, kNone), joins);
    }
}

/// A joint goes or comes between calls of one eliminator, which knows the mechanisms of the call before.
TEST(JointElimination, IsTheSameWhateverCameBefore) {
  Random random(9);
  JointEliminator eliminator;
  std::vector<Join> joins = some_joins(random, 60, 120);
  for (int i = 0; i < 60; ++i) {
    if (random.uniform() < 0.5 && !joins.empty())
      joins.erase(joins.begin() + static_cast<std::ptrdiff_t>(random.next() % joins.size()));
    else
      joins.push_back(some_joins(random, 1, 120).front());
    expect_as_plain(eliminator.eliminate(joins, kNone), joins);
  }
}

TEST(JointElimination, TakesAStarOfManyJointByJoint) {
  std::vector<Join> joins;
  for (std::uint32_t j = 1; j < 200; ++j) joins.emplace_back(0, j);
  joins.emplace_back(300, 301);
  JointEliminator eliminator;
  const JointElimination found = eliminator.eliminate(joins, kNone);
  EXPECT_EQ(found.one_by_one.size(), 199U);
  EXPECT_EQ(found.order, Numbers{199});
  expect_as_plain(found, joins);
}

/// Chains, a net and rings of boxes of which joints go and come back before every step.
std::uint64_t hash_of_coming_and_going(const Backend& backend) {
  Scene scene(backend, PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION,
              {0, -9.81, 0}, 1);
  const PlumbShape box = scene.box({0.2, 0.1, 0.15});
  constexpr std::uint32_t kSide = 14;
  std::vector<PlumbBody> bodies;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i)
    bodies.push_back(scene.add(box, {0.6 * (i % kSide), 0.5 * (i / kSide), 0}));
  std::vector<PlumbJointDesc> descs;
  const auto join = [&](PlumbJointType type, std::uint32_t a, std::uint32_t b) {
    PlumbJointDesc desc = joint_desc(type);
    desc.body_a = bodies[a];
    desc.body_b = bodies[b];
    const bool beside = b == a + 1;
    desc.frame_a.position = beside ? PlumbVec3{0.3, 0, 0} : PlumbVec3{0, 0.25, 0};
    desc.frame_b.position = beside ? PlumbVec3{-0.3, 0, 0} : PlumbVec3{0, -0.25, 0};
    descs.push_back(desc);
  };
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const std::uint32_t row = i / kSide;
    if (i % kSide + 1 < kSide) join(row % 3 == 0 ? PLUMB_JOINT_HINGE : PLUMB_JOINT_BALL, i, i + 1);
    if (row > 8 && row + 1 < kSide) join(PLUMB_JOINT_BALL, i, i + kSide);  // the net
    if (row == 2 && i % 4 == 0) join(PLUMB_JOINT_FIXED, i, i + kSide);
  }
  std::vector<PlumbJoint> joints(descs.size());
  check(scene.world(), scene.world().joints()->create_joints(descs, joints));
  Random random(12);
  for (int step = 0; step < 60; ++step) {
    for (int k = 0; k < 3; ++k) {
      const std::size_t j = random.next() % joints.size();
      if (joints[j] != 0) {
        check(scene.world(), scene.world().joints()->destroy_joints({&joints[j], 1}));
        joints[j] = 0;
      } else {
        check(scene.world(), scene.world().joints()->create_joints({&descs[j], 1}, {&joints[j], 1}));
      }
    }
    scene.run(1);
  }
  return scene.hash();
}

/// With the elimination that worked out all mechanisms anew whenever a joint came or went.
TEST(JointElimination, GivesTheBitsThatWereRecorded) {
  EXPECT_EQ(hash_of_coming_and_going(engine()), sizeof(Real) == 4 ? 0x14a65cf4f257572fU : 0x3d46585b245bfe9bU);
}

}  // namespace
}  // namespace plumb::impulse::test
