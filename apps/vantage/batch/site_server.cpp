// SPDX-License-Identifier: MIT
#include "batch/site_server.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

// Its system headers define names that Eigen's use, so no header of ours that needs Eigen is here.
#include <httplib.h>

#include "vantage/core/error.h"

namespace vantage::batch {
namespace {

constexpr const char* kLoopback = "127.0.0.1";
/// Requests carry no body.
constexpr std::size_t kLargestRequest = 1 << 16;
constexpr std::size_t kThreads = 4;

/// Whether the name by which the server was asked for is this machine's own. A page from elsewhere
/// can make its own name lead here, but not change what the browser sends as Host.
bool is_own_name(const std::string& host) {
  const std::string name = host.substr(0, host.rfind(':'));
  return name == kLoopback || name == "localhost";
}

void send_file(const std::filesystem::path& path, const std::string& type,
               httplib::Response& response) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  auto stream = std::make_shared<std::ifstream>(path, std::ios::binary);
  if (error || !*stream) {
    response.status = 404;
    return;
  }
  if (size == 0) {
    response.set_content("", type);
    return;
  }
  response.set_content_provider(
      static_cast<std::size_t>(size), type.c_str(),
      [stream](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        constexpr std::size_t kChunk = 1 << 16;
        std::string chunk(std::min(length, kChunk), '\0');
        stream->seekg(static_cast<std::streamoff>(offset));
        stream->read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
        return stream->gcount() > 0 &&
               sink.write(chunk.data(), static_cast<std::size_t>(stream->gcount()));
      });
}

void answer(const FolderSite& site, const httplib::Request& request, httplib::Response& response) {
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cache-Control", "no-cache");
  if (!is_own_name(request.get_header_value("Host"))) {
    response.status = 403;
    response.set_content("This server answers to 127.0.0.1 and localhost only.\n", "text/plain");
    return;
  }
  if (request.path == "/favicon.ico") {  // every browser asks
    response.status = 204;
    return;
  }
  std::optional<SitePage> page;
  try {
    page = site.find(request.path);
  } catch (const Error& error) {
    response.status = 500;
    response.set_content(std::string(error.what()) + "\n", "text/plain; charset=utf-8");
    return;
  }
  if (!page) {
    response.status = 404;
    response.set_content("There is no such result.\n", "text/plain");
  } else if (page->file.empty()) {
    response.set_content(page->body, page->type.c_str());
  } else {
    send_file(page->file, page->type, response);
  }
}

}  // namespace

struct SiteServer::Parts {
  explicit Parts(FolderSite shown) : site(std::move(shown)) {}

  FolderSite site;
  httplib::Server server{};
  std::string address{};
  std::atomic<bool> ended = false;
  std::thread listener{};
};

SiteServer::SiteServer(FolderSite site, int port)
    : parts_(std::make_unique<Parts>(std::move(site))) {
  httplib::Server& server = parts_->server;
  server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
  server.set_payload_max_length(kLargestRequest);
  server.Get(".*",
             [parts = parts_.get()](const httplib::Request& request, httplib::Response& response) {
               answer(parts->site, request, response);
             });
  int bound = port;
  if (port == 0) {
    bound = server.bind_to_any_port(kLoopback);
  } else if (!server.bind_to_port(kLoopback, port)) {
    bound = -1;
  }
  if (bound < 0) {
    throw IoError(std::string(kLoopback) + ":" + std::to_string(port),
                  "cannot be had; choose another port with --port, or 0 for any that is free");
  }
  parts_->address = std::string("http://") + kLoopback + ":" + std::to_string(bound) + "/";
  parts_->listener = std::thread([parts = parts_.get()] {
    parts->server.listen_after_bind();
    parts->ended = true;
  });
}

SiteServer::~SiteServer() {
  while (!parts_->server.is_running() && !parts_->ended) {
    std::this_thread::yield();  // stop() before the listener runs would be forgotten
  }
  parts_->server.stop();
  parts_->listener.join();
}

const std::string& SiteServer::address() const {
  return parts_->address;
}

}  // namespace vantage::batch
