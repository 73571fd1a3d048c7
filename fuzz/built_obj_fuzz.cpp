// SPDX-License-Identifier: MIT
// An OBJ with material libraries beside it, line by line from its grammar: a model whose faces are the
// same with and without its materials and with long lines broken, or a FormatError.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "vantage/io/model.h"

#include "choices.h"
#include "io/readers.h"
#include "sound_model.h"

namespace {

class ObjDraft {
 public:
  explicit ObjDraft(Choices& choices) : choices_(choices) {}

  std::string model() {
    std::string text;
    for (std::size_t line = 0; line < 64 && !choices_.is_over(); ++line) {
      text += model_line() + end();
    }
    return text;
  }

  std::string library() {
    std::string text;
    for (std::size_t line = 0; line < 16 && !choices_.is_over(); ++line) {
      text += library_line() + end();
    }
    return text;
  }

 private:
  static constexpr std::array<const char*, 4> kNames{"a", "b c", "", "\xC3\xA9"};

  std::string end() {
    constexpr std::array<const char*, 8> kEnds{"\n",   "\n", "\n",     "\n",
                                               "\r\n", "\r", " # x\n", "\t \n"};
    return choices_.of(kEnds);
  }

  std::string numbers(std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
      text += " " + choices_.number();
    }
    return text;
  }

  std::string model_line() {
    constexpr std::array<const char*, 10> kOther{"s off",  "vn 0 0 1", "l 1 2",    "p 1",
                                                 "vp 0 1", "?",        "cstype x", "surf 0 1",
                                                 "#",      "curv 0 1"};
    switch (choices_.below(10)) {
      case 0:
      case 1:
      case 2:
        ++points_;
        return "v" + numbers(choices_.once_in(6) ? choices_.below(9) : 3);
      case 3:
      case 4:
        return face();
      case 5:
        ++uvs_;
        return "vt" + numbers(choices_.below(4));
      case 6:
        return std::string("usemtl ") + choices_.of(kNames);
      case 7:
        return choices_.once_in(4) ? "mtllib absent.mtl a.mtl" : "mtllib a.mtl";
      case 8:
        return std::string(choices_.below(2) == 0 ? "g " : "o ") + choices_.of(kNames);
      default:
        return choices_.of(kOther);
    }
  }

  /// Of a vertex from 1 on, or from the last one back.
  std::string corner(std::size_t count) {
    if (count == 0 || choices_.once_in(64)) {
      return choices_.index(count + 2);
    }
    const std::size_t place = 1 + choices_.below(count);
    return choices_.once_in(4) ? "-" + std::to_string(place) : std::to_string(place);
  }

  std::string face() {
    constexpr std::array<const char*, 4> kJoints{"", "/", "//", "/x/"};
    std::string text = choices_.once_in(16) ? "fo" : "f";
    for (std::size_t i = choices_.once_in(8) ? choices_.below(12) : 3; i > 0; --i) {
      text += " " + corner(points_);
      if (const char* const joint = kJoints[choices_.once_in(16) ? 3 : choices_.below(3)];
          *joint != 0) {
        text += joint + corner(uvs_);
      }
    }
    return text;
  }

  std::string library_line() {
    constexpr std::array<const char*, 6> kOptions{"",           " -s 2 2 2",  " -o 1e999 0",
                                                  " -clamp on", " -mm 0 nan", " -t"};
    constexpr std::array<const char*, 4> kPictures{" a.png", " ../a.png", "", " a b.png"};
    constexpr std::array<const char*, 3> kMaps{"map_Kd", "map_d", "map_Ks"};
    switch (choices_.below(5)) {
      case 0:
        return std::string("newmtl ") + choices_.of(kNames);
      case 1:
        return "Kd" + numbers(choices_.below(5));
      case 2:
        return "d" + numbers(1);
      case 3:
        return "Tr" + numbers(choices_.below(2));
      default:
        return std::string(choices_.of(kMaps)) + choices_.of(kOptions) + choices_.of(kPictures);
    }
  }

  Choices& choices_;
  std::size_t points_ = 0;
  std::size_t uvs_ = 0;
};

/// The same, each line that is no comment and ends plainly broken before its second word.
std::string broken_lines(const std::string& text) {
  std::string result;
  bool is_first = true;
  for (const char c : text) {
    const bool is_here = c == ' ' && is_first;
    result += is_here ? std::string(" \\\n") : std::string(1, c);
    is_first = c == '\n' || c == '\r' || (is_first && c != ' ');
  }
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  ObjDraft draft(choices);
  const std::string library =
      choices.below(4) == 1 ? draft.library() : "newmtl a\nKd 1 0 0\nd 0.5\n";
  const std::string text = draft.model();
  const auto side_files = [&](const std::string& path) {
    return path == "a.mtl" ? vantage::SideFile{library, {}} : vantage::SideFile{{}, "is not there"};
  };
  const auto read = [&](const std::string& bytes, bool has_look) {
    return vantage::parse_obj(bytes, "fuzz.obj", {}, {{}, side_files, {.appearance = has_look}});
  };
  const auto model = sound_model([&] { return read(text, true); });
  expect_same(model, sound_model([&] { return read(text, false); }));
  // Comments go on where lines are broken.
  if (text.find('#') == std::string::npos) {
    expect_same(model, sound_model([&] { return read(broken_lines(text), true); }));
  }
  return 0;
}
