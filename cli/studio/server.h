// The studio for a browser of this machine. Layer: cli.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "cli/studio/page.h"
#include "rholm/studio.h"

namespace rholm::cli {

struct ServerOptions {
  int port = 0;                // 0: one that is free
  std::size_t max_upload = 0;  // bytes of a body
};

// Listens on 127.0.0.1 only, from its construction on. Everything is below an address with a random
// token in it; without the token there is nothing, and requests of other pages are refused.
class StudioServer {
 public:
  // Throws Io if the port is taken.
  StudioServer(Studio& studio, Page page, const ServerOptions& options);
  ~StudioServer();
  StudioServer(const StudioServer&) = delete;
  StudioServer& operator=(const StudioServer&) = delete;

  const std::string& address() const;  // "http://127.0.0.1:PORT/TOKEN/"
  // Serves until `stop` returns true, which is asked ten times a second; then ends all sessions.
  void run(const std::function<bool()>& stop);

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rholm::cli
