#include "integration/processes.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <thread>

namespace radfarm::test {

bool eventually(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

std::vector<int> processes_with(const std::string& text) {
  std::vector<int> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    int pid = 0;
    const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), pid);
    if (error != std::errc{} || stop != name.data() + name.size()) continue;
    std::ifstream file(entry.path() / "cmdline", std::ios::binary);  // a zombie's is empty
    const std::string line((std::istreambuf_iterator<char>(file)), {});
    if (line.find(text) != std::string::npos) found.push_back(pid);
  }
  return found;
}

std::filesystem::path program(const std::string& name) { return std::filesystem::path(RADFARM_PROGRAMS) / name; }

std::filesystem::path scene(const std::string& name) {
  return std::filesystem::path(RADFARM_SOURCE_DIR) / "tests/scenes" / name;
}

}  // namespace radfarm::test
