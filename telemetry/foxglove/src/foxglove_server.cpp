// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/foxglove/foxglove_server.h>

#include <algorithm>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <set>
#include <thread>
#include <utility>

namespace pitchboard::telemetry {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using ErrorOf = boost::system::error_code;

constexpr std::size_t maxRequest = std::size_t{256} << 10;  // bytes of a client's frame

struct Frame {
  bool isText = false;
  bool isData = false;  ///< may be dropped
  std::shared_ptr<const std::string> bytes;
};

Frame textFrame(std::string text) {
  return {.isText = true, .bytes = std::make_shared<const std::string>(std::move(text))};
}
Frame binaryFrame(std::string bytes) {
  return {.bytes = std::make_shared<const std::string>(std::move(bytes))};
}

/// The subprotocol that both know; empty: none.
std::string_view commonSubprotocol(std::string_view offered) {
  while (!offered.empty()) {
    const std::size_t comma = std::min(offered.find(','), offered.size());
    std::string_view one = offered.substr(0, comma);
    offered.remove_prefix(std::min(comma + 1, offered.size()));
    while (!one.empty() && one.front() == ' ') one.remove_prefix(1);
    while (!one.empty() && one.back() == ' ') one.remove_suffix(1);
    const auto known = std::ranges::find(foxgloveSubprotocols, one);
    if (known != foxgloveSubprotocols.end()) return *known;
  }
  return {};
}

}  // namespace

/// Everything but the counts belongs to the thread.
struct FoxgloveServer::Impl {
  struct Kept {
    std::uint64_t time = 0;
    std::string payload;
    std::function<std::string()> make{};  ///< makes the payload; empty: it is there
    const std::string& bytes() {
      if (make) payload = std::exchange(make, {})();
      return payload;
    }
  };

  class Client : public std::enable_shared_from_this<Client> {
   public:
    Client(Impl& server, Tcp::socket socket) : m_server(server), m_stream(std::move(socket)) {}

    void begin() {
      m_stream.next_layer().expires_after(std::chrono::seconds(10));
      http::async_read(m_stream.next_layer(), m_buffer, m_request,
                       [self = shared_from_this()](ErrorOf error, std::size_t /*bytes*/) {
                         if (!error) self->answer();
                       });
    }
    void send(Frame frame) {
      if (!m_isOpen) return;
      m_waiting += frame.bytes->size();
      m_queue.push_back(std::move(frame));
      makeRoom();
      if (m_queue.size() == 1) write();
    }
    void send(std::uint32_t channel, std::uint64_t time, std::string_view payload) {
      for (const auto& [subscription, of] : m_subscriptions) {
        if (of != channel) continue;
        Frame frame = binaryFrame(foxgloveMessageFrame({subscription, time, payload}));
        frame.isData = true;
        send(std::move(frame));
      }
    }
    /// Makes the message only if it is wanted.
    void send(std::uint32_t channel, Kept& kept) {
      const bool isWanted = std::ranges::any_of(
          m_subscriptions, [channel](const auto& one) { return one.second == channel; });
      if (isWanted) send(channel, kept.time, kept.bytes());
    }
    void forget(std::uint32_t channel) {
      std::erase_if(m_subscriptions, [channel](const auto& one) { return one.second == channel; });
    }
    /// Programs that know only the older subprotocol call the frame an error.
    void sendPlayback(const FoxglovePlaybackState& state) {
      if (m_controls) send(binaryFrame(foxglovePlaybackFrame(state)));
    }
    void close() {
      m_isOpen = false;
      ErrorOf ignored;
      m_stream.next_layer().socket().close(ignored);
    }

   private:
    void answer() {
      const std::string_view offered(m_request[http::field::sec_websocket_protocol].data(),
                                     m_request[http::field::sec_websocket_protocol].size());
      const std::string_view chosen = commonSubprotocol(offered);
      if (!websocket::is_upgrade(m_request)) {
        return refuse(http::status::upgrade_required,
                      "This is a server of Foxglove's WebSocket protocol: connect to it with "
                      "Foxglove, Lichtblick or PlotJuggler.\n");
      }
      if (chosen.empty()) {
        return refuse(http::status::bad_request,
                      "The client must offer the subprotocol foxglove.sdk.v1 or "
                      "foxglove.websocket.v1.\n");
      }
      if (m_server.clients.size() >= m_server.options.maxClients) {
        return refuse(http::status::service_unavailable, "Too many programs are connected.\n");
      }
      m_controls = m_server.options.playback && chosen == foxgloveSubprotocols.front();
      m_stream.next_layer().expires_never();
      m_stream.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
      m_stream.set_option(websocket::stream_base::decorator(
          [name = std::string(chosen)](websocket::response_type& response) {
            response.set(http::field::sec_websocket_protocol, name);
          }));
      m_stream.read_message_max(maxRequest);
      m_stream.async_accept(m_request, [self = shared_from_this()](ErrorOf error) {
        if (!error) self->welcome();
      });
    }
    void refuse(http::status status, const char* text) {
      m_refusal.result(status);
      m_refusal.version(m_request.version());
      m_refusal.set(http::field::content_type, "text/plain; charset=utf-8");
      m_refusal.body() = text;
      m_refusal.keep_alive(false);
      m_refusal.prepare_payload();
      http::async_write(m_stream.next_layer(), m_refusal,
                        [self = shared_from_this()](ErrorOf /*error*/, std::size_t /*bytes*/) {
                          ErrorOf ignored;
                          self->m_stream.next_layer().socket().shutdown(Tcp::socket::shutdown_send,
                                                                        ignored);
                        });
    }
    void welcome() {
      m_isOpen = true;
      m_server.clients.insert(shared_from_this());
      m_server.clientCount = m_server.clients.size();
      m_buffer.clear();
      send(m_server.serverInfo(m_controls));
      std::vector<FoxgloveChannel> channels;
      for (const auto& [id, channel] : m_server.channels) channels.push_back(channel);
      if (!channels.empty()) send(textFrame(foxgloveAdvertise(channels)));
      sendPlayback(m_server.playback);
      read();
    }
    void read() {
      m_stream.async_read(
          m_buffer, [self = shared_from_this()](ErrorOf error, std::size_t /*bytes*/) {
            if (error) return self->end();
            const std::string frame = beast::buffers_to_string(self->m_buffer.data());
            self->m_buffer.clear();
            const auto request = self->m_stream.got_text() ? parseFoxgloveRequest(frame)
                                                           : parseFoxgloveControl(frame);
            if (request) {
              std::visit([&self](const auto& one) { self->take(one); }, *request);
            } else {
              self->send(textFrame(foxgloveStatus({2, request.error().message})));
            }
            self->read();
          });
    }
    void take(const FoxgloveSubscribe& request) {
      for (const auto& [subscription, channel] : request.pairs) {
        if (!m_server.channels.contains(channel)) {
          send(textFrame(foxgloveStatus(
              {1, "There is no channel " + std::to_string(channel) + " to subscribe to."})));
          continue;
        }
        m_subscriptions[subscription] = channel;
        const auto kept = m_server.kept.find(channel);
        if (kept == m_server.kept.end()) continue;
        send(binaryFrame(
            foxgloveMessageFrame({subscription, kept->second.time, kept->second.bytes()})));
      }
    }
    void take(const FoxgloveUnsubscribe& request) {
      for (const std::uint32_t subscription : request.subscriptions) {
        m_subscriptions.erase(subscription);
      }
    }
    void take(const FoxglovePlaybackControl& request) {
      if (m_controls && m_server.options.control) m_server.options.control(request);
    }
    void take(const FoxgloveOther& /*request*/) {}

    /// The first frame is being written. Messages go, oldest first; answers stay.
    void makeRoom() {
      const bool isTooMuch = m_waiting > m_server.options.queueBytes;
      auto next = m_queue.begin() + (m_queue.empty() ? 0 : 1);
      while (m_waiting > m_server.options.queueBytes && next != m_queue.end()) {
        if (!next->isData) {
          ++next;
          continue;
        }
        m_waiting -= next->bytes->size();
        next = m_queue.erase(next);
        ++m_server.droppedCount;
      }
      if (isTooMuch && !m_isWarned) {
        m_isWarned = true;
        send(textFrame(foxgloveStatus(
            {1, "This program reads more slowly than messages come; the oldest are left out."})));
      }
    }
    void write() {
      const Frame& frame = m_queue.front();
      m_stream.text(frame.isText);
      m_stream.async_write(
          asio::buffer(*frame.bytes),
          [self = shared_from_this(), kept = frame.bytes](ErrorOf error, std::size_t /*bytes*/) {
            if (error || !self->m_isOpen) return self->end();
            self->m_waiting -= kept->size();
            self->m_queue.pop_front();
            if (!self->m_queue.empty()) self->write();
          });
    }
    void end() {
      m_isOpen = false;
      m_server.clients.erase(shared_from_this());
      m_server.clientCount = m_server.clients.size();
    }

    Impl& m_server;
    websocket::stream<beast::tcp_stream> m_stream;
    beast::flat_buffer m_buffer{maxRequest};
    http::request<http::string_body> m_request;
    http::response<http::string_body> m_refusal;
    std::map<std::uint32_t, std::uint32_t> m_subscriptions;  // to channels
    std::deque<Frame> m_queue;
    std::size_t m_waiting = 0;  // bytes in the queue
    bool m_controls = false;    // the playback
    bool m_isOpen = false, m_isWarned = false;
  };

  explicit Impl(const FoxgloveServerOptions& given) : options(given) {}

  Result<void> listen() {
    const Tcp::endpoint endpoint(asio::ip::address_v4(options.bind.value), options.port);
    ErrorOf error;
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(Tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      return failure(ErrorCode::SystemError,
                     "cannot listen on port " + std::to_string(options.port) + ": " +
                         error.message() + "; another program may use it, choose another port",
                     options.bind.text());
    }
    port = acceptor.local_endpoint(error).port();
    return {};
  }
  void accept() {
    acceptor.async_accept([this](ErrorOf error, Tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error) std::make_shared<Client>(*this, std::move(socket))->begin();
      accept();
    });
  }
  Frame serverInfo(bool withPlayback) const {
    FoxgloveServerInfo info;
    info.name = options.name;
    info.sessionId = options.sessionId;
    return textFrame(foxgloveServerInfo(info, withPlayback ? options.playback : std::nullopt));
  }
  void sendAll(const Frame& frame) {
    for (const auto& client : clients) client->send(frame);
  }

  FoxgloveServerOptions options;
  asio::io_context context;
  Tcp::acceptor acceptor{context};
  std::uint16_t port = 0;
  std::map<std::uint32_t, FoxgloveChannel> channels;
  std::map<std::uint32_t, Kept> kept;
  FoxglovePlaybackState playback;
  std::set<std::shared_ptr<Client>> clients;
  std::atomic<std::size_t> clientCount = 0;
  std::atomic<std::uint64_t> droppedCount = 0;
  std::thread thread;
};

FoxgloveServer::FoxgloveServer(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}

Result<std::unique_ptr<FoxgloveServer>> FoxgloveServer::start(
    const FoxgloveServerOptions& options) {
  auto impl = std::make_unique<Impl>(options);
  if (auto listening = impl->listen(); !listening) return tl::unexpected(listening.error());
  impl->accept();
  impl->thread = std::thread([&server = *impl] {
    const auto stays = asio::make_work_guard(server.context);
    server.context.run();
  });
  return std::unique_ptr<FoxgloveServer>(new FoxgloveServer(std::move(impl)));
}

FoxgloveServer::~FoxgloveServer() {
  asio::post(m_impl->context, [&impl = *m_impl] {
    ErrorOf ignored;
    impl.acceptor.close(ignored);
    for (const auto& client : impl.clients) client->close();
    impl.context.stop();
  });
  m_impl->thread.join();
  m_impl->clients.clear();
}

std::uint16_t FoxgloveServer::port() const {
  return m_impl->port;
}

void FoxgloveServer::advertise(FoxgloveChannel channel) {
  asio::post(m_impl->context, [&impl = *m_impl, channel = std::move(channel)] {
    impl.channels[channel.id] = channel;
    impl.sendAll(textFrame(foxgloveAdvertise(std::vector{channel})));
  });
}

void FoxgloveServer::unadvertise(std::uint32_t channel) {
  asio::post(m_impl->context, [&impl = *m_impl, channel] {
    impl.channels.erase(channel);
    impl.kept.erase(channel);
    for (const auto& client : impl.clients) client->forget(channel);
    impl.sendAll(textFrame(foxgloveUnadvertise(std::vector{channel})));
  });
}

void FoxgloveServer::send(std::uint32_t channel, std::uint64_t logTime, std::string_view payload) {
  if (m_impl->clientCount == 0) return;
  asio::post(m_impl->context, [&impl = *m_impl, channel, logTime, payload = std::string(payload)] {
    for (const auto& client : impl.clients) client->send(channel, logTime, payload);
  });
}

void FoxgloveServer::sendKept(std::uint32_t channel, std::uint64_t logTime,
                              std::function<std::string()> payload) {
  Impl::Kept kept{logTime, {}, std::move(payload)};
  // Made here, so that a match that plays faster than its messages are made does not pile them up.
  if (m_impl->clientCount > 0) kept.bytes();
  asio::post(m_impl->context, [&impl = *m_impl, channel, kept = std::move(kept)]() mutable {
    for (const auto& client : impl.clients) client->send(channel, kept);
    impl.kept[channel] = std::move(kept);
  });
}

void FoxgloveServer::setTime(std::uint64_t time) {
  asio::post(m_impl->context, [&impl = *m_impl, time] {
    Frame frame = binaryFrame(foxgloveTimeFrame(time));
    frame.isData = true;
    impl.sendAll(frame);
  });
}

void FoxgloveServer::setPlayback(const FoxglovePlaybackState& state) {
  asio::post(m_impl->context, [&impl = *m_impl, state] {
    impl.playback = state;
    impl.playback.requestId.clear();  // who connects later asked for nothing
    impl.playback.didSeek = false;
    for (const auto& client : impl.clients) client->sendPlayback(state);
  });
}

FoxgloveServerStatus FoxgloveServer::status() const {
  return {.clients = m_impl->clientCount, .dropped = m_impl->droppedCount};
}

}  // namespace pitchboard::telemetry
