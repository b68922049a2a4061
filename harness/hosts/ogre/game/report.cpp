#include "hosts/ogre/game/report.hpp"

#include <nlohmann/json.hpp>

namespace plumb::ogre {
namespace {

using Json = nlohmann::ordered_json;

Json array_of(const PlumbVec3& v) { return Json::array({v.x, v.y, v.z}); }

}  // namespace

std::string report(Game& game, int frames) {
  const Moment moment = game.stage().moment();
  const std::vector<Thing>& things = game.scene().things;
  Json line;
  line["frames"] = frames;
  line["seconds"] = moment.time;
  line["engine"] = game.engine();
  line["bodies"] = game.stage().things_alive();
  const auto ground = game.stage().ground();
  line["character"] = {{"position", array_of(moment.character)},
                       {"height", moment.character.y},
                       {"ground", ground ? Json(things[*ground].name) : Json()}};
  line["platform_height"] = moment.poses[game.scene().platform].position.y;
  line["picked"] = nullptr;
  if (const auto& picked = game.picked())
    line["picked"] = {{"name", things[picked->thing].name}, {"moved", picked->moved}};
  line["switches"] = Json::array();
  for (const Switch& done : game.switches())
    line["switches"].push_back({{"time", done.time},
                                {"from", done.from},
                                {"to", done.to},
                                {"bodies", done.bodies},
                                {"position_error", done.position_error},
                                {"velocity_error", done.velocity_error}});
  line["notices"] = Json::array();
  for (const Notice& notice : game.notices()) line["notices"].push_back(notice.text);
  for (std::size_t i = 0; i < things.size(); ++i)
    line["positions"][things[i].name] = array_of(moment.poses[i].position);
  return line.dump();
}

}  // namespace plumb::ogre
