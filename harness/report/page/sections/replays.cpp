// Replays: recorded scenes in three dimensions, all engines side by side. The viewer finds the bundles by their class.
#include <fmt/format.h>

#include "base/base64.hpp"
#include "base/deflate.hpp"
#include "report/page/parts/assets.hpp"
#include "report/page/parts/bundled_scripts.hpp"
#include "report/page/parts/looks.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

/// What the viewer runs by itself: the engine once, and the scenes as they begin.
std::string live_parts(const PageWorlds& worlds) {
  if (worlds.list.empty()) return "";
  std::string out = fmt::format(R"(<script type="application/octet-stream" class="plumb-engine">{}</script>)",
                                base64(deflated(worlds.engine)));
  for (const auto& [scene, json] : worlds.list)
    out += fmt::format(R"(<script type="application/octet-stream" class="plumb-world" data-scene="{}">{}</script>)",
                       escape_html(scene), base64(deflated(json)));
  return out;
}

std::string page_of(const std::string& title, const std::string& content) {
  return fmt::format(
      R"(<!doctype html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" )"
      R"(content="width=device-width,initial-scale=1"><meta http-equiv="Content-Security-Policy" )"
      R"(content="default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; )"
      R"(img-src data: blob:"><title>{}</title><style>{}</style>)"
      "</head><body><main>{}<script>{}</script></main></body></html>\n",
      escape_html(title), page_style, content, viewer_script);
}

std::string player(const std::vector<PageReplay>& replays) {
  std::string out = R"(<div id="plumb-viewer"></div>)";
  for (const PageReplay& replay : replays) {
    out += fmt::format(
        R"(<script type="application/octet-stream" class="plumb-replay" data-scene="{}" data-backend="{}" data-hue="{}">)"
        "{}</script>",
        escape_html(replay.scene), escape_html(replay.backend),
        replay.colour.value_or(look_of(replay.backend).colour()), base64(replay.bundle));
  }
  return out;
}

}  // namespace

std::string replay_page(const std::vector<PageReplay>& replays) {
  return page_of(replays.empty() ? "" : replays.front().scene, player(replays));
}

std::string live_page(const PageWorlds& worlds) {
  return page_of(worlds.list.empty() ? "" : worlds.list.front().scene,
                 R"(<div id="plumb-live"></div>)" + live_parts(worlds) +
                     about("This page runs the engine impulse itself, as WebAssembly, and comes to the same bits as "
                           "plumb run as long as nothing is changed. Drag a body to pull it along. Energy and gaps of "
                           "joints are worked out as the harness does; contacts, their forces and depths are the "
                           "engine's own."));
}

std::string replays_place(const PageOptions& options) {
  if (options.replays.empty() && options.replays_note.empty()) return "";
  std::string words =
      "What the engines made of the same scene, side by side. Curves, depths and the gaps of "
      "joints are the referee's; contact forces are the engine's own. ";
  words += escape_html(options.replays_note);
  const std::string start = R"(<section id="replays" class="part replays"><h2>Replays</h2>)";
  if (options.replays.empty()) return start + about(words) + "</section>";
  if (!has_viewer()) {
    return start + about(words) +
           about(
               "This program was built without node and therefore shows no replays. Build it where node and npm are, "
               "and write the page again: what was recorded stays valid.") +
           "</section>";
  }
  return fmt::format("{}{}{}<script>{}</script>{}</section>", start, player(options.replays),
                     live_parts(options.worlds), viewer_script, about(words));
}

}  // namespace plumb::harness
