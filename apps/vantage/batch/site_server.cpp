// SPDX-License-Identifier: MIT
#include "batch/site_server.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <optional>
#include <string>
#include <thread>
#include <utility>

// Its system headers define names that Eigen's use, so no header of ours that needs Eigen is here.
#include "vantage/core/error.h"

#include "batch/http_connection.h"

namespace vantage::batch {
namespace {

constexpr const char* kLoopback = "127.0.0.1";
/// One for each connection that is open, most of which only wait: a browser opens six and keeps them.
constexpr std::size_t kThreads = 256;
constexpr int kRequestsPerConnection = 200;

constexpr const char* kPolicy = "Content-Security-Policy";
/// How every policy begins.
const std::string kNothing =
    "default-src 'none'; base-uri 'none'; form-action 'none'; style-src 'unsafe-inline'; ";
const std::string kUnframed = kNothing + "frame-ancestors 'none'; ";
/// The pages made here have a script that only ever sets text.
const std::string kOwnPage = kUnframed + "img-src 'self'; script-src 'unsafe-inline'";
/// No policy of a page keeps its script from going to another page. That of the page around it does.
const std::string kAroundReport = kUnframed + "frame-src 'self'; script-src 'unsafe-inline'";
/// Anybody may have written a file of these names: in a sandbox it has no origin, so that it can
/// read nothing of this server, and it can load nothing from anywhere. Reports hand out pictures and cameras.
const std::string kReport = kNothing +
                            "frame-ancestors 'self'; img-src data: blob:; script-src "
                            "'unsafe-inline'; sandbox allow-scripts allow-downloads";
const std::string kFile = kUnframed + "img-src 'self' data:; sandbox";

/// What a browser opens in place of a report: the report in a frame, which has the keys at once.
constexpr const char* kReportFrame = R"html(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Vantage: report</title>
<style>iframe { position: fixed; inset: 0; width: 100%; height: 100%; border: 0; }</style>
<iframe title="report" sandbox="allow-scripts allow-downloads" allow="clipboard-write" src="?framed"></iframe>
<script>
"use strict";
const frame = document.querySelector("iframe");
frame.addEventListener("load", () => frame.focus());
const folder = location.pathname.split("/").at(-2);
try {
  if (folder) document.title = decodeURIComponent(folder) + " · Vantage";
} catch {}  // a name that is no UTF-8
</script>
)html";

/// Whether the name by which the server was asked for is this machine's own. A page from elsewhere
/// can make its own name lead here, but not change what the browser sends as Host.
bool is_own_name(const std::string& host) {
  const std::string name = host.substr(0, host.rfind(':'));
  return name == kLoopback || name == "localhost";
}

/// Whether a part is asked for that begins beyond the end. Any other range is answered by the whole, but for what is
/// none, as 5-2, which the library refuses before it asks.
bool is_beyond(const httplib::Request& request, std::size_t size) {
  httplib::Ranges ranges;
  if (!request.has_header("Range") ||
      !httplib::detail::parse_range_header(request.get_header_value("Range"), ranges) ||
      ranges.size() != 1) {
    return false;
  }
  const auto [first, last] = ranges.front();
  return first < 0 ? last == 0 : static_cast<std::size_t>(first) >= size;
}

void send_file(const std::shared_ptr<const ServedFile>& file, const std::string& type,
               httplib::Response& response) {
  if (file->size() == 0) {
    response.set_content("", type);
    return;
  }
  response.set_content_provider(
      file->size(), type.c_str(),
      [file](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        constexpr std::size_t kChunk = 1 << 16;
        std::string chunk(std::min(length, kChunk), '\0');
        const std::size_t got = file->read(offset, chunk.data(), chunk.size());
        return got > 0 && sink.write(chunk.data(), got);
      });
}

void send(const SitePage& page, const httplib::Request& request, httplib::Response& response) {
  const std::string& own = page.is_report ? kAroundReport : kOwnPage;
  response.set_header(kPolicy, !page.file ? own : page.is_report ? kReport : kFile);
  const std::size_t size = page.file ? page.file->size() : page.body.size();
  if (is_beyond(request, size)) {
    response.status = 416;
    response.set_header("Content-Range", "bytes */" + std::to_string(size));
  } else if (page.file) {
    send_file(page.file, page.type, response);
  } else {
    response.set_content(page.body, page.type.c_str());
  }
}

void answer(const FolderSite& site, const httplib::Request& request, httplib::Response& response) {
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
  if (page && page->is_report && request.get_header_value("Sec-Fetch-Dest") == "document") {
    page->file = nullptr;
    page->body = kReportFrame;
  }
  if (page) {
    send(*page, request, response);
  } else {
    response.status = 404;
    response.set_content("There is no such result.\n", "text/plain");
  }
}

/// Of every answer, also of those that the library makes itself.
void add_headers(const httplib::Request& /*request*/, httplib::Response& response) {
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cache-Control", "no-cache");
  response.headers.erase("Accept-Ranges");  // that the library says where a HEAD asks
  response.set_header("Accept-Ranges", "none");
  if (!response.has_header(kPolicy)) {
    response.set_header(kPolicy, kFile);
  }
}

httplib::Server::HandlerResponse refuse_writing(const httplib::Request& request,
                                                httplib::Response& response) {
  if (request.method == "GET" || request.method == "HEAD") {
    return httplib::Server::HandlerResponse::Unhandled;
  }
  response.status = 405;
  response.set_header("Allow", "GET, HEAD");
  return httplib::Server::HandlerResponse::Handled;
}

/// The library's server on connections that have an end.
class Server final : public httplib::Server {
 public:
  void end() {
    ended_ = true;
    stop();
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
    HttpConnection connection(socket, ended_);
    bool is_last = false;
    for (int left = kRequestsPerConnection - 1; !is_last && connection.wait_for_request(); --left) {
      bool was_read = false;
      bool has_body = false;
      bool closed = false;
      const bool answered =
          process_request(connection, left == 0, closed, [&](httplib::Request& request) {
            was_read = true;
            request.ranges.clear();  // the library would put thousands of them together in memory
            has_body =
                request.has_header("Content-Length") || request.has_header("Transfer-Encoding");
          });
      is_last = !answered || closed || !was_read || has_body || left == 0;
      if (has_body || !was_read) {
        connection.drain();
      }
    }
    return true;
  }

  std::atomic<bool> ended_ = false;
};

}  // namespace

struct SiteServer::Parts {
  explicit Parts(FolderSite shown) : site(std::move(shown)) {}

  FolderSite site;
  Server server{};
  std::string address{};
  std::atomic<bool> ended = false;
  std::thread listener{};
};

SiteServer::SiteServer(FolderSite site, int port)
    : parts_(std::make_unique<Parts>(std::move(site))) {
  Server& server = parts_->server;
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;  // httplib would also let another program share the port
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
  server.set_keep_alive_max_count(kRequestsPerConnection);  // which it only says
  server.set_pre_routing_handler(refuse_writing);
  server.set_post_routing_handler(add_headers);
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
  parts_->server.end();
  parts_->listener.join();
}

const std::string& SiteServer::address() const {
  return parts_->address;
}

}  // namespace vantage::batch
