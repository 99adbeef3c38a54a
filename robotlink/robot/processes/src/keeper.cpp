// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/keeper.h>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>

#include <base/system_reason.h>
#include <base/try.h>

#include "process_table.h"

namespace pitchboard::link {
namespace {

constexpr int control = 3;  // the descriptor that a keeper inherits

void signalAll(int number) {
  for (const pid_t pid : descendantsOf(::getpid())) ::kill(pid, number);
}

void passOn(int number, pid_t program) {
  switch (number) {
    case SIGSTOP:
      signalAll(number);  // what is started meanwhile is found by the second look
      [[fallthrough]];
    case SIGCONT:
    case SIGKILL:
      signalAll(number);
      break;
    default:
      ::kill(-program, number);
  }
}

/// Ends as the program did, once nothing that it started lives.
[[noreturn]] void endLike(const siginfo_t& end) {
  ::kill(-end.si_pid, SIGKILL);
  // Each killed process leaves its children to us. The program's own number is still taken.
  while (::waitpid(end.si_pid, nullptr, 0) < 0 && errno == EINTR) {
  }
  while (!descendantsOf(::getpid()).empty()) {
    signalAll(SIGKILL);
    ::waitpid(-1, nullptr, 0);
  }
  if (end.si_code == CLD_EXITED) ::_exit(end.si_status);
  ::prctl(PR_SET_DUMPABLE, 0);  // the program has left a core dump if it was to
  std::signal(end.si_status, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::kill(::getpid(), end.si_status);
  ::_exit(EXIT_FAILURE);
}

/// Collects what ended.
void reap(pid_t program) {
  siginfo_t end{};
  while (::waitid(P_ALL, 0, &end, WEXITED | WNOHANG | WNOWAIT) == 0 && end.si_pid != 0) {
    if (end.si_pid == program) endLike(end);
    ::waitpid(end.si_pid, nullptr, 0);
    end.si_pid = 0;
  }
}

}  // namespace

Result<Kept> spawnKept(const SpawnRequest& request, const std::string& robotProgram) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    return failure(ErrorCode::SystemError,
                   "cannot start the keeper of the robots' processes: " + systemReason(errno));
  }
  Kept kept{{}, UniqueFd(ends[0])};
  UniqueFd its(ends[1]);
  // The environment is the program's alone: a library that it loads is not for the keeper.
  SpawnRequest keeper{{robotProgram, std::string(keepCommand), request.directory,
                       std::to_string(request.environment.size())}};
  for (const auto& [name, value] : request.environment) {
    keeper.command.insert(keeper.command.end(), {name, value});
  }
  keeper.command.insert(keeper.command.end(), request.command.begin(), request.command.end());
  keeper.inherited = its.get();
  keeper.outlives = true;
  kept.keeper = TRY(spawn(keeper));
  its.reset();  // a keeper that is gone must not be waited for
  std::array<char, 4096> answer{};
  ssize_t got = 0;
  do {
    got = ::recv(kept.control.get(), answer.data(), answer.size() - 1, 0);
  } while (got < 0 && errno == EINTR);
  char* rest = nullptr;
  const long number = std::strtol(answer.data(), &rest, 10);
  if (got > 0 && *rest == '\0') {
    kept.program = static_cast<pid_t>(number);
    return kept;
  }
  ::waitpid(kept.keeper.pid, nullptr, 0);
  if (got > 0) return failure(static_cast<ErrorCode>(number), rest + 1);
  return failure(ErrorCode::SystemError, "the keeper of '" + request.command.front() + "' ended");
}

void keep(const std::vector<std::string>& arguments) {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_IGN);
  sigset_t ended;
  ::sigemptyset(&ended);
  ::sigaddset(&ended, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &ended, nullptr);
  const UniqueFd ends(::signalfd(-1, &ended, SFD_CLOEXEC | SFD_NONBLOCK));

  SpawnRequest request;
  request.directory = arguments.at(0);
  std::size_t at = 2;
  for (int left = std::stoi(arguments.at(1)); left > 0; --left, at += 2) {
    request.environment.emplace_back(arguments.at(at), arguments.at(at + 1));
  }
  request.command.assign(arguments.begin() + static_cast<std::ptrdiff_t>(at), arguments.end());
  request.output = STDOUT_FILENO;
  const auto program = spawn(request);
  const std::string answer = program ? std::to_string(program->pid)
                                     : std::to_string(static_cast<int>(program.error().code)) +
                                           ' ' + program.error().message;
  (void)::send(control, answer.data(), answer.size(), MSG_NOSIGNAL);
  if (!program) return;

  std::array<pollfd, 2> sources{{{control, POLLIN, 0}, {ends.get(), POLLIN, 0}}};
  while (true) {
    (void)::poll(sources.data(), sources.size(), -1);
    char number = SIGKILL;
    if (sources[0].revents != 0) {
      const ssize_t got = ::recv(control, &number, 1, MSG_DONTWAIT);
      if (got == 0) sources[0].fd = -1;  // our parent has ended
      if (got >= 0) passOn(number, program->pid);
    }
    signalfd_siginfo signal;
    while (::read(ends.get(), &signal, sizeof signal) > 0) {
    }
    reap(program->pid);
  }
}

}  // namespace pitchboard::link
