// `radfarm doctor`: whether this machine can render.
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>

#include <grpcpp/grpcpp.h>

#include "base/file.h"
#include "cli/commands.h"
#include "pipeline/fingerprint.h"
#include "process/child_process.h"

namespace radfarm::cli {
namespace {

struct Finding {
  std::string what;
  bool good = true;
  std::string detail;
};

Finding check_cpu() {
#if defined(__x86_64__)
  const bool good = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  return {"processor", good, good ? "has AVX2 and FMA" : "lacks AVX2 or FMA; build with -DRADFARM_MARCH=x86-64"};
#else
  return {"processor", true, "not x86-64"};
#endif
}

Finding check_program(const std::string& name) {
  const std::filesystem::path path = executable_folder() / name;
  const bool good = ::access(path.c_str(), X_OK) == 0;
  return {name, good, path.string() + (good ? "" : " is missing: install the programs side by side")};
}

Finding check_temporary_folder() {
  const Result<TemporaryDirectory> folder = TemporaryDirectory::create("radfarm-doctor");
  if (!folder) return {"temporary folder", false, folder.error().message};
  const Status written = write_file_atomically(folder->path() / "probe", std::string_view("x"));
  return {"temporary folder", written.has_value(),
          written ? folder->path().parent_path().string() + " can be written" : written.error().message};
}

Finding check_loopback() {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool good =
      fd >= 0 && ::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 && ::listen(fd, 1) == 0;
  if (fd >= 0) ::close(fd);
  return {"loopback ports", good, good ? "can listen on 127.0.0.1" : "cannot listen on 127.0.0.1"};
}

Result<ExitCode> run_doctor() {
  const Finding findings[] = {check_cpu(), check_program("radfarm-coordinator"), check_program("radfarm-worker"),
                              check_temporary_folder(), check_loopback()};
  bool good = true;
  for (const Finding& finding : findings) {
    std::printf("%-4s %-20s %s\n", finding.good ? "ok" : "BAD", finding.what.c_str(), finding.detail.c_str());
    good = good && finding.good;
  }
  std::printf("     %-20s %s\n", "build", build_id().c_str());
  std::printf("     %-20s %s\n", "fingerprint", numeric_fingerprint().c_str());
  std::printf("     %-20s %s\n", "gRPC", grpc::Version().c_str());
  std::printf("     %-20s %u\n", "threads", std::thread::hardware_concurrency());
  return good ? ExitCode::kDone : ExitCode::kInternal;
}

}  // namespace

void add_doctor(CLI::App& app, Action& action) {
  CLI::App& verb = *app.add_subcommand("doctor", "whether this machine can render");
  verb.callback([&action] { action = run_doctor; });
}

}  // namespace radfarm::cli
