// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/sockets/udp_receiver.h>

#include <ifaddrs.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cinttypes>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <vector>

#include <arpa/inet.h>
#include <base/system_reason.h>
#include <net/if.h>
#include <netinet/in.h>
#include <telemetry/sockets/datagram.h>
#include <telemetry/sockets/socket_address.h>

#include "udp_socket.h"

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

  /// Wakes waiting threads; from now on take() does not wait.
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

/// A socket that another program has bound.
struct BoundSocket {
  Address address;  ///< 0.0.0.0: all
  std::uint16_t port = 0;
  std::uint64_t inode = 0;
};

namespace {

namespace fs = std::filesystem;

constexpr std::string_view socketPrefix = "socket:[";

/// Calls `take` with the inode of each socket that a process has open, until it returns false.
template <class Take>
void eachSocket(const fs::path& process, Take take) {
  std::error_code error;
  for (fs::directory_iterator entry(process / "fd", error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code unreadable;
    const std::string target = fs::read_symlink(entry->path(), unreadable).string();
    if (unreadable || !target.starts_with(socketPrefix)) continue;
    if (!take(std::strtoull(target.c_str() + socketPrefix.size(), nullptr, 10))) return;
  }
}

}  // namespace

/// Returns the UDP sockets of other programs in this network namespace; empty if the system does
/// not tell.
std::optional<std::vector<BoundSocket>> socketsOfOthers() {
  std::ifstream table("/proc/self/net/udp");
  std::string line;
  if (!std::getline(table, line)) return std::nullopt;
  std::vector<BoundSocket> others;
  while (std::getline(table, line)) {
    unsigned address = 0, port = 0;
    std::uint64_t inode = 0;
    constexpr const char* form = "%*u: %x:%x %*x:%*x %*x %*x:%*x %*x:%*x %*x %*u %*d %" SCNu64;
    if (std::sscanf(line.c_str(), form, &address, &port, &inode) != 3) continue;
    others.push_back({{ntohl(address)}, static_cast<std::uint16_t>(port), inode});
  }
  std::vector<std::uint64_t> own;
  eachSocket("/proc/self", [&own](std::uint64_t inode) {
    own.push_back(inode);
    return true;
  });
  std::erase_if(others, [&own](const BoundSocket& socket) {
    return std::ranges::find(own, socket.inode) != own.end();
  });
  return others;
}

/// Names the programs that have the sockets with these inodes, "pitchboard (process 4711)". Only
/// the user's own processes can be searched; others stay "another program".
void namePrograms(std::map<std::uint64_t, std::string>& programs) {
  for (auto& [inode, program] : programs) program = "another program";
  std::error_code error;
  for (fs::directory_iterator entry("/proc", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string process = entry->path().filename().string();
    if (process.find_first_not_of("0123456789") != std::string::npos) continue;
    std::string title;
    eachSocket(entry->path(), [&](std::uint64_t inode) {
      const auto wanted = programs.find(inode);
      if (wanted == programs.end()) return true;
      if (title.empty()) {
        std::ifstream comm(entry->path() / "comm");
        std::getline(comm, title);
        title += " (process " + process + ")";
      }
      wanted->second = title;
      return true;
    });
  }
}

/// Returns the addresses at which broadcasts arrive: 255.255.255.255 and that of each interface.
std::vector<Address> broadcastAddresses() {
  std::vector<Address> found{{INADDR_BROADCAST}};
  const auto add = [&found](Address address) {
    if (std::ranges::find(found, address) == found.end()) found.push_back(address);
  };
  add({0x7fffffff});  // 127.255.255.255: the loopback interface does not name it
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return found;
  struct Free {
    void operator()(ifaddrs* list) const { freeifaddrs(list); }
  };
  const std::unique_ptr<ifaddrs, Free> owner(first);
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    if ((one->ifa_flags & IFF_BROADCAST) == 0 || one->ifa_broadaddr == nullptr) continue;
    sockaddr_in name{};
    std::memcpy(&name, one->ifa_broadaddr, sizeof name);
    add({ntohl(name.sin_addr.s_addr)});
  }
  return found;
}

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
        ports(options.ports.size()) {
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

  /// Opens the sockets of a port: one, or one for each broadcast address if another program was
  /// there first. Returns why there is none.
  std::string open(std::size_t index) {
    std::vector<UdpSocket>& sockets = ports[index];
    sockets.clear();
    const std::uint16_t port = options.ports[index];
    const int bytes = options.receiveBufferBytes;
    const PortUse use = options.yieldsToFirst ? PortUse::First : PortUse::Shared;
    auto whole = UdpSocket::bind(options.bind, port, bytes, use);
    const bool yields = !whole && options.yieldsToFirst && options.bind.value == INADDR_ANY;
    if (whole) sockets.push_back(std::move(*whole));
    for (const Address address : yields ? broadcastAddresses() : std::vector<Address>{}) {
      if (auto part = UdpSocket::bind(address, port, bytes, PortUse::Shared)) {
        sockets.push_back(std::move(*part));
      }
    }
    for (const UdpSocket& socket : sockets) {
      if (watch(socket.descriptor(), static_cast<std::uint32_t>(index))) continue;
      const std::string reason = systemReason(errno);
      sockets.clear();
      return reason;
    }
    const std::lock_guard lock(statusMutex);
    PortStatus& known = status.ports[index];
    known.bound = !sockets.empty();
    known.broadcastsOnly = known.bound && yields;
    if (known.bound) known.port = sockets.front().port();
    return known.bound ? std::string() : whole.error().text();
  }

  /// True when every port is bound.
  bool bindMissing() {
    bool all = true;
    for (std::size_t i = 0; i < ports.size(); ++i) {
      if (!ports[i].empty()) continue;
      std::string problem = open(i);
      all = all && problem.empty();
      const std::lock_guard lock(statusMutex);
      status.ports[i].problem = std::move(problem);
    }
    return all;
  }

  /// Finds out which other programs receive on these ports, and takes over a port whose first
  /// program has ended.
  void lookAround() {
    std::vector<BoundSocket> others = socketsOfOthers().value_or(std::vector<BoundSocket>{});
    std::erase_if(others, [this](const BoundSocket& other) {
      return std::ranges::find(status.ports, other.port, &PortStatus::port) == status.ports.end();
    });
    std::map<std::uint64_t, std::string> named;
    bool isKnown = true;
    for (const BoundSocket& other : others) {
      const auto known = programs.find(other.inode);
      isKnown = isKnown && known != programs.end();
      named[other.inode] = known != programs.end() ? known->second : std::string();
    }
    if (!isKnown) namePrograms(named);
    programs = std::move(named);

    const std::vector<Address> broadcasts = broadcastAddresses();
    std::vector<PortStatus> found(ports.size());
    for (std::size_t i = 0; i < ports.size(); ++i) {
      for (const BoundSocket& other : others) {
        if (other.port != status.ports[i].port) continue;
        const bool isBroadcast = std::ranges::find(broadcasts, other.address) != broadcasts.end();
        found[i].othersTakeAll = found[i].othersTakeAll || !isBroadcast;
        std::string& names = found[i].others;
        const std::string& name = programs[other.inode];
        if (names.find(name) == std::string::npos) names += (names.empty() ? "" : ", ") + name;
      }
      if (!status.ports[i].broadcastsOnly || found[i].othersTakeAll) continue;
      drain(i);
      (void)open(i);
    }
    // At once, so that no other thread sees a part of it.
    const std::lock_guard lock(statusMutex);
    for (std::size_t i = 0; i < ports.size(); ++i) {
      PortStatus& port = status.ports[i];
      // The kernel knows of it even if /proc does not tell.
      const bool isHidden = port.broadcastsOnly && found[i].others.empty();
      port.others = isHidden ? "another program" : std::move(found[i].others);
      port.othersTakeAll = found[i].othersTakeAll;
    }
  }

  /// Takes everything that a socket holds, but no more than a few hundred datagrams in one go, so
  /// that a flood on one port cannot starve the others.
  void drain(std::size_t index) {
    for (UdpSocket& socket : ports[index]) drain(index, socket);
  }

  void drain(std::size_t index, UdpSocket& socket) {
    constexpr int maxRounds = 8;
    for (int round = 0; round < maxRounds; ++round) {
      received.clear();
      std::uint64_t drops = 0;
      const std::size_t count = socket.receive(buffers, *options.clock, received, drops);
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
      if (!complete || options.yieldsToFirst) {
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
      if ((!complete || options.yieldsToFirst) && Clock::now() >= nextTry) {
        complete = bindMissing();
        if (options.yieldsToFirst) lookAround();
        nextTry = Clock::now() + options.retry;
      }
    }
  }

  ReceiverOptions options;
  std::function<void()> onReady;
  DatagramQueue queue;
  UniqueFd poll, wake;
  std::vector<std::vector<UdpSocket>> ports;      // in the order of the options; empty: not bound
  std::map<std::uint64_t, std::string> programs;  // of other programs' sockets, by inode
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

std::vector<std::string> portRanges(std::vector<std::uint16_t> ports) {
  std::ranges::sort(ports);
  std::vector<std::string> ranges;
  for (std::size_t i = 0; i < ports.size();) {
    std::size_t last = i;
    while (last + 1 < ports.size() && ports[last + 1] == ports[last] + 1) ++last;
    std::string& range = ranges.emplace_back(std::to_string(ports[i]));
    if (last > i) range += "–" + std::to_string(ports[last]);
    i = last + 1;
  }
  return ranges;
}

std::string sharedPortsText(const ReceiverStatus& status, std::optional<std::uint16_t> ignored) {
  // One sentence for the ports that are shared with the same programs in the same way.
  std::map<std::tuple<bool, bool, std::string>, std::vector<std::uint16_t>> shared;
  for (const PortStatus& port : status.ports) {
    if (!port.bound || port.others.empty() || port.port == ignored) continue;
    shared[{port.broadcastsOnly, port.othersTakeAll, port.others}].push_back(port.port);
  }
  std::string text;
  for (const auto& [how, ports] : shared) {
    const auto& [broadcastsOnly, takeAll, others] = how;
    std::string list;
    for (const std::string& range : portRanges(ports)) list += (list.empty() ? "" : ", ") + range;
    text += text.empty() ? "" : " ";
    if (broadcastsOnly) {
      text += "UDP " + list + " was first opened by " + others +
              ", which gets what robots send to this computer alone. Only broadcasts arrive here. "
              "Close that program to receive everything.";
    } else if (takeAll) {
      text += "UDP " + list + " was opened later by " + others +
              ", which now gets what robots send to this computer alone. Close that program.";
    } else {
      text += "UDP " + list + " was also opened by " + others +
              ", which receives broadcasts only. Everything still arrives here.";
    }
  }
  return text;
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
  // Bound before the thread starts, so that the caller can send at once.
  impl->bindMissing();
  if (impl->options.yieldsToFirst) impl->lookAround();
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
