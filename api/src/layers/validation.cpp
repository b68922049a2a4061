// The validation layer: entering and leaving a call, the phases, and what is seen around every call.
#include "validation.hpp"

#include "validation_calls.hpp"
#include "validation_single_calls.hpp"

namespace plumb::layers {
namespace {

// Text of this thread's last failed create_world, as error_text(null) answers it.
thread_local std::string creation_text;

bool is_loss(PlumbResult result) { return result == PLUMB_E_WORLD_LOST || result == PLUMB_E_DEVICE_LOST; }

std::string text_for(Call call, const std::string& text) { return std::string(name_of(call)) + ": " + text; }

// Refusals of negotiation are no answer to a call.
bool is_result(PlumbResult result) {
  return result >= PLUMB_E_DEVICE_LOST && result <= PLUMB_COPIED && result != PLUMB_E_VERSION &&
         result != PLUMB_E_EXCLUDED;
}

bool is_allowed(Remarks allowed, PlumbResult result) {
  switch (result) {
    case PLUMB_TRUNCATED: return allowed == Remarks::may_truncate;
    case PLUMB_GROWN: return allowed == Remarks::may_grow;
    case PLUMB_COPIED: return allowed == Remarks::may_copy;
    default: return true;
  }
}

}  // namespace

template <Call call, class... Args>
PlumbResult ValidationLayer::on_world_call(PlumbWorld* world, Args... args) {
  const auto forward = [&](ValidatedWorld& state) { return run(CallTag<call>(), state, world, args...); };
  return checked_call(call, CallTraits<call>::thread, CallTraits<call>::remarks, world, std::ref(forward));
}

PlumbResult ValidationLayer::checked_call(Call call, Thread thread, Remarks remarks, PlumbWorld* world,
                                          const std::function<PlumbResult(ValidatedWorld&)>& forward) {
  const std::shared_ptr<ValidatedWorld> state = find(world);
  if (state == nullptr || state->destroyed) {
    const std::string text = text_for(call, world == nullptr   ? "world is null"
                                            : state == nullptr ? "world is none that this backend made"
                                                               : "world has been destroyed");
    note(FindingKind::host_mistake, text);
    if (state != nullptr) state->set_text(text);
    creation_text = text;
    return PLUMB_E_INVALID_ARGUMENT;
  }
  const auto fail = [&](FindingKind kind, PlumbResult code, const std::string& text) {
    note(kind, text_for(call, text));
    if (state->lost == PLUMB_OK) state->set_text(text_for(call, text));
    return code;
  };
  try {
    const Visit visit(*state, thread);
    enter(call, *state, visit);
    const PlumbResult result = forward(*state);
    judge(call, remarks, *state, world, result);
    return result;
  } catch (const HostError& error) {
    return fail(FindingKind::host_mistake, error.code, error.text);
  } catch (const BackendError& error) {
    return fail(FindingKind::backend_mistake, PLUMB_E_INTERNAL, std::string("the backend ") + error.text);
  }
}

void ValidationLayer::enter(Call call, ValidatedWorld& world, const Visit& visit) {
  if (!visit.entered())
    throw HostError{PLUMB_E_WRONG_THREAD, "another thread is in this world; one caller at a time, please"};
  if (is_loss(world.lost)) throw HostError{world.lost, "the world is lost; only destroy_world and error_text are left"};
  const bool of_manifolds = call == Call::manifolds_read || call == Call::manifolds_modify;
  if (world.stepping && call != Call::core_wait && !of_manifolds)
    throw HostError{PLUMB_E_WRONG_PHASE, "called between step and wait; call wait first"};
  if (!world.stepping && of_manifolds)
    throw HostError{PLUMB_E_WRONG_PHASE, "called outside of a step; call step first"};
  if (!world.stepping && call == Call::core_wait)
    throw HostError{PLUMB_E_WRONG_PHASE, "called without a step to wait for; call step first"};
}

void ValidationLayer::judge(Call call, Remarks allowed, ValidatedWorld& world, PlumbWorld* handle, PlumbResult result) {
  if (!is_result(result)) throw BackendError{"answered " + std::to_string(result) + ", which is no result of a call"};
  if (!is_allowed(allowed, result))
    throw BackendError{"answered the remark " + std::to_string(result) + ", which is not this call's"};
  if (result < 0) {
    const char* text = next_core()->error_text(handle);
    world.set_text(text == nullptr ? "" : text);
    if (is_loss(result)) world.lost = result;
    if (text == nullptr || *text == '\0')
      note(FindingKind::backend_mistake, text_for(call, "the backend failed without a word of why"));
    if (is_loss(result)) return;
  }
  // Queries change nothing, and others may run beside them; a step that runs must not be disturbed.
  const bool changes = result < 0 || call == Call::core_create_bodies || call == Call::core_destroy_bodies;
  if (changes && !world.stepping && world.inside.load() < 0)
    check_body_count(world, handle, result < 0 ? "has failed" : "is done");
}

void ValidationLayer::check_body_count(ValidatedWorld& world, PlumbWorld* handle, const std::string& when) {
  if (!has(*next_core(), &PlumbBackendTable::list_bodies)) return;
  std::uint32_t count = 0;
  if (next_core()->list_bodies(handle, nullptr, 0, &count) < 0) return;
  if (count == world.bodies) return;
  const std::uint32_t expected = world.bodies;
  world.bodies = count;  // said once
  throw BackendError{"has " + std::to_string(count) + " bodies after the call " + when + "; it should be " +
                     std::to_string(expected)};
}

PlumbResult ValidationLayer::create_world(const PlumbWorldDesc* desc, PlumbWorld** world) {
  try {
    require_memory(desc, 1, "desc");
    require_memory(world, 1, "world");
    require_struct_size(*desc, UINT32_MAX, "desc");
    require_memory(desc->settings, desc->setting_count, "desc.settings");
    for (std::uint32_t i = 0; i < desc->setting_count; ++i)
      require_memory(desc->settings[i].name, 1, "desc.settings.name");
    PlumbWorld* made = nullptr;
    const PlumbResult result = next<Call::core_create_world>()(desc, &made);
    if (!is_result(result) || result > 0) throw BackendError{"answered " + std::to_string(result)};
    if (result < 0) {
      const char* text = next_core()->error_text(nullptr);
      creation_text = text == nullptr ? "" : text;
      if (creation_text.empty())
        note(FindingKind::backend_mistake, "create_world: the backend failed without a word of why");
      return result;
    }
    if (made == nullptr) throw BackendError{"made no world"};
    const std::lock_guard lock(mutex_);
    worlds_[made] = std::make_shared<ValidatedWorld>();
    *world = made;
    return result;
  } catch (const HostError& error) {
    note(FindingKind::host_mistake, creation_text = text_for(Call::core_create_world, error.text));
    return error.code;
  } catch (const BackendError& error) {
    note(FindingKind::backend_mistake, creation_text = text_for(Call::core_create_world, "the backend " + error.text));
    return PLUMB_E_INTERNAL;
  }
}

void ValidationLayer::destroy_world(PlumbWorld* world) {
  if (world == nullptr) return next<Call::core_destroy_world>()(nullptr);
  const std::shared_ptr<ValidatedWorld> state = find(world);
  const auto refuse = [&](const std::string& text) {
    note(FindingKind::host_mistake, text_for(Call::core_destroy_world, text));
    if (state != nullptr) state->set_text(text_for(Call::core_destroy_world, text));
  };
  if (state == nullptr) return refuse("world is none that this backend made");
  if (state->destroyed) return refuse("world was destroyed before");
  const Visit visit(*state, Thread::one_caller);
  if (!visit.entered()) return refuse("another thread is in this world; it stays");
  if (state->stepping) {
    refuse("called between step and wait; call wait first");
    next<Call::core_wait>()(world, nullptr);  // so that the backend is not torn down in the middle of its step
  }
  state->destroyed = true;  // before another thread can be given a world of the same address
  next<Call::core_destroy_world>()(world);
}

PlumbDegree ValidationLayer::capability(PlumbCapability kind, std::uint32_t a, std::uint32_t b, const char** text) {
  const char* said = nullptr;
  const PlumbDegree degree = next_core()->capability(kind, a, b, &said);
  const std::string question =
      "capability(" + std::to_string(kind) + ", " + std::to_string(a) + ", " + std::to_string(b) + ")";
  if (said == nullptr) note(FindingKind::backend_mistake, question + ": the backend's note is null");
  if (text != nullptr) *text = said == nullptr ? "" : said;
  if (degree >= PLUMB_NONE && degree <= PLUMB_NATIVE) return degree;
  note(FindingKind::backend_mistake,
       question + ": the backend answered " + std::to_string(degree) + ", which is no degree");
  return PLUMB_NONE;
}

const char* ValidationLayer::error_text(PlumbWorld* world) {
  const std::shared_ptr<ValidatedWorld> state = find(world);
  return state != nullptr ? state->text() : creation_text.c_str();
}

std::shared_ptr<ValidatedWorld> ValidationLayer::find(PlumbWorld* world) {
  const std::lock_guard lock(mutex_);
  const auto found = worlds_.find(world);
  return found == worlds_.end() ? nullptr : found->second;
}

void ValidationLayer::note(FindingKind kind, const std::string& text) {
  constexpr std::size_t most = 1000;
  const std::lock_guard lock(mutex_);
  if (findings_.size() < most) findings_.push_back({kind, text});
}

std::vector<Finding> ValidationLayer::take_findings() {
  const std::lock_guard lock(mutex_);
  return std::exchange(findings_, {});
}

const PlumbBackendTable* validate(const PlumbBackendTable* next) {
  using Slots = LayerSlots<ValidationLayer>;
  static std::mutex mutex;  // two callers at once get one layer
  const std::lock_guard lock(mutex);
  if (Slots::find(next) != nullptr) return next;
  if (const PlumbBackendTable* table = Slots::find_over(next)) return table;
  return Slots::open("validation", next);
}

std::vector<Finding> findings(const PlumbBackendTable* validated) {
  ValidationLayer* layer = LayerSlots<ValidationLayer>::find(validated);
  return layer == nullptr ? std::vector<Finding>() : layer->take_findings();
}

}  // namespace plumb::layers
