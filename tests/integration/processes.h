#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace radfarm::test {

/// How long a test waits for what must happen; generous, because it is only ever reached by a failure.
inline constexpr std::chrono::seconds kPatience{120};

/// Asks `condition` again and again until it holds; false after kPatience.
bool eventually(const std::function<bool()>& condition);

/// The living processes whose command line contains `text`.
std::vector<int> processes_with(const std::string& text);

std::filesystem::path program(const std::string& name);
std::filesystem::path scene(const std::string& name);

}  // namespace radfarm::test
