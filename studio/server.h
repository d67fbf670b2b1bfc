#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace repose::studio {

struct StudioOptions {
  std::filesystem::path folder;
  int port = 0;                        ///< 0: any free port
  std::filesystem::path program = {};  ///< for calibrations; empty: none can be started
};

/// Serves the page and its requests over HTTP, on this machine only. Routes are documented in
/// server.cpp; for access control see access.h.
class Server {
 public:
  /// Binds the port.
  /// @throws base::InputError  there is no such folder, or the port is taken.
  explicit Server(const StudioOptions& options);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  Server(Server&&) = delete;
  Server& operator=(Server&&) = delete;

  /// "http://127.0.0.1:PORT/?token=..."
  const std::string& address() const;
  /// Serves until stop(), which any thread may call at any time, before run() too.
  void run();
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace repose::studio
