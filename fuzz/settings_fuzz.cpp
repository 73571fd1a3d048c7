// SPDX-License-Identifier: MIT
// Any bytes as the file of --config set options within their ranges, or are refused as usage.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <CLI/CLI.hpp>

#include "memory_file.h"
#include "settings.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  CLI::App program("fuzz", "vantage");
  CLI::App* const command = program.add_subcommand("view");
  int threads = 1;
  double fov = 1.0;
  bool json = false;
  std::string text;
  command->add_option("--threads", threads)->check(CLI::Range(0, 1024));
  command->add_option("--fov", fov)->check(CLI::Range(0.0, 180.0));
  command->add_flag("--json", json);
  command->add_option("--method", text);
  vantage::cli::add_config_flag(*command);
  try {
    program.parse("view --config " + file.path());
    vantage::cli::apply_settings(*command);
  } catch (const CLI::ParseError&) {
  }
  if (threads < 0 || threads > 1024 || !(fov >= 0.0 && fov <= 180.0)) {
    std::abort();
  }
  return 0;
}
