// SPDX-License-Identifier: MIT
#include "batch/confined_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>

#include "vantage/core/error.h"

#include "batch/descriptor.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;

constexpr int kFolderFlags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

std::string last_part(const std::string& name) {
  return name.substr(name.find_last_of('/') + 1);
}

std::string parent_of(const std::string& name) {
  const std::size_t slash = name.find_last_of('/');
  return slash == std::string::npos ? std::string() : name.substr(0, slash);
}

/// What is behind a name, links not followed; type 0 if nothing.
mode_t type_of(int parent, const std::string& part) {
  struct stat status {};

  return parent >= 0 && ::fstatat(parent, part.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0
             ? status.st_mode & S_IFMT
             : 0;
}

/// Removes an entry of an open folder. The library's remove_all() follows no link below its
/// argument, and this argument has no link above.
bool remove_entry(int parent, const std::string& part) {
  if (::unlinkat(parent, part.c_str(), 0) == 0 || errno == ENOENT) {
    return true;
  }
  std::error_code error;
  fs::remove_all("/proc/self/fd/" + std::to_string(parent) + "/" + part, error);
  return !error;
}

std::string why(int error) {
  return error == ELOOP || error == ENOTDIR ? "is reached through a link or a file, and nothing is "
                                              "written there; move that away"
                                            : "cannot be written";
}

}  // namespace

ConfinedFolder::ConfinedFolder(std::string path, const std::string& work_name)
    : path_(std::move(path)),
      part_(".work/" + work_name + ".part"),
      folder_(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (folder_ < 0) {
    throw IoError(path_, "cannot be opened", errno);
  }
}

ConfinedFolder::~ConfinedFolder() {
  ::close(folder_);
}

bool ConfinedFolder::is_name(std::string_view name) {
  std::size_t from = 0;
  while (from <= name.size()) {
    const std::size_t slash = std::min(name.find('/', from), name.size());
    const std::string_view part = name.substr(from, slash - from);
    if (part.empty() || part == "." || part == ".." || part.find('\0') != std::string::npos) {
      return false;
    }
    from = slash + 1;
  }
  return true;
}

std::string ConfinedFolder::path_of(const std::string& name) const {
  return (fs::path(path_) / name).string();
}

/// The folder that holds the last part of a name, or −1 and errno.
int ConfinedFolder::open_parent(const std::string& name) const {
  if (!is_name(name)) {
    errno = EINVAL;
    return -1;
  }
  Descriptor folder(::openat(folder_, ".", kFolderFlags));
  for (std::size_t from = 0, slash = 0;
       folder.number() >= 0 && (slash = name.find('/', from)) != std::string::npos;
       from = slash + 1) {
    folder = Descriptor(
        ::openat(folder.number(), name.substr(from, slash - from).c_str(), kFolderFlags));
  }
  return folder.release();
}

bool ConfinedFolder::exists(const std::string& name) const {
  return type_of(Descriptor(open_parent(name)).number(), last_part(name)) != 0;
}

bool ConfinedFolder::is_folder(const std::string& name) const {
  return type_of(Descriptor(open_parent(name)).number(), last_part(name)) == S_IFDIR;
}

bool ConfinedFolder::is_empty_folder(const std::string& name) const {
  const Descriptor parent(open_parent(name));
  const Descriptor folder(
      parent.number() < 0 ? -1 : ::openat(parent.number(), last_part(name).c_str(), kFolderFlags));
  std::error_code error;
  return folder.number() >= 0 &&
         fs::is_empty("/proc/self/fd/" + std::to_string(folder.number()), error) && !error;
}

int ConfinedFolder::open_file(const std::string& name, int flags) const {
  const Descriptor parent(open_parent(name));
  if (parent.number() < 0) {
    return -1;
  }
  Descriptor file(::openat(parent.number(), last_part(name).c_str(),
                           flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666));

  struct stat status {};

  // A second name of a file that is written to would be somebody else's.
  const bool writes = (flags & O_ACCMODE) != O_RDONLY;
  if (file.number() >= 0 && (::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode) ||
                             (writes && status.st_nlink != 1))) {
    errno = EINVAL;
    return -1;
  }
  return file.release();
}

std::string ConfinedFolder::beginning_of(const std::string& name, std::size_t most) const {
  const Descriptor file(open_file(name, O_RDONLY));
  std::string bytes(most, '\0');
  const ssize_t got = file.number() < 0 ? 0 : ::read(file.number(), bytes.data(), most);
  bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return bytes;
}

std::optional<std::string> ConfinedFolder::content_of(const std::string& name) const {
  constexpr off_t kMost = off_t{1} << 31U;
  const Descriptor file(open_file(name, O_RDONLY));

  struct stat status {};

  if (file.number() < 0 || ::fstat(file.number(), &status) != 0 || status.st_size > kMost) {
    return std::nullopt;
  }
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::read(file.number(), bytes.data() + done, bytes.size() - done);
    if (got == 0 || (got < 0 && errno != EINTR)) {
      return std::nullopt;
    }
    done += got > 0 ? static_cast<std::size_t>(got) : 0;
  }
  return bytes;
}

void ConfinedFolder::make_folders(const std::string& name) const {
  if (!is_name(name)) {
    throw IoError(path_of(name), "is no place inside the results' folder");
  }
  for (std::size_t slash = 0; slash != std::string::npos;) {
    slash = name.find('/', slash + 1);
    const std::string upper = name.substr(0, slash);
    const Descriptor parent(open_parent(upper));
    const std::string part = last_part(upper);
    const bool is_made =
        parent.number() >= 0 && ::mkdirat(parent.number(), part.c_str(), 0777) == 0;
    const int error = errno == EEXIST ? ENOTDIR : errno;  // before anything else is asked
    if (!is_made && type_of(parent.number(), part) != S_IFDIR) {
      throw IoError(path_of(upper), why(error), error);
    }
  }
}

void ConfinedFolder::make_new_folder(const std::string& name) const {
  const Descriptor parent(open_parent(name));
  if (parent.number() < 0 || ::mkdirat(parent.number(), last_part(name).c_str(), 0777) != 0) {
    throw IoError(path_of(name), "cannot be created", errno);
  }
}

bool ConfinedFolder::remove(const std::string& name) const {
  const Descriptor parent(open_parent(name));
  return parent.number() < 0 ? errno == ENOENT : remove_entry(parent.number(), last_part(name));
}

void ConfinedFolder::move(const std::string& from, const std::string& to) const {
  if (const std::string above = parent_of(to); !above.empty()) {
    make_folders(above);
  }
  const Descriptor source(open_parent(from));
  const Descriptor target(open_parent(to));
  if (source.number() < 0 || target.number() < 0) {
    throw IoError(path_of(to), why(errno), errno);
  }
  const std::string old_name = last_part(from);
  const std::string new_name = last_part(to);
  const auto rename = [&](unsigned flags) {
    return ::renameat2(source.number(), old_name.c_str(), target.number(), new_name.c_str(),
                       flags) == 0;
  };
  if (rename(0)) {
    return;
  }
  // The place is taken by an earlier result. File systems without an exchange leave a moment in
  // which there is no result, never half of one.
  if (rename(RENAME_EXCHANGE)) {
    remove_entry(source.number(), old_name);
    return;
  }
  remove_entry(target.number(), new_name);
  if (!rename(0)) {
    throw IoError(path_of(to), "cannot be put in place", errno);
  }
}

int ConfinedFolder::create_part() const {
  make_folders(parent_of(part_));
  remove(part_);  // a dead process's: the name is ours
  const int file = open_file(part_, O_WRONLY | O_CREAT | O_EXCL);
  if (file < 0) {
    throw IoError(path_of(part_), "cannot be created", errno);
  }
  return file;
}

void ConfinedFolder::finish_part(const std::string& name) const {
  const Descriptor work(open_parent(part_));
  const Descriptor target(open_parent(name));
  if (work.number() < 0 || target.number() < 0 ||
      ::renameat(work.number(), last_part(part_).c_str(), target.number(),
                 last_part(name).c_str()) != 0) {
    const int error = errno;
    remove(part_);
    throw IoError(path_of(name), why(error), error);
  }
}

void ConfinedFolder::write(const std::string& name, std::string_view bytes) const {
  const Descriptor file(create_part());
  int error = write_all(file.number(), bytes);
  // Some file systems cannot flush and say so; that is no failure.
  if (error == 0 && ::fsync(file.number()) != 0 && errno != EINVAL && errno != ENOTSUP) {
    error = errno;
  }
  if (error != 0) {
    remove(part_);
    throw IoError(path_of(name), "cannot be written", error);
  }
  finish_part(name);
}

}  // namespace vantage::batch
