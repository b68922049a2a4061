#include "simulation/support.hpp"

#include <map>
#include <set>
#include <tuple>

#include "scene/build.hpp"
#include "simulation/names.hpp"

namespace plumb::harness {

namespace {

struct Question {
  PlumbCapability kind;
  std::uint32_t a, b;
  std::string name;
};

std::string answer(const Backend& backend, const Question& question) {
  if (backend.capability(question.kind, question.a, question.b) != PLUMB_NONE) return "";
  const std::string note = backend.capability_note(question.kind, question.a, question.b);
  return note.empty() ? question.name : question.name + ": " + note;
}

// Children of compounds count as shapes of their own: an adapter dispatches pairs of them.
std::vector<PlumbShapeType> types_in(const Scene& scene, std::size_t shape) {
  const SceneShape& whole = scene.shapes[shape];
  std::vector<PlumbShapeType> types{whole.desc.type};
  for (const SceneShape::Child& child : whole.children) types.push_back(scene.shapes[child.shape].desc.type);
  return types;
}

// One representative for each combination of shape, motion and filter that the scene has: piles stay cheap to check.
struct Kind {
  std::size_t shape;
  PlumbMotion motion;
  PlumbFilter filter;
  std::size_t count = 1;
};

std::vector<Kind> kinds_of(const Scene& scene) {
  std::map<std::tuple<std::size_t, PlumbMotion, std::uint32_t, std::uint32_t, std::int32_t>, Kind> kinds;
  for (const SceneBody& body : scene.bodies) {
    if (!body.shape || (body.desc.flags & PLUMB_BODY_SENSOR) != 0) continue;
    const PlumbFilter& filter = body.desc.filter;
    const Kind kind{*body.shape, body.desc.motion, filter};
    const auto [at, is_new] =
        kinds.try_emplace({*body.shape, body.desc.motion, filter.category, filter.mask, filter.group}, kind);
    if (!is_new) ++at->second.count;
  }
  std::vector<Kind> list;
  for (const auto& entry : kinds) list.push_back(entry.second);
  return list;
}

std::vector<Question> pair_questions(const Scene& scene) {
  if ((scene.needs & PLUMB_NEED_COLLISION) == 0) return {};
  std::set<std::pair<PlumbShapeType, PlumbShapeType>> pairs;
  const std::vector<Kind> kinds = kinds_of(scene);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (std::size_t j = i; j < kinds.size(); ++j) {
      const Kind &a = kinds[i], &b = kinds[j];
      if (i == j && a.count == 1) continue;
      if (a.motion != PLUMB_DYNAMIC && b.motion != PLUMB_DYNAMIC) continue;
      if (!may_touch(a.filter, b.filter)) continue;
      for (const PlumbShapeType p : types_in(scene, a.motion == PLUMB_DYNAMIC ? a.shape : b.shape)) {
        for (const PlumbShapeType q : types_in(scene, a.motion == PLUMB_DYNAMIC ? b.shape : a.shape)) {
          if (p != PLUMB_COMPOUND && q != PLUMB_COMPOUND) pairs.insert({p, q});
        }
      }
    }
  }
  std::vector<Question> questions;
  for (const auto& [p, q] : pairs)
    questions.push_back(
        {PLUMB_CAP_PAIR, p, q, "contacts of " + word_of(shape_words(), p) + " and " + word_of(shape_words(), q)});
  return questions;
}

std::vector<Question> joint_questions(const Scene& scene) {
  std::vector<Question> questions;
  for (const SceneJoint& joint : scene.joints) {
    const PlumbJointType type = joint.desc.type;
    const std::string name = word_of(joint_words(), type) + " joints";
    questions.push_back({PLUMB_CAP_JOINT, type, 0, name});
    const auto feature = [&](PlumbJointFeature which) {
      questions.push_back(
          {PLUMB_CAP_JOINT_FEATURE, type, which, word_of(joint_feature_words(), which) + " of " + name});
    };
    for (std::size_t axis = 0; axis < 6; ++axis) {
      if (joint.desc.limits[axis].enabled != 0) feature(PLUMB_JOINT_HAS_LIMITS);
      if (joint.desc.motors[axis].enabled != 0) feature(PLUMB_JOINT_HAS_MOTORS);
      if (joint.desc.springs[axis].enabled != 0)
        feature(joint.desc.springs[axis].mode == PLUMB_SPRING_STIFFNESS ? PLUMB_JOINT_HAS_STIFFNESS
                                                                        : PLUMB_JOINT_HAS_SPRINGS);
    }
    if (joint.desc.break_force > 0 || joint.desc.break_torque > 0) feature(PLUMB_JOINT_BREAKS);
    if ((scene.needs & PLUMB_NEED_JOINT_REACTIONS) != 0) feature(PLUMB_JOINT_HAS_REACTION);
    for (const SceneAction& action : scene.host)
      if (action.kind == SceneAction::targets && action.name == joint.name) feature(PLUMB_JOINT_HAS_TARGETS);
  }
  return questions;
}

}  // namespace

PlumbNeeds needs_of(const Backend& backend) {
  PlumbNeeds needs = 0;
  for (std::uint32_t bit = 0; bit < PLUMB_NEED_COUNT; ++bit) {
    if (backend.capability(PLUMB_CAP_NEED, bit) != PLUMB_NONE) needs |= PlumbNeeds{1} << bit;
  }
  return needs;
}

std::string missing_support(const Backend& backend, const Scene& scene) {
  std::vector<Question> questions;
  for (std::uint32_t bit = 0; bit < PLUMB_NEED_COUNT; ++bit) {
    if ((scene.needs >> bit & 1) != 0) questions.push_back({PLUMB_CAP_NEED, bit, 0, word_of(need_words(), bit)});
  }
  for (const Kind& kind : kinds_of(scene)) {
    for (const PlumbShapeType type : types_in(scene, kind.shape))
      questions.push_back({PLUMB_CAP_SHAPE, type, kind.motion,
                           word_of(motion_words(), kind.motion) + " " + word_of(shape_words(), type)});
  }
  for (const SceneShape& shape : scene.shapes)
    if (!shape.materials.empty())
      questions.push_back({PLUMB_CAP_TRIANGLE_MATERIAL, shape.desc.type, 0,
                           "materials by triangle of a " + word_of(shape_words(), shape.desc.type)});
  for (const auto& more : {joint_questions(scene), pair_questions(scene)})
    questions.insert(questions.end(), more.begin(), more.end());
  for (const Question& question : questions) {
    if (std::string lacking = answer(backend, question); !lacking.empty()) return lacking;
  }
  return "";
}

}  // namespace plumb::harness
