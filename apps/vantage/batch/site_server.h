// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "batch/folder_site.h"

namespace vantage::batch {

/// Shows a site at 127.0.0.1, to this machine only, from threads of its own until it is destroyed.
class SiteServer {
 public:
  /// \param port 0: any that is free. \throw Error if the port cannot be had.
  SiteServer(FolderSite site, int port);
  ~SiteServer();
  SiteServer(const SiteServer&) = delete;
  SiteServer& operator=(const SiteServer&) = delete;

  /// "http://127.0.0.1:PORT/".
  [[nodiscard]] const std::string& address() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace vantage::batch
