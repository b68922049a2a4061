#include "report/page/parts/packed.hpp"

#include "base/base64.hpp"
#include "base/deflate.hpp"
#include "report/page/parts/bundled_scripts.hpp"

namespace plumb::harness {

std::string packed_blocks(const Json& blocks) {
  if (!has_page_script() || blocks.empty()) return "";
  return R"(<script type="application/octet-stream" class="packed">)" +
         base64(deflated(blocks.dump(-1, ' ', false, Json::error_handler_t::replace))) + "</script>";
}

}  // namespace plumb::harness
