// SPDX-License-Identifier: MIT
#include "choice/choice_table.h"

#include <locale>
#include <sstream>
#include <string>

#include "vantage/core/error.h"

#include "choice/choice_table_text.h"

namespace vantage {
namespace {

[[noreturn]] void refuse_choice_line(const std::string& line) {
  throw InvalidInput("the table of choices has a line that is not understood: " + line);
}

/// "HEIGHT WIDTH MIRRORS SIDE UP FRONT", mirrors of side, front and up as three digits.
RecordedChoice read_choice(std::istream& words, const std::string& line) {
  RecordedChoice choice;
  std::string mirrors;
  Vec3& d = choice.direction;
  words >> choice.shape.height >> choice.shape.width >> mirrors >> d.x() >> d.y() >> d.z();
  if (!words || mirrors.size() != 3 || !(d.norm() > 0.5)) {
    refuse_choice_line(line);
  }
  choice.shape.mirrors_side = mirrors[0] == '1';
  choice.shape.mirrors_front = mirrors[1] == '1';
  choice.shape.mirrors_up = mirrors[2] == '1';
  d.normalize();
  return choice;
}

void read_constant(ChoiceTable& table, const std::string& kind, std::istream& words,
                   const std::string& line) {
  double* const constant = kind == "habit"          ? &table.habit_weight
                           : kind == "significance" ? &table.significance_weight
                           : kind == "bandwidth"    ? &table.bandwidth
                           : kind == "mirror"       ? &table.mirror_weight
                                                    : nullptr;
  if (constant == nullptr || !(words >> *constant)) {
    refuse_choice_line(line);
  }
}

}  // namespace

ChoiceTable parse_choice_table(std::string_view text) {
  ChoiceTable table;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string kind;
    words >> kind;
    if (kind == "view") {
      table.choices.push_back(read_choice(words, line));
    } else if (!kind.empty() && !kind.starts_with('#')) {
      read_constant(table, kind, words, line);
    }
  }
  if (table.choices.empty() || !(table.bandwidth > 0.0)) {
    throw InvalidInput("the table of choices has no view or no bandwidth");
  }
  return table;
}

const ChoiceTable& choice_table() {
  static const ChoiceTable table = parse_choice_table(kChoiceTable);
  return table;
}

}  // namespace vantage
