// SPDX-License-Identifier: MIT
#include "batch/sqlite.h"

#include <cerrno>

#include <sqlite3.h>
#include <sys/stat.h>

#include "vantage/core/error.h"

#include "batch/no_room.h"

namespace vantage::batch {

namespace {

std::int64_t bytes_in_file(const std::string& path) {
  struct stat status {};

  return ::stat(path.c_str(), &status) == 0 ? std::int64_t{status.st_size} : 0;
}

/// The file as one that nobody changes.
std::string read_only_address(const std::string& path) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string address = "file:";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    address += '%';
    address += kDigits[byte >> 4U];
    address += kDigits[byte & 15U];
  }
  return address + "?immutable=1";
}

}  // namespace

void Database::Close::operator()(sqlite3* handle) const {
  sqlite3_close_v2(handle);
}

Database::Database(const std::string& path, Mode mode) : path_(path) {
  open(path,
       mode == Mode::Create ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READWRITE);
  // Where nothing can be written, SQLite finds no place for its index of the log, and a log without
  // one is not read: but without a log the file alone is all there is.
  if (mode == Mode::Read && !can_be_read() && bytes_in_file(path + "-wal") == 0) {
    open(read_only_address(path), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
  }
}

void Database::open(const std::string& address, int flags) {
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(address.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) {
    fail("cannot be opened");
  }
  sqlite3_extended_result_codes(handle, 1);
  sqlite3_busy_timeout(handle, 10'000);
}

bool Database::can_be_read() const {
  sqlite3_exec(handle_.get(), "SELECT 1 FROM sqlite_schema", nullptr, nullptr, nullptr);
  const int code = sqlite3_errcode(handle_.get()) & 0xff;
  return code != SQLITE_CANTOPEN && code != SQLITE_READONLY && code != SQLITE_IOERR;
}

void Database::fail(const std::string& doing) const {
  const int code = handle_ ? sqlite3_errcode(handle_.get()) : SQLITE_NOMEM;
  const int system = handle_ ? sqlite3_system_errno(handle_.get()) : ENOMEM;
  if (code == SQLITE_FULL || (code == SQLITE_IOERR_WRITE && system == ENOSPC) || system == ENOSPC) {
    throw IoError(path_, kNoRoom, ENOSPC);
  }
  const char* why = handle_ ? sqlite3_errmsg(handle_.get()) : "out of memory";
  throw IoError(path_, doing + ": " + why);
}

void Database::run(const std::string& sql) {
  if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
    fail("cannot be used");
  }
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Statement::Statement(Database& database, const std::string& sql) : database_(&database) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database.handle(), sql.c_str(), static_cast<int>(sql.size()), &statement,
                         nullptr) != SQLITE_OK) {
    database.fail("cannot be used");
  }
  statement_.reset(statement);
}

Statement& Statement::bind(int index, std::string_view text) {
  // SQLite copies the text only when told that it may vanish.
  sqlite3_bind_text64(statement_.get(), index, text.data() == nullptr ? "" : text.data(),
                      text.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  return *this;
}

Statement& Statement::bind(int index, std::int64_t number) {
  sqlite3_bind_int64(statement_.get(), index, number);
  return *this;
}

Statement& Statement::bind(int index, double number) {
  sqlite3_bind_double(statement_.get(), index, number);
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) {
    // What gives rows asks. SQLite counts the end of a transaction, too, as something that only reads.
    database_->fail(columns() > 0 ? "cannot be read" : "cannot be written");
  }
  return code == SQLITE_ROW;
}

void Statement::run() {
  while (step()) {
  }
  reset();
}

void Statement::reset() {
  sqlite3_reset(statement_.get());
  sqlite3_clear_bindings(statement_.get());
}

int Statement::columns() const {
  return sqlite3_column_count(statement_.get());
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

bool Statement::is_real(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_FLOAT;
}

bool Statement::is_integer(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_INTEGER;
}

std::string Statement::text(int column) const {
  const auto* bytes = sqlite3_column_text(statement_.get(), column);
  const int count = sqlite3_column_bytes(statement_.get(), column);
  return bytes == nullptr
             ? std::string()
             : std::string(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double Statement::number(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}

}  // namespace vantage::batch
