// SPDX-License-Identifier: MIT
#include "terminal_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "vantage/io/write.h"

namespace vantage::cli {
namespace {

/// Terminals answer within a few milliseconds; over a slow line this much is waited.
constexpr int kAnswerMs = 250;
/// Longest side of pictures for terminals that draw pixels.
constexpr int kPixelSide = 480;
/// Most characters across: wider is not clearer.
constexpr int kMostColumns = 96;
/// Lines that the summary needs.
constexpr int kSummaryLines = 10;

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view{} : std::string_view(value);
}

/// What the terminal answers to the question for its primary attributes; empty if it does not.
std::string attributes_answer() {
  const int terminal = ::open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios before{};
  if (terminal < 0 || ::tcgetattr(terminal, &before) != 0) {
    if (terminal >= 0) {
      ::close(terminal);
    }
    return {};
  }
  termios raw = before;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  ::tcsetattr(terminal, TCSANOW, &raw);
  std::string answer;
  constexpr std::string_view kQuestion = "\033[c";
  if (::write(terminal, kQuestion.data(), kQuestion.size()) > 0) {
    pollfd waiting{terminal, POLLIN, 0};
    char byte = 0;
    while (answer.size() < 64 && ::poll(&waiting, 1, kAnswerMs) > 0 &&
           ::read(terminal, &byte, 1) == 1) {
      answer += byte;
      if (byte == 'c') {
        break;
      }
    }
  }
  ::tcsetattr(terminal, TCSANOW, &before);
  ::close(terminal);
  return answer;
}

/// Whether "\033[?62;4;22c" lists attribute 4, sixel graphics.
bool lists_sixel(const std::string& answer) {
  const std::size_t from = answer.find('?');
  if (from == std::string::npos) {
    return false;
  }
  const std::string list = ";" + answer.substr(from + 1, answer.size() - from - 2) + ";";
  return list.find(";4;") != std::string::npos;
}

void append_colour(std::string& text, bool foreground, const std::uint8_t* rgb, bool true_colour) {
  text += foreground ? "\033[38;" : "\033[48;";
  if (true_colour) {
    text += "2;" + std::to_string(rgb[0]) + ";" + std::to_string(rgb[1]) + ";" +
            std::to_string(rgb[2]) + "m";
    return;
  }
  // The cube of 6 × 6 × 6 colours and the 24 greys of terminals with 256 colours.
  const int spread = std::max({rgb[0], rgb[1], rgb[2]}) - std::min({rgb[0], rgb[1], rgb[2]});
  int index = 0;
  if (spread < 16) {
    index = 232 + std::clamp((rgb[1] - 3) / 10, 0, 23);
  } else {
    const auto level = [](int value) {
      return value < 48 ? 0 : value < 115 ? 1 : (value - 35) / 40;
    };
    index = 16 + 36 * level(rgb[0]) + 6 * level(rgb[1]) + level(rgb[2]);
  }
  text += "5;" + std::to_string(index) + "m";
}

bool solid(const Image& image, int x, int y) {
  return y < image.height && image.pixel(x, y)[3] >= 128;
}

/// Without colours: ten steps of ink, the upper and lower pixel of a character together.
std::string ink_blocks(const Image& image) {
  constexpr std::string_view kInk = " .:-=+*#%@";
  std::string text;
  for (int y = 0; y < image.height; y += 2) {
    for (int x = 0; x < image.width; ++x) {
      int light = 0;
      int count = 0;
      for (const int row : {y, y + 1}) {
        if (solid(image, x, row)) {
          light += image.pixel(x, row)[1];
          ++count;
        }
      }
      const auto step = count == 0 ? 0 : 1 + light * 8 / (255 * count);
      text += kInk[static_cast<std::size_t>(step)];
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

std::string half_blocks(const Image& image) {
  if (!environment("NO_COLOR").empty()) {
    return ink_blocks(image);
  }
  const std::string_view depth = environment("COLORTERM");
  const bool true_colour = depth == "truecolor" || depth == "24bit";
  std::string text;
  for (int y = 0; y < image.height; y += 2) {
    std::string blank;
    for (int x = 0; x < image.width; ++x) {
      const bool upper = solid(image, x, y);
      const bool lower = solid(image, x, y + 1);
      if (!upper && !lower) {
        blank += ' ';
        continue;
      }
      text += std::exchange(blank, {});
      append_colour(text, true, image.pixel(x, upper ? y : y + 1), true_colour);
      if (upper && lower) {
        append_colour(text, false, image.pixel(x, y + 1), true_colour);
      }
      text += upper ? "▀\033[0m" : "▄\033[0m";
    }
    text += '\n';
  }
  return text;
}

std::string kitty_picture(const Image& image) {
  constexpr std::size_t kChunk = 4096;  // the most that the protocol allows
  const std::string data = base64(png_bytes(image));
  std::string text;
  for (std::size_t at = 0; at < data.size(); at += kChunk) {
    const bool more = at + kChunk < data.size();
    text += at == 0 ? "\033_Ga=T,f=100,q=2,m=" : "\033_Gm=";
    text += more ? "1;" : "0;";
    text += data.substr(at, kChunk) + "\033\\";
  }
  return text + "\n";
}

std::string iterm_picture(const Image& image) {
  const std::string png = png_bytes(image);
  return "\033]1337;File=inline=1;size=" + std::to_string(png.size()) +
         ";width=" + std::to_string(image.width) + "px:" + base64(png) + "\a\n";
}

/// One row of six pixels' bits as sixels; four or more equal ones as "!count".
void append_runs(std::string& text, const std::vector<std::uint8_t>& bits) {
  for (std::size_t at = 0; at < bits.size();) {
    std::size_t end = at + 1;
    while (end < bits.size() && bits[end] == bits[at]) {
      ++end;
    }
    const auto sixel = static_cast<char>(63 + bits[at]);
    if (end - at > 3) {
      text += "!" + std::to_string(end - at) + sixel;
    } else {
      text.append(end - at, sixel);
    }
    at = end;
  }
}

/// Colours are a cube of 6 × 6 × 6; what is transparent is not drawn.
std::string sixel_picture(const Image& image) {
  constexpr int kLevels = 6;
  constexpr std::size_t kColours = 216;  // kLevels cubed
  constexpr int kNone = -1;
  const auto colour_at = [&](int x, int y) {
    if (!solid(image, x, y)) {
      return kNone;
    }
    // Ordered dithering in squares of two by two keeps shades from breaking into bands.
    constexpr std::array<int, 4> kOrder{0, 2, 3, 1};
    const int nudge = (2 * kOrder[static_cast<std::size_t>(2 * (y % 2) + x % 2)] - 3) * 51 / 8;
    int index = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      index = kLevels * index + (std::clamp(image.pixel(x, y)[c] + nudge, 0, 255) + 25) / 51;
    }
    return index;
  };
  std::string text =
      "\033P0;1q\"1;1;" + std::to_string(image.width) + ";" + std::to_string(image.height);
  for (int i = 0; i < kLevels * kLevels * kLevels; ++i) {
    text += "#" + std::to_string(i) + ";2;" + std::to_string(i / 36 * 20) + ";" +
            std::to_string(i / 6 % 6 * 20) + ";" + std::to_string(i % 6 * 20);
  }
  for (int y = 0; y < image.height; y += 6) {
    std::array<std::vector<std::uint8_t>, kColours> planes{};
    for (int x = 0; x < image.width; ++x) {
      for (int row = 0; row < 6; ++row) {
        const int colour = colour_at(x, y + row);
        if (colour != kNone) {
          std::vector<std::uint8_t>& plane = planes[static_cast<std::size_t>(colour)];
          plane.resize(static_cast<std::size_t>(image.width), 0);
          plane[static_cast<std::size_t>(x)] |=
              static_cast<std::uint8_t>(1U << static_cast<unsigned>(row));
        }
      }
    }
    for (std::size_t colour = 0; colour < planes.size(); ++colour) {
      if (!planes[colour].empty()) {
        text += "#" + std::to_string(colour);
        append_runs(text, planes[colour]);
        text += '$';
      }
    }
    text += '-';
  }
  return text + "\033\\\n";
}

}  // namespace

PictureProtocol terminal_protocol() {
  if (::isatty(STDOUT_FILENO) == 0) {
    return PictureProtocol::Blocks;
  }
  const std::string_view program = environment("TERM_PROGRAM");
  const std::string_view term = environment("TERM");
  // Inside tmux and screen these are of the terminal outside, which does not see our bytes.
  if (environment("TMUX").empty() && environment("STY").empty()) {
    if (!environment("KITTY_WINDOW_ID").empty() || term == "xterm-kitty" ||
        term == "xterm-ghostty" || program == "ghostty" || program == "WezTerm" ||
        !environment("KONSOLE_VERSION").empty()) {
      return PictureProtocol::Kitty;
    }
    if (program == "iTerm.app" || program == "mintty" || environment("LC_TERMINAL") == "iTerm2") {
      return PictureProtocol::Iterm;
    }
  }
  return term != "dumb" && lists_sixel(attributes_answer()) ? PictureProtocol::Sixel
                                                            : PictureProtocol::Blocks;
}

TerminalSize terminal_size() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
    return {};
  }
  return {size.ws_col, size.ws_row};
}

PictureExtent picture_extent(PictureProtocol protocol, const TerminalSize& terminal,
                             double aspect) {
  double width = kPixelSide;
  double height = kPixelSide;
  if (protocol == PictureProtocol::Blocks) {
    width = std::min(terminal.columns, kMostColumns);
    height = 2.0 * std::max(terminal.rows - kSummaryLines, 8);
  }
  const double scale = std::min(width, height * aspect);
  return {std::max(1, static_cast<int>(scale)), std::max(1, static_cast<int>(scale / aspect))};
}

std::string terminal_picture(const Image& image, PictureProtocol protocol) {
  switch (protocol) {
    case PictureProtocol::Kitty:
      return kitty_picture(image);
    case PictureProtocol::Iterm:
      return iterm_picture(image);
    case PictureProtocol::Sixel:
      return sixel_picture(image);
    case PictureProtocol::Blocks:
      break;
  }
  return half_blocks(image);
}

}  // namespace vantage::cli
