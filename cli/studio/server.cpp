#include "cli/studio/server.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>
#include <cstring>
#include <limits>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <httplib.h>

#include "cli/studio/connections.h"
#include "cli/studio/token.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

using HttpRequest = httplib::Request;
using HttpResponse = httplib::Response;

constexpr int kThreads = 64;     // chosen: an open page holds one for events, a request holds one
constexpr int kMaxStreams = 40;  // chosen: the other threads answer requests
// Bytes of a body; chosen. A body without a stated length may have at most this many. For a longer
// one, memory is allocated after this many bytes have arrived.
constexpr std::uint64_t kUnproved = std::uint64_t{64} << 20;
// Bytes of JSON; chosen: a number in it takes up to 16 times its text. Larger bodies are read one
// at a time.
constexpr std::size_t kSmallJson = std::size_t{1} << 20;
constexpr auto kIdle = std::chrono::seconds(30);  // for a request or answer without progress
constexpr int kKept = 1 << 20;                    // bytes of a heap; chosen: memory of one poll
constexpr auto kBeat = std::chrono::seconds(10);  // for streams without events
constexpr auto kLook = std::chrono::milliseconds(1000);  // time in which a stream notices the end

const httplib::Headers& safe_headers() {
  static const httplib::Headers kHeaders = {
      {"Cache-Control", "no-store"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Content-Security-Policy",
       "default-src 'self'; connect-src 'self'; img-src 'self' data: blob:; "
       "style-src 'self' 'unsafe-inline'; worker-src 'self' blob:; frame-ancestors 'none'"}};
  return kHeaders;
}

// Returns the answer to every request without the token, which has no body.
std::string not_found() {
  std::string text = "HTTP/1.1 404 Not Found\r\nConnection: close\r\nContent-Length: 0\r\n";
  for (const auto& [name, value] : safe_headers()) text += fmt::format("{}: {}\r\n", name, value);
  return text + "\r\n";
}

// A connection that the library reads and writes. No wait is longer than kIdle.
class Connection : public httplib::Stream {
 public:
  // Reads at most `most` bytes.
  Connection(int socket, std::string head, std::uint64_t most)
      : socket_(socket), buffer_(std::move(head)), most_(most) {}

  bool is_readable() const override { return read_ < buffer_.size() || is_ready(POLLIN, 0); }
  bool is_writable() const override {
    if (!is_ready(POLLOUT, 0)) return false;
    char byte = 0;  // a closed connection is readable, up to its end
    return !is_ready(POLLIN, 0) || ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0;
  }
  // The library reads lines byte by byte, so reads come from a buffer.
  ssize_t read(char* bytes, std::size_t n) override {
    if (read_ == buffer_.size()) {
      if (!is_ready(POLLIN, kIdleMilliseconds)) return -1;
      buffer_.resize(kBuffer);
      const ssize_t got = ::recv(socket_, buffer_.data(), kBuffer, 0);
      buffer_.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
      read_ = 0;
      if (got <= 0) return got;
    }
    n = std::min(n, buffer_.size() - read_);
    std::memcpy(bytes, buffer_.data() + read_, n);
    read_ += n;
    all_ += n;
    return all_ > most_ ? -1 : static_cast<ssize_t>(n);
  }
  ssize_t write(const char* bytes, std::size_t n) override {
    return is_ready(POLLOUT, kIdleMilliseconds) ? ::send(socket_, bytes, n, MSG_NOSIGNAL) : -1;
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override { ip.clear(), port = 0; }
  void get_local_ip_and_port(std::string& ip, int& port) const override { ip.clear(), port = 0; }
  socket_t socket() const override { return socket_; }

 private:
  static constexpr std::size_t kBuffer = std::size_t{64}
                                         << 10;  // bytes; chosen: what a system call is worth
  static constexpr int kIdleMilliseconds =
      static_cast<int>(std::chrono::milliseconds(kIdle).count());

  bool is_ready(short event, int milliseconds) const {
    pollfd one = {.fd = socket_, .events = event, .revents = 0};
    return ::poll(&one, 1, milliseconds) > 0;
  }

  const int socket_;
  std::string buffer_;
  const std::uint64_t most_;
  std::size_t read_ = 0;   // position in the buffer
  std::uint64_t all_ = 0;  // number of bytes read
};

// Returns true if a line of the head begins with that lower-case name.
bool has_header(std::string_view head, std::string_view name) {
  const auto is_same_letter = [](char a, char b) {
    return b == std::tolower(static_cast<unsigned char>(a));
  };
  for (std::size_t at = head.find('\n'); at != std::string_view::npos;
       at = head.find('\n', at + 1)) {
    const std::string_view line = head.substr(at + 1, name.size());
    if (std::equal(line.begin(), line.end(), name.begin(), name.end(), is_same_letter)) return true;
  }
  return false;
}

// Hands each connection to `on_connection`; answer() serves a connection whose head has been read.
class Server : public httplib::Server {
 public:
  Server() {
    // The accepting thread only hands connections on.
    struct AtOnce : httplib::TaskQueue {
      void enqueue(std::function<void()> give_away) override { give_away(); }
      void shutdown() override {}
    };
    new_task_queue = [] { return new AtOnce; };
  }
  std::function<void(int socket)> on_connection;

  void answer(int socket, std::string head) {
    // The library keeps the text between chunks of a body, however long it is.
    const bool in_pieces = has_header(head, "transfer-encoding");
    Connection connection(socket, std::move(head),
                          in_pieces ? 2 * kUnproved : std::numeric_limits<std::uint64_t>::max());
    bool closed = false;
    process_request(connection, true, closed, {});
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
    on_connection(socket);
    return true;
  }
};

// Keeps little freed memory. By default the allocator learns from large arrays to keep as much at
// the end of every heap, and each thread has a heap.
void keep_little_memory() {
#ifdef __GLIBC__
  ::mallopt(M_MMAP_THRESHOLD, kKept);
  ::mallopt(M_TRIM_THRESHOLD, kKept);
#endif
}

// Sets the body by a provider, so that the library does not compress it: nothing leaves this
// machine.
void set_body(HttpResponse& response, std::shared_ptr<const std::string> body,
              const std::string& type) {
  if (body->empty()) {
    response.set_content("", type);
    return;
  }
  const std::size_t size = body->size();
  response.set_content_provider(
      size, type,
      [body = std::move(body)](std::size_t offset, std::size_t n, httplib::DataSink& out) {
        return out.write(body->data() + offset, n);
      });
}

void give(const StudioResponse& answer, HttpResponse& response) {
  response.status = answer.status;
  if (!answer.download.empty()) {
    response.set_header("Content-Disposition",
                        fmt::format("attachment; filename=\"{}\"", answer.download));
  }
  set_body(response, std::make_shared<const std::string>(answer.body), answer.type);
}

void refuse(HttpResponse& response, int status, const std::string& code, const std::string& text) {
  response.status = status;
  set_body(response,
           std::make_shared<const std::string>(
               fmt::format(R"({{"error":{{"code":"{}","message":"{}"}}}})", code, text)),
           "application/json");
}

// Returns true for a request that another site's page causes. A typed address or a link to the page
// itself is accepted.
bool is_foreign(const HttpRequest& request, bool is_page) {
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  if (site.empty() || site == "same-origin" || site == "none") return false;
  return !(is_page && request.method == "GET" &&
           request.get_header_value("Sec-Fetch-Mode") == "navigate" &&
           request.get_header_value("Sec-Fetch-Dest") == "document");
}

StudioRequest request_of(const HttpRequest& request, std::string path, std::string body) {
  StudioRequest asked = {.method = request.method == "HEAD" ? "GET" : request.method,
                         .path = std::move(path),
                         .query = {request.params.begin(), request.params.end()},
                         .body = std::move(body),
                         .session = request.get_header_value("X-Session")};
  return asked;
}

}  // namespace

class StudioServer::Parts {
 public:
  Parts(Studio& studio, Page page, const ServerOptions& options)
      : studio_(studio), page_(std::move(page)), max_upload_(options.max_upload) {
    set_up();
    int port = options.port;
    if (port == 0) port = server_.bind_to_any_port("127.0.0.1");
    const bool bound = options.port == 0 ? port > 0 : server_.bind_to_port("127.0.0.1", port);
    if (!bound) {
      throw Error(
          ErrorCode::kIo,
          fmt::format("port {} is in use or not allowed; leave out --port to use a free port",
                      options.port));
    }
    // The library's queue holds five connections, and closes further ones that arrive at once.
    ::listen(listening_, SOMAXCONN);
    hosts_[0] = fmt::format("127.0.0.1:{}", port);
    hosts_[1] = fmt::format("localhost:{}", port);
    address_ = fmt::format("http://{}/{}/", hosts_[0], token_);
  }

  const std::string& address() const { return address_; }

  void run(const std::function<bool()>& stop) {
    std::atomic<bool> ended = false;
    std::thread listening([&] {
      server_.listen_after_bind();
      ended = true;
    });
    while (!stop() && !ended) {
      studio_.tend();
      std::this_thread::sleep_for(kPause);
    }
    stopping_ = true;
    studio_.close();
    connections_.close();
    // A server that has not started yet cannot be stopped, and would never end.
    while (!server_.is_running() && !ended)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    server_.stop();
    listening.join();
  }

 private:
  static constexpr auto kPause = std::chrono::milliseconds(100);

  void set_up() {
    ::signal(SIGPIPE, SIG_IGN);  // from connections whose browser has gone
    keep_little_memory();
    server_.on_connection = [this](int socket) { connections_.add(socket); };
    server_.set_default_headers(safe_headers());
    server_.set_payload_max_length(max_upload_);
    server_.set_tcp_nodelay(true);
    // Without the library's SO_REUSEPORT, which would let another program share the port.
    server_.set_socket_options([this](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
      listening_ = socket;
    });
    server_.set_pre_routing_handler([this](const HttpRequest& request, HttpResponse& response) {
      return may_ask(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                        : httplib::Server::HandlerResponse::Handled;
    });
    server_.set_expect_100_continue_handler(
        [this](const HttpRequest& request, HttpResponse& response) {
          return may_ask(request, response) ? 100 : response.status;
        });
    server_.Get(".*", [this](const HttpRequest& request, HttpResponse& response) {
      answer_get(request, response);
    });
    server_.Delete(".*", [this](const HttpRequest& request, HttpResponse& response) {
      give(studio_.handle(request_of(request, below(request), {})), response);
    });
    server_.Post(
        ".*", [this](const HttpRequest& request, HttpResponse& response,
                     const httplib::ContentReader& read) { answer_post(request, response, read); });
  }

  // Returns the path below the token.
  std::string below(const HttpRequest& request) const {
    return request.path.substr(token_.size() + 2);
  }

  // Returns the largest number of bytes of a body for a path.
  std::uint64_t most_of(const HttpRequest& request) const {
    const bool is_file = request.method == "POST" && below(request) == "api/file";
    if (is_file) return max_upload_;
    return request.method == "POST" ? std::min<std::uint64_t>(kMaxStudioJson, max_upload_) : 0;
  }

  void refuse_large(const HttpRequest& request, HttpResponse& response) const {
    refuse(response, 413, "too_large",
           below(request) == "api/file"
               ? fmt::format("a file may have at most {} bytes; see rholm studio --max-upload",
                             max_upload_)
               : fmt::format("the body of a request may have at most {} bytes", most_of(request)));
  }

  // Returns true if the target of a request line is below the token.
  bool has_token(std::string_view target) const {
    const std::size_t n = token_.size();
    return target.size() >= n + 2 && target[0] == '/' && target[n + 1] == '/' &&
           is_same(target.substr(1, n), token_);
  }

  // Checks a request before its body is read.
  bool may_ask(const HttpRequest& request, HttpResponse& response) const {
    if (!has_token(request.path)) {
      response.status = 404;
      return false;
    }
    const std::string host = request.get_header_value("Host");
    const std::string origin = request.get_header_value("Origin");
    const bool known = host == hosts_[0] || host == hosts_[1];
    if (!known || (request.has_header("Origin") && origin != "http://" + host) ||
        is_foreign(request, below(request).empty())) {
      refuse(response, 403, "forbidden", "only the page of the studio may send requests");
      return false;
    }
    const bool in_pieces = request.has_header("Transfer-Encoding");
    if (request.get_header_value<std::uint64_t>("Content-Length") > most_of(request) ||
        (in_pieces && most_of(request) == 0)) {
      refuse_large(request, response);
      return false;
    }
    return true;
  }

  void answer_get(const HttpRequest& request, HttpResponse& response) {
    const std::string path = below(request);
    if (path == "api/events") return stream(request, response);
    if (path.starts_with("api/"))
      return give(studio_.handle(request_of(request, path, {})), response);
    const auto file = page_.find(path.empty() ? "index.html" : path);
    if (file == page_.end()) {
      response.status = 404;
      return;
    }
    set_body(response, file->second.bytes, file->second.type);
  }

  // Counts bodies while they arrive; the limit applies to all of them together.
  void answer_post(const HttpRequest& request, HttpResponse& response,
                   const httplib::ContentReader& read) {
    if (request.is_multipart_form_data()) {
      return refuse(response, 400, "bad_request", "the body must be plain bytes, not a form");
    }
    const std::uint64_t said = request.get_header_value<std::uint64_t>("Content-Length");
    const std::uint64_t most = most_of(request);
    const std::uint64_t proved = said > 0 ? most : std::min(most, kUnproved);
    std::string body;
    bool is_large = false, is_crowded = false;
    const bool whole = read([&](const char* bytes, std::size_t n) {
      is_large = body.size() + n > proved;
      is_crowded = arriving_.fetch_add(n) + n > std::max<std::uint64_t>(max_upload_, kUnproved);
      if (is_large || is_crowded) {
        arriving_ -= n;
        return false;
      }
      if (body.empty()) body.reserve(std::min(said, kUnproved));
      if (body.size() + n > body.capacity()) body.reserve(std::max(said, 2 * body.capacity()));
      body.append(bytes, n);
      return true;
    });
    const std::size_t arrived = body.size();
    if (is_crowded) {
      refuse(response, 503, "busy",
             "too many requests at the same time; send it again in a moment");
    } else if (is_large && proved < most) {
      refuse(response, 411, "length_required",
             fmt::format("a body of more than {} bytes needs a Content-Length", proved));
    } else if (!whole && !is_large) {
      refuse(response, 400, "bad_request", "the body is incomplete");
    } else if (!whole) {
      refuse_large(request, response);
    } else {
      const bool is_small = arrived <= kSmallJson || below(request) == "api/file";
      std::unique_lock alone(large_json_, std::defer_lock);
      if (!is_small) alone.lock();
      give(studio_.handle(request_of(request, below(request), std::move(body))), response);
    }
    arriving_ -= arrived;
  }

  void stream(const HttpRequest& request, HttpResponse& response) {
    std::string session = request.get_header_value("X-Session");
    if (session.empty()) session = request.get_param_value("session");
    std::shared_ptr<StudioListener> listener = studio_.listen(session);
    if (!listener) return refuse(response, 404, "no_session", "there is no such session");
    if (streams_ >= kMaxStreams) {
      return refuse(response, 503, "too_many_sessions", "too many pages are open; close one");
    }
    ++streams_;
    auto beat = std::make_shared<std::chrono::steady_clock::time_point>();
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, listener, beat](std::size_t, httplib::DataSink& out) {
          return send_events(*listener, *beat, out);
        },
        [this](bool) { --streams_; });
  }

  bool send_events(StudioListener& listener, std::chrono::steady_clock::time_point& beat,
                   httplib::DataSink& out) const {
    if (stopping_ || listener.ended()) {
      out.done();
      return true;
    }
    std::string text;
    for (const StudioEvent& event : listener.wait(kLook)) {
      text += fmt::format("event: {}\ndata: {}\n\n", event.name, event.data);
    }
    const auto now = std::chrono::steady_clock::now();
    if (text.empty() && now - beat >= kBeat) text = ": here\n\n";
    if (text.empty()) return out.is_writable();
    beat = now;
    return out.write(text.data(), text.size());
  }

  Studio& studio_;
  const Page page_;
  const std::size_t max_upload_;
  const std::string token_ = random_token();
  std::string hosts_[2], address_;
  socket_t listening_ = INVALID_SOCKET;
  std::atomic<bool> stopping_{false};
  std::atomic<int> streams_{0};
  std::atomic<std::uint64_t> arriving_{0};  // bytes of bodies that are not answered yet
  std::mutex large_json_;
  Server server_;
  Connections connections_{
      {.workers = kThreads,
       .may_ask = [this](std::string_view target) { return has_token(target); },
       .refusal = not_found(),
       .serve = [this](int socket, std::string head) { server_.answer(socket, std::move(head)); }}};
};

StudioServer::StudioServer(Studio& studio, Page page, const ServerOptions& options)
    : parts_(std::make_unique<Parts>(studio, std::move(page), options)) {}
StudioServer::~StudioServer() = default;

const std::string& StudioServer::address() const { return parts_->address(); }
void StudioServer::run(const std::function<bool()>& stop) { parts_->run(stop); }

}  // namespace rholm::cli
