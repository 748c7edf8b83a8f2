// `radfarm coordinator` and `radfarm worker` become the programs of those names, which lie beside this one.
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "process/child_process.h"

namespace radfarm::cli {
namespace {

/// Replaces this process; returns only when that fails.
Result<ExitCode> become(const std::string& name, std::vector<std::string> words) {
  const std::string program = (executable_folder() / name).string();
  words.insert(words.begin(), program);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  sigset_t none;
  sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  ::execv(program.c_str(), pointers.data());
  return fail(Code::kInternal, program + ": cannot start: " + std::strerror(errno));
}

void add_program(CLI::App& app, Action& action, const char* verb_name, const char* help, const char* program) {
  CLI::App& verb = *app.add_subcommand(verb_name, help);
  verb.prefix_command();
  verb.set_help_flag();
  verb.callback(
      [&action, &verb, program] { action = [words = verb.remaining(), program] { return become(program, words); }; });
}

}  // namespace

void add_programs(CLI::App& app, Action& action) {
  add_program(app, action, "coordinator", "run a coordinator; see `radfarm coordinator serve --help`",
              "radfarm-coordinator");
  add_program(app, action, "worker", "run a worker; see `radfarm worker --help`", "radfarm-worker");
}

}  // namespace radfarm::cli
