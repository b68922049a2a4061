// Where output goes and how: formats, the width of the terminal, a progress bar on a terminal only.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "schedule/bench.hpp"

namespace plumb::harness {

struct OutputOptions {
  bool json = false, csv = false;
};

/// Columns of the terminal behind standard output; 0 when it is none.
[[nodiscard]] int terminal_width();
/// Colours are for terminals whose user did not set NO_COLOR.
[[nodiscard]] bool wants_colour();

/// Text, cut to a width and filled up with blanks.
[[nodiscard]] std::string column(const std::string& text, std::size_t width);

/// A line on standard error that is drawn over itself. Where that is no terminal: nothing, or, with `logs`, a line of
/// its own now and then.
class ProgressBar {
 public:
  explicit ProgressBar(bool logs = false);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  void draw(const RunProgress& progress);
  void clear();

 private:
  void log(const RunProgress& progress);

  int width_ = 0;
  bool logs_ = false, drawn_ = false;
  std::chrono::steady_clock::time_point logged_;
};

}  // namespace plumb::harness
