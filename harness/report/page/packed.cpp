#include "report/page/packed.hpp"

#include "report/page/base64.hpp"
#include "report/page/page.hpp"
#include "rows/deflate.hpp"

namespace plumb::harness {

std::string packed_blocks(const Json& blocks) {
  if (!has_page_script() || blocks.empty()) return "";
  return R"(<script type="application/octet-stream" class="packed">)" +
         base64(deflated(blocks.dump(-1, ' ', false, Json::error_handler_t::replace))) + "</script>";
}

}  // namespace plumb::harness
