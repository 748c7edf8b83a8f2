#pragma once

#include <functional>
#include <initializer_list>
#include <thread>

#include "base/status.h"

namespace radfarm {

/// Keeps `signals` for a SignalWatcher, and turns SIGPIPE into error values. Called by main before any other thread
/// starts (gRPC starts some), so that all threads inherit it; a signal that comes before the watcher waits for it.
void block_signals(std::initializer_list<int> signals);

/// Calls `handler(signal)` on a thread of its own each time one of `signals` arrives, while it lives.
/// Requires: block_signals() of the same.
class SignalWatcher {
 public:
  SignalWatcher(std::initializer_list<int> signals, std::function<void(int)> handler);
  ~SignalWatcher();
  SignalWatcher(const SignalWatcher&) = delete;
  SignalWatcher& operator=(const SignalWatcher&) = delete;

 private:
  void run();

  std::function<void(int)> handler_;
  int signal_fd_;
  int stop_fd_;
  std::thread thread_;
};

/// SIGKILL to this process when its parent ends. `parent` is the parent's id as the parent gave it: if that one is gone
/// already, CANCELLED. The kernel watches the thread that spawned us, so parents spawn from threads that last.
Status die_with_parent(int parent);

}  // namespace radfarm
