#include "reduce/reduction.hpp"

#include <algorithm>

#include "reduce/ddmin.hpp"
#include "reduce/plain_scene.hpp"

namespace plumb::harness {
namespace {

using Pointers = std::vector<Json::json_pointer>;

class Reduction {
 public:
  Reduction(Json scene, const std::function<bool(const Json&)>& fails, const std::function<void(const Json&)>& shrunk)
      : scene_(std::move(scene)), fails_(fails), shrunk_(shrunk) {}

  Json run() {
    take_out(0);  // what else is measured may have its own times
    shorten();
    for (std::size_t kind = 1; kind < parts_of(scene_).size(); ++kind)
      // What was taken out may have held up what was tried before it.
      if (take_out(kind) && kind > 1) kind = 0;
    shorten();
    return scene_;
  }

 private:
  void settle_for(const Json& less) {
    scene_ = less;
    shrunk_(scene_);
  }

  /// Whether anything of the kind could go.
  bool take_out(std::size_t kind) {
    const Json whole = scene_;
    const Pointers all = parts_of(whole)[kind];
    const auto fails = [&](const Pointers& kept) {
      Pointers gone;
      std::copy_if(all.begin(), all.end(), std::back_inserter(gone),
                   [&](const auto& part) { return std::find(kept.begin(), kept.end(), part) == kept.end(); });
      const Json less = without(whole, gone);
      if (!fails_(less)) return false;
      settle_for(less);
      return true;
    };
    return ddmin<Json::json_pointer>(all, fails).size() < all.size();
  }

  void shorten() {
    constexpr int most_halvings = 20;
    for (int i = 0; i < most_halvings; ++i) {
      Json less = scene_;
      less["seconds"] = scene_.at("seconds").get<double>() / 2;
      if (less["seconds"] < scene_.at("dt") || !fails_(less)) return;
      settle_for(less);
    }
  }

  Json scene_;
  const std::function<bool(const Json&)>& fails_;
  const std::function<void(const Json&)>& shrunk_;
};

}  // namespace

Json reduced(const Json& scene, const std::function<bool(const Json&)>& fails,
             const std::function<void(const Json&)>& shrunk) {
  return Reduction(scene, fails, shrunk).run();
}

}  // namespace plumb::harness
