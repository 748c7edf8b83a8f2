#pragma once

#include "process/signals.h"

namespace radfarm {

/// While it lives, SIGINT and SIGTERM end the process at once, as cancelled. For commands that leave nothing behind; main() has
/// blocked the signals for all commands.
class EndOnSignal {
 public:
  explicit EndOnSignal(const char* program);

 private:
  SignalWatcher watcher_;
};

}  // namespace radfarm
