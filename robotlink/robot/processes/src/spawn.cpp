// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/spawn.h>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include <base/system_reason.h>
#include <base/try.h>
#include <base/unique_fd.h>

namespace pitchboard::link {
namespace {

// Descriptors 0 to 2 are about to be replaced in the child; a parent without standard streams would
// otherwise be given exactly these numbers.
UniqueFd aboveStandard(int fd) {
  UniqueFd low(fd);
  if (fd < 0 || fd > 2) return low;
  return UniqueFd(::fcntl(fd, F_DUPFD_CLOEXEC, 3));
}

struct Ends {
  UniqueFd read, write;
};

bool makePipe(Ends& ends) {
  int fds[2];
  if (::pipe2(fds, O_CLOEXEC) != 0) return false;
  ends.read = aboveStandard(fds[0]);
  ends.write = aboveStandard(fds[1]);
  return ends.read && ends.write;
}

/// Lets a program write this much before it has to wait for its reader. The system may allow less.
constexpr int outputBytes = 1 << 20;

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
    std::string path = (folder.empty() ? "." : std::string(folder)) + "/" + program;
    if (executable(path)) return path;
    if (colon == std::string_view::npos) return {};
    rest.remove_prefix(colon + 1);
  }
}

struct ChildPlan {
  const char* path;
  char* const* arguments;
  char* const* environment;
  const char* directory;  // null: ours
  int input, output, inherited, report;
  pid_t parent;
  bool outlives;
};

constexpr int inheritedDescriptor = 3;

[[noreturn]] void fail(const ChildPlan& plan, int error) {
  while (::write(plan.report, &error, sizeof error) < 0 && errno == EINTR) {
  }
  ::_exit(127);
}

void closeOthersAtExec(int first) {
#ifdef SYS_close_range
  constexpr unsigned closeOnExec = 1U << 2;  // CLOSE_RANGE_CLOEXEC
  if (::syscall(SYS_close_range, static_cast<unsigned>(first), ~0U, closeOnExec) == 0) return;
#endif
  constexpr int defaultLimit = 4096;  // for kernels before 5.11
  for (int fd = first; fd < defaultLimit; ++fd) ::fcntl(fd, F_SETFD, FD_CLOEXEC);
}

// Runs in the child; all signals are blocked until its handlers are reset, so that no handler of
// the parent can run here.
[[noreturn]] void becomeChild(const ChildPlan& plan) {
  if (plan.outlives) {
    ::setsid();
  } else {
    ::setpgid(0, 0);
    if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) fail(plan, errno);
    // The parent may have died before the line above took effect.
    if (::getppid() != plan.parent) ::_exit(127);
  }

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
  if (plan.directory != nullptr && ::chdir(plan.directory) != 0) fail(plan, errno);
  // The way back to us lies above the one descriptor that is handed on.
  int report = plan.report;
  int firstClosed = inheritedDescriptor;
  if (plan.inherited >= 0) {
    report = ::fcntl(plan.report, F_DUPFD_CLOEXEC, inheritedDescriptor + 1);
    const int inherited = ::fcntl(plan.inherited, F_DUPFD_CLOEXEC, inheritedDescriptor + 1);
    if (report < 0 || inherited < 0 || ::dup2(inherited, inheritedDescriptor) < 0) {
      fail(plan, errno);
    }
    ++firstClosed;
  }
  closeOthersAtExec(firstClosed);
  ::execve(plan.path, plan.arguments, plan.environment);
  const int error = errno;
  ChildPlan failed = plan;
  failed.report = report;
  fail(failed, error);
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
  const char* const advice =
      error == EACCES ? "; make the file executable (chmod +x)"
      : error == ENOEXEC
          ? "; a script needs a first line that names its interpreter, #!/usr/bin/env python3"
          : "";
  return failure(code, "cannot start '" + program + "': " + systemReason(error) + advice);
}

std::vector<std::string> environmentOf(const SpawnRequest& request) {
  std::vector<std::string> all;
  for (char** entry = ::environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const auto replaced = [&text](const auto& added) {
      return text.size() > added.first.size() && text.starts_with(added.first) &&
             text[added.first.size()] == '=';
    };
    if (std::ranges::none_of(request.environment, replaced)) {
      all.emplace_back(text);
    }
  }
  for (const auto& [name, value] : request.environment) all.push_back(name + '=' + value);
  return all;
}

std::vector<char*> pointersTo(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// Refuses what the system would refuse, too, but with a better message.
Result<std::string> pathOf(const SpawnRequest& request) {
  if (request.command.empty() || request.command.front().empty()) {
    return failure(ErrorCode::InvalidArgument, "cannot start a process: no program is given");
  }
  const std::string& program = request.command.front();
  std::string path = inPath(program);
  if (path.empty()) {
    return failure(ErrorCode::NotFound, "cannot start '" + program +
                                            "': no such program in PATH; "
                                            "write ./ before the name of a file in this folder");
  }
  struct stat status {};
  std::error_code unused;
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) {
    return cannotStart(program, EISDIR);
  }
  if (!request.directory.empty() &&
      (::stat(request.directory.c_str(), &status) != 0 || !S_ISDIR(status.st_mode))) {
    return failure(ErrorCode::NotFound, "cannot start '" + program + "' in the folder '" +
                                            request.directory + "': no such folder");
  }
  // The child looks for a relative path in its own folder.
  const std::filesystem::path folder = request.directory.empty()
                                           ? std::filesystem::current_path(unused)
                                           : std::filesystem::path(request.directory);
  if (path.front() != '/' && ::stat((folder / path).c_str(), &status) != 0 && errno == ENOENT) {
    return failure(ErrorCode::NotFound, "cannot start '" + program +
                                            "': there is no such file in " + folder.string() +
                                            "; write the whole path, or start from its folder");
  }
  return path;
}

}  // namespace

Result<Spawned> spawn(const SpawnRequest& request) {
  const auto path = TRY(pathOf(request));
  const std::string& program = request.command.front();

  Ends output, report;
  const bool collects = request.output < 0;
  const UniqueFd nothing = aboveStandard(::open("/dev/null", O_RDWR | O_CLOEXEC));
  if (!nothing || !makePipe(report)) return cannotStart(program, errno);
  if (collects && (!makePipe(output) || ::fcntl(output.read.get(), F_SETFL, O_NONBLOCK) != 0)) {
    return cannotStart(program, errno);
  }
  if (collects) (void)::fcntl(output.read.get(), F_SETPIPE_SZ, outputBytes);

  const std::vector<std::string> environment = environmentOf(request);
  const std::vector<char*> arguments = pointersTo(request.command);
  const std::vector<char*> variables = pointersTo(environment);
  const ChildPlan plan{path.c_str(),
                       arguments.data(),
                       variables.data(),
                       request.directory.empty() ? nullptr : request.directory.c_str(),
                       request.input >= 0 ? request.input : nothing.get(),
                       collects ? output.write.get() : request.output,
                       request.inherited,
                       report.write.get(),
                       ::getpid(),
                       request.outlives};

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
