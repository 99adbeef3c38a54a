// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/fake_time.h>

#include <sys/mman.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <base/system_reason.h>

namespace pitchboard::link {
namespace {

// Stopped programs do not look at their clock; the library knows no speed of 0.
constexpr double stoppedSpeed = 1e-6;

}  // namespace

std::string FakeTime::library() {
#ifdef __x86_64__
  constexpr const char* machine = "x86_64-linux-gnu";
#elif defined(__aarch64__)
  constexpr const char* machine = "aarch64-linux-gnu";
#else
  constexpr const char* machine = "";
#endif
  // Programs with threads need the second one; it serves the others as well.
  for (const std::string& folder :
       {std::string("/usr/lib/") + machine + "/faketime", std::string("/usr/lib64/faketime"),
        std::string("/usr/lib/faketime")}) {
    const std::string file = folder + "/libfaketimeMT.so.1";
    if (::access(file.c_str(), R_OK) == 0) return file;
  }
  return {};
}

Result<std::unique_ptr<FakeTime>> FakeTime::create() {
  if (library().empty()) {
    return failure(ErrorCode::NotFound,
                   "a team's own programs run at ×1 only, because libfaketime is not installed; "
                   "install the package faketime");
  }
  Descriptor file(::memfd_create("pitchboard-time", MFD_CLOEXEC));
  if (!file) {
    return failure(ErrorCode::SystemError,
                   "the programs' time cannot be set: " + systemReason(errno));
  }
  return std::unique_ptr<FakeTime>(new FakeTime(std::move(file)));
}

std::vector<std::pair<std::string, std::string>> FakeTime::start(double speed, Time now) {
  m_started = m_changed = now;
  m_passed = 0.0;
  m_speed = speed;
  write();
  const char* before = std::getenv("LD_PRELOAD");
  const std::string preload =
      library() + (before != nullptr && *before != '\0' ? ' ' + std::string(before) : "");
  return {{"LD_PRELOAD", preload},
          {"FAKETIME_TIMESTAMP_FILE",
           "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(m_file.get())},
          {"FAKETIME_NO_CACHE", "1"}};
}

void FakeTime::setSpeed(double speed, Time now) {
  m_passed += std::chrono::duration<double>(now - m_changed).count() * m_speed;
  m_changed = now;
  m_speed = speed;
  write();
}

void FakeTime::write() const {
  // The library: time = start + (now - start) · rate + offset, from the program's own start on.
  const double rate = m_speed > 0.0 ? m_speed : stoppedSpeed;
  const double offset =
      m_passed - std::chrono::duration<double>(m_changed - m_started).count() * rate;
  std::array<char, 64> text{};
  const int size = std::snprintf(text.data(), text.size(), "%+.6f x%.9g\n", offset, rate);
  // One write at the beginning, so that a reader never sees half of it; blanks cover an older one.
  std::string padded(text.data(), static_cast<std::size_t>(size));
  padded.resize(text.size(), '\n');
  (void)!::pwrite(m_file.get(), padded.data(), padded.size(), 0);
}

void FakeTime::removeRemains(int pid) {
  std::error_code ignored;
  for (const char* name : {"/dev/shm/faketime_shm_", "/dev/shm/sem.faketime_sem_"}) {
    std::filesystem::remove(name + std::to_string(pid), ignored);
  }
}

}  // namespace pitchboard::link
