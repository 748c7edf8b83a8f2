// radfarm: the command line.
#include <csignal>

#include "cli/commands.h"
#include "process/signals.h"

int main(int argc, char** argv) {
  radfarm::block_signals({SIGINT, SIGTERM, SIGCHLD});
  return radfarm::cli::run(argc, argv);
}
