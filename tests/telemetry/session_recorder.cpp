// SPDX-License-Identifier: GPL-3.0-or-later
// Records rows until it is killed: session_recorder FILE SHARED SECONDS. SHARED is a file of 16
// bytes, mapped: number and time (s) of the last row that was handed to the recording. SECONDS: how
// long the disk takes to keep what it is given; 0: as it is.

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <thread>

#include <telemetry/session/session_writer.h>

using namespace pitchboard::telemetry;

struct Shared {
  std::atomic<std::uint64_t> rows;
  std::atomic<double> time;
};

namespace {

unsigned stall = 0;

}  // namespace

// Instead of the C library's.
extern "C" int fdatasync(int descriptor) {
  if (stall == 0) return fsync(descriptor);
  sleep(stall);
  return 0;
}

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  stall = static_cast<unsigned>(std::atoi(argv[3]));
  const int descriptor = open(argv[2], O_RDWR | O_CLOEXEC);
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (memory == MAP_FAILED) return 2;
  Shared& shared = *static_cast<Shared*>(memory);
  auto writer = SessionWriter::create(argv[1], {});
  if (!writer) return 2;
  GroupInfo info{"match", {{"COUNT", ColumnType::Float64, "", "", ColumnKind::Number, {}}}, {}};
  for (int i = 0; i < 200; ++i) {
    info.columns.push_back(
        {"X" + std::to_string(i), ColumnType::Float64, "", "", ColumnKind::Number, {}});
  }
  const GroupId group = (*writer)->addGroup(info);
  std::vector<double> values(info.columns.size());
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t row = 0; getppid() != 1; ++row) {
    const double time =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    values[0] = static_cast<double>(row);
    values[1 + row % 200] = time;
    (*writer)->append(group, {time, {}, values});
    shared.time = time;
    shared.rows = row + 1;
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  return 0;
}
