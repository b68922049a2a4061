#include "host_world.hpp"

#include <vector>

namespace plumb {
namespace {

/// Calls a function of the table that fills an array, with an array that is long enough.
template <class Row, class Fill>
PlumbResult fill_all(std::vector<Row>& rows, Fill&& fill) {
  std::uint32_t count = 0;
  rows.resize(rows.capacity());
  PlumbResult result = fill(rows.data(), static_cast<std::uint32_t>(rows.size()), &count);
  while (result == PLUMB_TRUNCATED) {
    rows.resize(count);
    result = fill(rows.data(), count, &count);
  }
  rows.resize(result < 0 ? 0 : count);
  return result;
}

template <class Element>
std::uint32_t count_of(std::span<Element> elements) {
  return static_cast<std::uint32_t>(elements.size());
}

template <class Id>
const Id* ids_or_null(std::span<const Id> ids) {
  return ids.empty() ? nullptr : ids.data();
}

/// The tables of a backend's extensions; null of those that it lacks.
struct Extensions {
  const PlumbJointsTable* joints;
  const PlumbQueriesTable* queries;
  const PlumbCollideTable* collide;
  const PlumbDebugTable* debug;
  const PlumbSettingsTable* settings;
  const PlumbSnapshotTable* snapshot;
  const PlumbStateTable* state;
  const PlumbExceptionsTable* exceptions;
  const PlumbModifyTable* modify;
  const PlumbManifoldsTable* manifolds;
  const PlumbWorldsTable* worlds;
  const PlumbClosestTable* closest;
  const PlumbCookingTable* cooking;
};

class HostWorld final : public IPhysicsWorld,
                        private IJoints,
                        private IQueries,
                        private ICollide,
                        private IDebug,
                        private ISettings,
                        private ISnapshot,
                        private IState,
                        private IExceptions,
                        private IModify,
                        private IManifolds,
                        private IWorlds,
                        private IClosest,
                        private ICooking {
 public:
  HostWorld(const PlumbBackendTable& table, PlumbWorld* world)
      : table_(table),
        world_(world),
        extensions_{find<PlumbJointsTable>(PLUMB_EXT_JOINTS),     find<PlumbQueriesTable>(PLUMB_EXT_QUERIES),
                    find<PlumbCollideTable>(PLUMB_EXT_COLLIDE),   find<PlumbDebugTable>(PLUMB_EXT_DEBUG),
                    find<PlumbSettingsTable>(PLUMB_EXT_SETTINGS), find<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT),
                    find<PlumbStateTable>(PLUMB_EXT_STATE),       find<PlumbExceptionsTable>(PLUMB_EXT_EXCEPTIONS),
                    find<PlumbModifyTable>(PLUMB_EXT_MODIFY),     find<PlumbManifoldsTable>(PLUMB_EXT_MANIFOLDS),
                    find<PlumbWorldsTable>(PLUMB_EXT_WORLDS),     find<PlumbClosestTable>(PLUMB_EXT_CLOSEST),
                    find<PlumbCookingTable>(PLUMB_EXT_COOKING)} {}
  ~HostWorld() override { table_.destroy_world(world_); }

  // --- core ----------------------------------------------------------------------------------------------------------

  PlumbResult create_shapes(std::span<const PlumbShapeDesc> descs, std::span<PlumbShape> ids) override {
    return table_.create_shapes(world_, descs.data(), sizeof(PlumbShapeDesc), count_of(descs), ids.data());
  }
  PlumbResult destroy_shapes(std::span<const PlumbShape> ids) override {
    return table_.destroy_shapes(world_, ids.data(), count_of(ids));
  }
  PlumbResult create_bodies(std::span<const PlumbBodyDesc> descs, std::span<PlumbBody> ids) override {
    return table_.create_bodies(world_, descs.data(), sizeof(PlumbBodyDesc), count_of(descs), ids.data());
  }
  PlumbResult destroy_bodies(std::span<const PlumbBody> ids) override {
    return table_.destroy_bodies(world_, ids.data(), count_of(ids));
  }
  PlumbResult read(PlumbField field, std::span<const PlumbBody> ids, Rows rows) override {
    return table_.read(world_, field, rows.type(), ids_or_null(ids), static_cast<std::uint32_t>(rows.count()),
                       rows.data(), rows.stride());
  }
  PlumbResult write(PlumbField field, std::span<const PlumbBody> ids, ConstRows rows) override {
    return table_.write(world_, field, rows.type(), ids_or_null(ids), static_cast<std::uint32_t>(rows.count()),
                        rows.data(), rows.stride());
  }
  PlumbResult set_gravity(const PlumbVec3& gravity) override { return table_.set_gravity(world_, &gravity); }
  PlumbResult step(double dt) override {
    const PlumbStepDesc desc = {sizeof desc, 0, dt};
    return table_.step(world_, &desc);
  }
  PlumbResult wait(PlumbStepReport& report) override {
    report.struct_size = sizeof report;
    return table_.wait(world_, &report);
  }
  std::span<const PlumbContact> contacts() override {
    check(*this, fill_all(contact_rows_, [this](PlumbContact* out, std::uint32_t capacity, std::uint32_t* count) {
      return table_.contacts(world_, out, sizeof *out, capacity, count);
    }));
    return contact_rows_;
  }
  std::span<const PlumbEvent> events() override {
    check(*this, fill_all(event_rows_, [this](PlumbEvent* out, std::uint32_t capacity, std::uint32_t* count) {
      return table_.events(world_, out, sizeof *out, capacity, count);
    }));
    return event_rows_;
  }
  std::span<const PlumbBody> bodies() override {
    check(*this, fill_all(body_ids_, [this](PlumbBody* out, std::uint32_t capacity, std::uint32_t* count) {
      return table_.list_bodies(world_, out, capacity, count);
    }));
    return body_ids_;
  }
  PlumbResult hash(std::uint64_t& value) override {
    return extensions_.snapshot == nullptr ? PLUMB_E_UNSUPPORTED : extensions_.snapshot->hash(world_, &value);
  }
  [[nodiscard]] std::string error_text() const override { return table_.error_text(world_); }

  IJoints* joints() override { return extensions_.joints == nullptr ? nullptr : this; }
  IQueries* queries() override { return extensions_.queries == nullptr ? nullptr : this; }
  ICollide* collide() override { return extensions_.collide == nullptr ? nullptr : this; }
  IDebug* debug() override { return extensions_.debug == nullptr ? nullptr : this; }
  ISettings* settings() override { return extensions_.settings == nullptr ? nullptr : this; }
  ISnapshot* snapshot() override { return extensions_.snapshot == nullptr ? nullptr : this; }
  IState* state() override { return extensions_.state == nullptr ? nullptr : this; }
  IExceptions* exceptions() override { return extensions_.exceptions == nullptr ? nullptr : this; }
  IModify* modify() override { return extensions_.modify == nullptr ? nullptr : this; }
  IManifolds* manifolds() override { return extensions_.manifolds == nullptr ? nullptr : this; }
  IWorlds* worlds() override { return extensions_.worlds == nullptr ? nullptr : this; }
  IClosest* closest() override { return extensions_.closest == nullptr ? nullptr : this; }
  ICooking* cooking() override { return extensions_.cooking == nullptr ? nullptr : this; }

 private:
  // --- extensions ----------------------------------------------------------------------------------------------------

  PlumbResult create_joints(std::span<const PlumbJointDesc> descs, std::span<PlumbJoint> ids) override {
    return extensions_.joints->create(world_, descs.data(), sizeof(PlumbJointDesc), count_of(descs), ids.data());
  }
  PlumbResult destroy_joints(std::span<const PlumbJoint> ids) override {
    return extensions_.joints->destroy(world_, ids.data(), count_of(ids));
  }
  PlumbResult read_joints(PlumbJointField field, std::span<const PlumbJoint> ids, Rows rows) override {
    return extensions_.joints->read(world_, field, rows.type(), ids_or_null(ids),
                                    static_cast<std::uint32_t>(rows.count()), rows.data(), rows.stride());
  }
  PlumbResult write_joints(PlumbJointField field, std::span<const PlumbJoint> ids, ConstRows rows) override {
    return extensions_.joints->write(world_, field, rows.type(), ids_or_null(ids),
                                     static_cast<std::uint32_t>(rows.count()), rows.data(), rows.stride());
  }

  Hits cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) override {
    return collect([&](PlumbHit* hits, std::uint32_t capacity, std::uint32_t* count) {
      return extensions_.queries->rays(world_, mode, rays.data(), sizeof(PlumbRay), count_of(rays), hits, capacity,
                                       count);
    });
  }
  Hits cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) override {
    return collect([&](PlumbHit* hits, std::uint32_t capacity, std::uint32_t* count) {
      return extensions_.queries->casts(world_, mode, casts.data(), sizeof(PlumbCast), count_of(casts), hits, capacity,
                                        count);
    });
  }
  Hits overlap_shapes(std::span<const PlumbOverlap> overlaps) override {
    return collect([&](PlumbHit* hits, std::uint32_t capacity, std::uint32_t* count) {
      return extensions_.queries->overlaps(world_, overlaps.data(), sizeof(PlumbOverlap), count_of(overlaps), hits,
                                           capacity, count);
    });
  }
  Penetrations penetrations(std::span<const PlumbOverlap> overlaps) override {
    if (!has(*extensions_.queries, &PlumbQueriesTable::penetrations)) return {PLUMB_E_UNSUPPORTED, {}};
    thread_local std::vector<PlumbPenetration> found;
    const auto fill = [&](PlumbPenetration* out, std::uint32_t capacity, std::uint32_t* count) {
      return extensions_.queries->penetrations(world_, overlaps.data(), sizeof(PlumbOverlap), count_of(overlaps), out,
                                               capacity, count);
    };
    return {fill_all(found, fill), found};
  }

  Hits turning_casts(PlumbHitMode mode, std::span<const PlumbTurningCast> casts) override {
    if (!has(*extensions_.queries, &PlumbQueriesTable::turning_casts)) return {PLUMB_E_UNSUPPORTED, {}};
    return collect([&](PlumbHit* hits, std::uint32_t capacity, std::uint32_t* count) {
      return extensions_.queries->turning_casts(world_, mode, casts.data(), sizeof(PlumbTurningCast), count_of(casts),
                                                hits, capacity, count);
    });
  }

  PlumbResult create_cooked(std::span<const PlumbCookedShape> shapes, std::span<PlumbShape> ids) override {
    return extensions_.cooking->create(world_, shapes.data(), sizeof(PlumbCookedShape), count_of(shapes), ids.data());
  }

  ClosestBodies closest_bodies(PlumbHitMode mode, std::span<const PlumbProbe> probes) override {
    thread_local std::vector<PlumbClosest> found;
    const PlumbResult result = fill_all(found, [&](PlumbClosest* out, std::uint32_t capacity, std::uint32_t* count) {
      return extensions_.closest->bodies(world_, mode, probes.data(), sizeof(PlumbProbe), count_of(probes), out,
                                         capacity, count);
    });
    return {result, found};
  }

  PlumbResult collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                            std::span<const PlumbPairPoint>& points) override {
    thread_local std::vector<PlumbPairPoint> found;
    const PlumbResult result = fill_all(found, [&](PlumbPairPoint* out, std::uint32_t capacity, std::uint32_t* count) {
      return extensions_.collide->pairs(world_, pairs.data(), sizeof(PlumbPosedPair), count_of(pairs), results.data(),
                                        out, capacity, count);
    });
    points = found;
    return result;
  }

  PlumbResult candidate_pairs(std::span<const PlumbDebugPair>& pairs) override {
    return look(extensions_.debug->pairs, debug_pairs_, pairs);
  }
  PlumbResult tree_boxes(std::span<const PlumbDebugBox>& boxes) override {
    return look(extensions_.debug->boxes, debug_boxes_, boxes);
  }
  PlumbResult separating_axes(std::span<const PlumbDebugAxis>& axes) override {
    return look(extensions_.debug->axes, debug_axes_, axes);
  }
  PlumbResult body_states(std::span<const PlumbDebugBody>& bodies) override {
    if (!has(*extensions_.debug, &PlumbDebugTable::bodies)) return PLUMB_E_UNSUPPORTED;
    return look(extensions_.debug->bodies, debug_bodies_, bodies);
  }
  PlumbResult solved_constraints(std::span<const PlumbDebugConstraint>& constraints) override {
    if (!has(*extensions_.debug, &PlumbDebugTable::constraints)) return PLUMB_E_UNSUPPORTED;
    return look(extensions_.debug->constraints, debug_constraints_, constraints);
  }

  PlumbResult get_setting(const char* name, PlumbSettingValue& value) override {
    return extensions_.settings->get(world_, name, &value);
  }
  PlumbResult set_setting(const char* name, const PlumbSettingValue& value) override {
    return extensions_.settings->set(world_, name, &value);
  }

  PlumbResult save(std::span<const std::byte>& data) override { return save_by(extensions_.snapshot->save, data); }
  PlumbResult save_world(std::span<const std::byte>& data) override {
    if (!has(*extensions_.snapshot, &PlumbSnapshotTable::save_world)) return PLUMB_E_UNSUPPORTED;
    return save_by(extensions_.snapshot->save_world, data);
  }
  PlumbResult restore(std::span<const std::byte> data) override {
    return extensions_.snapshot->restore(world_, data.data(), data.size());
  }

  PlumbResult borrow(const PlumbStateRequest& request, PlumbDLManagedTensor*& tensor, PlumbFence* fence) override {
    return extensions_.state->borrow(world_, &request, &tensor, fence);
  }
  PlumbResult row_map(std::span<const PlumbBody>& ids, std::uint64_t& generation) override {
    const PlumbResult result = fill_all(row_ids_, [&](PlumbBody* out, std::uint32_t capacity, std::uint32_t* count) {
      return extensions_.state->rows(world_, out, capacity, count, &generation);
    });
    ids = row_ids_;
    return result;
  }

  PlumbResult set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) override {
    return extensions_.exceptions->set(world_, pairs.data(), sizeof(PlumbBodyPair), count_of(pairs), touch ? 1 : 0);
  }
  PlumbResult modify_bodies(std::span<const PlumbBodyChange> changes) override {
    return extensions_.modify->bodies(world_, changes.data(), sizeof(PlumbBodyChange), count_of(changes));
  }
  PlumbResult modify_joints(std::span<const PlumbJointChange> changes) override {
    return extensions_.modify->joints(world_, changes.data(), sizeof(PlumbJointChange), count_of(changes));
  }
  PlumbResult modify_shapes(std::span<const PlumbShape> shapes, std::span<const PlumbShapeDesc> descs) override {
    if (!has(*extensions_.modify, &PlumbModifyTable::shapes)) return PLUMB_E_UNSUPPORTED;
    return extensions_.modify->shapes(world_, shapes.data(), descs.data(), sizeof(PlumbShapeDesc), count_of(descs));
  }
  PlumbResult read_manifolds(std::span<const PlumbManifold>& manifolds) override {
    const PlumbResult result =
        fill_all(manifold_rows_, [this](PlumbManifold* out, std::uint32_t capacity, std::uint32_t* count) {
          return extensions_.manifolds->read(world_, out, sizeof *out, capacity, count);
        });
    manifolds = manifold_rows_;
    return result;
  }
  PlumbResult modify_manifolds(std::span<const PlumbManifoldChange> changes) override {
    return extensions_.manifolds->modify(world_, changes.data(), sizeof(PlumbManifoldChange), count_of(changes));
  }
  PlumbResult list_exceptions(std::span<const PlumbBodyPair>& pairs) override {
    return look(extensions_.exceptions->list, exception_pairs_, pairs);
  }

  PlumbResult group(std::span<IPhysicsWorld* const> others) override {
    std::vector<PlumbWorld*> handles;
    for (IPhysicsWorld* other : others) {
      const auto* host_world = dynamic_cast<const HostWorld*>(other);
      if (host_world == nullptr || &host_world->table_ != &table_)
        throw Error(PLUMB_E_INVALID_ARGUMENT, "worlds of several backends, or none of a backend's, cannot be grouped");
      handles.push_back(host_world->world_);
    }
    return extensions_.worlds->group(world_, handles.data(), count_of(others));
  }
  PlumbResult borrow_all(const PlumbStateRequest& request, PlumbDLManagedTensor*& tensor, PlumbFence* fence) override {
    return extensions_.worlds->borrow_all(world_, &request, &tensor, fence);
  }

  // --- plumbing ------------------------------------------------------------------------------------------------------

  template <class Table>
  const Table* find(const char* name) const {
    return static_cast<const Table*>(table_.extension(name));
  }

  /// Queries may run on several threads at once, so each thread has its own rows.
  template <class Fill>
  static Hits collect(Fill&& fill) {
    thread_local std::vector<PlumbHit> found;
    const PlumbResult result = fill_all(found, fill);
    return {result, found};
  }

  /// At first with the room that earlier ones took: whoever saves each frame pays for one save.
  PlumbResult save_by(decltype(PlumbSnapshotTable::save) function, std::span<const std::byte>& data) {
    std::size_t size = 0;
    snapshot_bytes_.resize(snapshot_bytes_.capacity());
    PlumbResult result = function(world_, snapshot_bytes_.data(), snapshot_bytes_.size(), &size);
    if (result == PLUMB_TRUNCATED) {
      snapshot_bytes_.resize(size);
      result = function(world_, snapshot_bytes_.data(), size, &size);
    }
    snapshot_bytes_.resize(result < 0 ? 0 : size);
    data = snapshot_bytes_;
    return result;
  }

  template <class Row>
  PlumbResult look(PlumbResult (*function)(PlumbWorld*, Row*, std::uint32_t, std::uint32_t*), std::vector<Row>& storage,
                   std::span<const Row>& rows) {
    const PlumbResult result = fill_all(storage, [&](Row* out, std::uint32_t capacity, std::uint32_t* count) {
      return function(world_, out, capacity, count);
    });
    rows = storage;
    return result;
  }

  const PlumbBackendTable& table_;
  PlumbWorld* world_;
  const Extensions extensions_;
  std::vector<PlumbContact> contact_rows_;
  std::vector<PlumbEvent> event_rows_;
  std::vector<PlumbManifold> manifold_rows_;
  std::vector<PlumbBody> body_ids_, row_ids_;
  std::vector<PlumbDebugPair> debug_pairs_;
  std::vector<PlumbDebugBox> debug_boxes_;
  std::vector<PlumbDebugAxis> debug_axes_;
  std::vector<PlumbDebugBody> debug_bodies_;
  std::vector<PlumbDebugConstraint> debug_constraints_;
  std::vector<std::byte> snapshot_bytes_;
  std::vector<PlumbBodyPair> exception_pairs_;
};

}  // namespace

std::unique_ptr<IPhysicsWorld> adopt_world(const PlumbBackendTable& table, PlumbWorld* world) {
  return std::make_unique<HostWorld>(table, world);
}

}  // namespace plumb
