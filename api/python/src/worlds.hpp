// Worlds of one backend that are called together: each call goes to all of them, spread over threads, while Python's
// other threads run; steps by plumb.worlds/1 where the backend has it.
#pragma once

#include <deque>
#include <span>

#include "lent_rows.hpp"
#include "plumb/helpers/worlds.hpp"
#include "world.hpp"

namespace plumb::python {

class Worlds {
 public:
  /// Bodies by their place in the order of creation, in every world; none: all.
  using Places = py::array_t<std::uint32_t, py::array::c_style>;
  using Mask = py::array_t<bool, py::array::c_style>;

  /// worlds: at least one, all different. threads: as of StepTogether, and no more than there are worlds. Throws
  /// ValueError for worlds of several backends, and for different numbers of bodies.
  Worlds(py::tuple worlds, std::uint32_t threads);
  Worlds(const Worlds&) = delete;
  Worlds& operator=(const Worlds&) = delete;

  [[nodiscard]] py::array_t<std::uint64_t> bodies() const;
  void step(double dt);
  [[nodiscard]] const std::vector<Report>& reports() const { return reports_; }
  void mark();
  void reset(const Mask& mask);
  /// rows: [world][body][column].
  void read(PlumbField field, const std::optional<Places>& places, py::array rows);
  void write(PlumbField field, const std::optional<Places>& places, const py::array& rows, const Mask& mask);
  /// rows: [world][joint][column]; joints: handles, the same in every world.
  void read_joints(PlumbJointField field, const Handles& joints, py::array rows);
  void write_joints(PlumbJointField field, const Handles& joints, const py::array& rows, const Mask& mask);
  LentRows borrow(PlumbField field, std::int32_t device_type, bool allow_copy);

 private:
  struct Block;
  using Passages = std::deque<Passage>;  // where they stay as they lie

  /// Passes the gates of all, or throws, with the world's number, what the first that cannot be called now says.
  [[nodiscard]] Passages enter(const char* name);
  /// Calls act(i), which answers with a PlumbResult, for each world, on the threads. All are called, also where one
  /// fails; throws then, with the world's number, the Error of the first that did.
  template <class Act>
  void each(Act&& act);
  /// The same behind the gates, while other threads of Python run.
  template <class Act>
  void call(const char* name, Act&& act);

  [[nodiscard]] Block block_of(const py::array& rows, std::size_t count, std::uint32_t columns) const;
  [[nodiscard]] Block block_of(PlumbField field, const std::optional<Places>& places, const py::array& rows) const;
  [[nodiscard]] std::span<const bool> checked(const Mask& mask) const;
  [[nodiscard]] const PlumbWorldsTable* extension() const;
  void group();

  py::tuple kept_;  // whom worlds_ points to
  std::vector<World*> worlds_;
  std::vector<std::vector<PlumbBody>> ids_;  // by world, of when they came together
  helpers::StepTogether together_;
  std::vector<Report> reports_;     // of the last step; empty before the first
  std::vector<std::string> marks_;  // by world; empty before the first
};

}  // namespace plumb::python
