// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/ipc.h>
#include <sys/shm.h>

#include <atomic>
#include <cerrno>
#include <utility>

#include <base/system_reason.h>
#include <robotlink/blackboard/system_v.h>

namespace pitchboard::link {
namespace {

Error attachError(const SegmentInfo& info, int number) {
  const std::string context = "segment " + std::to_string(info.key);
  if (number != EACCES) {
    return {ErrorCode::SystemError, "shmat failed: " + systemReason(number), context};
  }
  return {ErrorCode::SystemError,
          "belongs to user " + std::to_string(info.owner) +
              " and may not be read by this program; run as that user, or create it with a mode "
              "that lets others read (0644)",
          context};
}

}  // namespace

SegmentView::SegmentView(const void* address, int key, int shmid, std::size_t bytes)
    : m_address(address), m_key(key), m_shmid(shmid), m_bytes(bytes) {}

SegmentView::SegmentView(SegmentView&& other) noexcept
    : m_address(std::exchange(other.m_address, nullptr)),
      m_key(other.m_key),
      m_shmid(other.m_shmid),
      m_bytes(other.m_bytes) {}

SegmentView& SegmentView::operator=(SegmentView&& other) noexcept {
  std::swap(m_address, other.m_address);
  std::swap(m_key, other.m_key);
  std::swap(m_shmid, other.m_shmid);
  std::swap(m_bytes, other.m_bytes);
  return *this;
}

SegmentView::~SegmentView() {
  if (m_address != nullptr) shmdt(m_address);
}

Result<SegmentView> SegmentView::attach(int key, std::size_t bytes) {
  const auto info = SystemVSegments::info(key);
  if (!info) return tl::unexpected(info.error());
  if (bytes != 0 && info->bytes != bytes) {
    return failure(ErrorCode::Conflict,
                   "has " + std::to_string(info->bytes) + " bytes, not " + std::to_string(bytes) +
                       "; give its real size or its own catalog",
                   "segment " + std::to_string(key));
  }
  const void* const address = shmat(info->shmid, nullptr, SHM_RDONLY);
  // shmat's way of saying that it failed.
  if (address == reinterpret_cast<const void*>(-1)) {
    return tl::unexpected(attachError(*info, errno));
  }
  return SegmentView(address, key, info->shmid, info->bytes);
}

std::uint32_t SegmentView::word(std::size_t index) const {
  if (index >= m_bytes / sizeof(std::uint32_t)) return 0;
  // An atomic_ref takes no const object; nothing is written.
  auto* const words = static_cast<std::uint32_t*>(const_cast<void*>(m_address));
  return std::atomic_ref<std::uint32_t>(words[index]).load(std::memory_order_relaxed);
}

bool SegmentView::isThere() const {
  const auto info = SystemVSegments::info(m_key);
  return info && info->shmid == m_shmid;
}

bool SegmentView::isShared() const {
  shmid_ds status{};
  return shmctl(m_shmid, IPC_STAT, &status) == 0 && status.shm_nattch > 1;
}

}  // namespace pitchboard::link
