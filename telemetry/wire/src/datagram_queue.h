// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How datagrams get from the network thread of UdpReceiver, which owns the queue, to the thread
// that looks at them. Any thread.

#include <condition_variable>
#include <mutex>

#include <telemetry/wire/datagram.h>

namespace pitchboard::telemetry {

/// Two batches that change places: the network thread fills one while the other is looked at.
class DatagramQueue {
 public:
  DatagramQueue(std::size_t maxDatagrams, std::size_t maxBytes)
      : m_maxDatagrams(maxDatagrams), m_maxBytes(maxBytes) {}

  /// Appends all of `batch`; what does not fit is counted. True when the queue was empty before.
  bool push(const DatagramBatch& batch) {
    bool first = false;
    {
      const std::lock_guard lock(m_mutex);
      first = m_waiting.empty();
      for (std::size_t i = 0; i < batch.size(); ++i) {
        const DatagramView datagram = batch[i];
        if (m_waiting.size() >= m_maxDatagrams ||
            m_waiting.bytes() + datagram.payload.size() > m_maxBytes) {
          ++m_drops;
        } else {
          m_waiting.append(datagram);
        }
      }
      first = first && !m_waiting.empty();
    }
    if (first) m_arrived.notify_one();
    return first;
  }

  bool take(DatagramBatch& batch, Duration wait) {
    batch.clear();
    std::unique_lock lock(m_mutex);
    if (wait > Duration::zero()) {
      m_arrived.wait_for(lock, wait, [this] { return m_closed || !m_waiting.empty(); });
    }
    std::swap(batch, m_waiting);
    return !batch.empty();
  }

  /// Wakes whoever waits; from now on take() does not wait.
  void close() {
    {
      const std::lock_guard lock(m_mutex);
      m_closed = true;
    }
    m_arrived.notify_all();
  }

  std::uint64_t drops() const {
    const std::lock_guard lock(m_mutex);
    return m_drops;
  }

 private:
  mutable std::mutex m_mutex;
  std::condition_variable m_arrived;
  DatagramBatch m_waiting;
  std::size_t m_maxDatagrams, m_maxBytes;
  std::uint64_t m_drops = 0;
  bool m_closed = false;
};

}  // namespace pitchboard::telemetry
