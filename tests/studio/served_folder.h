#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include <gmock/gmock.h>

#include "studio/http.h"
#include "studio/json_answer.h"
#include "studio/server.h"
#include "tests/support/temporary_folder.h"

namespace repose::studio::test {

/// A studio on its own folder, and a client that holds its access token.
class ServedFolder {
 public:
  explicit ServedFolder(const std::filesystem::path& program = {}) : program_(program) { serve(); }
  ~ServedFolder() { end(); }
  ServedFolder(const ServedFolder&) = delete;
  ServedFolder& operator=(const ServedFolder&) = delete;
  ServedFolder(ServedFolder&&) = delete;
  ServedFolder& operator=(ServedFolder&&) = delete;

  /// Starts a new studio on the same folder.
  void serve() {
    server_ = std::make_unique<Server>(StudioOptions{.folder = folder.path(), .program = program_});
    thread_ = std::thread([this] { server_->run(); });
    const std::string address = server_->address();
    const std::string token = address.substr(address.find("token=") + std::string("token=").size());
    port = std::stoi(address.substr(std::string("http://127.0.0.1:").size()));
    client = std::make_unique<httplib::Client>("127.0.0.1", port);
    client->set_read_timeout(120);
    client->set_default_headers({{"Cookie", "repose_" + std::to_string(port) + "=" + token}});
  }
  void end() {
    if (!server_) return;
    server_->stop();
    thread_.join();
    server_.reset();
  }

  Json get(const std::string& path, int status = 200) const {
    return answer_of(client->Get(path), path, status);
  }
  Json post(const std::string& path, const Json& json, int status = 200) const {
    return answer_of(client->Post(path, json.dump(), "application/json"), path, status);
  }
  Json put(const std::string& path, const Json& json, int status = 200) const {
    return answer_of(client->Put(path, json.dump(), "application/json"), path, status);
  }
  Json remove(const std::string& path, int status = 200) const {
    return answer_of(client->Delete(path), path, status);
  }

  std::string text(const std::string& name) const {
    return repose::testing::text_of(folder.path() / name);
  }

  repose::testing::TemporaryFolder folder;
  std::unique_ptr<httplib::Client> client;
  int port = 0;

 private:
  static Json answer_of(const httplib::Result& answer, const std::string& path, int status) {
    EXPECT_TRUE(answer) << path;
    if (!answer) return {};
    EXPECT_EQ(answer->status, status) << path << ": " << answer->body;
    return Json::parse(answer->body, nullptr, false);
  }

  std::filesystem::path program_;
  std::unique_ptr<Server> server_;
  std::thread thread_;
};

}  // namespace repose::studio::test
