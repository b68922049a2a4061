#include "cli/output/output.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace plumb::harness {

namespace {

int width_of(int descriptor) {
  winsize size{};
  if (isatty(descriptor) == 0) return 0;
  return ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// 0:07, 12:30, 3:04:00.
std::string time_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(std::min(seconds, 3.6e6)));
  const auto minutes = whole / 60 % 60, rest = whole % 60;
  return whole >= 3600 ? fmt::format("{}:{:02}:{:02}", whole / 3600, minutes, rest)
                       : fmt::format("{}:{:02}", minutes, rest);
}

}  // namespace

int terminal_width() { return width_of(STDOUT_FILENO); }

bool wants_colour() {
  const char* refused = std::getenv("NO_COLOR");
  return terminal_width() > 0 && (refused == nullptr || *refused == '\0');
}

std::string column(const std::string& text, std::size_t width) {
  if (text.size() > width) return text.substr(0, width - 1) + "~";
  return text + std::string(width - text.size(), ' ');
}

ProgressBar::ProgressBar(bool logs)
    : width_(width_of(STDERR_FILENO)), logs_(logs), logged_(std::chrono::steady_clock::now()) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::draw(const RunProgress& progress) {
  if (width_ == 0) {
    if (logs_) log(progress);
    return;
  }
  constexpr std::size_t bar_width = 24;
  const double within =
      progress.steps == 0 ? 0 : std::min(1.0, static_cast<double>(progress.step) / static_cast<double>(progress.steps));
  const double share = (static_cast<double>(progress.cells_done) + within) /
                       static_cast<double>(std::max<std::size_t>(1, progress.cells_total));
  const auto filled = static_cast<std::size_t>(std::min(1.0, share) * bar_width);
  std::string line = fmt::format("[{}{}] {}/{}  {}", std::string(filled, '#'), std::string(bar_width - filled, '.'),
                                 progress.cells_done, progress.cells_total, progress.cell);
  if (progress.seconds_left) line += "  " + time_text(*progress.seconds_left) + " left";
  if (progress.steps != 0)
    line += fmt::format("  step {} of {}", std::min(progress.step, progress.steps), progress.steps);
  line.resize(std::min(line.size(), static_cast<std::size_t>(width_ - 1)));
  fmt::print(stderr, "\r\033[K{}", line);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::log(const RunProgress& progress) {
  constexpr std::chrono::seconds pause{30};
  const auto now = std::chrono::steady_clock::now();
  if (now - logged_ < pause) return;
  logged_ = now;
  fmt::print(stderr, "{} of {} cells{}\n", progress.cells_done, progress.cells_total,
             progress.seconds_left ? ", about " + time_text(*progress.seconds_left) + " left" : "");
}

void ProgressBar::clear() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
  drawn_ = false;
}

}  // namespace plumb::harness
