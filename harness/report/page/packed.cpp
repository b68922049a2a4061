#include "report/page/packed.hpp"

#include "report/page/base64.hpp"
#include "rows/deflate.hpp"

namespace plumb::harness {

std::string packed_markup(const std::string& html) {
  return R"(<script type="application/octet-stream" class="packed">)" + base64(deflated(html)) + "</script>";
}

}  // namespace plumb::harness
