#include "joints/tree.hpp"

#include "articulated/body_sets.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::mujoco {
namespace {

/// Number 0 is all that stands still.
std::size_t number_of(const Body* body) {
  return body == nullptr || body->is(PLUMB_STATIC) ? 0 : std::size_t{slot_of(body->handle)} + 1;
}

bool moves(const Body* body) { return body != nullptr && body->is(PLUMB_DYNAMIC); }

/// Those that must be links first.
std::vector<Joint*> in_turn(const std::vector<std::unique_ptr<Joint>>& joints) {
  std::vector<Joint*> turn;
  for (const bool closes : {false, true})
    for (const auto& joint : joints)
      if (joint && joint->desc.type != PLUMB_JOINT_DISTANCE && can_close_a_loop(joint->desc) == closes &&
          (moves(joint->a) || moves(joint->b)))
        turn.push_back(joint.get());
  return turn;
}

std::vector<Joint*> choose_links(std::size_t body_slots, const std::vector<std::unique_ptr<Body>>& bodies,
                                 const std::vector<std::unique_ptr<Joint>>& joints) {
  articulated::BodySets groups(body_slots + 1);
  groups.root(0);
  for (const auto& body : bodies)
    if (body && body->is(PLUMB_KINEMATIC)) groups.root(number_of(body.get()));
  std::vector<Joint*> links;
  for (Joint* joint : in_turn(joints)) {
    if (groups.join(number_of(joint->a), number_of(joint->b))) {
      links.push_back(joint);
    } else if (!can_close_a_loop(joint->desc)) {
      throw Error(PLUMB_E_UNSUPPORTED,
                  std::string("a ") + backend::joint_name(joint->desc.type) +
                      " joint would close a loop, which MuJoCo has for ball, hinge, fixed and distance joints without "
                      "limits, motors and springs");
    }
  }
  return links;
}

void add_subtree(Tree& tree, Body* body) {
  tree.order.push_back(body);
  for (Body* child : tree.children[slot_of(body->handle)]) add_subtree(tree, child);
}

/// Hangs what the links lead to below who is there already.
void hang(Tree& tree, const std::vector<std::vector<Joint*>>& links_of, std::vector<Body*> reached,
          std::vector<bool>& seen) {
  for (std::size_t i = 0; i < reached.size(); ++i) {
    Body* parent = reached[i];
    for (Joint* link : links_of[slot_of(parent->handle)]) {
      Body* child = link->a == parent ? link->b : link->a;
      if (child == nullptr || !moves(child) || seen[slot_of(child->handle)]) continue;
      seen[slot_of(child->handle)] = true;
      child->parent = parent;
      child->link = link;
      child->reversed = child == link->a;
      tree.children[slot_of(parent->handle)].push_back(child);
      reached.push_back(child);
    }
  }
}

}  // namespace

Tree grow_tree(const std::vector<std::unique_ptr<Body>>& bodies, const std::vector<std::unique_ptr<Joint>>& joints) {
  const std::vector<Joint*> links = choose_links(bodies.size(), bodies, joints);
  Tree tree;
  tree.children.resize(bodies.size());
  std::vector<std::vector<Joint*>> links_of(bodies.size());
  std::vector<bool> seen(bodies.size(), false);
  for (const auto& joint : joints)
    if (joint) joint->is_link = false;
  for (Joint* link : links) {
    link->is_link = true;
    for (const Body* end : {link->a, link->b})
      if (end != nullptr) links_of[slot_of(end->handle)].push_back(link);
  }
  for (const auto& body : bodies) {
    if (!body) continue;
    body->parent = nullptr;
    body->link = nullptr;
    body->reversed = false;
    body->shift = {};
  }
  const auto plant = [&](Body* root) {
    seen[slot_of(root->handle)] = true;
    tree.roots.push_back(root);
    hang(tree, links_of, {root}, seen);
  };
  for (const auto& body : bodies)
    if (body && !body->is(PLUMB_DYNAMIC)) plant(body.get());
  for (Joint* link : links) {  // with the world itself
    Body* body = link->b;
    if (link->a != nullptr || seen[slot_of(body->handle)]) continue;
    body->link = link;
    plant(body);
  }
  for (const auto& body : bodies)
    if (body && !seen[slot_of(body->handle)]) plant(body.get());
  for (Body* root : tree.roots) {
    if (root->link == nullptr) root->shift = root->centre_of_mass();
    add_subtree(tree, root);
  }
  return tree;
}

}  // namespace plumb::mujoco
