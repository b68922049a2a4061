#include "page_reader.hpp"

#include <sstream>

#include "base/deflate.hpp"

namespace plumb::harness::testing {

namespace {

std::string bytes_of_base64(std::string_view text) {
  std::string bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const unsigned digit = c >= 'a'   ? static_cast<unsigned>(c - 'a') + 26
                           : c >= 'A' ? static_cast<unsigned>(c - 'A')
                           : c >= '0' ? static_cast<unsigned>(c - '0') + 52
                           : c == '+' ? 62u
                                      : 63u;
    buffer = buffer << 6 | digit;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(buffer >> bits & 0xff);
  }
  return bytes;
}

}  // namespace

std::string packed_page(const std::vector<Row>& rows, PageOptions options) {
  options.written = "2026-01-01 00:00 UTC";
  options.source = "results";
  std::ostringstream out;
  write_page(out, rows, options);
  return out.str();
}

namespace {

/// Calls plain() with what stands outside of packed scripts, and packed() with what stands in them, in order.
template <typename Plain, typename Packed>
void read_page(const std::string& page, const Plain& plain, const Packed& packed) {
  const std::string start = R"(<script type="application/octet-stream" class="packed">)", end = "</script>";
  std::size_t from = 0;
  for (std::size_t at = page.find(start); at != std::string::npos; at = page.find(start, from)) {
    plain(page.substr(from, at - from));
    const std::size_t first = at + start.size(), last = page.find(end, first);
    packed(inflated(bytes_of_base64(std::string_view(page).substr(first, last - first))));
    from = last + end.size();
  }
  plain(page.substr(from));
}

}  // namespace

std::string page_of(const std::vector<Row>& rows, PageOptions options) {
  std::string opened;
  const auto append = [&](const std::string& text) { opened += text; };
  read_page(packed_page(rows, std::move(options)), append, append);
  return opened;
}

std::vector<Json> packed_data(const std::vector<Row>& rows, PageOptions options) {
  std::vector<Json> all;
  read_page(
      packed_page(rows, std::move(options)), [](const std::string&) {},
      [&](const std::string& text) { all.push_back(Json::parse(text)); });
  return all;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

}  // namespace plumb::harness::testing
