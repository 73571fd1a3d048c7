// SPDX-License-Identifier: MIT
#include "orientation/candidate_model.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <span>
#include <utility>

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

[[noreturn]] void refuse(std::string_view line) {
  throw InvalidInput("the orientation table has a line that is not understood: " +
                     std::string(line));
}

}  // namespace

/// Reads one line's tree.
class TreeReader {
 public:
  TreeReader(CandidateModel& model, std::span<const std::string_view> words, std::string_view line)
      : model_(model), words_(words), line_(line) {}

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

  /// "NAME", "NAME-opposite" or "NAME-mean".
  static CandidateModel::Term term_of(std::string_view word) {
    using Less = CandidateModel::Less;
    const Less less = word.ends_with("-opposite") ? Less::Opposite
                      : word.ends_with("-mean")   ? Less::Mean
                                                  : Less::Nothing;
    return {std::string(word.substr(0, less == Less::Nothing ? word.size() : word.rfind('-'))),
            less};
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
    if (depth == kDeepest) {
      refuse(line_);
    }
    model_.nodes_[here].term = model_.place_of(term_of(first));
    model_.nodes_[here].limit = number(word());
    node(depth + 1);
    model_.nodes_[here].above = model_.nodes_.size();
    node(depth + 1);
  }

  CandidateModel& model_;
  std::span<const std::string_view> words_;
  std::string_view line_;
  std::size_t next_ = 0;
};

CandidateModel::CandidateModel(std::string_view table, std::string_view subject) {
  while (!table.empty()) {
    const std::string_view line = table.substr(0, table.find('\n'));
    table.remove_prefix(std::min(line.size() + 1, table.size()));
    const std::vector<std::string_view> words = words_of(line);
    if (words.size() < 3 || words[0] != subject) {
      continue;
    }
    const std::optional<double> value = number_of(words[2]);
    if (words[1] == "tree") {
      TreeReader(*this, std::span(words).subspan(2), line).read();
    } else if (words[1] == "convention_log_odds" && value) {
      convention_log_odds = *value;
    } else if (words[1] == "threshold" && value) {
      threshold = *value;
    } else if (words[1] == "share" && value) {
      share = *value;
    } else {
      refuse(line);
    }
  }
}

std::size_t CandidateModel::place_of(Term term) {
  const auto found = std::find(terms_.begin(), terms_.end(), term);
  const auto place = static_cast<std::size_t>(found - terms_.begin());
  if (found == terms_.end()) {
    terms_.push_back(std::move(term));
  }
  return place;
}

std::vector<double> CandidateModel::values_of(const Term& term,
                                              const std::vector<Evidence>& candidates) {
  std::vector<double> plain;
  double mean = 0.0;
  for (const Evidence& candidate : candidates) {
    const auto found = std::find_if(
        candidate.begin(), candidate.end(),
        [&](const OrientationFeature& feature) { return feature.name == term.feature; });
    if (found == candidate.end()) {
      throw InvalidInput("the orientation table names a feature that is not measured: " +
                         term.feature);
    }
    plain.push_back(found->value);
    mean += found->value / static_cast<double>(candidates.size());
  }
  std::vector<double> values = plain;
  for (std::size_t c = 0; c < values.size(); ++c) {
    values[c] -= term.less == Less::Opposite ? plain[c ^ std::size_t{1}]
                 : term.less == Less::Mean   ? mean
                                             : 0.0;
  }
  return values;
}

std::vector<double> CandidateModel::scores(const std::vector<Evidence>& candidates) const {
  std::vector<std::vector<double>> values;  // of each term
  values.reserve(terms_.size());
  for (const Term& term : terms_) {
    values.push_back(values_of(term, candidates));
  }
  std::vector<double> result(candidates.size(), 0.0);
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    for (const std::size_t root : roots_) {
      std::size_t at = root;
      while (nodes_[at].above != 0) {
        at = values[nodes_[at].term][c] < nodes_[at].limit ? at + 1 : nodes_[at].above;
      }
      result[c] += nodes_[at].limit;
    }
  }
  return result;
}

}  // namespace vantage
