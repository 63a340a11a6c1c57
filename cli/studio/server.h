// Serves the studio to a browser on this machine. Layer: cli.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "cli/studio/page.h"
#include "rholm/studio.h"

namespace rholm::cli {

struct ServerOptions {
  int port = 0;                // 0: any free port
  std::size_t max_upload = 0;  // largest body in bytes
};

// Listens on 127.0.0.1 only, from construction on. All addresses contain a random token; requests
// without it and requests from other pages are refused.
class StudioServer {
 public:
  // Throws Io if the port is taken.
  StudioServer(Studio& studio, Page page, const ServerOptions& options);
  ~StudioServer();
  StudioServer(const StudioServer&) = delete;
  StudioServer& operator=(const StudioServer&) = delete;

  const std::string& address() const;  // "http://127.0.0.1:PORT/TOKEN/"
  // Serves until `stop`, called ten times a second, returns true; then ends all sessions.
  void run(const std::function<bool()>& stop);

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rholm::cli
