#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string_view>

#include "base/status.h"

namespace radfarm {

/// How far long work is, told to whoever waits, and whether they still wait. Passed down as a parameter; a default one tells
/// nobody and is never cancelled. Neither ever changes a result: work that was cancelled returns early with what nobody may
/// use, so the caller asks check() and throws it away.
class Progress {
 public:
  /// `done` of `total` pieces of `phase`, such as "senders"; total is 0 where it is not known. Called from any thread, once
  /// for each some milliseconds of work: must be quick, and choose itself what it passes on.
  using Sink = std::function<void(std::string_view phase, std::uint64_t done, std::uint64_t total)>;

  Progress() = default;
  explicit Progress(Sink sink, std::stop_token stop = {}) : sink_(std::move(sink)), stop_(std::move(stop)) {}

  void report(std::string_view phase, std::uint64_t done = 0, std::uint64_t total = 0) const {
    if (sink_) sink_(phase, done, total);
  }
  bool is_cancelled() const { return stop_.stop_requested(); }
  /// CANCELLED once it is.
  Status check() const;

 private:
  Sink sink_;
  std::stop_token stop_;
};

/// parallel_for() that reports what is done as `phase` and leaves out the pieces not begun when it is cancelled.
void parallel_for(const Progress& progress, std::string_view phase, std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace radfarm
