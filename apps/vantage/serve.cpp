// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <utility>

#include "batch/site_server.h"
#include "commands.h"
#include "method_flags.h"
#include "standard_output.h"
#include "terminal.h"
#include "value_checks.h"

namespace vantage::cli {
namespace {

/// How often is looked whether to stop.
constexpr std::chrono::milliseconds kPulse{100};

struct ServeCommand {
  std::string folder{};
  int port = 0;

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("DIR", folder, "folder of a batch, or any folder with results of view in it")
        ->required();
    app.add_option("--port", port, "port on 127.0.0.1; 0: any that is free")
        ->check(within(0, 65535))
        ->capture_default_str();
    add_common_flags(app, session.flags);
  }

  void run(Session& session) const {
    const RunContext run = session.run();
    auto site = session.read([&] { return batch::FolderSite(folder, run.stop); });
    const batch::SiteServer server(std::move(site), port);
    session.end_progress();
    const std::string& address = server.address();
    std::printf("%s\n",
                session.flags.json ? ("{\"url\": \"" + address + "\"}").c_str() : address.c_str());
    finish_standard_output();  // nobody would know the address
    session.say(printable(folder) + " is shown at that address; Ctrl-C ends it");
    while (!run.stop.stop_requested()) {
      std::this_thread::sleep_for(kPulse);
    }
    if (Session::is_out_of_time()) {
      run.check();
    }
  }
};

}  // namespace

void add_serve_command(CLI::App& program, Session& session) {
  add_command<ServeCommand>(program, session, "serve",
                            "shows a folder of results in the browser, to this machine only",
                            "Examples:\n"
                            "  vantage serve results\n"
                            "  vantage serve . --port 8080\n"
                            "\n"
                            "Ctrl-C ends it, with exit code 0.");
}

}  // namespace vantage::cli
