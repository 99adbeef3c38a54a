// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/foxglove/foxglove_client.h>

#include <netdb.h>
#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <unordered_map>
#include <utility>

#include <telemetry/formats/text_errors.h>

namespace pitchboard::telemetry {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using ErrorOf = boost::system::error_code;
using Endpoints = std::vector<Tcp::endpoint>;

constexpr std::size_t readBytes = std::size_t{64} << 10;  // in one go
constexpr std::size_t keptBuffer = std::size_t{4} << 20;  // larger ones are given back
constexpr std::size_t eventBytes = 64;                    // of an event besides its contents
constexpr std::size_t shownText = 200;                    // of what a server says

std::string megabytes(std::size_t bytes) {
  return std::to_string(bytes >> 20) + " MB";
}

/// Looks up a name; this may take long.
Endpoints lookUp(const std::string& host, std::uint16_t port, std::string& problem) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int code = ::getaddrinfo(host.c_str(), nullptr, &wanted, &found);
  if (code != 0) {
    problem = ::gai_strerror(code);
    return {};
  }
  Endpoints endpoints;
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    Tcp::endpoint endpoint;
    if (one->ai_addrlen > endpoint.capacity()) continue;
    std::copy_n(reinterpret_cast<const char*>(one->ai_addr), one->ai_addrlen,
                reinterpret_cast<char*>(endpoint.data()));
    endpoint.resize(one->ai_addrlen);
    endpoint.port(port);
    endpoints.push_back(endpoint);
  }
  ::freeaddrinfo(found);
  if (endpoints.empty()) problem = "the name has no address";
  return endpoints;
}

}  // namespace

/// Everything but take(), subscribe() and status() is done on the thread.
struct FoxgloveClient::Impl {
  /// One attempt. What is under way holds it.
  struct Connection {
    explicit Connection(asio::io_context& context) : stream(context) {}
    websocket::stream<beast::tcp_stream> stream;
    websocket::response_type response;
    beast::flat_buffer buffer;
    std::deque<std::string> outgoing;  ///< the first one is being written
    bool isSkipping = false;           ///< the rest of a frame that is too large
    bool hasBegun = false;
    std::string sessionId;
    std::size_t schemaBytes = 0;
    struct Channel {
      std::size_t schemaBytes = 0;
      std::optional<std::uint32_t> subscription;
    };
    std::unordered_map<std::uint32_t, Channel> channels;
    std::unordered_map<std::uint32_t, std::uint32_t> channelOf;  ///< by subscription
    std::uint32_t nextSubscription = 1;
  };
  using ConnectionPtr = std::shared_ptr<Connection>;

  /// How a thread that looks up a name finds us, as long as we are there.
  struct Link {
    std::mutex mutex;
    Impl* impl = nullptr;
  };

  Impl(FoxgloveAddress a, std::function<WallTime()> n, std::function<void()> e, FoxgloveLimits l)
      : address(std::move(a)), now(std::move(n)), onEvent(std::move(e)), limits(l) {
    link->impl = this;
    retry = limits.firstRetry;
    asio::post(context, [this] { connect(); });
    thread = std::thread([this] { run(); });
  }

  ~Impl() {
    {
      const std::lock_guard lock(link->mutex);
      link->impl = nullptr;
    }
    context.stop();
    thread.join();
  }

  void run() {
    while (!context.stopped()) {
      try {
        context.run();
        return;  // stopped: there is always a timer or an operation
      } catch (const std::exception& error) {
        fail(connection, error.what());
      }
    }
  }

  // Connecting.
  void connect() {
    connection = std::make_shared<Connection>(context);
    setState(FoxgloveState::Connecting);
    expectAnswer(connection);
    ErrorOf error;
    const auto numeric = asio::ip::make_address(address.host, error);
    if (!error) return reach(connection, {Tcp::endpoint(numeric, address.port)});
    if (isLookingUp) return;  // its result is that of this attempt
    isLookingUp = true;
    std::thread([link = link, host = address.host, port = address.port] {
      std::string problem;
      Endpoints endpoints = lookUp(host, port, problem);
      const std::lock_guard lock(link->mutex);
      if (link->impl == nullptr) return;
      asio::post(link->impl->context, [impl = link->impl, problem, endpoints] {
        impl->isLookingUp = false;
        if (endpoints.empty()) {
          impl->fail(impl->connection, problem);
        } else {
          impl->reach(impl->connection, endpoints);
        }
      });
    }).detach();
  }

  void reach(const ConnectionPtr& by, const Endpoints& endpoints) {
    if (!by) return;
    // Between two attempts, or a second answer to one.
    if (beast::get_lowest_layer(by->stream).socket().is_open()) return;
    auto kept = std::make_shared<Endpoints>(endpoints);
    beast::get_lowest_layer(by->stream)
        .async_connect(*kept, [this, by, kept](const ErrorOf& error, const Tcp::endpoint&) {
          if (error) return fail(by, error.message());
          greet(by);
        });
  }

  void greet(const ConnectionPtr& by) {
    if (by != connection) return;
    ErrorOf ignored;
    beast::get_lowest_layer(by->stream).socket().set_option(Tcp::no_delay(true), ignored);
    by->stream.set_option(websocket::stream_base::timeout{
        websocket::stream_base::none(),  // expectAnswer() sees to it
        std::chrono::duration_cast<std::chrono::steady_clock::duration>(limits.silence), true});
    by->stream.set_option(websocket::stream_base::decorator([](websocket::request_type& request) {
      std::string offered;
      for (const std::string_view one : foxgloveSubprotocols) {
        offered += (offered.empty() ? "" : ", ") + std::string(one);
      }
      request.set(beast::http::field::sec_websocket_protocol, offered);
      request.set(beast::http::field::user_agent, "pitchboard");
    }));
    by->stream.read_message_max(0);  // a frame that is too large costs itself, not the connection
    const std::string host = address.text().substr(5, address.text().find('/', 5) - 5);
    by->stream.async_handshake(by->response, host, address.path,
                               [this, by](const ErrorOf& error) { greeted(by, error); });
  }

  void greeted(const ConnectionPtr& by, const ErrorOf& error) {
    if (by != connection) return;
    if (error == websocket::error::upgrade_declined) {
      return fail(by, "the server answered with HTTP " + std::to_string(by->response.result_int()) +
                          " and does not speak Foxglove's protocol there");
    }
    if (error) return fail(by, error.message());
    const auto chosen = by->response[beast::http::field::sec_websocket_protocol];
    const std::string subprotocol(chosen.data(), chosen.size());
    if (std::ranges::find(foxgloveSubprotocols, subprotocol) == foxgloveSubprotocols.end()) {
      return fail(by, "the server speaks WebSocket, but not Foxglove's protocol");
    }
    {
      const std::lock_guard lock(mutex);
      status.subprotocol = subprotocol;
      ++status.connections;
    }
    read(by);
  }

  /// Gives up an attempt that does not get on.
  void expectAnswer(const ConnectionPtr& by) {
    timer.expires_after(limits.answer);
    timer.async_wait([this, by](const ErrorOf& error) {
      if (error || by != connection || by->hasBegun) return;
      fail(by, "no answer");
    });
  }

  void fail(const ConnectionPtr& failed, const std::string& why) {
    if (!failed || failed != connection) return;                  // it has failed already
    const ConnectionPtr by = std::exchange(connection, nullptr);  // `failed` may be `connection`
    ErrorOf ignored;
    beast::get_lowest_layer(by->stream).socket().close(ignored);
    if (by->hasBegun) push(FoxgloveEnded{}, 0);
    {
      const std::lock_guard lock(mutex);
      status.problem = (by->hasBegun ? "Connection to " : "Cannot connect to ") + address.text() +
                       (by->hasBegun ? " lost: " : ": ") + why + ".";
    }
    setState(FoxgloveState::Waiting);
    timer.expires_after(retry);
    timer.async_wait([this](const ErrorOf& error) {
      if (!error) connect();
    });
    retry = std::min(retry * 2, limits.lastRetry);
  }

  // Reading.
  void read(const ConnectionPtr& by) {
    by->stream.async_read_some(by->buffer, readBytes,
                               [this, by](const ErrorOf& error, std::size_t) {
                                 if (by != connection) return;
                                 if (error) return fail(by, reasonOf(*by, error));
                                 takeRead(by);
                                 if (by == connection) read(by);
                               });
  }

  static std::string reasonOf(Connection& by, const ErrorOf& error) {
    if (error == websocket::error::closed || error == asio::error::eof) {
      const auto& reason = by.stream.reason().reason;
      std::string text = "the server closed it";
      if (!reason.empty()) text += " (" + printable({reason.data(), reason.size()}) + ")";
      return text;
    }
    if (error == beast::error::timeout) return "the server does not answer any more";
    return error.message();
  }

  void takeRead(const ConnectionPtr& by) {
    const bool isText = by->stream.got_text();
    const std::size_t most = isText ? limits.textBytes : limits.frameBytes;
    if (by->buffer.size() > most) by->isSkipping = true;
    if (by->isSkipping) by->buffer.clear();
    if (!by->stream.is_message_done()) return;
    if (std::exchange(by->isSkipping, false)) {
      refuse("A frame is larger than " + megabytes(most) + ".");
    } else {
      const auto data = by->buffer.cdata();
      const std::string_view bytes(static_cast<const char*>(data.data()), data.size());
      takeFrame(by, isText, bytes);
    }
    by->buffer.clear();
    if (by->buffer.capacity() > keptBuffer) by->buffer.shrink_to_fit();
  }

  void takeFrame(const ConnectionPtr& by, bool isText, std::string_view bytes) {
    auto frame = isText ? parseFoxgloveText(bytes) : parseFoxgloveBinary(bytes);
    if (!frame) return refuse(frame.error().message);
    if (const auto* info = std::get_if<FoxgloveServerInfo>(&*frame)) return begin(by, *info);
    if (const auto* text = std::get_if<FoxgloveStatusText>(&*frame)) {
      if (text->level == 0) return;
      const std::lock_guard lock(mutex);
      status.serverText = printable(text->text, shownText);
      return;
    }
    if (std::holds_alternative<FoxgloveOther>(*frame)) return;
    if (!by->hasBegun) return refuse("The server has sent something before serverInfo.");
    if (const auto* message = std::get_if<FoxgloveMessage>(&*frame)) {
      takeMessage(*by, *message);
    } else if (auto* added = std::get_if<FoxgloveAdvertise>(&*frame)) {
      addChannels(by, std::move(*added));
    } else if (const auto* removed = std::get_if<FoxgloveUnadvertise>(&*frame)) {
      removeChannels(by, removed->channels);
    }
  }

  void begin(const ConnectionPtr& by, const FoxgloveServerInfo& info) {
    const bool isSame = by->hasBegun && by->sessionId == info.sessionId;
    by->hasBegun = true;
    by->sessionId = info.sessionId;
    retry = limits.firstRetry;
    {
      const std::lock_guard lock(mutex);
      status.server = printable(info.name, shownText);
      status.problem.clear();
    }
    if (isSame) return setState(FoxgloveState::Connected);
    by->channels.clear();
    by->channelOf.clear();
    by->schemaBytes = 0;
    ++session;
    // Once more for a session that begins within a connection: it takes as long as others.
    timer.cancel();
    setState(FoxgloveState::Connected);
    keep(by, push(FoxgloveBegun{session, printable(info.name, shownText)}, info.name.size()));
  }

  void addChannels(const ConnectionPtr& by, FoxgloveAdvertise&& added) {
    if (added.refused > 0) refuse(added.reason, added.refused);
    FoxgloveChannelsAdded event;
    std::size_t bytes = 0;
    for (FoxgloveChannel& channel : added.channels) {
      forget(*by, channel.id);
      if (by->channels.size() >= limits.channels) {
        refuse("The server has more than " + std::to_string(limits.channels) + " channels.");
        continue;
      }
      if (by->schemaBytes + channel.schema.size() > limits.schemaBytes) {
        refuse("The schemas of the server's channels are larger than " +
               megabytes(limits.schemaBytes) + ".");
        continue;
      }
      by->schemaBytes += channel.schema.size();
      by->channels[channel.id].schemaBytes = channel.schema.size();
      bytes += channel.schema.size() + channel.topic.size() + eventBytes;
      event.channels.push_back(std::move(channel));
    }
    if (!event.channels.empty()) keep(by, push(std::move(event), bytes));
  }

  void removeChannels(const ConnectionPtr& by, const std::vector<std::uint32_t>& channels) {
    for (const std::uint32_t channel : channels) forget(*by, channel);
    keep(by, push(FoxgloveChannelsRemoved{channels}, channels.size() * sizeof(std::uint32_t)));
  }

  static void forget(Connection& by, std::uint32_t channel) {
    const auto known = by.channels.find(channel);
    if (known == by.channels.end()) return;
    by.schemaBytes -= known->second.schemaBytes;
    if (known->second.subscription) by.channelOf.erase(*known->second.subscription);
    by.channels.erase(known);
  }

  void takeMessage(const Connection& by, const FoxgloveMessage& message) {
    const auto channel = by.channelOf.find(message.subscription);
    if (channel == by.channelOf.end()) return;  // of a channel that has gone a moment ago
    push(FoxgloveReceived{channel->second, message.logTime, now(), std::string(message.payload)},
         message.payload.size());
  }

  /// Nobody takes events: this ends a flood of channels that come and go.
  void keep(const ConnectionPtr& by, bool isKept) {
    if (!isKept) fail(by, "more channels come and go than can be taken");
  }

  void refuse(const std::string& why, std::uint64_t count = 1) {
    const std::lock_guard lock(mutex);
    status.malformed += count;
    status.malformedReason = why;
  }

  /// Returns false if there is no room for it.
  bool push(FoxgloveEvent event, std::size_t bytes) {
    bytes += eventBytes;
    {
      const std::lock_guard lock(mutex);
      const bool isMessage = std::holds_alternative<FoxgloveReceived>(event);
      // Messages leave room for what must not be dropped.
      if (queued + bytes > limits.queueBytes * (isMessage ? 1 : 2)) {
        if (isMessage) ++status.dropped;
        return false;
      }
      if (isMessage) {
        ++status.messages;
        status.bytes += bytes - eventBytes;
      }
      queued += bytes;
      events.push_back(std::move(event));
    }
    announce();
    return true;
  }

  void setState(FoxgloveState state) {
    {
      const std::lock_guard lock(mutex);
      status.state = state;
    }
    announce();
  }

  void announce() {
    {
      const std::lock_guard lock(mutex);
      if (std::exchange(isAnnounced, true)) return;
    }
    if (onEvent) onEvent();
  }

  // Writing.
  void subscribe(std::uint64_t wanted, const std::vector<std::uint32_t>& channels) {
    if (!connection || !connection->hasBegun || wanted != session) return;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const std::uint32_t channel : channels) {
      const auto known = connection->channels.find(channel);
      if (known == connection->channels.end() || known->second.subscription) continue;
      const std::uint32_t id = connection->nextSubscription++;
      known->second.subscription = id;
      connection->channelOf[id] = channel;
      pairs.emplace_back(id, channel);
    }
    if (pairs.empty()) return;
    connection->outgoing.push_back(foxgloveSubscribe(pairs));
    if (connection->outgoing.size() == 1) write(connection);
  }

  void write(const ConnectionPtr& by) {
    by->stream.text(true);
    by->stream.async_write(asio::buffer(by->outgoing.front()),
                           [this, by](const ErrorOf& error, std::size_t) {
                             if (by != connection) return;
                             if (error) return fail(by, reasonOf(*by, error));
                             by->outgoing.pop_front();
                             if (!by->outgoing.empty()) write(by);
                           });
  }

  const FoxgloveAddress address;
  const std::function<WallTime()> now;
  const std::function<void()> onEvent;
  const FoxgloveLimits limits;

  mutable std::mutex mutex;  // guards what follows, up to the context
  FoxgloveClientStatus status;
  std::vector<FoxgloveEvent> events;
  std::size_t queued = 0;  // bytes
  bool isAnnounced = false;

  asio::io_context context{1};
  asio::steady_timer timer{context};
  ConnectionPtr connection;
  std::uint64_t session = 0;
  Duration retry{};
  bool isLookingUp = false;
  const std::shared_ptr<Link> link = std::make_shared<Link>();
  std::thread thread;  // last: it uses all of the above
};

FoxgloveClient::FoxgloveClient(FoxgloveAddress address, std::function<WallTime()> now,
                               std::function<void()> onEvent, FoxgloveLimits limits)
    : m_impl(
          std::make_unique<Impl>(std::move(address), std::move(now), std::move(onEvent), limits)) {}

FoxgloveClient::~FoxgloveClient() = default;

std::vector<FoxgloveEvent> FoxgloveClient::take() {
  const std::lock_guard lock(m_impl->mutex);
  m_impl->isAnnounced = false;
  m_impl->queued = 0;
  return std::exchange(m_impl->events, {});
}

void FoxgloveClient::subscribe(std::uint64_t session, std::vector<std::uint32_t> channels) {
  asio::post(m_impl->context, [impl = m_impl.get(), session, wanted = std::move(channels)] {
    impl->subscribe(session, wanted);
  });
}

FoxgloveClientStatus FoxgloveClient::status() const {
  const std::lock_guard lock(m_impl->mutex);
  return m_impl->status;
}

const FoxgloveAddress& FoxgloveClient::address() const {
  return m_impl->address;
}

}  // namespace pitchboard::telemetry
