#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace repose::studio {

struct StudioOptions {
  std::filesystem::path folder;
  int port = 0;                        ///< 0: one that is free
  std::filesystem::path program = {};  ///< that calibrates; empty: nothing is started
};

/// The page and what it asks for, over HTTP, for this machine alone. What an address gives is said
/// in server.cpp beside it; who is answered, in access.h.
class Server {
 public:
  /// Takes the port.
  /// @throws base::InputError  there is no such folder, or the port is taken.
  explicit Server(const StudioOptions& options);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  Server(Server&&) = delete;
  Server& operator=(Server&&) = delete;

  /// "http://127.0.0.1:PORT/?token=..."
  const std::string& address() const;
  /// Answers until stop(), which any thread may call.
  void run();
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace repose::studio
