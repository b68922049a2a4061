// Joints with rows that do not always hold: which piece of its law each row is on, and the equations of that.
#pragma once

#include "joints/axis_memory.hpp"
#include "joints/joint_law.hpp"
#include "joints/joint_solve.hpp"

namespace plumb::impulse {

/// Rounds in a pass. Rows that would still change are few then, and are brought to what their laws allow.
inline constexpr std::uint32_t kMostRounds = 40;
/// In so many of them all rows change whose law asks for it. That is fast, but rows can undo each other for ever: then
/// in so many half of them change, another half in each round, and at last a quarter. (Judice, Pires, "A block
/// principal pivoting algorithm for large-scale strictly monotone linear complementarity problems", Computers Ops Res.
/// 21, 1994, go on with one row alone, which would take all mechanisms in turn.)
inline constexpr std::uint32_t kFreeRounds = 4, kHalfRounds = 12;
PLUMB_HD inline bool may_change(std::uint32_t joint, int row, std::uint32_t round) {
  constexpr std::uint32_t kFactor = 6;  // any will do, but with another no recorded bit stays
  std::uint32_t mixed = (joint * kFactor + static_cast<std::uint32_t>(row)) * 0x9e3779b9U + round * 0x85ebca6bU;
  mixed = (mixed ^ mixed >> 16) * 0x7feb352dU;
  mixed = mixed ^ mixed >> 15;
  if (round < kFreeRounds) return true;
  return (mixed & (round < kFreeRounds + kHalfRounds ? 1U : 3U)) == 0;
}

/// Beside JointWork.
struct AxisWork : AxisMemory {
  JointMatrix whole;  ///< K of all rows
  RowPiece piece[kJointRows];
  RowPiece reached[kJointRows];  ///< at the end of the pass over places
  RowLaw law[kJointRows];        ///< in this pass, of rows that do not always hold
  RowNumbers target;             ///< the speed of hard rows, the impulse without speed of others
  RowNumbers cfm;                ///< speed for a unit impulse by which a row yields; below 0: its impulse is its target
  RowNumbers spring;             ///< impulse of the spring in this sub-step
  RowNumbers before;             ///< speeds when the pass began
  RowNumbers borne;              ///< impulses when the step began
  std::uint32_t predicted;       ///< bits: rows that are taken to hold while contacts push
  std::uint32_t let_go;          ///< bits: of these, those that have not
  bool is_trusted;               ///< none of its island has let go in this step
  RowNumbers bend;  ///< what the speeds over a sub-step have beyond those now, where that was last looked at

  PLUMB_HD bool is_active(int row) const { return cfm[row] >= 0; }
  PLUMB_HD bool is_predicted(int row) const { return (predicted >> row & 1U) != 0; }
  /// Bits: rows that are.
  [[nodiscard]] PLUMB_HD std::uint32_t active() const {
    std::uint32_t rows = 0;
    PLUMB_UNROLL
    for (int i = 0; i < kJointRows; ++i) rows |= static_cast<std::uint32_t>(is_active(i)) << i;
    return rows;
  }
};

/// What the joint does to body b at frame b's origin, summed over a step. By slot.
struct JointReaction {
  Vec force, torque;             ///< N s, N m s
  Real counted[kJointRows];      ///< of the impulses in this sub-step
  Real spring_mass[kJointRows];  ///< against which the springs were made, kg or kg m2
  Real held_for[kJointRows];     ///< for how long rows that need not hold have, with force to spare, s
  Real way;                      ///< of the row whose number it is (is_of_way), rad or m
  std::uint32_t first_step;      ///< of the joint for which that was
};

struct AxisParts {
  const JointAxes* axes;     ///< by joint
  const JointDrive* drives;  ///< by slot
  AxisWork* work;            ///< by joint
  JointReaction* reactions;  ///< by slot
};

struct AxisView : JointView {
  AxisParts parts;

  PLUMB_HD JointReaction& reaction(std::uint32_t j) const { return parts.reactions[joints[j].slot]; }
  PLUMB_HD Real* total(std::uint32_t j) const { return impulses[joints[j].slot].along; }
};

PLUMB_HD inline bool is_held(const AxisView& view, std::uint32_t j, int row) {
  const int first = rows_of(view.joints[j].type);
  return row < first || view.parts.axes[j].row[row - first].coordinate == kLocked;
}

/// The row whose number is the way that it has gone, or -1. It is the last of its joint.
PLUMB_HD inline int row_of_way(const AxisView& view, std::uint32_t j) {
  const Joint& joint = view.joints[j];
  const int last = row_count(joint) - 1, first = rows_of(joint.type);
  return last >= first && is_of_way(view.parts.axes[j].row[last - first].kind) ? last : -1;
}

/// Whether a motor may be what holds a row.
PLUMB_HD inline bool is_driven(const AxisView& view, std::uint32_t j, int row) {
  const Joint& joint = view.joints[j];
  return view.parts.drives[joint.slot].max_force[view.parts.axes[j].row[row - rows_of(joint.type)].coordinate] > 0;
}

/// A row that has held for so long is taken to hold on while contacts push: one with a motor, which a new one is, too,
/// and one at a limit, s. What that costs where it is wrong: a step that is taken back.
inline constexpr Real kMotorHolds = Real(0.25), kLimitHolds = Real(0.05);
/// A row that was taken to hold, and moves at more than this, has let go, m/s or rad/s.
inline constexpr Real kLetsGo = Real(0.05);
/// A limit that contacts did not count on is held once more before bodies move where they would go beyond it by so
/// much, m or rad, and further than they are.
inline constexpr Real kPassesLimit = Real(3e-3);
/// A limit that was taken to hold may pull for the rest of the step, by so much of what it bore. Contacts that come to
/// rest push as if it held to the end, and would throw about a part that it has let go for the last of that.
inline constexpr Real kMostPull = Real(0.1);

/// Mass against which the spring of a row works, of the two bodies as they are by themselves: tension, which may be
/// great just then and soon be gone, is no mass. Where no turn is free the arms do not count.
PLUMB_HD inline Real spring_mass(const AxisView& view, std::uint32_t j, int row, const JointEnd& a, const JointEnd& b) {
  const Joint& joint = view.joints[j];
  const Real inverse_mass = view.inverse_mass(joint.body_a) + view.inverse_mass(joint.body_b);
  if (view.parts.axes[j].masses_alone != 0) return reciprocal_or_zero(inverse_mass);
  const Jacobian& rows = view.work[j].rows;
  const Vec &along = rows.direction(row), on_a = rows.on_a(row), on_b = rows.on_b(row);
  return reciprocal_or_zero(inverse_mass * dot(along, along) +
                            dot(view.own_inverse_inertia(joint.body_a, a.orientation) * on_a, on_a) +
                            dot(view.own_inverse_inertia(joint.body_b, b.orientation) * on_b, on_b));
}

/// Rows, errors and K where the bodies are now.
PLUMB_SHARED_CODE inline void refresh_axis_joint(const AxisView& view, std::uint32_t j) {
  const Joint& joint = view.joints[j];
  const JointAxes& axes = view.parts.axes[j];
  JointWork& work = view.work[j];
  AxisWork& own = view.parts.work[j];
  const JointEnd a = view.end(joint.body_a), b = view.end(joint.body_b);
  const JointPlace place = place_joint(joint, view.base(joint), a, b);
  const JointAxesPlace at = axes_of(joint, axes, place);
  all_errors(joint, axes, place, at, work.error);
  work.is_far_off = is_any_far_off(joint, axes, place, at);
  put_rows(work.rows, row_count(joint), joint_mass(view, joint, a, b), own.whole,
           [&](JointRow(&rows)[kJointRows]) { all_rows(joint, axes, place, at, rows); });
  own.forget();
  JointReaction& reaction = view.reaction(j);
  const bool is_new = reaction.first_step != joint.first_step;
  const int of_way = row_of_way(view, j);
  if (of_way >= 0) work.error[of_way] = is_new ? Real(0) : reaction.way;
  lanes_meet();
  if (!is_new) return;
  reaction.first_step = joint.first_step;
  reaction.way = 0;
  each_row(rows_of(joint.type), row_count(joint), [&](int i) {
    reaction.spring_mass[i] = spring_mass(view, j, i, a, b);
    reaction.held_for[i] = is_driven(view, j, i) ? kMotorHolds : Real(0);
  });
}

/// Bodies go on as they are for h seconds: the way of a row whose number it is.
PLUMB_HD inline void add_way(const AxisView& view, std::uint32_t j, Real h) {
  const int row = row_of_way(view, j);
  if (row < 0) return;
  const Joint& joint = view.joints[j];
  const Lanes speeds = speeds_now(view, j, view.velocity(joint.body_a), view.velocity(joint.body_b));
  each_row(row, row + 1, [&](int i) { view.reaction(j).way += h * of_row(speeds, i); });
  lanes_meet();
}

/// Over the sub-step, with velocities a and b. What is known of its way alone goes on as it does now.
PLUMB_HD inline Lanes speeds_over_places(const AxisView& view, std::uint32_t j, const JointPass& pass,
                                         const Velocity& a, const Velocity& b, const Lanes& now) {
  const Joint& joint = view.joints[j];
  const JointWork& work = view.work[j];
  const JointAxes& axes = view.parts.axes[j];
  const JointPlace place = place_joint(joint, view.base(joint), view.end_after(joint.body_a, a, pass.h),
                                       view.end_after(joint.body_b, b, pass.h));
  RowNumbers then;
  all_errors(joint, axes, place, then);
  const int first = rows_of(joint.type), of_way = row_of_way(view, j);
  return by_row(row_count(joint), [&](int i) {
    if (i == of_way) return of_row(now, i);
    Real moved = then[i] - work.error[i];
    if (i >= first && goes_round(axes.row[i - first].kind)) moved = wrapped(moved);
    return moved * pass.inverse_h;
  });
}

/// What a pass sees of the speeds. Places are not linear in them: the rounds of a pass work on one tangent, so that
/// what they try on the way does not matter. anew: at the speeds as they are.
PLUMB_HD inline Lanes row_speeds(const AxisView& view, std::uint32_t j, const JointPass& pass, const Velocity& a,
                                 const Velocity& b, bool anew) {
  AxisWork& own = view.parts.work[j];
  if (pass.kind != PassKind::kPlaces) return speeds_now(view, j, a, b);
  if (!anew) return speeds_now(view, j, a, b) + load_row(own.bend);
  Lanes speed;
  if (own.recall_speeds(a, b, speed)) return speed;
  const Lanes now = speeds_now(view, j, a, b);
  speed = cannot_see_ahead(view.work[j], a, b, pass.h) ? now : speeds_over_places(view, j, pass, a, b, now);
  store_row(own.bend, speed - now);
  own.keep_speeds(a, b, speed);
  return speed;
}

PLUMB_HD inline RowLaw law_of_row(const AxisView& view, std::uint32_t j, int row, const JointPass& pass) {
  const Joint& joint = view.joints[j];
  const AxisWork& own = view.parts.work[j];
  const Real x = view.work[j].error[row] - (pass.kind == PassKind::kMoved ? pass.h * own.before[row] : Real(0));
  RowLaw law = law_of_places(view.parts.axes[j], row - rows_of(joint.type), x, view.parts.drives[joint.slot],
                             view.reaction(j).spring_mass[row], pass);
  if (pass.kind != PassKind::kSpeeds) return law;
  law.lower = own.reached[row] == RowPiece::kLower ? Real(0) : -kHuge;
  law.upper = own.reached[row] == RowPiece::kUpper ? Real(0) : kHuge;
  law.spring = own.spring[row];
  law.drag = 0;
  return law;
}

/// The speed that a row which always holds should have. rate: at which its error is taken back.
PLUMB_HD inline Real speed_of_held(const AxisView& view, std::uint32_t j, int row, const JointPass& pass, Real rate) {
  const Real error = view.work[j].error[row];
  switch (pass.kind) {
    case PassKind::kSpeeds: return 0;
    case PassKind::kMoved: {  // whose way does not tell yet that bodies have moved
      const Real moved_at = row == row_of_way(view, j) ? Real(0) : view.parts.work[j].before[row];
      return moved_at - speed_of_error(rate, error);
    }
    default: return -speed_of_error(rate, error);
  }
}

/// The equation of a row that does not always hold, by the piece that it is on.
PLUMB_HD inline void put_equation(AxisWork& own, int row, Real share) {
  const RowLaw& law = own.law[row];
  const RowPiece piece = own.piece[row];
  if (is_hard(piece)) {
    own.target[row] = law.speed(piece);
    own.cfm[row] = share * own.whole(row, row);
  } else {
    own.target[row] = law.sign_of(piece) + law.spring;
    own.cfm[row] = law.drag > 0 ? Real(1) / law.drag : Real(-1);
  }
}

/// What brings an impulse that does not depend on the speed to where it should be; 0 of others.
PLUMB_HD inline Real jump_of(const AxisWork& own, int row, Real total) {
  return own.is_active(row) ? Real(0) : own.target[row] - total;
}

/// A pass begins: finds the piece on which each row is by itself, and its equation. jump: jump_of each.
PLUMB_SHARED_CODE inline void choose_first_pieces(const AxisView& view, std::uint32_t j, const JointPass& pass,
                                                  const Velocity& a, const Velocity& b, Real share, Lanes& jump) {
  const Joint& joint = view.joints[j];
  AxisWork& own = view.parts.work[j];
  const Real* total = view.total(j);
  const Real rate = pass.kind == PassKind::kSpeeds ? Real(0) : rate_of_error(view, joint, pass);
  Lanes speeds(0);
  if (!is_plain(joint)) speeds = row_speeds(view, j, pass, a, b, true);
  const bool turns = turns_far(a, b, pass.h);
  jump = by_row(row_count(joint), [&](int i) {
    const Real speed = of_row(speeds, i);
    own.before[i] = turns ? Real(0) : speed;
    if (is_held(view, j, i)) {
      own.piece[i] = RowPiece::kHeld;
      own.target[i] = speed_of_held(view, j, i, pass, rate);
      own.cfm[i] = share * own.whole(i, i);
      return Real(0);
    }
    RowLaw& law = own.law[i] = law_of_row(view, j, i, pass);
    const bool stays = own.is_predicted(i) && !is_driven(view, j, i) && law.has_limit();
    if (stays) law.pull = kMostPull * abs(own.borne[i]);
    own.piece[i] = stays ? law.nearer_limit() : law.piece(speed, total[i], own.whole(i, i));
    put_equation(own, i, share);
    return jump_of(own, i, total[i]);
  });
}

/// A later round: the piece on which each row is where the equations have led. Returns whether one is another than
/// before, or ought to be.
PLUMB_SHARED_CODE inline bool choose_next_pieces(const AxisView& view, std::uint32_t j, const JointPass& pass,
                                                 const Velocity& a, const Velocity& b, std::uint32_t round, Real share,
                                                 Lanes& jump) {
  const Joint& joint = view.joints[j];
  AxisWork& own = view.parts.work[j];
  const Real* total = view.total(j);
  const Lanes speeds = row_speeds(view, j, pass, a, b, false);
  bool changed = false;
  jump = by_row(row_count(joint), [&](int i) {
    if (is_held(view, j, i)) return Real(0);
    const RowPiece piece = own.law[i].next(own.piece[i], of_row(speeds, i), total[i]);
    if (piece != own.piece[i]) {
      changed = true;
      if (may_change(j, i, round)) {
        own.piece[i] = piece;
        put_equation(own, i, share);
      }
    }
    return jump_of(own, i, total[i]);
  });
  return any_row(changed);
}

/// One of the two. Returns whether a row is on another piece than before, or ought to be.
PLUMB_HD inline bool choose_pieces(const AxisView& view, std::uint32_t j, const JointPass& pass, const Velocity& a,
                                   const Velocity& b, std::uint32_t round, Real share, Lanes& jump) {
  if (round != 0) return choose_next_pieces(view, j, pass, a, b, round, share, jump);
  choose_first_pieces(view, j, pass, a, b, share, jump);
  return false;
}

/// The matrix of the rows that are active, others being 0.
PLUMB_HD inline BlockAtWork masked_matrix(const AxisWork& own, int n) {
  BlockAtWork matrix;
  const Lanes cfm = load_row(own.cfm);
  const Mask is_active = !(cfm < Lanes(0));
  count_rows(n, [&](int q) {
    const Lanes column = select(is_active, column_of(own.whole, q), Lanes(0));
    put_column(matrix, q, own.is_active(q) ? select(lanes_of(1U << q), column + cfm, column) : Lanes(0));
  });
  return matrix;
}

/// Which rows may let go in a step and are nonetheless taken to hold while contacts push: none of an island of which
/// one has, where the step is gone over again. is_pushed: by contacts.
PLUMB_HD inline void predict_rows(const AxisView& view, std::uint32_t j, bool is_pushed, bool is_repeat) {
  AxisWork& own = view.parts.work[j];
  own.predicted = own.let_go = 0;
  if (!is_repeat) own.is_trusted = true;
  if (!is_pushed || !own.is_trusted) return;
  own.predicted = rows_where(rows_of(view.joints[j].type), row_count(view.joints[j]), [&](int i) {
    own.borne[i] = view.total(j)[i];
    const Real least = is_driven(view, j, i) ? kMotorHolds : kLimitHolds;
    return !is_held(view, j, i) && view.reaction(j).held_for[i] >= least;
  });
}

/// Which rows hold while contacts push: those that always do, and those of which that is predicted. Others may be left
/// at a limit, or overcome, and what pushes as if they held would push too hard.
PLUMB_HD inline void choose_rows_met(const AxisView& view, std::uint32_t j) {
  AxisWork& own = view.parts.work[j];
  each_row(0, row_count(view.joints[j]), [&](int i) {
    const bool holds = is_held(view, j, i) || own.is_predicted(i);
    own.cfm[i] = holds ? view.work[j].share * own.whole(i, i) : Real(-1);
  });
}

/// After a pass over speeds: for how long rows have held now, and which have not as predicted.
PLUMB_HD inline void follow_rows(const AxisView& view, std::uint32_t j, const JointPass& pass) {
  const Joint& joint = view.joints[j];
  AxisWork& own = view.parts.work[j];
  JointReaction& reaction = view.reaction(j);
  Lanes speed(0);
  if (own.predicted != 0) speed = speeds_now(view, j, view.velocity(joint.body_a), view.velocity(joint.body_b));
  const std::uint32_t gone = rows_where(rows_of(joint.type), row_count(joint), [&](int i) {
    if (is_held(view, j, i)) return false;
    const RowLaw& law = own.law[i];
    reaction.held_for[i] = law.holds(own.piece[i], view.total(j)[i]) ? reaction.held_for[i] + pass.h : Real(0);
    if (!own.is_predicted(i) || is_hard(own.piece[i])) return false;
    const Real off = of_row(speed, i) - (is_driven(view, j, i) ? law.steady : Real(0));
    return off * off > kLetsGo * kLetsGo;
  });
  if (leads_lanes()) own.let_go |= gone;
}

/// Whether joint j, as its bodies move now, will have passed a limit in h seconds.
PLUMB_HD inline bool passes_limit(const AxisView& view, std::uint32_t j, Real h) {
  const Joint& joint = view.joints[j];
  const JointAxes& axes = view.parts.axes[j];
  const int first = rows_of(joint.type), end = row_count(joint);
  if (first == end) return false;
  const Lanes speeds = speeds_now(view, j, view.velocity(joint.body_a), view.velocity(joint.body_b));
  return rows_where(first, end, [&](int i) {
           if (is_held(view, j, i)) return false;
           const Real x = view.work[j].error[i];
           const Real then = beyond_limits(axes, i - first, x + h * of_row(speeds, i));
           return then > kPassesLimit && then > beyond_limits(axes, i - first, x);
         }) != 0;
}

/// How far the rows are from their equations, with the other sign. tikhonov: as JointWork's. A motor's row never counts
/// what it has gathered: nothing takes back how far its speed was off, and it would creep under load.
PLUMB_SHARED_CODE inline Lanes row_residuals(const AxisView& view, std::uint32_t j, const JointPass& pass,
                                             const Velocity& a, const Velocity& b, bool anew, Real tikhonov) {
  const AxisWork& own = view.parts.work[j];
  const Real* total = view.total(j);
  const Lanes speeds = row_speeds(view, j, pass, a, b, anew);
  return by_row(row_count(view.joints[j]), [&](int i) {
    const Real speed = of_row(speeds, i);
    if (!own.is_active(i)) return Real(0);
    if (own.piece[i] == RowPiece::kSteady) return -(speed - own.target[i]);
    if (is_hard(own.piece[i])) return -((speed - own.target[i]) + tikhonov * own.cfm[i] * total[i]);
    return -(speed + own.cfm[i] * (total[i] - own.target[i]));
  });
}

/// At the end of a pass, in which rows do not switch their piece of the law any more: what brings impulses to what the
/// laws allow.
PLUMB_HD inline Lanes settle_pieces(const AxisView& view, std::uint32_t j, const JointPass& pass) {
  const Joint& joint = view.joints[j];
  AxisWork& own = view.parts.work[j];
  const Real* total = view.total(j);
  const int first = rows_of(joint.type);
  return by_row(row_count(joint), [&](int i) {
    if (i < first || own.piece[i] == RowPiece::kHeld) return Real(0);
    const RowLaw& law = own.law[i];
    if (pass.kind == PassKind::kPlaces) {
      own.reached[i] = own.piece[i];
      own.spring[i] = is_hard(own.piece[i]) ? law.spring - law.drag * law.speed(own.piece[i])
                                            : total[i] - law.sign_of(own.piece[i]);
    }
    return law.allowed(own.piece[i], total[i]) - total[i];
  });
}

/// What a round solves: nothing more; the first equations; those of other pieces; or of the same where they lead to.
enum class RoundKind : std::uint8_t { kDone, kFirst, kNewPieces, kAnew };
PLUMB_HD constexpr bool has_new_matrix(RoundKind kind) { return kind != RoundKind::kAnew; }
PLUMB_HD constexpr bool has_new_tangent(RoundKind kind) { return kind != RoundKind::kNewPieces; }

/// Goes through the rounds of a pass, until no piece changes. Where some did, another tangent is taken there.
class RoundCount {
 public:
  PLUMB_HD std::uint32_t round() const { return round_; }
  PLUMB_HD RoundKind next(bool changed) {
    const std::uint32_t round = round_++;
    if (round == 0) return RoundKind::kFirst;
    if (changed && round < kMostRounds) return RoundKind::kNewPieces;
    if (changed || anew_ || round == 1) return RoundKind::kDone;
    anew_ = true;
    return RoundKind::kAnew;
  }

 private:
  std::uint32_t round_ = 0;
  bool anew_ = false;
};

/// One joint with rows that do not always hold, by itself, exactly. Changes the velocities given, and the total.
PLUMB_HD inline void solve_axis_rows(const AxisView& view, std::uint32_t j, const JointPass& pass, Velocity& a,
                                     Velocity& b) {
  const Joint& joint = view.joints[j];
  const AxisWork& own = view.parts.work[j];
  JointWork& work = view.work[j];
  Real* total = view.total(j);
  const int n = row_count(joint);
  const auto push = [&](const Lanes& change) {
    each_row(0, n, [&](int i) { total[i] = total[i] + of_row(change, i); });
    RowNumbers all;
    spread(change, all);
    push_joint(work, n, all, a, b);
  };
  RoundCount rounds;
  while (true) {
    Lanes jump;
    const bool changed = choose_pieces(view, j, pass, a, b, rounds.round(), pass.softness.gamma, jump);
    const RoundKind kind = rounds.next(changed);
    if (kind == RoundKind::kDone) break;
    push(jump);
    if (has_new_matrix(kind)) {
      lanes_meet();
      BlockAtWork matrix = masked_matrix(own, n);
      factor(matrix, n);
      copy_columns(matrix, n, work.factor);
      lanes_meet();
    }
    push(solved_lanes(work.factor, n, row_residuals(view, j, pass, a, b, has_new_tangent(kind), Real(1))));
  }
  push(settle_pieces(view, j, pass));
}

PLUMB_HD inline void solve_axis_joint(const AxisView& view, std::uint32_t j, const JointPass& pass) {
  const Joint& joint = view.joints[j];
  const Velocity a = view.velocity(joint.body_a), b = view.velocity(joint.body_b);
  Velocity new_a = a, new_b = b;
  solve_axis_rows(view, j, pass, new_a, new_b);
  store_bodies(view, j, a, b, new_a, new_b);
}

/// A sub-step begins, or a step.
PLUMB_HD inline void begin_reaction(const AxisView& view, std::uint32_t j, bool step) {
  JointReaction& reaction = view.reaction(j);
  if (step) reaction.force = reaction.torque = {0, 0, 0};
  each_row(0, kJointRows, [&](int i) { reaction.counted[i] = 0; });
}

/// Adds what the impulses have gained since this was called last, along the rows as they are.
PLUMB_HD inline void add_reaction(const AxisView& view, std::uint32_t j) {
  const Joint& joint = view.joints[j];
  const JointWork& work = view.work[j];
  JointReaction& reaction = view.reaction(j);
  const Real* total = view.total(j);
  RowNumbers gained;
  spread(by_row(row_count(joint),
                [&](int i) {
                  const Real before = reaction.counted[i];
                  reaction.counted[i] = total[i];
                  return total[i] - before;
                }),
         gained);
  if (!leads_lanes()) return;
  const Vec arm = rotate(view.end(joint.body_b).orientation, joint.frame_b.position);
  for (int i = 0; i < row_count(joint); ++i) {
    reaction.force += gained[i] * work.rows.direction(i);
    reaction.torque += gained[i] * (work.rows.on_b(i) - cross(arm, work.rows.direction(i)));
  }
}

}  // namespace plumb::impulse
