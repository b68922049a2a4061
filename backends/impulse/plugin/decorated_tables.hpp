// A scope around every function of a backend's tables: it opens before a call comes in and closes when the call has
// gone out. A table with an entry that is not listed here does not compile, and an extension that is not listed is not
// served, so nothing can be forgotten.
#pragma once

#include <cstdint>
#include <string_view>

#include "plumb/plumb.h"

namespace plumb::impulse {

/// Around: a class without arguments to its constructor. A process has one decorated backend for each.
template <class Around>
class DecoratedTables {
 public:
  /// backend: its tables live as long as the process.
  static const PlumbBackendTable* of(const PlumbBackendTable& backend) {
    using Table = PlumbBackendTable;
    static const Table table = [&] {
      Table made =
          decorated<Table, &Table::info, &Table::capability, &Table::extension, &Table::create_world,
                    &Table::destroy_world, &Table::error_text, &Table::create_shapes, &Table::destroy_shapes,
                    &Table::create_bodies, &Table::destroy_bodies, &Table::list_bodies, &Table::user_data, &Table::read,
                    &Table::write, &Table::set_gravity, &Table::step, &Table::wait, &Table::contacts, &Table::events>(
              backend);
      made.extension = &extension;
      return made;
    }();
    return &table;
  }

 private:
  template <class Table>
  inline static Table plain{};

  template <auto kEntry>
  struct Call;
  template <class Table, class Result, class... Arguments, Result (*Table::*kEntry)(Arguments...)>
  struct Call<kEntry> {
    static Result call(Arguments... arguments) {
      [[maybe_unused]] const Around around;
      return (plain<Table>.*kEntry)(arguments...);
    }
  };

  template <class Table, auto... kEntries>
  static Table decorated(const Table& table) {
    static_assert(sizeof(Table) == 2 * sizeof(std::uint32_t) + sizeof...(kEntries) * sizeof(void (*)()),
                  "every entry of the table has to be listed");
    plain<Table> = table;
    Table made = table;
    ((made.*kEntries = &Call<kEntries>::call), ...);
    return made;
  }

  template <class Table, auto... kEntries>
  static const void* served(const char* name) {
    const void* table = plain<PlumbBackendTable>.extension(name);
    if (table == nullptr) return nullptr;
    static const Table made = decorated<Table, kEntries...>(*static_cast<const Table*>(table));
    return &made;
  }

  static const void* extension(const char* name) {
    using Closest = PlumbClosestTable;
    using Collide = PlumbCollideTable;
    using Cooking = PlumbCookingTable;
    using Debug = PlumbDebugTable;
    using Exceptions = PlumbExceptionsTable;
    using Joints = PlumbJointsTable;
    using Manifolds = PlumbManifoldsTable;
    using Modify = PlumbModifyTable;
    using Queries = PlumbQueriesTable;
    using SettingsTable = PlumbSettingsTable;
    using Snapshot = PlumbSnapshotTable;
    using State = PlumbStateTable;
    using Worlds = PlumbWorldsTable;
    const std::string_view wanted = name == nullptr ? "" : name;
    if (wanted == PLUMB_EXT_CLOSEST) return served<Closest, &Closest::bodies>(name);
    if (wanted == PLUMB_EXT_COLLIDE) return served<Collide, &Collide::pairs>(name);
    if (wanted == PLUMB_EXT_COOKING) return served<Cooking, &Cooking::cook, &Cooking::release, &Cooking::create>(name);
    if (wanted == PLUMB_EXT_DEBUG)
      return served<Debug, &Debug::pairs, &Debug::boxes, &Debug::axes, &Debug::bodies, &Debug::constraints>(name);
    if (wanted == PLUMB_EXT_EXCEPTIONS) return served<Exceptions, &Exceptions::set, &Exceptions::list>(name);
    if (wanted == PLUMB_EXT_JOINTS)
      return served<Joints, &Joints::create, &Joints::destroy, &Joints::read, &Joints::write>(name);
    if (wanted == PLUMB_EXT_MANIFOLDS) return served<Manifolds, &Manifolds::read, &Manifolds::modify>(name);
    if (wanted == PLUMB_EXT_MODIFY) return served<Modify, &Modify::bodies, &Modify::joints, &Modify::shapes>(name);
    if (wanted == PLUMB_EXT_QUERIES)
      return served<Queries, &Queries::rays, &Queries::casts, &Queries::overlaps, &Queries::penetrations,
                    &Queries::turning_casts>(name);
    if (wanted == PLUMB_EXT_SETTINGS)
      return served<SettingsTable, &SettingsTable::describe, &SettingsTable::get, &SettingsTable::set>(name);
    if (wanted == PLUMB_EXT_SNAPSHOT)
      return served<Snapshot, &Snapshot::save, &Snapshot::restore, &Snapshot::hash, &Snapshot::save_world>(name);
    if (wanted == PLUMB_EXT_STATE) return served<State, &State::borrow, &State::rows>(name);
    if (wanted == PLUMB_EXT_WORLDS) return served<Worlds, &Worlds::group, &Worlds::borrow_all>(name);
    return nullptr;
  }
};

}  // namespace plumb::impulse
