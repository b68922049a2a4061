#include "joints/tree.hpp"

#include "articulated/body_sets.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::dart6 {
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

std::vector<Joint*> choose_links(const std::vector<std::unique_ptr<Body>>& bodies,
                                 const std::vector<std::unique_ptr<Joint>>& joints) {
  articulated::BodySets sets(bodies.size() + 1);
  sets.root(0);
  for (const auto& body : bodies)
    if (body && body->is(PLUMB_KINEMATIC)) sets.root(number_of(body.get()));
  std::vector<Joint*> links;
  for (Joint* joint : in_turn(joints)) {
    if (can_be_link(*joint) && sets.join(number_of(joint->a), number_of(joint->b))) {
      links.push_back(joint);
    } else if (!can_close_a_loop(joint->desc)) {
      throw Error(PLUMB_E_UNSUPPORTED,
                  std::string("a ") + backend::joint_name(joint->desc.type) +
                      " joint with limits, motors or springs would close a loop, or joins a body that does not turn; "
                      "leave these out, or give them to a joint of the tree");
    }
  }
  return links;
}

class Forest {
 public:
  Forest(const std::vector<std::unique_ptr<Body>>& bodies, const std::vector<Joint*>& links)
      : links_of_(bodies.size()), seen_(bodies.size(), false) {
    for (Joint* link : links)
      for (const Body* end : {link->a, link->b})
        if (end != nullptr) links_of_[slot_of(end->handle)].push_back(link);
  }

  [[nodiscard]] bool has(const Body& body) const { return seen_[slot_of(body.handle)]; }

  /// With all that hangs on it, however deep, a body's own children one after the other.
  void plant(Body* root) {
    seen_[slot_of(root->handle)] = true;
    std::size_t next = order_.size();
    order_.push_back(root);
    for (; next < order_.size(); ++next) {
      Body* parent = order_[next];
      for (Joint* link : links_of_[slot_of(parent->handle)]) {
        Body* child = link->a == parent ? link->b : link->a;
        if (child == nullptr || !moves(child) || has(*child)) continue;
        seen_[slot_of(child->handle)] = true;
        child->parent = parent;
        child->link = link;
        child->reversed = child == link->a;
        order_.push_back(child);
      }
    }
  }

  std::vector<Body*> take() { return std::move(order_); }

 private:
  std::vector<std::vector<Joint*>> links_of_;
  std::vector<bool> seen_;
  std::vector<Body*> order_;
};

/// A link with the world, or with what stands still, makes a root.
void plant_on_ground(Forest& forest, const std::vector<Joint*>& links) {
  for (Joint* link : links) {
    const bool b_moves = moves(link->b);
    const Body* other = b_moves ? link->a : link->b;
    Body* body = b_moves ? link->b : link->a;
    if (moves(other) || (other != nullptr && other->is(PLUMB_KINEMATIC)) || forest.has(*body)) continue;
    body->link = link;
    body->reversed = !b_moves;
    forest.plant(body);
  }
}

}  // namespace

std::vector<Body*> grow_trees(const std::vector<std::unique_ptr<Body>>& bodies,
                              const std::vector<std::unique_ptr<Joint>>& joints) {
  const std::vector<Joint*> links = choose_links(bodies, joints);
  for (const auto& joint : joints)
    if (joint) joint->is_link = false;
  for (Joint* link : links) link->is_link = true;
  for (const auto& body : bodies) {
    if (!body) continue;
    body->parent = nullptr;
    body->link = nullptr;
    body->reversed = false;
  }
  // What stands still hangs on nothing and carries nothing: its children are those of the world.
  Forest forest(bodies, links);
  plant_on_ground(forest, links);
  for (const auto& body : bodies)
    if (body && body->is(PLUMB_KINEMATIC)) forest.plant(body.get());
  for (const auto& body : bodies)
    if (body && body->is(PLUMB_DYNAMIC) && !forest.has(*body)) forest.plant(body.get());
  std::vector<Body*> order = forest.take();
  for (const auto& body : bodies)
    if (body && body->is(PLUMB_STATIC)) order.push_back(body.get());
  return order;
}

}  // namespace plumb::dart6
