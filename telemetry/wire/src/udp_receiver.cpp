// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/wire/udp_receiver.h>

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <mutex>
#include <optional>
#include <thread>

#include <base/system_reason.h>
#include <telemetry/wire/socket_address.h>

#include "datagram_queue.h"
#include "udp_socket.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::uint32_t stopEvent = ~0U;

}  // namespace

struct UdpReceiver::Impl {
  Impl(ReceiverOptions o, std::function<void()> ready)
      : options(std::move(o)),
        onReady(std::move(ready)),
        queue(options.maxDatagrams, options.maxBytes),
        poll(epoll_create1(EPOLL_CLOEXEC)),
        wake(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
        sockets(options.ports.size()) {
    if (!options.clock) options.clock = std::make_shared<const LiveClock>();
    status.ports.resize(options.ports.size());
    for (std::size_t i = 0; i < options.ports.size(); ++i) status.ports[i].port = options.ports[i];
  }

  bool watch(int descriptor, std::uint32_t what) const {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u32 = what;
    return epoll_ctl(poll.get(), EPOLL_CTL_ADD, descriptor, &event) == 0;
  }

  /// True when every port is bound.
  bool bindMissing() {
    bool all = true;
    for (std::size_t i = 0; i < sockets.size(); ++i) {
      if (sockets[i]) continue;
      auto socket = UdpSocket::bind(options.bind, options.ports[i], options.receiveBufferBytes);
      const bool good = socket && watch(socket->descriptor(), static_cast<std::uint32_t>(i));
      const std::lock_guard lock(statusMutex);
      PortStatus& port = status.ports[i];
      port.bound = good;
      if (good) {
        port.port = socket->port();
        port.problem.clear();
        sockets[i] = std::move(*socket);
      } else {
        port.problem = socket ? systemReason(errno) : socket.error().text();
        all = false;
      }
    }
    return all;
  }

  /// Takes everything that a socket holds, but no more than a few hundred datagrams in one go, so
  /// that a flood on one port cannot starve the others.
  void drain(std::size_t index) {
    constexpr int maxRounds = 8;
    for (int round = 0; round < maxRounds; ++round) {
      received.clear();
      std::uint64_t drops = 0;
      const std::size_t count = sockets[index]->receive(buffers, *options.clock, received, drops);
      if (count == 0) return;
      {
        const std::lock_guard lock(statusMutex);
        PortStatus& port = status.ports[index];
        port.datagrams += count;
        port.bytes += received.bytes();
        port.kernelDrops += drops;
        for (std::size_t i = 0; i < count; ++i) port.truncated += received[i].truncated ? 1U : 0U;
      }
      if (queue.push(received) && onReady) onReady();
      if (count < ReceiveBuffers::messages) return;
    }
  }

  void run() {
    using Clock = std::chrono::steady_clock;
    bool complete = bindMissing();
    auto nextTry = Clock::now() + options.retry;
    std::array<epoll_event, 32> events{};
    for (;;) {
      int wait = -1;
      if (!complete) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(nextTry - Clock::now());
        wait = static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 60'000));
      }
      const int count =
          epoll_wait(poll.get(), events.data(), static_cast<int>(events.size()), wait);
      if (count < 0 && errno != EINTR) return;
      for (int i = 0; i < count; ++i) {
        const std::uint32_t what = events[static_cast<std::size_t>(i)].data.u32;
        if (what == stopEvent) return;
        drain(what);
      }
      if (!complete && Clock::now() >= nextTry) {
        complete = bindMissing();
        nextTry = Clock::now() + options.retry;
      }
    }
  }

  ReceiverOptions options;
  std::function<void()> onReady;
  DatagramQueue queue;
  UniqueFd poll, wake;
  std::vector<std::optional<UdpSocket>> sockets;
  ReceiveBuffers buffers;
  DatagramBatch received;
  mutable std::mutex statusMutex;
  ReceiverStatus status;
  std::mutex stopMutex;
  std::thread thread;
};

Result<std::vector<std::uint16_t>> livePorts(int base, int count, int referee) {
  std::vector<std::uint16_t> ports;
  if (base < 0 || count < 0 || count > 1024 || base + count > highestPort) {
    return failure(ErrorCode::InvalidArgument,
                   "The robots' ports must lie between 1 and 65535; choose another port base.",
                   "port base " + std::to_string(base));
  }
  if (!isPort(referee)) {
    return failure(ErrorCode::InvalidArgument, "A port is a number from 1 to 65535.",
                   "GameController port " + std::to_string(referee));
  }
  if (referee > base && referee <= base + count) {
    return failure(ErrorCode::InvalidArgument,
                   "This port is also one of the robots'; choose another port base.",
                   "GameController port " + std::to_string(referee));
  }
  for (int i = 1; i <= count; ++i) ports.push_back(static_cast<std::uint16_t>(base + i));
  ports.push_back(static_cast<std::uint16_t>(referee));
  return ports;
}

std::uint64_t ReceiverStatus::kernelDrops() const {
  std::uint64_t sum = 0;
  for (const PortStatus& port : ports) sum += port.kernelDrops;
  return sum;
}

std::uint64_t ReceiverStatus::datagrams() const {
  std::uint64_t sum = 0;
  for (const PortStatus& port : ports) sum += port.datagrams;
  return sum;
}

Result<std::unique_ptr<UdpReceiver>> UdpReceiver::start(ReceiverOptions options,
                                                        std::function<void()> onReady) {
  auto impl = std::make_unique<Impl>(std::move(options), std::move(onReady));
  if (impl->poll.get() < 0 || impl->wake.get() < 0 || !impl->watch(impl->wake.get(), stopEvent)) {
    return failure(ErrorCode::SystemError,
                   "Cannot wait for data from the network: " + systemReason(errno) + ".");
  }
  // Bound before the thread starts, so that whoever started it may send at once.
  impl->bindMissing();
  Impl* raw = impl.get();
  impl->thread = std::thread([raw] { raw->run(); });
  return std::unique_ptr<UdpReceiver>(new UdpReceiver(std::move(impl)));
}

UdpReceiver::UdpReceiver(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}

UdpReceiver::~UdpReceiver() {
  stop();
}

void UdpReceiver::stop() {
  const std::lock_guard lock(m_impl->stopMutex);
  if (!m_impl->thread.joinable()) return;
  const std::uint64_t one = 1;
  // Cannot fail: the counter of an eventfd holds far more than one.
  [[maybe_unused]] const auto written = write(m_impl->wake.get(), &one, sizeof one);
  m_impl->thread.join();
  m_impl->queue.close();
}

bool UdpReceiver::take(DatagramBatch& batch, Duration wait) {
  return m_impl->queue.take(batch, wait);
}

ReceiverStatus UdpReceiver::status() const {
  ReceiverStatus status;
  {
    const std::lock_guard lock(m_impl->statusMutex);
    status = m_impl->status;
  }
  status.queueDrops = m_impl->queue.drops();
  return status;
}

}  // namespace pitchboard::telemetry
