// The validation layer's check of each call, by the shape of its arguments.
#pragma once

#include <cmath>
#include <set>

#include "validation.hpp"

namespace plumb::layers {

template <Call call, class Desc>
PlumbResult ValidationLayer::run(CallTag<call>, ValidatedWorld& state, PlumbWorld* world, const Desc* descs,
                                 std::size_t stride, std::uint32_t count, std::uint64_t* ids) {
  require_descs(descs, stride, count);
  require_memory(ids, count, "ids");
  Canary canary(sizeof(std::uint64_t), sizeof(std::uint64_t), count);
  const PlumbResult result = next<call>()(world, descs, stride, count, reinterpret_cast<std::uint64_t*>(canary.data()));
  if (!canary.end_intact()) throw BackendError{"wrote more than " + std::to_string(count) + " ids"};
  if (result < 0) return result;
  if (const std::size_t i = canary.first_unwritten(count); i < count)
    throw BackendError{"left ids[" + std::to_string(i) + "] unwritten"};
  canary.copy_to(ids, count);
  const std::set<std::uint64_t> distinct(ids, ids + count);
  if (distinct.size() != count || distinct.contains(0)) throw BackendError{"gave ids that are null or not distinct"};
  if (CallTraits<call>::objects == Objects::bodies) state.bodies += count;
  return result;
}

template <Call call>
PlumbResult ValidationLayer::run(CallTag<call>, ValidatedWorld& state, PlumbWorld* world, const std::uint64_t* ids,
                                 std::uint32_t count) {
  require_memory(ids, count, "ids");
  const PlumbResult result = next<call>()(world, ids, count);
  if (result >= 0 && CallTraits<call>::objects == Objects::bodies) state.bodies -= count;
  return result;
}

inline void check_order(const PlumbBodyPair* pairs, std::size_t count) {
  const auto key = [](const PlumbBodyPair& pair) { return std::pair(slot_of(pair.body_a), slot_of(pair.body_b)); };
  for (std::size_t i = 0; i < count; ++i)
    if (slot_of(pairs[i].body_a) >= slot_of(pairs[i].body_b) || (i > 0 && key(pairs[i]) <= key(pairs[i - 1])))
      throw BackendError{"row " + std::to_string(i) + " breaks the order of body_a, body_b"};
}
template <class Row>
void check_order(const Row*, std::size_t) {}

template <Call call, class Row>
PlumbResult ValidationLayer::run(CallTag<call>, ValidatedWorld& state, PlumbWorld* world, Row* out,
                                 std::uint32_t capacity, std::uint32_t* count) {
  require_memory(out, capacity, "out");
  require_memory(count, 1, "count");
  Canary canary(sizeof(Row), sizeof(Row), capacity);
  std::uint32_t found = 0;
  const PlumbResult result = next<call>()(world, reinterpret_cast<Row*>(canary.data()), capacity, &found);
  if (!canary.end_intact()) throw BackendError{"wrote more than " + std::to_string(capacity) + " rows"};
  if (result < 0) return result;
  require_count(result, capacity, found);
  const std::uint32_t written = std::min(found, capacity);
  if (const std::size_t i = canary.first_unwritten(written); i < written)
    throw BackendError{"left row " + std::to_string(i) + " unwritten"};
  canary.copy_to(out, written);
  *count = found;
  check_order(out, written);
  if (call == Call::core_list_bodies && found != state.bodies)
    throw BackendError{"lists " + std::to_string(found) + " bodies where " + std::to_string(state.bodies) + " live"};
  return result;
}

inline void check_row(const PlumbContact& contact, std::size_t index, const PlumbContact*) {
  if (contact.body_a == 0 || contact.body_b == 0) throw BackendError{"row " + std::to_string(index) + " names no body"};
}
inline void check_row(const PlumbManifold& manifold, std::size_t index, const PlumbManifold*) {
  if (manifold.body_a == 0 || manifold.body_b == 0)
    throw BackendError{"row " + std::to_string(index) + " names no body"};
  if (manifold.point_count == 0 || manifold.point_count > PLUMB_MANIFOLD_POINTS)
    throw BackendError{"row " + std::to_string(index) + " has " + std::to_string(manifold.point_count) + " points"};
}
inline void check_row(const PlumbEvent& event, std::size_t index, const PlumbEvent* before) {
  if (event.type >= PLUMB_EVENT_COUNT)
    throw BackendError{"row " + std::to_string(index) + " is of type " + std::to_string(event.type) +
                       ", which is none"};
  const auto key = [](const PlumbEvent& e) {
    return std::tuple(e.type, slot_of(e.body_a), slot_of(e.body_b), slot_of(e.joint));
  };
  if (before != nullptr && key(event) < key(*before))
    throw BackendError{"row " + std::to_string(index) + " breaks the order of type, body_a, body_b, joint"};
}

template <Call call, class Row>
PlumbResult ValidationLayer::run(CallTag<call>, ValidatedWorld&, PlumbWorld* world, Row* out, std::size_t stride,
                                 std::uint32_t capacity, std::uint32_t* count) {
  require_memory(out, capacity, "out");
  require_memory(count, 1, "count");
  require_stride<Row>(stride, capacity, "out");
  Canary canary(sizeof(Row), stride, capacity);
  std::uint32_t found = 0;
  const PlumbResult result = next<call>()(world, reinterpret_cast<Row*>(canary.data()), stride, capacity, &found);
  if (!canary.end_intact()) throw BackendError{"wrote more than " + std::to_string(capacity) + " rows"};
  if (!canary.padding_intact()) throw BackendError{"wrote between the rows"};
  if (result < 0) return result;
  require_count(result, capacity, found);
  const std::uint32_t written = std::min(found, capacity);
  if (const std::size_t i = canary.first_unwritten(written); i < written)
    throw BackendError{"left row " + std::to_string(i) + " unwritten"};
  canary.copy_to(out, written);
  *count = found;
  const Row* before = nullptr;
  for (std::size_t i = 0; i < written; ++i) {
    const Row* row = reinterpret_cast<const Row*>(canary.row(i));
    check_row(*row, i, before);
    before = row;
  }
  return result;
}

template <Call call>
std::uint32_t columns_for(std::uint32_t field) {
  return CallTraits<call>::objects == Objects::joints ? joint_columns_of(field) : columns_of(field);
}

template <Call call>
PlumbResult ValidationLayer::run(CallTag<call>, ValidatedWorld&, PlumbWorld* world, std::uint32_t field,
                                 PlumbDataType type, const std::uint64_t* ids, std::uint32_t count, void* rows,
                                 std::size_t stride) {
  const std::size_t size = require_rows(columns_for<call>(field), type, rows, count, stride);
  Canary canary(size, stride, count);
  const PlumbResult result = next<call>()(world, field, type, ids, count, canary.data(), stride);
  if (!canary.end_intact()) throw BackendError{"wrote more than " + std::to_string(count) + " rows"};
  if (!canary.padding_intact()) throw BackendError{"wrote between the rows"};
  if (result < 0) return result;
  if (const std::size_t i = canary.first_unwritten(count); i < count)
    throw BackendError{"left row " + std::to_string(i) + " unwritten"};
  canary.copy_to(rows, count);
  return result;
}

template <Call call>
PlumbResult ValidationLayer::run(CallTag<call>, ValidatedWorld&, PlumbWorld* world, std::uint32_t field,
                                 PlumbDataType type, const std::uint64_t* ids, std::uint32_t count, const void* rows,
                                 std::size_t stride) {
  require_rows(columns_for<call>(field), type, rows, count, stride);
  return next<call>()(world, field, type, ids, count, rows, stride);
}

/// What was asked for, and what its answer is called.
struct Question {
  std::uint32_t queries;
  bool closest;
  const char *rows, *count;  ///< its arguments
  const char* found;         ///< what they hold
};

inline void check_found(const Question& asked, const PlumbHit* hits, std::uint32_t written) {
  const auto key = [](const PlumbHit& hit) { return std::tuple(hit.query, hit.fraction, slot_of(hit.body)); };
  for (std::uint32_t i = 0; i < written; ++i) {
    const std::string which = "hits[" + std::to_string(i) + "]";
    if (hits[i].query >= asked.queries)
      throw BackendError{which + " is of query " + std::to_string(hits[i].query) + ", which is none"};
    if (asked.closest && hits[i].query != i)
      throw BackendError{which + " is of query " + std::to_string(hits[i].query)};
    if (!asked.closest && hits[i].body == 0) throw BackendError{which + " names no body"};
    if (!(hits[i].body == 0 || (hits[i].fraction >= 0 && hits[i].fraction <= 1)))
      throw BackendError{which + ".fraction is " + std::to_string(hits[i].fraction) + ", not in 0..1"};
    if (!asked.closest && i > 0 && key(hits[i]) < key(hits[i - 1]))
      throw BackendError{which + " breaks the order of query, fraction, body"};
  }
}

inline void check_found(const Question& asked, const PlumbClosest* rows, std::uint32_t written) {
  const auto key = [](const PlumbClosest& row) { return std::tuple(row.probe, row.distance, slot_of(row.body)); };
  for (std::uint32_t i = 0; i < written; ++i) {
    const PlumbClosest& row = rows[i];
    const std::string which = "out[" + std::to_string(i) + "]";
    if (row.probe >= asked.queries)
      throw BackendError{which + " is of probe " + std::to_string(row.probe) + ", which is none"};
    if (asked.closest && row.probe != i) throw BackendError{which + " is of probe " + std::to_string(row.probe)};
    if (!asked.closest && row.body == 0) throw BackendError{which + " names no body"};
    if (row.body != 0 && !(row.distance >= 0))
      throw BackendError{which + ".distance is " + std::to_string(row.distance) + ", not 0 or above"};
    if (row.body != 0 && std::isnan(row.normal.x) != (row.distance == 0))
      throw BackendError{which + ".normal is " + (row.distance == 0 ? "told of what touches" : "NaN of what is apart")};
    if (!asked.closest && i > 0 && key(row) < key(rows[i - 1]))
      throw BackendError{which + " breaks the order of probe, distance, body"};
  }
}

inline void check_found(const Question& asked, const PlumbPenetration* rows, std::uint32_t written) {
  const auto key = [](const PlumbPenetration& row) { return std::tuple(row.query, -row.depth, slot_of(row.body)); };
  for (std::uint32_t i = 0; i < written; ++i) {
    const PlumbPenetration& row = rows[i];
    const std::string which = "out[" + std::to_string(i) + "]";
    if (row.query >= asked.queries)
      throw BackendError{which + " is of query " + std::to_string(row.query) + ", which is none"};
    if (row.body == 0) throw BackendError{which + " names no body"};
    if (!(row.depth >= 0)) throw BackendError{which + ".depth is " + std::to_string(row.depth) + ", not 0 or above"};
    if (const double length = std::hypot(row.normal.x, row.normal.y, row.normal.z); !(std::abs(length - 1) < 1e-3))
      throw BackendError{which + ".normal has length " + std::to_string(length)};
    if (i > 0 && key(row) < key(rows[i - 1])) throw BackendError{which + " breaks the order of query, depth, body"};
  }
}

// Forwards a query with a stand-in for its answer, and checks that.
template <class Row, class Forward>
PlumbResult checked_answer(const Question& asked, Row* rows, std::uint32_t capacity, std::uint32_t* count,
                           Forward&& forward) {
  require_memory(rows, capacity, asked.rows);
  require_memory(count, 1, asked.count);
  Canary canary(sizeof(Row), sizeof(Row), capacity);
  std::uint32_t found = 0;
  const PlumbResult result = forward(reinterpret_cast<Row*>(canary.data()), &found);
  if (!canary.end_intact()) throw BackendError{"wrote more than " + std::to_string(capacity) + " " + asked.rows};
  if (result < 0) return result;
  require_count(result, capacity, found);
  if (asked.closest && found != asked.queries)
    throw BackendError{"counts " + std::to_string(found) + " closest " + asked.found + " for " +
                       std::to_string(asked.queries) + " queries"};
  const std::uint32_t written = std::min(found, capacity);
  if (const std::size_t i = canary.first_unwritten(written); i < written)
    throw BackendError{std::string("left ") + asked.rows + "[" + std::to_string(i) + "] unwritten"};
  canary.copy_to(rows, written);
  *count = found;
  check_found(asked, rows, written);
  return result;
}

inline void require_hit_mode(PlumbHitMode mode) {
  if (mode != PLUMB_HIT_CLOSEST && mode != PLUMB_HIT_ALL)
    refuse_argument("mode is " + std::to_string(mode) + "; it must be PLUMB_HIT_CLOSEST or PLUMB_HIT_ALL");
}

template <Call call, class Query>
PlumbResult ValidationLayer::run(CallTag<call>, ValidatedWorld&, PlumbWorld* world, PlumbHitMode mode,
                                 const Query* queries, std::size_t stride, std::uint32_t count, PlumbHit* hits,
                                 std::uint32_t capacity, std::uint32_t* hit_count) {
  require_hit_mode(mode);
  require_memory(queries, count, "queries");
  require_stride<Query>(stride, count, "queries");
  return checked_answer({count, mode == PLUMB_HIT_CLOSEST, "hits", "hit_count", "hits"}, hits, capacity, hit_count,
                        [&](PlumbHit* out, std::uint32_t* found) {
                          return next<call>()(world, mode, queries, stride, count, out, capacity, found);
                        });
}

inline PlumbResult ValidationLayer::run(CallTag<Call::queries_overlaps>, ValidatedWorld&, PlumbWorld* world,
                                        const PlumbOverlap* overlaps, std::size_t stride, std::uint32_t count,
                                        PlumbHit* hits, std::uint32_t capacity, std::uint32_t* hit_count) {
  require_memory(overlaps, count, "overlaps");
  require_stride<PlumbOverlap>(stride, count, "overlaps");
  return checked_answer({count, false, "hits", "hit_count", "hits"}, hits, capacity, hit_count,
                        [&](PlumbHit* out, std::uint32_t* found) {
                          return next<Call::queries_overlaps>()(world, overlaps, stride, count, out, capacity, found);
                        });
}

inline PlumbResult ValidationLayer::run(CallTag<Call::queries_penetrations>, ValidatedWorld&, PlumbWorld* world,
                                        const PlumbOverlap* overlaps, std::size_t stride, std::uint32_t count,
                                        PlumbPenetration* out, std::uint32_t capacity, std::uint32_t* out_count) {
  require_memory(overlaps, count, "overlaps");
  require_stride<PlumbOverlap>(stride, count, "overlaps");
  return checked_answer({count, false, "out", "out_count", "bodies"}, out, capacity, out_count,
                        [&](PlumbPenetration* rows, std::uint32_t* found) {
                          return next<Call::queries_penetrations>()(world, overlaps, stride, count, rows, capacity,
                                                                    found);
                        });
}

inline PlumbResult ValidationLayer::run(CallTag<Call::closest_bodies>, ValidatedWorld&, PlumbWorld* world,
                                        PlumbHitMode mode, const PlumbProbe* probes, std::size_t stride,
                                        std::uint32_t count, PlumbClosest* out, std::uint32_t capacity,
                                        std::uint32_t* out_count) {
  require_hit_mode(mode);
  require_memory(probes, count, "probes");
  require_stride<PlumbProbe>(stride, count, "probes");
  return checked_answer({count, mode == PLUMB_HIT_CLOSEST, "out", "out_count", "bodies"}, out, capacity, out_count,
                        [&](PlumbClosest* rows, std::uint32_t* found) {
                          return next<Call::closest_bodies>()(world, mode, probes, stride, count, rows, capacity,
                                                              found);
                        });
}

}  // namespace plumb::layers
