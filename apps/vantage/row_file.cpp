// SPDX-License-Identifier: MIT
#include "row_file.h"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "vantage/core/error.h"

#include "output_folder.h"
#include "standard_output.h"

namespace vantage::cli {
namespace {

/// Creates a file beside `path` under a name that nothing there has. \return the name, or nothing
/// and errno.
std::string create_beside(const std::string& path, std::FILE*& file) {
  constexpr int kTries = 100;
  const std::string folder = path.substr(0, path.find_last_of('/') + 1);
  for (int i = 0; i < kTries; ++i) {
    // Not made from the file's own name, which may be as long as a name can be.
    std::string part =
        folder + ".vantage-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".part";
    const int made = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (made >= 0) {
      file = ::fdopen(made, "wb");
      return part;
    }
    if (errno != EEXIST) {
      break;
    }
  }
  return {};
}

}  // namespace

RowFile::RowFile(std::string path) : path_(std::move(path)) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (path_ == "-") {
    file_ = stdout;
  } else if (fs::exists(status) && !fs::is_regular_file(status)) {
    // A device or a pipe must not be replaced by a file.
    file_ = std::fopen(path_.c_str(), "wbe");
  } else {
    if (fs::is_symlink(path_, error)) {  // the file that the link names is replaced, not the link
      const fs::path target = fs::canonical(path_, error);
      path_ = error ? path_ : target.string();
    }
    if (const fs::path folder = fs::path(path_).parent_path(); !folder.empty()) {
      make_folder(folder.string());
    }
    part_ = create_beside(path_, file_);
  }
  if (file_ == nullptr) {
    throw IoError(path_, "cannot be created", errno);
  }
}

RowFile::~RowFile() {
  if (file_ != nullptr && file_ != stdout) {
    std::fclose(file_);
    ::unlink(part_.c_str());
  }
}

void RowFile::add(const std::string& row) {
  if (std::fwrite(row.data(), 1, row.size(), file_) != row.size()) {
    throw IoError(file_ == stdout ? "standard output" : path_, "cannot be written", errno);
  }
}

void RowFile::finish() {
  std::FILE* const file = std::exchange(file_, nullptr);
  if (file == stdout) {
    finish_standard_output();
    return;
  }
  int error = std::fflush(file) == 0 ? 0 : errno;
  error = std::fclose(file) == 0 || error != 0 ? error : errno;
  if (error == 0 && !part_.empty() && ::rename(part_.c_str(), path_.c_str()) != 0) {
    error = errno;
  }
  if (error != 0) {
    ::unlink(part_.c_str());
    throw IoError(path_, "cannot be written", error);
  }
}

}  // namespace vantage::cli
