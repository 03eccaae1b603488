#include "core/child_process.h"

#include "core/error.h"
#include "core/files.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace daumier {
namespace {

/// Sends the child's stdout and stderr to files, closes its stdin, and takes it to its folder.
class ChildStart {
 public:
  ChildStart(const std::filesystem::path& out, const std::filesystem::path& err, const std::filesystem::path& folder) {
    constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, out.c_str(), kWrite, 0600);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, err.c_str(), kWrite, 0600);
    if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
  }
  ~ChildStart() { posix_spawn_file_actions_destroy(&actions_); }
  ChildStart(const ChildStart&) = delete;
  ChildStart& operator=(const ChildStart&) = delete;

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

/// The status of waitpid once the child has ended; nothing after the time, or where the task is cancelled before.
std::optional<int> WaitFor(pid_t child, double seconds, const Task& task) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline || task.cancelled()) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return status;
}

void Kill(pid_t child) {
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

}  // namespace

std::optional<ChildResult> RunChild(const std::vector<std::string>& arguments, const std::filesystem::path& scratch,
                                    const ChildOptions& options) {
  const auto out = scratch / "child.out", err = scratch / "child.err";
  std::vector<char*> pointers;
  for (const auto& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);

  const ChildStart start(out, err, options.folder);
  pid_t child = 0;
  const int failure = posix_spawnp(&child, pointers[0], start.get(), nullptr, pointers.data(), environ);
  if (failure == ENOENT) return std::nullopt;
  DAUMIER_CHECK(failure == 0, "cannot start {}: {}", arguments[0], std::strerror(failure));

  const auto status = WaitFor(child, options.timeout_seconds, options.task);
  if (!status && options.task.cancelled()) {
    kill(child, SIGTERM);
    if (!WaitFor(child, ChildOptions::kGrace, {})) Kill(child);
    throw Cancelled(fmt::format("{} was stopped", arguments[0]));
  }
  if (!status) {
    Kill(child);
    throw Error(fmt::format("{} did not end within {} s and was killed", arguments[0], options.timeout_seconds));
  }
  DAUMIER_CHECK(WIFEXITED(*status), "{} was ended by signal {}: {}", arguments[0], WTERMSIG(*status), ReadFile(err));
  return ChildResult{WEXITSTATUS(*status), ReadFile(out), ReadFile(err)};
}

}  // namespace daumier
