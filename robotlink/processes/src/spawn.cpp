// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/spawn.h>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>

#include <base/descriptor.h>
#include <base/system_reason.h>

namespace pitchboard::link {
namespace {

// Descriptors 0 to 2 are about to be replaced in the child; a parent without standard streams would
// otherwise be given exactly these numbers.
Descriptor aboveStandard(int fd) {
  Descriptor low(fd);
  if (fd < 0 || fd > 2) return low;
  return Descriptor(::fcntl(fd, F_DUPFD_CLOEXEC, 3));
}

struct Ends {
  Descriptor read, write;
};

bool makePipe(Ends& ends) {
  int fds[2];
  if (::pipe2(fds, O_CLOEXEC) != 0) return false;
  ends.read = aboveStandard(fds[0]);
  ends.write = aboveStandard(fds[1]);
  return ends.read && ends.write;
}

bool executable(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
         ::access(path.c_str(), X_OK) == 0;
}

// execvp would search after the fork, which is not async-signal-safe.
std::string inPath(const std::string& program) {
  if (program.find('/') != std::string::npos) return program;
  const char* variable = std::getenv("PATH");
  std::string_view rest = variable != nullptr ? variable : "/usr/local/bin:/usr/bin:/bin";
  while (true) {
    const std::size_t colon = rest.find(':');
    const std::string_view folder = rest.substr(0, colon);
    const std::string path = (folder.empty() ? "." : std::string(folder)) + "/" + program;
    if (executable(path)) return path;
    if (colon == std::string_view::npos) return {};
    rest.remove_prefix(colon + 1);
  }
}

struct ChildPlan {
  const char* path;
  char* const* arguments;
  char* const* environment;
  int input, output, report;
  pid_t parent;
};

[[noreturn]] void fail(const ChildPlan& plan, int error) {
  while (::write(plan.report, &error, sizeof error) < 0 && errno == EINTR) {
  }
  ::_exit(127);
}

void closeOthersAtExec() {
#ifdef SYS_close_range
  constexpr unsigned closeOnExec = 1U << 2;  // CLOSE_RANGE_CLOEXEC
  if (::syscall(SYS_close_range, 3U, ~0U, closeOnExec) == 0) return;
#endif
  constexpr int usualLimit = 4096;  // for kernels before 5.11
  for (int fd = 3; fd < usualLimit; ++fd) ::fcntl(fd, F_SETFD, FD_CLOEXEC);
}

// Runs in the child; all signals are blocked until its handlers are reset, so that no handler of
// the parent can run here.
[[noreturn]] void becomeChild(const ChildPlan& plan) {
  ::setpgid(0, 0);
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) fail(plan, errno);
  // The parent may have died before the line above took effect.
  if (::getppid() != plan.parent) ::_exit(127);

  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  for (int signal = 1; signal < NSIG; ++signal) ::sigaction(signal, &standard, nullptr);
  sigset_t none;
  ::sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);

  if (::dup2(plan.input, STDIN_FILENO) < 0 || ::dup2(plan.output, STDOUT_FILENO) < 0 ||
      ::dup2(plan.output, STDERR_FILENO) < 0) {
    fail(plan, errno);
  }
  closeOthersAtExec();
  ::execve(plan.path, plan.arguments, plan.environment);
  fail(plan, errno);
}

// The error of the child's exec, or 0 when it is running.
int readReport(int fd) {
  int error = 0;
  ssize_t got = 0;
  do {
    got = ::read(fd, &error, sizeof error);
  } while (got < 0 && errno == EINTR);
  return got == sizeof error ? error : 0;
}

tl::unexpected<Error> cannotStart(const std::string& program, int error) {
  const ErrorCode code = error == ENOENT ? ErrorCode::NotFound : ErrorCode::SystemError;
  return failure(code, "cannot start '" + program + "': " + systemReason(error));
}

}  // namespace

Result<Spawned> spawn(const std::vector<std::string>& command) {
  if (command.empty() || command.front().empty()) {
    return failure(ErrorCode::InvalidArgument, "cannot start a process: no program is given");
  }
  const std::string& program = command.front();
  const std::string path = inPath(program);
  if (path.empty()) {
    return failure(ErrorCode::NotFound, "cannot start '" + program +
                                            "': there is no such program in the folders of PATH");
  }
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) {
    return cannotStart(program, EISDIR);
  }

  Ends output, report;
  const Descriptor input = aboveStandard(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  if (!input || !makePipe(output) || !makePipe(report)) return cannotStart(program, errno);
  if (::fcntl(output.read.get(), F_SETFL, O_NONBLOCK) != 0) return cannotStart(program, errno);

  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  const ChildPlan plan{path.c_str(),       arguments.data(),   ::environ, input.get(),
                       output.write.get(), report.write.get(), ::getpid()};

  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t pid = ::fork();
  const int forkError = errno;
  if (pid == 0) becomeChild(plan);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (pid < 0) return cannotStart(program, forkError);

  report.write.reset();
  output.write.reset();
  if (const int error = readReport(report.read.get()); error != 0) {
    while (::waitpid(pid, nullptr, 0) < 0 && errno == EINTR) {
    }
    return cannotStart(program, error);
  }
  return Spawned{pid, std::move(output.read)};
}

}  // namespace pitchboard::link
