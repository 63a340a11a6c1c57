#include "cli/studio/server.h"

#include <signal.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include <fmt/format.h>
#include <httplib.h>

#include "cli/studio/token.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

using HttpRequest = httplib::Request;
using HttpResponse = httplib::Response;

constexpr int kThreads = 64;     // chosen: an open page holds one for its events, a request one
constexpr int kMaxStreams = 40;  // chosen: the rest of them answer
constexpr std::uint64_t kReserved = std::uint64_t{64} << 20;  // bytes; more only as they come
constexpr int kKept = 1 << 20;  // bytes of a heap; chosen: what a look allocates, and no more
constexpr auto kBeat = std::chrono::seconds(10);         // of streams with nothing to say
constexpr auto kLook = std::chrono::milliseconds(1000);  // how soon a stream notices that all ends

httplib::Headers safe_headers() {
  return {{"Cache-Control", "no-store"},
          {"X-Content-Type-Options", "nosniff"},
          {"Referrer-Policy", "no-referrer"},
          {"Content-Security-Policy",
           "default-src 'self'; connect-src 'self'; img-src 'self' data: blob:; "
           "style-src 'self' 'unsafe-inline'; worker-src 'self' blob:; frame-ancestors 'none'"}};
}

// Otherwise the allocator learns from large arrays to keep as much at the end of every heap, and
// threads have heaps of their own.
void keep_little_memory() {
#ifdef __GLIBC__
  ::mallopt(M_MMAP_THRESHOLD, kKept);
  ::mallopt(M_TRIM_THRESHOLD, kKept);
#endif
}

// By a provider, so that the library does not compress it: nothing leaves this machine.
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

// A page of somebody else that makes the browser ask. Who types the address, or follows a link to
// the page itself, is welcome.
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
          fmt::format("port {} of this machine cannot be listened on: another program does, "
                      "or it may not be used; leave out --port for one that is free",
                      options.port));
    }
    // The library lets five wait, and more that come at once are hung up on.
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
    // A server that has not begun yet cannot be stopped, and would never end.
    while (!server_.is_running() && !ended)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    server_.stop();
    listening.join();
  }

 private:
  static constexpr auto kPause = std::chrono::milliseconds(100);

  void set_up() {
    ::signal(SIGPIPE, SIG_IGN);  // of connections whose browser has gone
    keep_little_memory();
    server_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    server_.set_default_headers(safe_headers());
    server_.set_payload_max_length(max_upload_);
    // The rest of a body that is refused would be taken for the next request, and its end sought.
    server_.set_keep_alive_max_count(1);
    server_.set_tcp_nodelay(true);
    // Without the library's SO_REUSEPORT, by which another program could share the port.
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

  // The path below the token.
  std::string below(const HttpRequest& request) const {
    return request.path.substr(token_.size() + 2);
  }

  bool fits(const HttpRequest& request) const {
    return request.get_header_value<std::uint64_t>("Content-Length") <= max_upload_;
  }

  // Before a body is read.
  bool may_ask(const HttpRequest& request, HttpResponse& response) const {
    const std::string_view path = request.path;
    const std::size_t n = token_.size();
    if (path.size() < n + 2 || path[0] != '/' || path[n + 1] != '/' ||
        !is_same(path.substr(1, n), token_)) {
      response.status = 404;
      return false;
    }
    const std::string host = request.get_header_value("Host");
    const std::string origin = request.get_header_value("Origin");
    const bool known = host == hosts_[0] || host == hosts_[1];
    if (!known || (request.has_header("Origin") && origin != "http://" + host) ||
        is_foreign(request, path.size() == n + 2)) {
      refuse(response, 403, "forbidden", "this is for the page of the studio only");
      return false;
    }
    if (!fits(request)) {
      refuse(response, 413, "too_large",
             fmt::format("a file may have at most {} bytes; see rholm studio --max-upload",
                         max_upload_));
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

  // As many bytes as are allowed, also of a body whose length nobody has told.
  void answer_post(const HttpRequest& request, HttpResponse& response,
                   const httplib::ContentReader& read) {
    if (request.is_multipart_form_data()) {
      return refuse(response, 400, "bad_request", "a body is the bytes themselves, no form");
    }
    std::string body;
    body.reserve(std::min(request.get_header_value<std::uint64_t>("Content-Length"), kReserved));
    const bool whole = read([&](const char* bytes, std::size_t n) {
      if (body.size() + n > max_upload_) return false;
      body.append(bytes, n);
      return true;
    });
    if (!whole) {
      return refuse(response, 413, "too_large", "the body is not whole, or has too many bytes");
    }
    give(studio_.handle(request_of(request, below(request), std::move(body))), response);
  }

  void stream(const HttpRequest& request, HttpResponse& response) {
    std::string session = request.get_header_value("X-Session");
    if (session.empty()) session = request.get_param_value("session");
    std::shared_ptr<StudioListener> listener = studio_.listen(session);
    if (!listener) return refuse(response, 404, "no_session", "there is no such session");
    if (streams_ >= kMaxStreams) {
      return refuse(response, 503, "too_many_sessions", "too many pages are open; close one first");
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
  httplib::Server server_;
};

StudioServer::StudioServer(Studio& studio, Page page, const ServerOptions& options)
    : parts_(std::make_unique<Parts>(studio, std::move(page), options)) {}
StudioServer::~StudioServer() = default;

const std::string& StudioServer::address() const { return parts_->address(); }
void StudioServer::run(const std::function<bool()>& stop) { parts_->run(stop); }

}  // namespace rholm::cli
