// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace vantage::batch {

/// A database file. \throw IoError on any failure; ENOSPC if the disk is full.
class Database {
 public:
  enum class Mode { Create, Read };

  Database(const std::string& path, Mode mode);

  /// Runs statements that give nothing back.
  void run(const std::string& sql);

  [[nodiscard]] sqlite3* handle() const { return handle_.get(); }

  [[nodiscard]] const std::string& path() const { return path_; }

  /// Throws what the last failed call means.
  [[noreturn]] void fail(const std::string& doing) const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const;
  };

  void open(const std::string& address, int flags);
  [[nodiscard]] bool can_be_read() const;

  std::string path_;
  std::unique_ptr<sqlite3, Close> handle_{};
};

/// A prepared statement: bind 1…n, step, read columns 0…; reusable after reset().
class Statement {
 public:
  Statement(Database& database, const std::string& sql);

  Statement& bind(int index, std::string_view text);
  Statement& bind(int index, std::int64_t number);
  Statement& bind(int index, double number);

  /// Moves to the next row; false at the end.
  bool step();
  /// Runs to the end and makes ready for new values.
  void run();
  void reset();

  [[nodiscard]] int columns() const;
  [[nodiscard]] bool is_null(int column) const;
  [[nodiscard]] bool is_real(int column) const;
  [[nodiscard]] bool is_integer(int column) const;
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] double number(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };

  Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_{};
};

}  // namespace vantage::batch
