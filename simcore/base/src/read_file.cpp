// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <base/read_file.h>

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>

#include <base/system_reason.h>
#include <base/unique_fd.h>

namespace pitchboard {
namespace {

// Files of the kernel are small and read often; memory for a long file would cost more than they.
constexpr std::size_t firstStep = 4 * kibibyte, maxStep = 256 * kibibyte;

std::string sizeText(std::size_t bytes) {
  constexpr std::size_t mebi = std::size_t{1} << 20;
  if (bytes >= mebi && bytes % mebi == 0) return std::to_string(bytes / mebi) + " MiB";
  return std::to_string(bytes) + " bytes";
}

tl::unexpected<Error> cannotRead(const std::string& what, const std::string& context, int error) {
  return failure(error == ENOENT ? ErrorCode::NotFound : ErrorCode::SystemError,
                 what + " cannot be read: " + systemReason(error) + ".", context);
}

}  // namespace

Result<std::string> readDescriptor(int descriptor, std::size_t maxBytes, const std::string& what,
                                   const std::string& context) {
  std::string bytes;
  // One byte more than allowed tells a file that is too long, however long (or endless) it is.
  while (bytes.size() <= maxBytes) {
    const std::size_t at = bytes.size();
    const std::size_t step = std::clamp(at, firstStep, maxStep);
    bytes.resize(at + std::min(step, maxBytes + 1 - at));
    const ssize_t got = ::read(descriptor, bytes.data() + at, bytes.size() - at);
    const int error = got < 0 ? errno : 0;
    bytes.resize(at + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (error == EINTR) continue;
    if (error != 0) return cannotRead(what, context, error);
    if (got == 0) return bytes;
  }
  return failure(ErrorCode::Unsupported,
                 what + " is larger than " + sizeText(maxBytes) + "; that is not read.", context);
}

Result<std::string> readFile(const std::string& path, std::size_t maxBytes,
                             const std::string& what) {
  UniqueFd descriptor;
  do {
    descriptor.reset(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  } while (!descriptor && errno == EINTR);
  if (!descriptor) return cannotRead(what, path, errno);
  return readDescriptor(descriptor.get(), maxBytes, what, path);
}

}  // namespace pitchboard
