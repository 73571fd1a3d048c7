// SPDX-License-Identifier: MIT
#include "orientation/candidate_model.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "vantage/core/error.h"

namespace vantage {
namespace {

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(' '), line.size());
    if (end > 0) {
      words.push_back(line.substr(0, end));
    }
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return words;
}

std::optional<double> number_of(std::string_view word) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) {
    return std::nullopt;
  }
  return value;
}

/// Column of "NAME", "NAME-opposite" or "NAME-mean".
std::optional<std::size_t> column_of(std::string_view word,
                                     std::span<const std::string_view> features) {
  std::size_t block = 0;
  if (word.ends_with("-opposite")) {
    block = 1;
  } else if (word.ends_with("-mean")) {
    block = 2;
  }
  const std::string_view name = word.substr(0, block == 0 ? word.size() : word.rfind('-'));
  const auto found = std::find(features.begin(), features.end(), name);
  if (found == features.end()) {
    return std::nullopt;
  }
  return block * features.size() + static_cast<std::size_t>(found - features.begin());
}

[[noreturn]] void refuse(std::string_view line) {
  throw InvalidInput("the orientation table has a line that is not understood: " +
                     std::string(line));
}

}  // namespace

/// Reads one line's tree.
class TreeReader {
 public:
  TreeReader(CandidateModel& model, std::span<const std::string_view> words,
             std::span<const std::string_view> features, std::string_view line)
      : model_(model), words_(words), features_(features), line_(line) {}

  void read() {
    model_.roots_.push_back(model_.nodes_.size());
    node(0);
    if (next_ != words_.size()) {
      refuse(line_);
    }
  }

 private:
  std::string_view word() {
    if (next_ == words_.size()) {
      refuse(line_);
    }
    return words_[next_++];
  }

  double number(std::string_view text) {
    const std::optional<double> value = number_of(text);
    if (!value) {
      refuse(line_);
    }
    return *value;
  }

  void node(int depth) {
    constexpr int kDeepest = 16;
    const std::size_t here = model_.nodes_.size();
    model_.nodes_.emplace_back();
    const std::string_view first = word();
    if (const std::optional<double> leaf = number_of(first)) {
      model_.nodes_[here].limit = *leaf;
      return;
    }
    const std::optional<std::size_t> column = column_of(first, features_);
    if (!column || depth == kDeepest) {
      refuse(line_);
    }
    model_.nodes_[here].column = *column;
    model_.nodes_[here].limit = number(word());
    node(depth + 1);
    model_.nodes_[here].above = model_.nodes_.size();
    node(depth + 1);
  }

  CandidateModel& model_;
  std::span<const std::string_view> words_;
  std::span<const std::string_view> features_;
  std::string_view line_;
  std::size_t next_ = 0;
};

CandidateModel::CandidateModel(std::string_view table, std::string_view subject,
                               std::span<const std::string_view> features) {
  while (!table.empty()) {
    const std::string_view line = table.substr(0, table.find('\n'));
    table.remove_prefix(std::min(line.size() + 1, table.size()));
    const std::vector<std::string_view> words = words_of(line);
    if (words.size() < 3 || words[0] != subject) {
      continue;
    }
    const std::optional<double> value = number_of(words[2]);
    if (words[1] == "tree") {
      TreeReader(*this, std::span(words).subspan(2), features, line).read();
    } else if (words[1] == "witness" && value) {
      witness = *value;
    } else if (words[1] == "threshold" && value) {
      threshold = *value;
    } else if (words[1] == "share" && value) {
      share = *value;
    } else {
      refuse(line);
    }
  }
}

std::vector<double> CandidateModel::scores(const std::vector<std::vector<double>>& values) const {
  const std::size_t features = values.front().size();
  std::vector<double> mean(features, 0.0);
  for (const std::vector<double>& of_one : values) {
    for (std::size_t i = 0; i < features; ++i) {
      mean[i] += of_one[i] / static_cast<double>(values.size());
    }
  }
  std::vector<double> result(values.size(), 0.0);
  for (std::size_t c = 0; c < values.size(); ++c) {
    const std::vector<double>& opposite = values[c ^ std::size_t{1}];
    const auto value_at = [&](std::size_t column) {
      const std::size_t i = column % features;
      const double plain = values[c][i];
      return column < features       ? plain
             : column < 2 * features ? plain - opposite[i]
                                     : plain - mean[i];
    };
    for (const std::size_t root : roots_) {
      std::size_t at = root;
      while (nodes_[at].above != 0) {
        at = value_at(nodes_[at].column) < nodes_[at].limit ? at + 1 : nodes_[at].above;
      }
      result[c] += nodes_[at].limit;
    }
  }
  return result;
}

}  // namespace vantage
